// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import "../words/EffectRegisters.sol";

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

library Gamma {
    /// @notice Fills DECODE_TABLE and ENCODE_TABLE.
    function setTables() internal pure {
        assembly ("memory-safe") {
            mstore(DECODE_TABLE, DECODE_0)
            mstore(add(DECODE_TABLE, 0x20), DECODE_1)
            mstore(add(DECODE_TABLE, 0x40), DECODE_2)
            mstore(add(DECODE_TABLE, 0x60), DECODE_3)
            mstore(add(DECODE_TABLE, 0x80), DECODE_4)
            mstore(ENCODE_TABLE, ENCODE_0)
            mstore(add(ENCODE_TABLE, 0x20), ENCODE_1)
            mstore(add(ENCODE_TABLE, 0x40), ENCODE_2)
            mstore(add(ENCODE_TABLE, 0x60), ENCODE_3)
            mstore(add(ENCODE_TABLE, 0x80), ENCODE_4)
        }
    }

    /// @notice Returns the linear value of an sRGB level, both Q10, 0..255.
    function decode(uint256 level) internal pure returns (uint256 linear) {
        assembly ("memory-safe") {
            // two adjacent entries
            linear := shr(224, mload(add(DECODE_TABLE, shl(1, shr(12, level)))))
            let first := shr(16, linear)
            linear := shl(3, add(first, shr(12, mul(sub(and(linear, 0xffff), first), and(level, 0xfff)))))
        }
    }

    /// @notice Returns the sRGB level, Q8, of a linear value, Q16, 0..1.
    function encode(uint256 linear) internal pure returns (uint256 level) {
        assembly ("memory-safe") {
            switch lt(linear, 128)
            case 1 { level := shr(8, mul(linear, 3295)) }
            default {
                // floor(log2(linear)) - 3
                let k := shl(4, lt(0xffff, linear))
                k := or(k, shl(3, lt(0xff, shr(k, linear))))
                k := or(k, shl(2, lt(0xf, shr(k, linear))))
                k := or(k, shl(1, lt(3, shr(k, linear))))
                k := sub(or(k, lt(1, shr(k, linear))), 3)
                let entry := shr(k, linear)
                let rest := sub(linear, shl(k, entry))
                entry := add(shl(3, sub(k, 4)), sub(entry, 8))
                entry := shr(224, mload(add(ENCODE_TABLE, shl(1, entry))))
                level := shr(16, entry)
                level := add(level, shr(k, mul(sub(and(entry, 0xffff), level), rest)))
            }
        }
    }
}
