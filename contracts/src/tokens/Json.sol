// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Strings} from "@openzeppelin/contracts/utils/Strings.sol";
import {Base64} from "../encode/Base64.sol";

/// @title Json: token metadata for marketplaces and wallets. Text arguments must already be escaped for JSON.
library Json {
    using Strings for address;
    using Strings for uint256;

    /// @dev The size of the `data:` URI prefix of a document; and of the end of a document behind its picture.
    uint256 private constant SCHEME_SIZE = 29;
    uint256 private constant TAIL_SIZE = 2;

    /// @notice Returns a trait with a text value.
    function trait(string memory kind, string memory value) internal pure returns (string memory) {
        return string.concat('{"trait_type":"', kind, '","value":"', value, '"}');
    }

    /// @notice Returns a trait with a number. The display type makes marketplaces show the number instead of a rank.
    function trait(string memory kind, uint256 value) internal pure returns (string memory) {
        return string.concat('{"display_type":"number","trait_type":"', kind, '","value":', value.toString(), "}");
    }

    /// @notice Returns a trait that is present or absent.
    function trait(string memory kind, bool value) internal pure returns (string memory) {
        return trait(kind, value ? "Yes" : "No");
    }

    /// @notice Returns an optional field, such as `external_url`.
    function field(string memory name, string memory value) internal pure returns (string memory) {
        return string.concat('","', name, '":"', value);
    }

    /// @notice Returns the web3:// URL of a contract call (ERC-6860).
    /// @param path The function and its arguments, such as `/render/12?mime.content=image/bmp`.
    function link(address target, string memory path) internal view returns (string memory) {
        return string.concat("web3://", target.toHexString(), ":", block.chainid.toString(), path);
    }

    /// @notice Returns the web3:// URL of the picture of a stored scene.
    function picture(address studio, address scene, uint256 scale) internal view returns (string memory) {
        return link(studio, string.concat("/renderPNG/", scene.toHexString(), "/", scale.toString(), "?mime.type=png"));
    }

    /// @notice Returns the metadata of a token up to its picture.
    /// @param fields The concatenated results of `field`.
    /// @param traits The traits, separated by commas.
    function token(string memory name, string memory description, string memory fields, string memory traits)
        internal pure returns (bytes memory)
    {
        return abi.encodePacked('{"name":"', name, '","description":"', description, fields, '","attributes":[', traits, '],"image":"');
    }

    /// @notice Returns the metadata of a collection up to its picture (ERC-7572).
    /// @param banner A wide picture for the top of a page, as a `data:` URI.
    function collection(string memory name, string memory symbol, string memory description, string memory banner)
        internal pure returns (bytes memory)
    {
        return abi.encodePacked(pictureless(name, symbol, description), field("banner_image", banner), '","image":"');
    }

    /// @notice Returns the metadata of a collection without a picture, except for the closing characters.
    function pictureless(string memory name, string memory symbol, string memory description) internal pure returns (bytes memory) {
        return abi.encodePacked('{"name":"', name, '","symbol":"', symbol, '","description":"', description);
    }

    /// @notice Ends the call with the `data:` URI of a document without a picture.
    /// @param head The document except for the closing characters.
    function answer(bytes memory head) internal pure {
        finish(head, 0, 0);
    }

    /// @notice Ends the call with the `data:` URI of a document and its picture, or with the error of drawing the picture.
    /// @param head The document up to its picture.
    /// @param source The contract that returns the picture, as a `data:` URI.
    /// @param data The memory address of the calldata, and `size` its size in bytes. It may be overwritten.
    function answer(bytes memory head, address source, uint256 data, uint256 size) internal view {
        uint256 length;
        assembly ("memory-safe") {
            if iszero(staticcall(gas(), source, data, size, 0, 0)) {
                let begin := mload(0x40)
                returndatacopy(begin, 0, returndatasize())
                revert(begin, returndatasize())
            }
            // skip the offset
            returndatacopy(0, 0x20, 0x20)
            length := mload(0)
        }
        finish(head, 0x40, length);
    }

    /// @dev Memory cost grows quadratically, so the picture is copied once, and the encoded document overwrites it.
    /// @param offset The offset of the picture in the return data, and `size` its size in bytes.
    function finish(bytes memory head, uint256 offset, uint256 size) private pure {
        unchecked {
            uint256 begin;
            assembly ("memory-safe") {
                begin := mload(0x40)
            }
            uint256 length = head.length + size + TAIL_SIZE;
            // leave room for the offset and length of the return value
            uint256 target = begin + 0x40 + SCHEME_SIZE;
            uint256 document = target + length / 3 + Base64.OVERLAP;
            assembly ("memory-safe") {
                mcopy(document, add(head, 0x20), mload(head))
                let place := add(document, mload(head))
                returndatacopy(place, offset, size)
                place := add(place, size)
                // followed by zeros, which the encoder reads
                mstore(place, '"}')
                mstore(add(place, 0x20), 0)
                mstore(begin, 0x20)
                mstore(add(begin, 0x40), "data:application/json;base64,")
            }
            uint256 end = Base64.encode(document, length, target);
            assembly ("memory-safe") {
                mstore(end, 0)
                end := sub(end, begin)
                mstore(add(begin, 0x20), sub(end, 0x40))
                return(begin, and(add(end, 0x1f), not(0x1f)))
            }
        }
    }
}
