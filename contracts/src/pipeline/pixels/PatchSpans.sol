// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {max, min} from "../geometry/Screen.sol";
import {Patches} from "../shading/Patches.sol";
import {Spans} from "./Spans.sol";
import "../../words/Registers.sol";

// Computes `fill` of picture.py where `shade` is replaced by quadratic functions.
// Rows of fragments whose colours are quadratic functions of the position on the screen: see Patches. Eight fragments at a time, of which
// each channel is a word of eight values; the last fragment is the lowest in it, so a span is drawn from its right end to the left.

/// @dev Longer spans are drawn eight pixels at a time.
uint256 constant SHORT_SPAN = 5;

library PatchSpans {
    /// @notice Draws the rows from `row` (inclusive) to `last` (exclusive), given by addresses, between two edges, as PATCH_SIZE selects.
    function fill(uint256 edges, uint256 slopes, uint256 start, uint256 row, uint256 last) internal pure {
        unchecked {
            uint256 size = load(PATCH_SIZE);
            if (size == 1) return Spans.rows(edges, slopes, start, row, last, false, false);
            if (size == 0) return rows(edges, slopes, start, row, last);
            (row, last) = (Spans.rowAt(row), Spans.rowAt(last));
            while (row != last) {
                uint256 next = min(row / size * size + size, last);
                cells(edges, slopes, start, row, next);
                edges += slopes * (next - row);
                start += load(DY) * (next - row);
                row = next;
            }
        }
    }

    /// @dev Draws a row of cells: the rows of pixels from `row` (inclusive) to `last` (exclusive).
    function cells(uint256 edges, uint256 slopes, uint256 start, uint256 row, uint256 last) private pure {
        unchecked {
            uint256 size = load(PATCH_SIZE);
            uint256 lastEdges = edges + slopes * (last - row - 1);
            // edges are straight: their ends determine the range
            uint256 column = max(
                min((edges >> EDGES_LEFT_COLUMN_AT) & EDGES_LEFT_COLUMN_MASK, (lastEdges >> EDGES_LEFT_COLUMN_AT) & EDGES_LEFT_COLUMN_MASK),
                load(COLUMN_BEGIN)
            ) / size * size;
            uint256 end = min(max(edges >> EDGES_RIGHT_COLUMN_AT, lastEdges >> EDGES_RIGHT_COLUMN_AT), load(COLUMN_END));
            (uint256 origin, uint256 stride) = (load(DEPTH_ORIGIN), load(DEPTH_STRIDE));
            for (; column < end; column += size) {
                store(PATCH_BEGIN, column);
                store(PATCH_END, column + size);
                Patches.fit(column, row, start, size);
                rows(edges, slopes, start, origin - stride * row, origin - stride * last);
            }
        }
    }

    /// @dev Draws rows, given by addresses, with the quadratic function whose differences are set.
    function rows(uint256 edges, uint256 slopes, uint256 start, uint256 row, uint256 last) private pure {
        unchecked {
            setBend(uint256(loadSigned(QUADRATIC_DXX) >> 1));
            for (; int256(row) > int256(last); row -= load(DEPTH_STRIDE)) {
                // the column of the first fragment to draw, or for n > 0 of the last, of n fragments except for the last r
                uint256 column;
                uint256 end;
                uint256 n;
                uint256 r;
                assembly ("memory-safe") {
                    column := and(shr(EDGES_LEFT_COLUMN_AT, edges), EDGES_LEFT_COLUMN_MASK)
                    end := shr(EDGES_RIGHT_COLUMN_AT, edges)
                    if mload(PATCH_SIZE) {
                        if lt(column, mload(PATCH_BEGIN)) { column := mload(PATCH_BEGIN) } // max(column, PATCH_BEGIN)
                        if gt(end, mload(PATCH_END)) { end := mload(PATCH_END) } // min(end, PATCH_END)
                    }
                    n := sub(end, column)
                    switch sgt(n, SHORT_SPAN)
                    case 0 {
                        n := 0
                        if and(mload(MODE), CROSSES_COLUMNS) {
                            if lt(column, mload(COLUMN_BEGIN)) { column := mload(COLUMN_BEGIN) } // max(column, COLUMN_BEGIN)
                            if gt(end, mload(COLUMN_END)) { end := mload(COLUMN_END) } // min(end, COLUMN_END)
                        }
                        end := mul(end, gt(end, column)) // 0 if there is none
                    }
                    default {
                        // in groups of eight from the right, the same whether the tile cuts them or not: so its pixels are those of the
                        // whole picture
                        end := sub(end, 1) // the last column from here on
                        if and(mload(MODE), CROSSES_COLUMNS) {
                            if lt(column, mload(COLUMN_BEGIN)) { n := sub(end, sub(mload(COLUMN_BEGIN), 1)) } // without those before
                            if gt(end, sub(mload(COLUMN_END), 1)) {
                                // beyond the tile: whole groups are left out, the rest of r remains in its group
                                r := sub(end, sub(mload(COLUMN_END), 1))
                                n := sub(n, and(r, not(7)))
                                end := sub(end, and(r, not(7)))
                                r := and(r, 7)
                            }
                        }
                        column := end
                        end := sgt(n, r) // 0 if there is none
                    }
                }
                if (end != 0) {
                    uint256 f;
                    uint256 g;
                    assembly ("memory-safe") {
                        f := add(mload(QUADRATIC_START), mul(shr(1, mul(column, sub(column, 1))), mload(QUADRATIC_DXX)))
                        f := add(f, mul(column, mload(QUADRATIC_DX))) // START + column * DX + column * (column - 1) / 2 * DXX
                        g := add(mload(QUADRATIC_DX), mul(column, mload(QUADRATIC_DXX))) // DX + column * DXX
                    }
                    uint256 attribute = start + column * load(DX);
                    if (n == 0) Spans.draw(row + 8 * column, row + 8 * end, attribute, g, f, false, true, false);
                    else wide(row + 8 * column - 24, n, r, attribute, f, g - uint256(loadSigned(QUADRATIC_DXX) >> 1));
                }
                edges += slopes;
                start += load(DY);
                assembly ("memory-safe") {
                    mstore(QUADRATIC_START, add(mload(QUADRATIC_START), mload(QUADRATIC_DY))) // forward differences
                    mstore(QUADRATIC_DY, add(mload(QUADRATIC_DY), mload(QUADRATIC_DYY)))
                    mstore(QUADRATIC_DX, add(mload(QUADRATIC_DX), mload(QUADRATIC_DXY)))
                }
            }
        }
    }

    /// @dev Draws the last n of the fragments that end at p, except for the last r.
    /// @param p The address of the depth three pixels to the left of the last one: of the first of a word of four.
    /// @param attribute, f The accumulator and the quadratic function at the last fragment.
    /// @param g The slope of the function there.
    function wide(uint256 p, uint256 n, uint256 r, uint256 attribute, uint256 f, uint256 g) private pure {
        assembly ("memory-safe") {
            // The depth test of four pixels; the last n of them except for the last r take part. Writes depths, and returns ones
            // for the colours to keep.
            function depths(p_, n_, r_, attribute_) -> hidden_ {
                // as exact as the depths of single fragments, so that the first of coinciding surfaces remains
                let dx := mload(DX)
                let z := shr(ACCUMULATOR_DEPTH_AT, attribute_) // the last pixel, in the lowest lane
                attribute_ := sub(attribute_, dx)
                z := or(z, and(shr(128, attribute_), THIRD_DEPTH))
                attribute_ := sub(attribute_, dx)
                z := or(z, and(shr(64, attribute_), SECOND_DEPTH))
                z := or(z, and(sub(attribute_, dx), FIRST_DEPTH))
                let old := mload(p_)
                let keep_ := or(shl(shl(6, n_), not(0)), sub(shl(shl(6, r_), 1), 1)) // lanes from n on, and below r
                // depths have a free bit above them
                let fail := sub(TOPS_64, z)
                fail := and(add(old, fail), TOPS_64) // old + 2^63 - z >= 2^63: where old >= z
                fail := and(fail, not(keep_))
                if fail {
                    keep_ := or(keep_, or(fail, sub(fail, shr(63, fail)))) // whole lanes
                    // spread bits 0, 64, 128 and 192 to lanes of 24 bits
                    hidden_ := mul(shr(63, fail), TOPS_64_TO_24)
                    hidden_ := shr(120, mul(and(hidden_, PIXELS_AT_120), LANE_24))
                }
                mstore(p_, xor(z, and(xor(z, old), keep_))) // keep ? old : z
            }

            // a channel of eight fragments, Q9 in 24 bits each, the last one lowest, clamped to 0..255
            function channel(value, slope_, bend) -> word {
                word := add(mul(and(value, LANE_24), ONES_24), bend) // value + x^2 * bend, for x = 0..7 to the left
                word := sub(word, mul(signextend(2, slope_), STEPS_24)) // - x * slope
                if and(word, BEYOND_BYTES_24) {
                    let high := and(word, TOPS_24) // lanes below 0
                    word := and(word, not(or(high, sub(high, shr(23, high))))) // become 0
                    high := and(add(word, CARRY_24), TOPS_24) // lanes above 255
                    word := or(word, sub(shr(6, high), shr(14, high))) // get all bits of 255
                }
                word := and(word, BYTES_24)
            }

            // as Patches.unweighted, and setBend below: assembly cannot call functions outside, and as such, where this loop is in pieces,
            // a cube of 512 x 512 pixels takes 2.8 % more gas
            function unweighted(value, depth) -> quotient {
                value := sub(and(shr(Q48, value), LANES_37), BIAS_36) // Q24
                quotient := add(mul(value, div(shl(Q34, mload(PATCH_WEIGHT)), depth)), HALF_85)
            }

            function storeBend(bend) {
                bend := add(bend, BEND_ROUNDING)
                mstore(BEND_BLUE, mul(signextend(2, shr(BLUE_Q9_AT, bend)), SQUARES_24))
                mstore(BEND_GREEN, mul(signextend(2, shr(GREEN_Q9_AT, bend)), SQUARES_24))
                mstore(BEND_RED, mul(signextend(2, shr(RED_Q9_AT, bend)), SQUARES_24))
            }

            for {} 1 {} {
                // colours to keep: pixels from n or 8 on, and below r
                let keep := or(or(shl(mul(24, n), not(0)), shl(192, not(0))), sub(shl(mul(24, r), 1), 1))
                keep := or(keep, depths(p, n, r, attribute))
                if gt(n, 4) {
                    let rest := mul(gt(r, 4), sub(r, 4)) // max(r - 4, 0)
                    keep := or(keep, shl(96, depths(sub(p, 32), sub(n, 4), rest, sub(attribute, shl(2, mload(DX))))))
                }
                let color := f
                let slope := g
                if mload(PATCH_WEIGHT) {
                    // quotients by the depths of pixels 0, 4 and 8 to the left, and a parabola through them
                    color := mload(PATCH_COLOR) // c(0), of which half a level is at least left
                    if iszero(color) { color := unweighted(f, shr(ACCUMULATOR_DEPTH_AT, attribute)) }
                    slope := add(sub(f, shl(2, g)), shl(3, mload(QUADRATIC_DXX))) // at x = -4: f - 4 g + 16 / 2 * DXX
                    slope := unweighted(slope, shr(ACCUMULATOR_DEPTH_AT, sub(attribute, shl(2, mload(DX))))) // c(-4), for now
                    let sum := add(sub(f, shl(3, g)), shl(5, mload(QUADRATIC_DXX)))
                    sum := unweighted(sum, shr(ACCUMULATOR_DEPTH_AT, sub(attribute, shl(3, mload(DX))))) // c(-8)
                    mstore(PATCH_COLOR, sum)
                    sum := add(color, sum) // c(0) + c(-8)
                    storeBend(shr(5, sub(sum, shl(1, slope)))) // (c(0) - 2 c(-4) + c(-8)) / 32
                    slope := shr(3, add(sub(sum, shl(2, slope)), shl(1, color))) // (3 c(0) - 4 c(-4) + c(-8)) / 8
                }
                let word := shl(7, channel(shr(BLUE_Q9_AT, color), shr(BLUE_Q9_AT, slope), mload(BEND_BLUE)))
                word := or(word, shr(1, channel(shr(GREEN_Q9_AT, color), shr(GREEN_Q9_AT, slope), mload(BEND_GREEN))))
                word := or(word, shr(9, channel(shr(RED_Q9_AT, color), shr(RED_Q9_AT, slope), mload(BEND_RED))))
                // eight pixels are the lower 24 bytes of a word that ends with the last one
                let q := sub(add(mload(IMAGE_ORIGIN), mul(3, shr(DEPTH_SIZE_BITS, p))), 20)
                mstore(q, xor(word, and(xor(word, mload(q)), keep))) // keep ? old : word
                if lt(n, 9) {
                    mstore(PATCH_COLOR, 0)
                    break
                }
                n := sub(n, 8)
                r := 0
                p := sub(p, 64)
                attribute := sub(attribute, shl(3, mload(DX)))
                f := add(sub(f, shl(3, g)), shl(5, mload(QUADRATIC_DXX))) // at x = -8: f - 8 g + 64 / 2 * DXX
                g := sub(g, shl(3, mload(QUADRATIC_DXX)))
            }
        }
    }

    /// @dev Sets the quadratic part of each channel over eight fragments, from half a second difference.
    function setBend(uint256 bend) private pure {
        assembly ("memory-safe") {
            // rounded to nearest
            bend := add(bend, BEND_ROUNDING)
            mstore(BEND_BLUE, mul(signextend(2, shr(BLUE_Q9_AT, bend)), SQUARES_24)) // x^2 * bend
            mstore(BEND_GREEN, mul(signextend(2, shr(GREEN_Q9_AT, bend)), SQUARES_24))
            mstore(BEND_RED, mul(signextend(2, shr(RED_Q9_AT, bend)), SQUARES_24))
        }
    }
}
