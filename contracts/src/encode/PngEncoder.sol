// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Png} from "./Png.sol";
import {PngErrors} from "./PngErrors.sol";

/// @title PngEncoder: PNG files of the renderer's bitmaps, for the Studio and all contracts that would rather call than carry the code.
contract PngEncoder is PngErrors {
    /// @notice A PNG file of a bitmap, each pixel a square of `scale` pixels, 1..8.
    function encode(bytes calldata bmp, uint256 scale) external pure returns (bytes memory) {
        answer(Png.encode(bmp, scale));
    }

    /// @notice The same as a `data:` URI.
    function dataURI(bytes calldata bmp, uint256 scale) external pure returns (string memory) {
        answer(bytes(Png.dataURI(bmp, scale)));
    }

    /// @dev Ends the call with bytes from where they are: the compiler would copy them.
    function answer(bytes memory data) private pure {
        assembly ("memory-safe") {
            let begin := sub(data, 0x20)
            let size := mload(data)
            mstore(begin, 0x20)
            mstore(add(add(data, 0x20), size), 0)
            return(begin, add(0x40, and(add(size, 0x1f), not(0x1f))))
        }
    }
}
