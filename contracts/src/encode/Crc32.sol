// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

/// @notice The checksum of PNG chunks (ISO 3309), for about 4 gas a byte.
/// @dev A message is a polynomial whose highest power stands first, and its checksum the rest of a division by
/// P = x^32 + x^26 + x^23 + x^22 + x^16 + x^12 + x^11 + x^10 + x^8 + x^7 + x^5 + x^4 + x^2 + x + 1 over {0, 1}. Adding a multiple of P
/// changes nothing. There are two whose terms are whole bytes apart, since the square of a sum is the sum of the squares there:
///   x^300 + x^155 + x^117 + x^89 + 1 is a multiple of P, and so is its 8th power: a byte may be taken away if it is added (xor) to
///     those that come 145, 183, 211 and 300 bytes later. As this holds for any byte, it holds for a word;
///   P to the 8th itself: a byte may be taken away if it is added to 14 of the 32 bytes that follow.
library Crc32 {
    /// @dev The bytes to which P to the 8th adds one that is taken away: one for each term of P but the first.
    uint256 private constant TERMS = 0x0000000000010000010100000000000100000001010100010100010100010101;
    /// @dev P, its bits in the order in which bytes are sent.
    uint256 private constant P = 0xedb88320;
    /// @dev What the terms of the sparse multiple span, and room for two words at the beginning and one at the end.
    uint256 private constant SPAN = 364;

    /// @notice The checksum of `size` bytes at `data`, at least 4. Memory from the free memory pointer on is used and left as it is.
    function sum(uint256 data, uint256 size) internal pure returns (uint256 crc) {
        assembly ("memory-safe") {
            let begin := mload(0x40)
            let end := add(begin, size)
            mcopy(begin, data, size)
            // the checksum begins with ones, and the message is followed by four bytes of zeros
            mstore(begin, xor(mload(begin), shl(224, 0xffffffff)))
            // two words in each turn
            for {} gt(sub(end, begin), SPAN) { begin := add(begin, 64) } {
                let word := mload(begin)
                let place := add(begin, 145)
                mstore(place, xor(mload(place), word))
                place := add(begin, 183)
                mstore(place, xor(mload(place), word))
                place := add(begin, 211)
                mstore(place, xor(mload(place), word))
                place := add(begin, 300)
                mstore(place, xor(mload(place), word))
                word := mload(add(begin, 32))
                place := add(begin, 177)
                mstore(place, xor(mload(place), word))
                place := add(begin, 215)
                mstore(place, xor(mload(place), word))
                place := add(begin, 243)
                mstore(place, xor(mload(place), word))
                place := add(begin, 332)
                mstore(place, xor(mload(place), word))
            }
            // byte by byte, until one word is left
            if gt(sub(end, begin), 32) {
                let word := mload(begin)
                for { begin := add(begin, 32) } lt(begin, end) { begin := add(begin, 1) } {
                    word := xor(or(shl(8, word), byte(0, mload(begin))), mul(shr(248, word), TERMS))
                }
                begin := sub(end, 32)
                mstore(begin, word)
            }
            // bit by bit
            for {} lt(begin, end) { begin := add(begin, 1) } {
                crc := xor(crc, byte(0, mload(begin)))
                crc := xor(shr(1, crc), mul(and(crc, 1), P))
                crc := xor(shr(1, crc), mul(and(crc, 1), P))
                crc := xor(shr(1, crc), mul(and(crc, 1), P))
                crc := xor(shr(1, crc), mul(and(crc, 1), P))
                crc := xor(shr(1, crc), mul(and(crc, 1), P))
                crc := xor(shr(1, crc), mul(and(crc, 1), P))
                crc := xor(shr(1, crc), mul(and(crc, 1), P))
                crc := xor(shr(1, crc), mul(and(crc, 1), P))
            }
            crc := xor(crc, 0xffffffff)
        }
    }
}
