// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

/// @dev The state of a bit reader.
/// @param next The address of the first byte that is not in `bits`.
/// @param bits The bits already read, the next one lowest.
/// @param count The number of these bits.
struct Reader {
    uint256 next;
    uint256 bits;
    uint256 count;
}

/// @dev Offsets in the workspace. Two tables, for literals and lengths, and for distances: an entry of two bytes, symbol * 16 + length of
/// its code, for each value of the next 15 bits.
uint256 constant LITERAL_TABLE = 0;
uint256 constant DISTANCE_TABLE = 0x10000;
/// @dev For each symbol of a length or distance: the number of extra bits (one byte), and the base to which they are added (two bytes).
uint256 constant LENGTHS = 0x20000;
uint256 constant DISTANCES = 0x20060;
/// @dev The code lengths of the symbols, one byte each; the symbols sorted by code length, two bytes each.
uint256 constant CODE_LENGTHS = 0x200e0;
uint256 constant SORTED = 0x20260;
uint256 constant WORKSPACE = 0x20500;

error NotDeflated();

/// @notice Decompresses DEFLATE data (RFC 1951): zlib data without header and checksum.
/// @return data The decompressed data, at the end of the used memory.
function inflate(bytes memory packed) pure returns (bytes memory data) {
    unchecked {
        uint256 space;
        Reader memory reader;
        uint256 out;
        assembly ("memory-safe") {
            mstore(reader, add(packed, 0x20))
            space := mload(0x40)
            data := add(space, WORKSPACE)
            out := add(data, 0x20)
        }
        writeBases(space);
        bool last;
        while (!last) {
            last = take(reader, 1) == 1;
            uint256 kind = take(reader, 2);
            if (kind == 0) {
                out = copyStored(reader, out);
            } else {
                if (kind == 1) fixedCodes(space);
                else if (kind == 2) dynamicCodes(reader, space);
                else revert NotDeflated();
                out = decode(reader, space, out);
            }
        }
        assembly ("memory-safe") {
            mstore(data, sub(out, add(data, 0x20)))
            mstore(0x40, and(add(out, 0x3f), not(0x1f)))
        }
    }
}

/// @dev Returns the next `count` bits, up to 32.
function take(Reader memory reader, uint256 count) pure returns (uint256 value) {
    unchecked {
        if (reader.count < 48) fill(reader);
        value = reader.bits & ((1 << count) - 1);
        reader.bits >>= count;
        reader.count -= count;
    }
}

/// @dev Reads 26 bytes ahead. Fewer than 48 bits must be buffered.
function fill(Reader memory reader) pure {
    unchecked {
        uint256 word;
        uint256 next = reader.next;
        assembly ("memory-safe") {
            word := shr(48, mload(next))
        }
        reader.bits |= (reversed(word) >> 48) << reader.count;
        reader.count += 208;
        reader.next = next + 26;
    }
}

/// @dev Reverses the bytes of a word.
function reversed(uint256 word) pure returns (uint256) {
    unchecked {
        word = ((word & 0x00ff00ff00ff00ff00ff00ff00ff00ff00ff00ff00ff00ff00ff00ff00ff00ff) << 8)
            | ((word >> 8) & 0x00ff00ff00ff00ff00ff00ff00ff00ff00ff00ff00ff00ff00ff00ff00ff00ff);
        word = ((word & 0x0000ffff0000ffff0000ffff0000ffff0000ffff0000ffff0000ffff0000ffff) << 16)
            | ((word >> 16) & 0x0000ffff0000ffff0000ffff0000ffff0000ffff0000ffff0000ffff0000ffff);
        word = ((word & 0x00000000ffffffff00000000ffffffff00000000ffffffff00000000ffffffff) << 32)
            | ((word >> 32) & 0x00000000ffffffff00000000ffffffff00000000ffffffff00000000ffffffff);
        word = ((word & 0x0000000000000000ffffffffffffffff0000000000000000ffffffffffffffff) << 64)
            | ((word >> 64) & 0x0000000000000000ffffffffffffffff0000000000000000ffffffffffffffff);
        return (word << 128) | (word >> 128);
    }
}

