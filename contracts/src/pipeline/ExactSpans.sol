// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {FragmentLight} from "./FragmentLight.sol";
import "./Registers.sol";

// Every fragment for itself, from depth and barycentric coordinates.

/// @dev Half a level in lanes of 85 bits, Q58.
uint256 constant HALF_85 = 0x800000000000000000000400000000000000000000200000000000000;

library ExactSpans {
    /// @notice Draws the rows from `row` to before `last`, between two edges.
    /// @param start The accumulator at column 0 of the first row.
    function rows(uint256 edges, uint256 slopes, uint256 start, uint256 row, uint256 last) internal pure {
        unchecked {
            for (; row != last; ++row) {
                uint256 column = max(max((edges >> EDGES_LEFT_COLUMN_AT) & EDGES_LEFT_COLUMN_MASK, load(PATCH_BEGIN)), load(COLUMN_BEGIN));
                span(row, column, min(min(edges >> EDGES_RIGHT_COLUMN_AT, load(PATCH_END)), load(COLUMN_END)), start + column * load(DX));
                edges += slopes;
                start += load(DY);
            }
        }
    }

    function span(uint256 row, uint256 column, uint256 end, uint256 attribute) private pure {
        unchecked {
            uint256 p = load(DEPTH_ORIGIN) - load(DEPTH_STRIDE) * row + 8 * column;
            row = load(RAY_TOP) + row * load(RAY_STEP);
            for (; column < end; ++column) {
                if (passes(p, attribute)) {
                    write(p, (colorAt(attribute, load(RAY_LEFT) + column * load(RAY_STEP), row) << Q10_TO_Q58) + HALF_85);
                }
                p += 8;
                attribute += load(DX);
            }
        }
    }

    /// @dev The depth test.
    function passes(uint256 p, uint256 attribute) private pure returns (bool nearer) {
        assembly ("memory-safe") {
            let old := mload(p)
            nearer := gt(attribute, or(old, BEHIND_DEPTH))
            if nearer {
                mstore(p, xor(old, and(xor(old, attribute), FIRST_DEPTH)))
            }
        }
    }

    /// @notice Writes a pixel of lanes of 85 bits, Q58, which are kept between 0 and 255.
    function write(uint256 p, uint256 f) internal pure {
        assembly ("memory-safe") {
            let color := and(f, BYTES_Q58)
            let high := and(f, ABOVE_Q58)
            if high {
                // above 255, or below 0: a carry into the next lane tells
                high := add(high, ABOVE_Q58)
                high := and(high, CARRIES_85)
                color := or(color, mul(shr(CARRY_85, high), BYTE_Q58))
                high := and(f, SIGNS_85)
                color := and(color, not(mul(shr(SIGN_85, high), BYTE_Q58)))
            }
            let packed := or(shl(BLUE_TO_TOP, color), and(shl(GREEN_TO_TOP, color), SECOND_BYTE))
            packed := or(packed, and(shl(RED_TO_TOP, color), THIRD_BYTE))
            p := add(mload(IMAGE_ORIGIN), mul(3, shr(3, p)))
            mstore(p, or(packed, and(mload(p), BEHIND_PIXEL)))
        }
    }

    /// @dev The colour where the accumulator and the ray are these.
    function colorAt(uint256 attribute, uint256 x, uint256 y) internal pure returns (uint256 color) {
        uint256 s;
        uint256 t;
        assembly ("memory-safe") {
            s := sar(ACCUMULATOR_S_AT, signextend(ACCUMULATOR_S_LAST_BYTE, attribute))
            t := sar(ACCUMULATOR_T_AT, signextend(ACCUMULATOR_T_LAST_BYTE, attribute))
            attribute := shr(ACCUMULATOR_DEPTH_AT, attribute)
        }
        return FragmentLight.colorAt(attribute, s, t, x, y);
    }

    function min(uint256 a, uint256 b) private pure returns (uint256) {
        return a < b ? a : b;
    }

    function max(uint256 a, uint256 b) private pure returns (uint256) {
        return a > b ? a : b;
    }
}
