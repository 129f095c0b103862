// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

/// @notice The checksum of PNG chunks (ISO 3309), for about 4 gas per byte.
/// @dev A message is a polynomial, with the highest power first, and its checksum the remainder of a division by P = x^32 + x^26 + x^23 +
/// x^22 + x^16 + x^12 + x^11 + x^10 + x^8 + x^7 + x^5 + x^4 + x^2 + x + 1 over GF(2). Adding a multiple of P changes nothing. Two multiples
/// have terms that are whole bytes apart, because squaring distributes over sums in GF(2):
///   x^300 + x^155 + x^117 + x^89 + 1 is a multiple of P, and so is its 8th power: a byte can be removed if it is added (xor) to the
///     bytes 145, 183, 211 and 300 positions later. Since this holds for any byte, it holds for a word;
///   P to the 8th itself: a byte can be removed if it is added to 14 of the 32 bytes that follow.
library Crc32 {
    /// @dev The bytes to which P to the 8th adds a removed byte: one for each term of P but the first.
    uint256 private constant TERMS = 0x0000000000010000010100000000000100000001010100010100010100010101;
    /// @dev P, with its bits in transmission order.
    uint256 private constant P = 0xedb88320;
    /// @dev The span of the sparse multiple's terms, plus room for two words at the beginning and one at the end.
    uint256 private constant SPAN = 364;

    /// @notice Returns the checksum of `size` bytes at `data`, at least 4. Uses memory from the free memory pointer on, without allocating
    /// it.
    function sum(uint256 data, uint256 size) internal pure returns (uint256 crc) {
        assembly ("memory-safe") {
            let begin := mload(0x40)
            let end := add(begin, size)
            mcopy(begin, data, size)
            // the checksum starts with ones, and four zero bytes follow the message
            mstore(begin, xor(mload(begin), shl(224, 0xffffffff)))
            // two words in each iteration
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
            // byte by byte, until one word remains
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
