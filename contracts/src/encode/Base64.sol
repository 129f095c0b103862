// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

/// @notice Base64 without a table: 24 bytes at a time, whose 32 characters are computed side by side in one word.
/// @dev Source of the encoding: RFC 4648.
library Base64 {
    /// @dev 1 in each byte.
    uint256 private constant EACH_BYTE = 0x0101010101010101010101010101010101010101010101010101010101010101;
    uint256 internal constant MARGIN = 128;
    /// @dev Each turn reads 96 bytes and writes 128: 32 more for each turn that was begun.
    uint256 internal constant OVERLAP = 32;

    /// @notice Writes the characters of `size` bytes at `data` to `target`, and up to MARGIN bytes without meaning behind them. The 32
    /// bytes behind the data must be zero. The characters may take the place of data that have been read: a target that is a third of
    /// `size` and OVERLAP bytes before the data stays behind them.
    /// @return end The address after the last character.
    function encode(uint256 data, uint256 size, uint256 target) internal pure returns (uint256 end) {
        unchecked {
            end = target + 4 * ((size + 2) / 3);
            convert(data, data + size, target);
            // fill up the last four characters: "=" for each byte that is missing
            uint256 missing = (3 - size % 3) % 3;
            assembly ("memory-safe") {
                for { let place := sub(end, missing) } lt(place, end) { place := add(place, 1) } { mstore8(place, 0x3d) }
            }
        }
    }

    /// @dev Four groups of 24 bytes in each turn, so that up to three are converted in vain.
    function convert(uint256 data, uint256 last, uint256 target) private pure {
        assembly ("memory-safe") {
            function characters(bits) -> text {
                // 32 numbers of 6 bits to the 32 bytes of a word: the upper half of each part moves up until there is a number a byte
                bits := add(bits, mul(and(bits, 0x0000000000000000ffffffffffffffffffffffff000000000000000000000000), 4294967295))
                bits := add(bits, mul(and(bits, 0x00000000ffffffffffff00000000000000000000ffffffffffff000000000000), 65535))
                bits := add(bits, mul(and(bits, 0x0000ffffff0000000000ffffff0000000000ffffff0000000000ffffff000000), 255))
                bits := add(bits, mul(and(bits, 0x00fff00000fff00000fff00000fff00000fff00000fff00000fff00000fff000), 15))
                bits := add(bits, mul(and(bits, 0x0fc00fc00fc00fc00fc00fc00fc00fc00fc00fc00fc00fc00fc00fc00fc00fc0), 3))
                // "A" + n, then what the steps to "a", "0", "+" and "/" differ from that
                text := add(bits, 0x4141414141414141414141414141414141414141414141414141414141414141)
                text := add(
                    text,
                    mul(and(shr(7, add(bits, 0x6666666666666666666666666666666666666666666666666666666666666666)), EACH_BYTE), 6)
                )
                text := sub(
                    text,
                    mul(and(shr(7, add(bits, 0x4c4c4c4c4c4c4c4c4c4c4c4c4c4c4c4c4c4c4c4c4c4c4c4c4c4c4c4c4c4c4c4c)), EACH_BYTE), 75)
                )
                text := sub(
                    text,
                    mul(and(shr(7, add(bits, 0x4242424242424242424242424242424242424242424242424242424242424242)), EACH_BYTE), 15)
                )
                text := add(
                    text,
                    mul(and(shr(7, add(bits, 0x4141414141414141414141414141414141414141414141414141414141414141)), EACH_BYTE), 3)
                )
            }

            // pictures have runs of one colour, and its period of three bytes divides 24: often a group is like the one before
            let previous := 0
            let text := 0x4141414141414141414141414141414141414141414141414141414141414141
            for {} lt(data, last) { data := add(data, 96) } {
                let bits := shr(64, mload(data))
                if xor(bits, previous) {
                    previous := bits
                    text := characters(previous)
                }
                mstore(target, text)
                bits := shr(64, mload(add(data, 24)))
                if xor(bits, previous) {
                    previous := bits
                    text := characters(previous)
                }
                mstore(add(target, 32), text)
                bits := shr(64, mload(add(data, 48)))
                if xor(bits, previous) {
                    previous := bits
                    text := characters(previous)
                }
                mstore(add(target, 64), text)
                bits := shr(64, mload(add(data, 72)))
                if xor(bits, previous) {
                    previous := bits
                    text := characters(previous)
                }
                mstore(add(target, 96), text)
                target := add(target, 128)
            }
        }
    }
}
