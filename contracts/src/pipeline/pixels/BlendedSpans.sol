// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Compositor} from "../Compositor.sol";
import {ExactSpans} from "./ExactSpans.sol";
import "../../words/Registers.sol";

// Translucent objects are drawn twice: the first pass (IS_DEPTH_PASS) finds the nearest fragment of each pixel, the second (IS_BLENDED)
// blends its colour with the pixel, once. The last two bits of a depth record the progress.

/// @dev A depth at the top of a word without its last two bits; the values of these bits: nearest fragment found, and drawn.
uint256 constant DEPTH_OF_PASSES = 0xfffffffffffffffc000000000000000000000000000000000000000000000000;
uint256 constant DEPTH_FOUND = 0x1000000000000000000000000000000000000000000000000;
uint256 constant DEPTH_DRAWN = 0x2000000000000000000000000000000000000000000000000;

library BlendedSpans {
    /// @notice Draws the rows from `row` (inclusive) to `last` (exclusive) between two edges.
    /// @param start The accumulator at column 0 of the first row.
    function rows(uint256 edges, uint256 slopes, uint256 start, uint256 row, uint256 last) internal pure {
        unchecked {
            for (; row != last; ++row) {
                uint256 column = (edges >> EDGES_LEFT_COLUMN_AT) & EDGES_LEFT_COLUMN_MASK;
                if (column < load(COLUMN_BEGIN)) column = load(COLUMN_BEGIN);
                uint256 end = edges >> EDGES_RIGHT_COLUMN_AT;
                if (end > load(COLUMN_END)) end = load(COLUMN_END);
                span(row, column, end, start + column * load(DX));
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
                    uint256 color = ExactSpans.colorAt(attribute, load(RAY_LEFT) + column * load(RAY_STEP), row);
                    ExactSpans.write(p, Compositor.over(color, p));
                }
                p += 8;
                attribute += load(DX);
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
}
