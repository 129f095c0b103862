// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Strings} from "@openzeppelin/contracts/utils/Strings.sol";
import {Base64} from "../encode/Base64.sol";

/// @title Json: what marketplaces and wallets read of a token. Text comes as it stands in JSON, escaped where it has to be.
library Json {
    using Strings for address;
    using Strings for uint256;

    /// @dev Bytes of what a `data:` URI of a document begins with; and of what ends a document behind its picture.
    uint256 private constant SCHEME_SIZE = 29;
    uint256 private constant TAIL_SIZE = 2;

    /// @notice A trait whose value is text.
    function trait(string memory kind, string memory value) internal pure returns (string memory) {
        return string.concat('{"trait_type":"', kind, '","value":"', value, '"}');
    }

    /// @notice A trait whose value is a number, shown as such: without a display type marketplaces show a rank.
    function trait(string memory kind, uint256 value) internal pure returns (string memory) {
        return string.concat('{"display_type":"number","trait_type":"', kind, '","value":', value.toString(), "}");
    }

    /// @notice A trait that is there or not.
    function trait(string memory kind, bool value) internal pure returns (string memory) {
        return trait(kind, value ? "Yes" : "No");
    }

    /// @notice A field that not every document has, such as `external_url`.
    function field(string memory name, string memory value) internal pure returns (string memory) {
        return string.concat('","', name, '":"', value);
    }

    /// @notice The web3:// address at which a contract answers a call (ERC-6860).
    /// @param path The call and its arguments, as `/render/12?mime.content=image/bmp`.
    function link(address target, string memory path) internal view returns (string memory) {
        return string.concat("web3://", target.toHexString(), ":", block.chainid.toString(), path);
    }

    /// @notice The web3:// address of the picture of a scene that a studio keeps.
    function picture(address studio, address scene, uint256 scale) internal view returns (string memory) {
        return link(studio, string.concat("/renderPNG/", scene.toHexString(), "/", scale.toString(), "?mime.type=png"));
    }

    /// @notice The metadata of a token up to its picture.
    /// @param fields One after the other, of `field`.
    /// @param traits Separated by commas.
    function token(string memory name, string memory description, string memory fields, string memory traits)
        internal
        pure
        returns (bytes memory)
    {
        return abi.encodePacked('{"name":"', name, '","description":"', description, fields, '","attributes":[', traits, '],"image":"');
    }

    /// @notice The metadata of a collection up to its picture, as ERC-7572 has it.
    /// @param banner What is shown across the top of a page: a wide picture, as a `data:` URI.
    function collection(string memory name, string memory symbol, string memory description, string memory banner)
        internal
        pure
        returns (bytes memory)
    {
        return abi.encodePacked(pictureless(name, symbol, description), field("banner_image", banner), '","image":"');
    }

    /// @notice The metadata of a collection without a picture, but for their end.
    function pictureless(string memory name, string memory symbol, string memory description) internal pure returns (bytes memory) {
        return abi.encodePacked('{"name":"', name, '","symbol":"', symbol, '","description":"', description);
    }

    /// @notice Ends the call with the `data:` URI of a document that shows no picture.
    /// @param head The document but for its end.
    function answer(bytes memory head) internal pure {
        finish(head, 0, 0);
    }

    /// @notice Ends the call with the `data:` URI of a document, or with why there is no picture.
    /// @param head The document up to its picture.
    /// @param source The contract that answers the picture, a `data:` URI.
    /// @param data Address of the data of that call, and `size` how many bytes. They may be overwritten.
    function answer(bytes memory head, address source, uint256 data, uint256 size) internal view {
        uint256 length;
        assembly ("memory-safe") {
            if iszero(staticcall(gas(), source, data, size, 0, 0)) {
                let begin := mload(0x40)
                returndatacopy(begin, 0, returndatasize())
                revert(begin, returndatasize())
            }
            // behind the offset
            returndatacopy(0, 0x20, 0x20)
            length := mload(0)
        }
        finish(head, 0x40, length);
    }

    /// @dev Memory grows with the square: the picture is copied once, and the characters of the document overwrite it.
    /// @param offset Where the picture begins in what was answered last, and `size` how many bytes.
    function finish(bytes memory head, uint256 offset, uint256 size) private pure {
        unchecked {
            uint256 begin;
            assembly ("memory-safe") {
                begin := mload(0x40)
            }
            uint256 length = head.length + size + TAIL_SIZE;
            // behind offset and length of what is answered
            uint256 target = begin + 0x40 + SCHEME_SIZE;
            uint256 document = target + length / 3 + Base64.OVERLAP;
            assembly ("memory-safe") {
                mcopy(document, add(head, 0x20), mload(head))
                let place := add(document, mload(head))
                returndatacopy(place, offset, size)
                place := add(place, size)
                // with zeros behind it, for the encoder
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
