// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Strings} from "@openzeppelin/contracts/utils/Strings.sol";
import {Base64} from "../encode/Base64.sol";

/// @title Json: what marketplaces and wallets read of a token.
library Json {
    using Strings for uint256;

    /// @notice A trait whose value is text.
    function trait(string memory kind, string memory value) internal pure returns (string memory) {
        return string.concat('{"trait_type":"', kind, '","value":"', Strings.escapeJSON(value), '"}');
    }

    /// @notice A trait whose value is a number.
    function trait(string memory kind, uint256 value) internal pure returns (string memory) {
        return string.concat('{"trait_type":"', kind, '","value":', value.toString(), "}");
    }

    /// @notice A trait that is there or not.
    function trait(string memory kind, bool value) internal pure returns (string memory) {
        return trait(kind, value ? "Yes" : "No");
    }

    /// @notice The metadata of a token.
    /// @param traits Separated by commas.
    /// @param image A `data:` URI.
    function token(string memory name, string memory description, string memory traits, string memory image)
        internal
        pure
        returns (bytes memory)
    {
        return abi.encodePacked(
            '{"name":"',
            Strings.escapeJSON(name),
            '","description":"',
            Strings.escapeJSON(description),
            '","attributes":[',
            traits,
            '],"image":"',
            image,
            '"}'
        );
    }

    /// @notice The metadata of a collection, as ERC-7572 has it.
    /// @param image A `data:` URI; none if it is empty.
    function collection(string memory name, string memory symbol, string memory description, string memory image)
        internal
        pure
        returns (bytes memory)
    {
        return abi.encodePacked(
            '{"name":"',
            Strings.escapeJSON(name),
            '","symbol":"',
            Strings.escapeJSON(symbol),
            '","description":"',
            Strings.escapeJSON(description),
            bytes(image).length == 0 ? "" : '","image":"',
            image,
            '"}'
        );
    }

    /// @notice The `data:` URI of a document.
    function uri(bytes memory json) internal pure returns (string memory) {
        return dataUri("data:application/json;base64,", json);
    }

    /// @notice A `data:` URI of bytes of any kind.
    /// @param head All before the characters of the bytes.
    function dataUri(string memory head, bytes memory data) internal pure returns (string memory text) {
        uint256 begin;
        uint256 last;
        uint256 neighbour;
        uint256 target;
        assembly ("memory-safe") {
            text := mload(0x40)
            target := add(add(text, 0x20), mload(head))
            mcopy(add(text, 0x20), add(head, 0x20), mload(head))
            // the encoder wants zeros behind the data: what is there comes back afterwards
            begin := add(data, 0x20)
            last := add(begin, mload(data))
            neighbour := mload(last)
            mstore(last, 0)
        }
        uint256 end = Base64.encode(begin, data.length, target);
        assembly ("memory-safe") {
            mstore(last, neighbour)
            mstore(text, sub(sub(end, text), 0x20))
            mstore(end, 0)
            mstore(0x40, and(add(end, 0x3f), not(0x1f)))
        }
    }
}
