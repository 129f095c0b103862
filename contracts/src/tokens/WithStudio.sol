// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {IStudio} from "../interfaces/IStudio.sol";
import {IWithStudio} from "../interfaces/IWithStudio.sol";
import {Json} from "./Json.sol";
import {Utf8} from "./Utf8.sol";

/// @title WithStudio: a contract that gives names to scenes stored by the Studio.
abstract contract WithStudio is IWithStudio {
    uint256 internal constant MAX_NAME = 64;

    IStudio public immutable studio;

    constructor(IStudio studio_) {
        if (address(studio_).code.length == 0) revert NoStudio(address(studio_));
        studio = studio_;
    }

    function checkName(string calldata name_) internal pure {
        uint256 length = bytes(name_).length;
        if (length == 0 || length > MAX_NAME) revert NameLength(length, MAX_NAME);
        uint256 valid = Utf8.validLength(bytes(name_));
        if (valid != length) revert NameNotUtf8(valid);
    }

    /// @dev Ends the call with the `data:` URI of a document.
    /// @param head The document up to its picture.
    /// @param scene The pointer to the scene of the picture; each of its pixels becomes a square of `scale` x `scale` pixels.
    function show(bytes memory head, address scene, uint256 scale) internal view {
        show(head, abi.encodeWithSignature("renderDataURI(address,uint256)", scene, scale));
    }

    /// @dev As above, with the calldata by which the Studio draws the picture.
    function show(bytes memory head, bytes memory request) internal view {
        uint256 data;
        assembly ("memory-safe") {
            data := add(request, 0x20)
        }
        Json.answer(head, address(studio), data, request.length);
    }
}