/// @dev Copies an uncompressed block.
function copyStored(Reader memory reader, uint256 out) pure returns (uint256) {
    unchecked {
        take(reader, reader.count & 7);
        uint256 size = take(reader, 16);
        take(reader, 16);
        uint256 from = reader.next - reader.count / 8;
        assembly ("memory-safe") {
            mcopy(out, from, size)
        }
        (reader.next, reader.bits, reader.count) = (from + size, 0, 0);
        return out + size;
    }
}

/// @dev Decodes the rest of a block.
function decode(Reader memory reader, uint256 space, uint256 begin) pure returns (uint256 out) {
    out = begin;
    bool ended;
    while (!ended) {
        if (reader.count < 48) fill(reader);
        assembly ("memory-safe") {
            let bits := mload(add(reader, 0x20))
            let count := mload(add(reader, 0x40))
            // a symbol takes at most 48 bits
            for {} iszero(lt(count, 48)) {} {
                let entry := shr(240, mload(add(space, shl(1, and(bits, 0x7fff)))))
                let size := and(entry, 15)
                bits := shr(size, bits)
                count := sub(count, size)
                let symbol := shr(4, entry)
                if lt(symbol, 256) {
                    mstore8(out, symbol)
                    out := add(out, 1)
                    continue
                }
                if eq(symbol, 256) {
                    ended := 1
                    break
                }
                // extra bits and base of a length or distance
                entry := shr(232, mload(add(add(space, LENGTHS), mul(3, sub(symbol, 257)))))
                size := shr(16, entry)
                let end := add(add(out, and(entry, 0xffff)), and(bits, sub(shl(size, 1), 1)))
                bits := shr(size, bits)
                count := sub(count, size)
                entry := shr(240, mload(add(add(space, DISTANCE_TABLE), shl(1, and(bits, 0x7fff)))))
                size := and(entry, 15)
                bits := shr(size, bits)
                count := sub(count, size)
                entry := shr(232, mload(add(add(space, DISTANCES), mul(3, shr(4, entry)))))
                size := shr(16, entry)
                let from := sub(out, add(and(entry, 0xffff), and(bits, sub(shl(size, 1), 1))))
                bits := shr(size, bits)
                count := sub(count, size)
                // overlapping copies double the copied range each time
                for {} lt(out, end) {} {
                    size := sub(out, from)
                    if gt(size, sub(end, out)) { size := sub(end, out) }
                    mcopy(out, from, size)
                    out := add(out, size)
                }
            }
            mstore(add(reader, 0x20), bits)
            mstore(add(reader, 0x40), count)
        }
    }
}

/// @dev Writes the bases and extra bits of lengths (from symbol 257) and distances (from symbol 0) of RFC 1951.
function writeBases(uint256 space) pure {
    assembly ("memory-safe") {
        let place := add(space, LENGTHS)
        for { let i := 0 let base := 3 } lt(i, 28) { i := add(i, 1) } {
            let extra := 0
            if gt(i, 7) { extra := sub(shr(2, i), 1) }
            mstore(place, or(shl(248, extra), shl(232, base)))
            place := add(place, 3)
            base := add(base, shl(extra, 1))
        }
        // the maximum length has its own symbol
        mstore(place, shl(232, 258))
        place := add(space, DISTANCES)
        for { let i := 0 let base := 1 } lt(i, 30) { i := add(i, 1) } {
            let extra := 0
            if gt(i, 3) { extra := sub(shr(1, i), 1) }
            mstore(place, or(shl(248, extra), shl(232, base)))
            place := add(place, 3)
            base := add(base, shl(extra, 1))
        }
    }
}

/// @dev Sets the fixed codes.
function fixedCodes(uint256 space) pure {
    unchecked {
        uint256 lengths = space + CODE_LENGTHS;
        for (uint256 i; i != 288; ++i) setLength(lengths, i, i < 144 ? 8 : i < 256 ? 9 : i < 280 ? 7 : 8);
        makeTable(space, lengths, 288, LITERAL_TABLE);
        for (uint256 i; i != 30; ++i) setLength(lengths, i, 5);
        makeTable(space, lengths, 30, DISTANCE_TABLE);
    }
}

