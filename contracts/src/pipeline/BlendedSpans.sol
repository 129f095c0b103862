// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {ExactSpans} from "./ExactSpans.sol";
import "./Registers.sol";

// Objects that are not opaque. They are drawn twice: the first pass (IS_DEPTH_PASS) finds the nearest fragment of each pixel, the second
// (IS_BLENDED) mixes its colour with what is there, once. The last two bits of a depth say how far it is.

/// @dev The depth at the top of a word without its last two bits, and what these say: nearest, and drawn.
uint256 constant DEPTH_OF_PASSES = 0xfffffffffffffffc000000000000000000000000000000000000000000000000;
uint256 constant DEPTH_FOUND = 0x1000000000000000000000000000000000000000000000000;
uint256 constant DEPTH_DRAWN = 0x2000000000000000000000000000000000000000000000000;
/// @dev Just below 256, Q10.
int256 constant BRIGHTEST = 0x3ffff;

library BlendedSpans {
    /// @notice Draws the rows from `row` to before `last`, between two edges.
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
                    ExactSpans.write(p, blended(color, ExactSpans.pixelAt(p)));
                }
                p += 8;
                attribute += load(DX);
            }
        }
    }

    /// @dev The depth test of both passes; whether the fragment is to be drawn now.
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

    /// @dev color * OPACITY + behind * (1 - OPACITY)
    /// @param color Signed lanes of 85 bits, Q10, which are kept between 0 and 255 first.
    /// @param behind Blue, green and red at the top of the word.
    function blended(uint256 color, uint256 behind) private pure returns (uint256 mixed) {
        unchecked {
            for (uint256 lane; lane != 3; ++lane) {
                int256 value = int256(color << 171) >> 171;
                // without what the lane has borrowed
                color = uint256(int256(color - uint256(value)) >> MIDDLE_85_AT);
                if (value < 0) value = 0;
                if (value > BRIGHTEST) value = BRIGHTEST;
                uint256 byte_ = (behind >> (248 - 8 * lane)) & 0xff;
                mixed |= ((uint256(value) * load(OPACITY) + (byte_ << 10) * (ONE_24 - load(OPACITY))) >> 24) << (MIDDLE_85_AT * lane);
            }
        }
    }
}
