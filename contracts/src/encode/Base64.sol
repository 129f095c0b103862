// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

/// @notice Base64 without a table: 24 bytes at a time; their 32 characters are computed in parallel in one word.
/// @dev Source of the encoding: RFC 4648.
library Base64 {
    /// @dev Masks of the upper 96 of 192 bits, of the upper halves of the resulting halves, and so on down to 6 bits.
    uint256 private constant UPPER_96 = 0x0000000000000000ffffffffffffffffffffffff000000000000000000000000;
    uint256 private constant UPPER_48 = 0x00000000ffffffffffff00000000000000000000ffffffffffff000000000000;
    uint256 private constant UPPER_24 = 0x0000ffffff0000000000ffffff0000000000ffffff0000000000ffffff000000;
    uint256 private constant UPPER_12 = 0x00fff00000fff00000fff00000fff00000fff00000fff00000fff00000fff000;
    uint256 private constant UPPER_6 = 0x0fc00fc00fc00fc00fc00fc00fc00fc00fc00fc00fc00fc00fc00fc00fc00fc0;
    /// @dev 1, 2 and "A" in each byte; and the addends that raise numbers from 26, 52 and 62 on to at least 128.
    uint256 private constant EACH_BYTE = 0x0101010101010101010101010101010101010101010101010101010101010101;
    uint256 private constant EACH_TWO = 0x0202020202020202020202020202020202020202020202020202020202020202;
    uint256 private constant EACH_A = 0x4141414141414141414141414141414141414141414141414141414141414141;
    uint256 private constant TO_128_FROM_26 = 0x6666666666666666666666666666666666666666666666666666666666666666;
    uint256 private constant TO_128_FROM_52 = 0x4c4c4c4c4c4c4c4c4c4c4c4c4c4c4c4c4c4c4c4c4c4c4c4c4c4c4c4c4c4c4c4c;
    uint256 private constant TO_128_FROM_62 = 0x4242424242424242424242424242424242424242424242424242424242424242;
    /// @dev The number of bytes behind the characters that may be overwritten.
    uint256 internal constant MARGIN = 128;
    /// @dev Each iteration reads 96 bytes and writes 128: an overlap of 32 bytes for each started iteration.
    uint256 internal constant OVERLAP = 32;

    /// @notice Writes the characters of `size` bytes at `data` to `target`, and up to MARGIN bytes of garbage behind them. The 32 bytes
    /// behind the data must be zero. The characters may overwrite data that was already read: a target that is a third of `size` plus
    /// OVERLAP bytes before the data is sufficient.
    /// @return end The address after the last character.
    function encode(uint256 data, uint256 size, uint256 target) internal pure returns (uint256 end) {
        unchecked {
            end = target + 4 * ((size + 2) / 3);
            convert(data, data + size, target);
            // replace the last characters by "=", one for each missing byte
            uint256 missing = (3 - size % 3) % 3;
            assembly ("memory-safe") {
                for { let place := sub(end, missing) } lt(place, end) { place := add(place, 1) } { mstore8(place, 0x3d) }
            }
        }
    }

    /// @dev Converts four groups of 24 bytes in each iteration; up to three of them may be unused.
    function convert(uint256 data, uint256 last, uint256 target) private pure {
        assembly ("memory-safe") {
            function characters(bits) -> text {
                // spread 32 numbers of 6 bits to the 32 bytes of a word: the upper half of each part moves up until each byte has one
                // number
                bits := add(bits, mul(and(bits, UPPER_96), 0xffffffff))
                bits := add(bits, mul(and(bits, UPPER_48), 0xffff))
                bits := add(bits, mul(and(bits, UPPER_24), 0xff))
                bits := add(bits, mul(and(bits, UPPER_12), 0xf))
                bits := add(bits, mul(and(bits, UPPER_6), 3))
                // "A" + n, and the differences at "a", "0", "+" and "/": 6, -75, -15 and 3
                let digits := mul(and(shr(7, add(bits, TO_128_FROM_52)), EACH_BYTE), 25)
                // of the last two, "/" is the odd one
                let lastTwo := and(shr(7, add(bits, TO_128_FROM_62)), EACH_BYTE)
                let small := and(shr(6, add(bits, TO_128_FROM_26)), EACH_TWO)
                text := mul(sub(add(small, and(lastTwo, bits)), add(digits, mul(lastTwo, 5))), 3)
                text := add(text, add(bits, EACH_A))
            }

            // pictures have runs of one colour; their period of three bytes divides 24
            let previous := 0
            let text := EACH_A
            for {} lt(data, last) { data := add(data, 96) } {
                let change := xor(mload(data), mload(add(data, 24)))
                if iszero(change) {
                    change := or(xor(mload(add(data, 32)), mload(add(data, 56))), xor(mload(add(data, 40)), mload(add(data, 64))))
                }
                switch change
                case 0 {
                    let bits := shr(64, mload(data))
                    if xor(bits, previous) {
                        previous := bits
                        text := characters(bits)
                    }
                    mstore(target, text)
                    mstore(add(target, 32), text)
                    mstore(add(target, 64), text)
                    mstore(add(target, 96), text)
                }
                default {
                    mstore(target, characters(shr(64, mload(data))))
                    mstore(add(target, 32), characters(shr(64, mload(add(data, 24)))))
                    mstore(add(target, 64), characters(shr(64, mload(add(data, 48)))))
                    mstore(add(target, 96), characters(shr(64, mload(add(data, 72)))))
                }
                target := add(target, 128)
            }
        }
    }
}