/// @dev Reads the codes at the beginning of a block, which are themselves encoded.
function dynamicCodes(Reader memory reader, uint256 space) pure {
    unchecked {
        uint256 lengths = space + CODE_LENGTHS;
        uint256 literals = take(reader, 5) + 257;
        uint256 total = literals + take(reader, 5) + 1;
        uint256 sent = take(reader, 4) + 4;
        bytes19 order = hex"10111200080709060a050b040c030d020e010f";
        for (uint256 i; i != 19; ++i) setLength(lengths, uint8(order[i]), i < sent ? take(reader, 3) : 0);
        makeTable(space, lengths, 19, LITERAL_TABLE);
        uint256 previous;
        for (uint256 i; i < total;) {
            if (reader.count < 48) fill(reader);
            uint256 entry;
            uint256 bits = reader.bits;
            assembly ("memory-safe") {
                entry := shr(240, mload(add(space, shl(1, and(bits, 0x7fff)))))
            }
            take(reader, entry & 15);
            uint256 symbol = entry >> 4;
            uint256 times = 1;
            if (symbol < 16) {
                previous = symbol;
            } else if (symbol == 16) {
                times = 3 + take(reader, 2);
            } else {
                previous = 0;
                times = symbol == 17 ? 3 + take(reader, 3) : 11 + take(reader, 7);
            }
            while (times-- != 0) setLength(lengths, i++, previous);
        }
        makeTable(space, lengths, literals, LITERAL_TABLE);
        makeTable(space, lengths + literals, total - literals, DISTANCE_TABLE);
    }
}

function setLength(uint256 lengths, uint256 symbol, uint256 value) pure {
    assembly ("memory-safe") {
        mstore8(add(lengths, symbol), value)
    }
}

/// @dev Builds the table of a code from its code lengths.
/// @param table The offset of the table in the workspace.
function makeTable(uint256 space, uint256 lengths, uint256 symbols, uint256 table) pure {
    assembly ("memory-safe") {
        table := add(space, table)
        // the number of codes of each length, 16 bits each
        let counts := 0
        for { let i := 0 } lt(i, symbols) { i := add(i, 1) } {
            counts := add(counts, shl(shl(4, byte(0, mload(add(lengths, i)))), 1))
        }
        // the start of each length among the sorted symbols
        let begins := 0
        for { let i := 1 let sum := 0 } lt(i, 16) { i := add(i, 1) } {
            begins := or(begins, shl(shl(4, i), sum))
            sum := add(sum, and(shr(shl(4, i), counts), 0xffff))
        }
        let sorted := add(space, SORTED)
        for { let i := 0 } lt(i, symbols) { i := add(i, 1) } {
            let shift := shl(4, byte(0, mload(add(lengths, i))))
            if shift {
                let place := add(sorted, shl(1, and(shr(shift, begins), 0xffff)))
                mstore8(place, shr(8, i))
                mstore8(add(place, 1), i)
                begins := add(begins, shl(shift, 1))
            }
        }
        // the table for one more bit is twice the table for the bits before, plus the codes of this length. Codes are counted from their
        // last bit, but transmitted with the first bit lowest, so they are reversed here
        mstore8(table, 0)
        mstore8(add(table, 1), 0)
        let code := 0
        for { let size := 1 } lt(size, 16) { size := add(size, 1) } {
            mcopy(add(table, shl(size, 1)), table, shl(size, 1))
            for { let n := and(shr(shl(4, size), counts), 0xffff) } n { n := sub(n, 1) } {
                let entry := or(shl(4, shr(240, mload(sorted))), size)
                let place := add(table, shl(1, code))
                mstore8(place, shr(8, entry))
                mstore8(add(place, 1), entry)
                sorted := add(sorted, 2)
                let bit := shl(sub(size, 1), 1)
                for {} and(code, bit) { bit := shr(1, bit) } { code := xor(code, bit) }
                code := xor(code, bit)
            }
        }
    }
}
