// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Compositor} from "../Compositor.sol";
import {FragmentLight} from "../shading/FragmentLight.sol";
import {Patches} from "../shading/Patches.sol";
import "../../words/Registers.sol";

// Computes `fill` of picture.py pixel by pixel, and `draw` where it blends.
// Rows of fragments that are drawn one by one, with colours of four kinds: linear, in the accumulator; quadratic functions; computed for
// each fragment; or the same, translucent. The flags that tell the kind are literals, of which the compiler is to make a function for each
// kind. (They are no numbers to be compared: in a loop, the compiler would compute and keep the results.)
//
// Translucent objects are drawn twice: the first pass (IS_DEPTH_PASS) finds the nearest fragment of each pixel, the second (IS_BLENDED)
// blends its colour with the pixel, once. The last two bits of a depth record the progress.

/// @dev A depth at the top of a word without its last two bits; the values of these bits: nearest fragment found, and drawn.
uint256 constant DEPTH_OF_PASSES = 0xfffffffffffffffc000000000000000000000000000000000000000000000000;
uint256 constant DEPTH_FOUND = 0x1000000000000000000000000000000000000000000000000;
uint256 constant DEPTH_DRAWN = 0x2000000000000000000000000000000000000000000000000;

library Spans {
    /// @notice Draws the rows from `row` (inclusive) to `last` (exclusive), given by addresses, between two edges.
    /// @param edges, slopes Columns, Q48.
    /// @param start The accumulator at column 0 of the first row; DX and DY are its changes.
    /// @param isLinear, isBlended The kind: colours in the accumulator; translucent; neither, colours computed for each fragment.
    function rows(uint256 edges, uint256 slopes, uint256 start, uint256 row, uint256 last, bool isLinear, bool isBlended) internal pure {
        unchecked {
            for (; int256(row) > int256(last); row -= load(DEPTH_STRIDE)) {
                uint256 column;
                uint256 end;
                assembly ("memory-safe") {
                    column := and(shr(EDGES_LEFT_COLUMN_AT, edges), EDGES_LEFT_COLUMN_MASK)
                    if lt(column, mload(COLUMN_BEGIN)) { column := mload(COLUMN_BEGIN) } // column = max(left, COLUMN_BEGIN)
                    end := shr(EDGES_RIGHT_COLUMN_AT, edges)
                    if gt(end, mload(COLUMN_END)) { end := mload(COLUMN_END) } // end = min(right, COLUMN_END)
                }
                if (column < end) {
                    uint256 x = isLinear ? 0 : load(RAY_LEFT) + column * load(RAY_STEP);
                    uint256 y = isLinear ? 0 : load(RAY_TOP) + rowAt(row) * load(RAY_STEP);
                    draw(row + 8 * column, row + 8 * end, start + column * load(DX), x, y, isLinear, false, isBlended);
                }
                edges += slopes;
                start += load(DY);
            }
        }
    }

    /// @notice Draws at least one fragment.
    /// @param p, end The addresses of the depths of the first pixel, and of the one after the last.
    /// @param attribute The accumulator at the first pixel.
    /// @param x, y The ray through it; of a quadratic function the first difference, and the value.
    function draw(
        uint256 p,
        uint256 end,
        uint256 attribute,
        uint256 x,
        uint256 y,
        bool isLinear,
        bool isQuadratic,
        bool isBlended
    ) internal pure {
        unchecked {
            uint256 pixel = load(IMAGE_ORIGIN) + 3 * (p >> DEPTH_SIZE_BITS);
            while (true) {
                if (isBlended ? passes(p, attribute) : attribute > load(p) | BEHIND_DEPTH) {
                    if (!isBlended) {
                        assembly ("memory-safe") {
                            // copying a few bytes is cheaper than inserting them into a word
                            mstore(0, attribute)
                            mcopy(p, 0, 8)
                        }
                    }
                    if (isLinear) {
                        assembly ("memory-safe") {
                            let color := and(shr(ACCUMULATOR_FRACTION, attribute), LANES_24)
                            // lanes above 255 get all bits of 255
                            color := or(color, mul(and(shr(OVERFLOW_CARRY_AT, add(color, OVERFLOW_TO_CARRY)), ONES), BYTE_Q10))
                            mstore(0, mul(and(color, BYTES_Q10), Q10_TO_PIXEL))
                            mcopy(pixel, 0, 3)
                        }
                    } else {
                        uint256 color = y;
                        if (isQuadratic) {
                            if (load(PATCH_WEIGHT) != 0) color = Patches.unweighted(y, attribute >> ACCUMULATOR_DEPTH_AT);
                            color >>= Q10_TO_Q58; // it has half a level already
                        } else {
                            color = FragmentLight.colorOf(attribute, x, y);
                            if (isBlended) color = Compositor.over(color, pixel);
                            color += HALF_85_Q10;
                        }
                        if (color & BEYOND_BYTE_85 != 0) color = FragmentLight.clamped(color);
                        assembly ("memory-safe") {
                            mstore8(pixel, shr(BLUE_Q10_AT, color))
                            mstore8(add(pixel, 1), shr(GREEN_Q10_AT, color))
                            mstore8(add(pixel, 2), shr(RED_Q10_AT, color))
                        }
                    }
                }
                p += 8;
                if (p == end) break;
                pixel += 3;
                attribute += load(DX);
                if (isQuadratic) {
                    y += x;
                    x += load(QUADRATIC_DXX);
                } else if (!isLinear) {
                    x += load(RAY_STEP);
                }
            }
        }
    }

    /// @dev Performs the depth test of either pass, and returns whether the fragment is to be drawn now.
    function passes(uint256 p, uint256 attribute) private pure returns (bool) {
        unchecked {
            uint256 old = load(p);
            bool second = load(MODE) & IS_BLENDED != 0;
            attribute &= DEPTH_OF_PASSES;
            if (second ? (old ^ (attribute | DEPTH_FOUND)) >> ACCUMULATOR_DEPTH_AT != 0 : attribute <= old | type(uint192).max) {
                return false;
            }
            store(p, attribute | (second ? DEPTH_DRAWN : DEPTH_FOUND) | (old & type(uint192).max));
            return second;
        }
    }

    /// @dev Returns the row of which this is the address of the depth at column 0.
    function rowAt(uint256 position) internal pure returns (uint256 row) {
        assembly ("memory-safe") {
            row := div(sub(mload(DEPTH_ORIGIN), position), mload(DEPTH_STRIDE))
        }
    }
}
