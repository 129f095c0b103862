// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

/// @notice Reads two fields of a block header.
/// @dev A header is an RLP list: each field is preceded by its length in one or more bytes. The first fields are the same since the first
/// block of Ethereum; forks append new fields. PREVRANDAO takes the place of the mix hash (EIP-4399). Callers check the hash of a header
/// before reading it.
library Header {
    uint256 private constant PARENT_HASH = 0;
    uint256 private constant PREV_RANDAO = 13;

    /// @notice The header does not contain the field.
    error NotAHeader();

    /// @notice Returns the hash of the parent block.
    function parentHash(bytes memory header) internal pure returns (bytes32) {
        return field(header, PARENT_HASH);
    }

    /// @notice Returns the PREVRANDAO value of the block.
    function prevRandao(bytes memory header) internal pure returns (bytes32) {
        return field(header, PREV_RANDAO);
    }

    /// @dev Returns a field of 32 bytes.
    function field(bytes memory header, uint256 index) private pure returns (bytes32 value) {
        unchecked {
            // list prefix: 0xf7 + the size of its length
            uint256 place = 1 + uint8(header[0]) - 0xf7;
            for (; index != 0; --index) {
                uint256 head = uint8(header[place]);
                if (head < 0x80) {
                    // a single byte, its own encoding
                    ++place;
                } else if (head < 0xb8) {
                    place += 1 + head - 0x80;
                } else {
                    // the only long field is the bloom filter: a 2-byte length, which is 256
                    if (head != 0xb9) revert NotAHeader();
                    place += 3 + (uint256(uint8(header[place + 1])) << 8) + uint8(header[place + 2]);
                }
            }
            if (uint8(header[place]) != 0xa0 || place + 33 > header.length) revert NotAHeader();
            assembly ("memory-safe") {
                value := mload(add(add(header, 0x21), place))
            }
        }
    }
}
