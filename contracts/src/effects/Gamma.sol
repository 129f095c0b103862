// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import "../words/EffectRegisters.sol";

// Computes `light` of picture.py, and its inverse in `colored`.
// sRGB (IEC 61966-2-1): linear = level / 12.92 up to level 0.04045, ((level + 0.055) / 1.055)^2.4 above; tables with linear interpolation.

/// @dev 16 bits each: 255 times the linear value of the levels 0, 4, 8 ... 256, Q7.
uint256 constant DECODE_0 = 0x00000028004f007800a900e4012a017b01d7024002b5033603c50461050b05c3;
uint256 constant DECODE_1 = 0x0689075f084309370a3a0b4e0c710da50eea104011a6131f14a9164417f219b3;
uint256 constant DECODE_2 = 0x1b861d6b1f642170238f25c228092a632cd22f5531ed3499375b3a313d1d401e;
uint256 constant DECODE_3 = 0x4335466249a44cfd506c53f1578d5b405f0a62eb66e36af26f19735877af7c1d;
uint256 constant DECODE_4 = 0x80a4000000000000000000000000000000000000000000000000000000000000;
/// @dev 16 bits each: the levels, Q8, of the linear values 2^(7 + i / 8) * (1 + (i mod 8) / 8), Q16, for i = 0 to 73.
uint256 constant ENCODE_0 = 0x066f073d080b08d909a70a740b390bf50caa0e020f441074119412a613ad14a8;
uint256 constant ENCODE_1 = 0x159a176519131aa81c291d971ef52045218823ed262b28482a492c322e052fc6;
uint256 constant ENCODE_2 = 0x317534a637a43a773d243fb14220447746b64afa4ef852bd564f59b65cf76016;
uint256 constant ENCODE_3 = 0x631668c76e1b732377e87c7280ca84f488f6908e97ac9e62a4c0aad0b09cb62b;
uint256 constant ENCODE_4 = 0xbb84c5a7cf27d81de09ce8b4f071f7ddff00ff00000000000000000000000000;

/// @dev Fraction bits of encoded levels; the shifts between formats; the bits of a level, Q10, between two entries of DECODE, which are 4
/// levels apart, and of the position of an entry.
uint256 constant Q8 = 8;
uint256 constant Q7_TO_Q10 = 3;
uint256 constant DECODE_STEP = 12;
uint256 constant BELOW_DECODE_STEP = 0xfff;
/// @dev An entry has 2^1 bytes; two entries at the top of a word; the upper one of two, and the mask of the lower one.
uint256 constant ENTRY_SHIFT = 1;
uint256 constant ENTRIES_AT = 224;
uint256 constant ENTRY_AT = 16;
uint256 constant ENTRY_MASK = 0xffff;
/// @dev The end of the lanes of a colour.
uint256 constant LANES_END = 3 * 56;
/// @dev Entries for each power of two: 2^3.
uint256 constant ENTRIES_SHIFT = 3;

library Gamma {
    /// @notice Fills DECODE_TABLE and ENCODE_TABLE.
    function setTables() internal pure {
        assembly ("memory-safe") {
            mstore(DECODE_TABLE, DECODE_0) // levels 0, 4 .. 60
            mstore(add(DECODE_TABLE, 0x20), DECODE_1) // 64 ..
            mstore(add(DECODE_TABLE, 0x40), DECODE_2) // 128 ..
            mstore(add(DECODE_TABLE, 0x60), DECODE_3) // 192 ..
            mstore(add(DECODE_TABLE, 0x80), DECODE_4) // 256
            mstore(ENCODE_TABLE, ENCODE_0) // 2^7 ..
            mstore(add(ENCODE_TABLE, 0x20), ENCODE_1)
            mstore(add(ENCODE_TABLE, 0x40), ENCODE_2)
            mstore(add(ENCODE_TABLE, 0x60), ENCODE_3)
            mstore(add(ENCODE_TABLE, 0x80), ENCODE_4)
        }
    }

    /// @notice Returns the linear value of an sRGB level, both Q10, 0..255.
    function decode(uint256 level) internal pure returns (uint256 linear) {
        assembly ("memory-safe") {
            linear := shr(ENTRIES_AT, mload(add(DECODE_TABLE, shl(ENTRY_SHIFT, shr(DECODE_STEP, level))))) // two adjacent entries
            let first := shr(ENTRY_AT, linear) // the lower one
            let rest := and(level, BELOW_DECODE_STEP) // between the two
            linear := shl(Q7_TO_Q10, add(first, shr(DECODE_STEP, mul(sub(and(linear, ENTRY_MASK), first), rest)))) // interpolated
        }
    }

    /// @notice Returns the linear values of a colour, lanes of Q10.
    function decodeLanes(uint256 color) internal pure returns (uint256 linear) {
        unchecked {
            for (uint256 i; i != LANES_END; i += MIDDLE_AT) linear |= decode((color >> i) & LANE_24) << i;
        }
    }

    /// @notice Returns the sRGB level, Q8, of a linear value, Q16, 0..1.
    function encode(uint256 linear) internal pure returns (uint256 level) {
        assembly ("memory-safe") {
            switch lt(linear, 128) // near black the curve is a line
            case 1 { level := shr(Q8, mul(linear, 3295)) } // 12.92 x, times 255
            default {
                let k := shl(4, lt(0xffff, linear)) // floor(log2(linear)) - 3, bit by bit
                k := or(k, shl(3, lt(0xff, shr(k, linear)))) // more than 8, 4, 2, 1 bits
                k := or(k, shl(2, lt(0xf, shr(k, linear))))
                k := or(k, shl(1, lt(3, shr(k, linear))))
                k := sub(or(k, lt(1, shr(k, linear))), 3)
                let entry := shr(k, linear) // 8 to 15
                let rest := sub(linear, shl(k, entry)) // below 2^k
                entry := add(shl(ENTRIES_SHIFT, sub(k, 4)), sub(entry, 8)) // from here on, its index
                entry := shr(ENTRIES_AT, mload(add(ENCODE_TABLE, shl(ENTRY_SHIFT, entry)))) // from here on, it and the next
                level := shr(ENTRY_AT, entry) // the lower one
                level := add(level, shr(k, mul(sub(and(entry, ENTRY_MASK), level), rest))) // interpolated
            }
        }
    }
}
