// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

/// @notice The two fields of a block's header that are wanted here.
/// @dev A header is a list in RLP: each field is preceded by a byte or a few that tell its length. Its first fields are the same since the
/// first block of Ethereum, forks add others behind them; PREVRANDAO stands where the mix hash stood (EIP-4399). Only headers whose hash is
/// known to be right are read.
library Header {
    uint256 private constant PARENT_HASH = 0;
    uint256 private constant PREV_RANDAO = 13;

    /// @notice The field is not there.
    error NotAHeader();

    /// @notice The hash of the block before.
    function parentHash(bytes memory header) internal pure returns (bytes32) {
        return field(header, PARENT_HASH);
    }

    /// @notice What PREVRANDAO was in the block.
    function prevRandao(bytes memory header) internal pure returns (bytes32) {
        return field(header, PREV_RANDAO);
    }

    /// @dev A field of 32 bytes.
    function field(bytes memory header, uint256 index) private pure returns (bytes32 value) {
        unchecked {
            // the list: 0xf7 and how many bytes tell its length
            uint256 place = 1 + uint8(header[0]) - 0xf7;
            for (; index != 0; --index) {
                uint256 head = uint8(header[place]);
                if (head < 0x80) {
                    // a byte that stands for itself
                    ++place;
                } else if (head < 0xb8) {
                    place += 1 + head - 0x80;
                } else {
                    // the only long field is the bloom filter: two bytes tell its 256
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
