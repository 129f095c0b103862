// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {FragmentLight} from "../shading/FragmentLight.sol";
import "../../words/Registers.sol";

// Shades every fragment individually, from depth and barycentric coordinates.

/// @dev Half a level in lanes of 85 bits, Q58 and Q10.
uint256 constant HALF_85 = 0x800000000000000000000400000000000000000000200000000000000;
uint256 constant HALF_85_Q10 = 0x800000000000000000000400000000000000000000200;
/// @dev Bits 18 to 36 of each lane, which are zero for a colour of 0 to 255, Q10. Adding the mask to the masked lane carries into bit 37
/// unless these bits are zero; bit 36 is the sign.
uint256 constant BEYOND_BYTE_85 = 0x7ffff00000000000000003ffff80000000000000001ffffc0000;
uint256 constant BEYOND_CARRY = 37;
uint256 constant BEYOND_SIGN = 36;
/// @dev 1 in each lane.
uint256 constant ONES_85 = 0x4000000000000000000002000000000000000000001;
/// @dev The lowest bit of the byte of each channel.
uint256 constant BLUE_Q10_AT = 10;
uint256 constant GREEN_Q10_AT = 95;
uint256 constant RED_Q10_AT = 180;

library ExactSpans {
    /// @notice Draws the rows from `row` (inclusive) to `last` (exclusive) between two edges.
    /// @param start The accumulator at column 0 of the first row.
    function rows(uint256 edges, uint256 slopes, uint256 start, uint256 row, uint256 last) internal pure {
        unchecked {
            for (; row != last; ++row) {
                uint256 column;
                uint256 end;
                assembly ("memory-safe") {
                    column := and(shr(EDGES_LEFT_COLUMN_AT, edges), EDGES_LEFT_COLUMN_MASK)
                    if lt(column, mload(COLUMN_BEGIN)) { column := mload(COLUMN_BEGIN) }
                    end := shr(EDGES_RIGHT_COLUMN_AT, edges)
                    if gt(end, mload(COLUMN_END)) { end := mload(COLUMN_END) }
                }
                if (column < end) span(row, column, end, start + column * load(DX));
                edges += slopes;
                start += load(DY);
            }
        }
    }

    /// @dev Draws at least one fragment.
    function span(uint256 row, uint256 column, uint256 end, uint256 attribute) private pure {
        unchecked {
            uint256 p = load(DEPTH_ORIGIN) - load(DEPTH_STRIDE) * row;
            end = p + 8 * end;
            p += 8 * column;
            uint256 x = load(RAY_LEFT) + column * load(RAY_STEP);
            uint256 y = load(RAY_TOP) + row * load(RAY_STEP);
            while (true) {
                uint256 depth = attribute >> ACCUMULATOR_DEPTH_AT;
                if (depth > load(p) >> ACCUMULATOR_DEPTH_AT) {
                    assembly ("memory-safe") {
                        mstore(p, or(shl(ACCUMULATOR_DEPTH_AT, depth), and(mload(p), BEHIND_DEPTH)))
                    }
                    write(p, colorAt(attribute, x, y));
                }
                p += 8;
                if (p == end) break;
                attribute += load(DX);
                x += load(RAY_STEP);
            }
        }
    }

    /// @notice Writes a pixel from signed lanes of 85 bits, Q10, rounded and clamped to 0..255.
    function write(uint256 p, uint256 color) internal pure {
        assembly ("memory-safe") {
            color := add(color, HALF_85_Q10)
            let beyond := and(color, BEYOND_BYTE_85)
            if beyond {
                // 255 in lanes above 255 or below 0, then 0 in those below 0
                beyond := and(shr(BEYOND_CARRY, add(beyond, BEYOND_BYTE_85)), ONES_85)
                color := or(color, mul(beyond, BYTE_Q10))
                color := and(color, not(mul(and(shr(BEYOND_SIGN, color), ONES_85), BYTE_Q10)))
            }
            p := add(mload(IMAGE_ORIGIN), mul(3, shr(3, p)))
            mstore8(p, shr(BLUE_Q10_AT, color))
            mstore8(add(p, 1), shr(GREEN_Q10_AT, color))
            mstore8(add(p, 2), shr(RED_Q10_AT, color))
        }
    }

    /// @dev Returns the colour for this accumulator and ray.
    function colorAt(uint256 attribute, uint256 x, uint256 y) internal pure returns (uint256 color) {
        uint256 s;
        uint256 t;
        assembly ("memory-safe") {
            s := sar(ACCUMULATOR_S_AT, signextend(ACCUMULATOR_S_LAST_BYTE, attribute))
            t := sar(ACCUMULATOR_T_AT, signextend(ACCUMULATOR_T_LAST_BYTE, attribute))
            attribute := shr(ACCUMULATOR_DEPTH_AT, attribute)
        }
        return FragmentLight.colorAt(attribute, s, t, x, y, false);
    }
}
