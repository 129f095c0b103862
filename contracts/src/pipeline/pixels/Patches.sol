// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {max, min} from "../geometry/Screen.sol";
import {ExactSpans, HALF_85} from "./ExactSpans.sol";
import {FragmentLight} from "../shading/FragmentLight.sol";
import {Quadratic} from "../shading/Quadratic.sol";
import "../../words/Registers.sol";

// Flat and unlit triangles whose colours are not linear on the screen: colours are approximated by quadratic functions, fitted to exact
// colours over the whole triangle or over its square cells. The cells are aligned to the canvas, not to the tile, so that tiles match the
// whole picture.

/// @dev Longer spans are drawn eight pixels at a time.
uint256 constant SHORT_SPAN = 5;

library Patches {
    /// @notice Draws the rows from `row` (inclusive) to `last` (exclusive) between two edges, as PATCH_SIZE selects.
    function fill(uint256 edges, uint256 slopes, uint256 start, uint256 row, uint256 last) internal pure {
        unchecked {
            uint256 size = load(PATCH_SIZE);
            if (size == 1) return ExactSpans.rows(edges, slopes, start, row, last);
            if (size == 0) return rows(edges, slopes, start, row, last);
            while (row != last) {
                uint256 next = min(row / size * size + size, last);
                cells(edges, slopes, start, row, next);
                edges += slopes * (next - row);
                start += load(DY) * (next - row);
                row = next;
            }
        }
    }

    /// @dev Draws a row of cells.
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
            for (; column < end; column += size) {
                store(PATCH_BEGIN, column);
                store(PATCH_END, column + size);
                fit(column, row, start, size);
                rows(edges, slopes, start, row, last);
            }
        }
    }

    /// @notice Fits a quadratic function to nine exact colours of the cell, where all depths are positive.
    function fit(uint256 column, uint256 row, uint256 start, uint256 size) internal pure {
        unchecked {
            uint256 half = size / 2;
            uint256 x = column + half;
            uint256 y = row / size * size + half;
            // from column 0 of the row to the centre
            start += x * load(DX) + (y - row) * load(DY);
            uint256 dx = half * load(DX);
            uint256 dy = half * load(DY);
            x = load(RAY_LEFT) + x * load(RAY_STEP);
            y = load(RAY_TOP) + y * load(RAY_STEP);
            uint256 step = half * load(RAY_STEP);
            uint256 left = weightedAt(start - dx, x - step, y);
            uint256 right = weightedAt(start + dx, x + step, y);
            uint256 middle = weightedAt(start, x, y);
            store(QUADRATIC_1, middle);
            store(QUADRATIC_SS, left + right - 2 * middle);
            store(QUADRATIC_S, right - left);
            left = weightedAt(start - dy, x, y - step);
            right = weightedAt(start + dy, x, y + step);
            store(QUADRATIC_TT, left + right - 2 * middle);
            store(QUADRATIC_T, right - left);
            left = weightedAt(start - dx - dy, x - step, y - step);
            right = weightedAt(start + dx + dy, x + step, y + step);
            start += dx - dy;
            x += step;
            y -= step;
            middle = weightedAt(start, x, y);
            start = weightedAt(start + 2 * (dy - dx), x - 2 * step, y + 2 * step);
            place(column + half, row - (row / size * size + half), size, right - left, middle - start, left + right - middle - start);
        }
    }

    /// @param down, up, cross Differences of the corners: lower right minus upper left, upper right minus lower left, and that of the sums
    /// of both pairs.
    function place(uint256 x, uint256 y, uint256 size, uint256 down, uint256 up, uint256 cross) private pure {
        unchecked {
            uint256 shift = 0;
            for (; size > 2; size >>= 1) ++shift;
            // Changes per pixel, Q58, where half the size is 2^shift. The first derivatives are the means of those along the centre lines
            // and along the borders: if third derivatives are not zero, one has twice the error of the other, with opposite sign.
            uint256 a = (2 * load(QUADRATIC_S) + down + up) << (48 - 3 - shift);
            uint256 b = (2 * load(QUADRATIC_T) + down - up) << (48 - 3 - shift);
            uint256 xx = load(QUADRATIC_SS) << (48 - 1 - 2 * shift);
            uint256 yy = load(QUADRATIC_TT) << (48 - 1 - 2 * shift);
            uint256 xy = cross << (48 - 2 - 2 * shift);
            // from the centre to column 0 of the row
            x = 0 - x;
            store(QUADRATIC_START, (load(QUADRATIC_1) << 48) + bias() + x * (a + x * xx + y * xy) + y * (b + y * yy));
            store(QUADRATIC_DX, a + (2 * x + 1) * xx + y * xy);
            store(QUADRATIC_DY, b + (2 * y + 1) * yy + x * xy);
            store(QUADRATIC_DXX, 2 * xx);
            store(QUADRATIC_DXY, xy);
            store(QUADRATIC_DYY, 2 * yy);
        }
    }

    /// @dev Returns the colour for this accumulator and ray, as quadratic functions approximate it.
    function weightedAt(uint256 attribute, uint256 x, uint256 y) private pure returns (uint256) {
        return weighted(ExactSpans.colorAt(attribute, x, y), attribute >> ACCUMULATOR_DEPTH_AT);
    }

    /// @dev Returns a colour as quadratic functions approximate it: if depths differ much, multiplied by its depth relative to the nearest,
    /// Q14.
    function weighted(uint256 color, uint256 depth) private pure returns (uint256) {
        unchecked {
            uint256 nearest = load(PATCH_WEIGHT);
            return nearest == 0 ? color : color * ((depth << 14) / nearest);
        }
    }

    /// @dev Returns the bias of a quadratic function: for rounding, or to keep it positive until it is divided by the depth.
    function bias() private pure returns (uint256) {
        return load(PATCH_WEIGHT) == 0 ? HALF_85 : BIAS_84;
    }

    /// @notice Fits a quadratic function to six exact colours of the triangle.
    function fitWhole(uint256 a, uint256 b, uint256 c, uint256 za, uint256 zb, uint256 zc, uint256 top) internal pure {
        unchecked {
            uint256 fa = between(a, a, za << 8, 0, 0);
            uint256 fb = between(b, b, zb << 8, ONE_24, 0);
            uint256 fc = between(c, c, zc << 8, 0, ONE_24);
            uint256 ab = between(a, b, (za + zb) << 7, HALF_24, 0);
            uint256 ac = between(a, c, (za + zc) << 7, 0, HALF_24);
            Quadratic.fromNodes(fa, fb, fc, ab, ac, between(b, c, (zb + zc) << 7, HALF_24, HALF_24));
            Quadratic.setDifferences(a, b, c, top);
            store(QUADRATIC_START, load(QUADRATIC_START) + bias());
        }
    }

    /// @dev Returns the colour at the midpoint between two vertices on the screen.
    function between(uint256 a, uint256 b, uint256 depth, uint256 s, uint256 t) private pure returns (uint256) {
        uint256 x;
        uint256 y;
        assembly ("memory-safe") {
            x := add(
                mload(RAY_LEFT),
                sar(
                    9,
                    mul(
                        add(and(shr(SCREEN_COLUMN_AT, a), SCREEN_COLUMN_MASK), and(shr(SCREEN_COLUMN_AT, b), SCREEN_COLUMN_MASK)),
                        mload(RAY_STEP)
                    )
                )
            )
            y := add(mload(RAY_TOP), sar(9, mul(add(shr(SCREEN_ROW_AT, a), shr(SCREEN_ROW_AT, b)), mload(RAY_STEP))))
        }
        return weighted(FragmentLight.colorAt(depth, s, t, x, y, false), depth);
    }

    /// @dev Draws quadratic colours row by row.
    function rows(uint256 edges, uint256 slopes, uint256 start, uint256 row, uint256 last) private pure {
        assembly ("memory-safe") {
            // The depth test of four pixels; the last n of them except for the last r take part. Writes depths, and returns ones for the
            // colours to keep.
            function depths(p, n, r, attribute) -> hidden {
                // as exact as the depths of single fragments, so that the first of coinciding surfaces remains
                let dx := mload(DX)
                let z := shr(ACCUMULATOR_DEPTH_AT, attribute)
                attribute := sub(attribute, dx)
                z := or(z, and(shr(128, attribute), THIRD_DEPTH))
                attribute := sub(attribute, dx)
                z := or(z, and(shr(64, attribute), SECOND_DEPTH))
                z := or(z, and(sub(attribute, dx), FIRST_DEPTH))
                let old := mload(p)
                let keep := or(shl(shl(6, n), not(0)), sub(shl(shl(6, r), 1), 1))
                // depths have a free bit above them
                let fail := sub(TOPS_64, z)
                fail := and(add(old, fail), TOPS_64)
                fail := and(fail, not(keep))
                if fail {
                    keep := or(keep, or(fail, sub(fail, shr(63, fail))))
                    // spread bits 0, 64, 128 and 192 to lanes of 24 bits
                    hidden := mul(shr(63, fail), TOPS_64_TO_24)
                    hidden := shr(120, mul(and(hidden, PIXELS_AT_120), LANE_24))
                }
                mstore(p, xor(z, and(xor(z, old), keep)))
            }

            // a channel of eight fragments, Q9 in 24 bits each, the last one lowest, clamped to 0..255
            function channel(value, slope, bend) -> word {
                word := add(mul(and(value, LANE_24), ONES_24), bend)
                word := sub(word, mul(signextend(2, slope), STEPS_24))
                if and(word, BEYOND_BYTES_24) {
                    let high := and(word, TOPS_24)
                    word := and(word, not(or(high, sub(high, shr(23, high)))))
                    high := and(add(word, CARRY_24), TOPS_24)
                    word := or(word, sub(shr(6, high), shr(14, high)))
                }
                word := and(word, BYTES_24)
            }

            // a colour, Q58, from a colour times its depth, Q72, in lanes kept positive by BIAS_84
            function unweighted(f, depth) -> color {
                f := sub(and(shr(48, f), LANES_37), BIAS_36)
                color := add(mul(f, div(shl(34, mload(PATCH_WEIGHT)), depth)), HALF_85)
            }

            // the quadratic part of each channel over eight fragments
            function setBend(bend) {
                // rounded to nearest
                bend := add(bend, BEND_ROUNDING)
                mstore(BEND_BLUE, mul(signextend(2, shr(BLUE_Q9_AT, bend)), SQUARES_24))
                mstore(BEND_GREEN, mul(signextend(2, shr(GREEN_Q9_AT, bend)), SQUARES_24))
                mstore(BEND_RED, mul(signextend(2, shr(RED_Q9_AT, bend)), SQUARES_24))
            }

            // draws the last n of the fragments that end at p, except for the last r; attribute, colour and slope are those of the last one
            function wide(p, n, r, attribute, f, g) {
                for {} 1 {} {
                    // colours to keep
                    let keep := or(or(shl(mul(24, n), not(0)), shl(192, not(0))), sub(shl(mul(24, r), 1), 1))
                    if lt(r, 4) { keep := or(keep, depths(p, n, r, attribute)) }
                    if gt(n, 4) {
                        keep := or(
                            keep,
                            shl(96, depths(sub(p, 32), sub(n, 4), mul(gt(r, 4), sub(r, 4)), sub(attribute, shl(2, mload(DX)))))
                        )
                    }
                    let color := f
                    let slope := g
                    if mload(PATCH_WEIGHT) {
                        // quotients by the depths of pixels 0, 4 and 8, and a parabola through them
                        color := unweighted(f, shr(ACCUMULATOR_DEPTH_AT, attribute))
                        slope := add(sub(f, shl(2, g)), shl(3, mload(QUADRATIC_DXX)))
                        slope := unweighted(slope, shr(ACCUMULATOR_DEPTH_AT, sub(attribute, shl(2, mload(DX)))))
                        let bend := add(sub(f, shl(3, g)), shl(5, mload(QUADRATIC_DXX)))
                        bend := add(color, unweighted(bend, shr(ACCUMULATOR_DEPTH_AT, sub(attribute, shl(3, mload(DX))))))
                        setBend(shr(5, sub(bend, shl(1, slope))))
                        slope := shr(3, add(sub(bend, shl(2, slope)), shl(1, color)))
                    }
                    let word := shl(7, channel(shr(BLUE_Q9_AT, color), shr(BLUE_Q9_AT, slope), mload(BEND_BLUE)))
                    word := or(word, shr(1, channel(shr(GREEN_Q9_AT, color), shr(GREEN_Q9_AT, slope), mload(BEND_GREEN))))
                    word := or(word, shr(9, channel(shr(RED_Q9_AT, color), shr(RED_Q9_AT, slope), mload(BEND_RED))))
                    let q := sub(add(mload(IMAGE_ORIGIN), mul(3, shr(3, p))), 20)
                    mstore(q, xor(word, and(xor(word, mload(q)), keep)))
                    if lt(n, 9) { break }
                    n := sub(n, 8)
                    r := 0
                    p := sub(p, 64)
                    attribute := sub(attribute, shl(3, mload(DX)))
                    f := add(sub(f, shl(3, g)), shl(5, mload(QUADRATIC_DXX)))
                    g := sub(g, shl(3, mload(QUADRATIC_DXX)))
                }
            }

            // one by one
            function narrow(p, end, attribute, f, g) {
                let q := add(mload(IMAGE_ORIGIN), mul(3, shr(3, p)))
                for {} 1 {} {
                    let old := mload(p)
                    let z := and(attribute, FIRST_DEPTH)
                    if gt(z, old) {
                        mstore(p, or(z, and(old, BEHIND_DEPTH)))
                        let color := f
                        if mload(PATCH_WEIGHT) { color := unweighted(f, shr(ACCUMULATOR_DEPTH_AT, attribute)) }
                        old := and(color, BYTES_Q58)
                        z := and(color, ABOVE_Q58)
                        if z {
                            z := add(z, ABOVE_Q58)
                            z := and(z, CARRIES_85)
                            old := or(old, mul(shr(85, z), BYTE_Q58))
                            z := and(color, SIGNS_85)
                            old := and(old, not(mul(shr(84, z), BYTE_Q58)))
                        }
                        z := or(shl(BLUE_TO_TOP, old), and(shl(GREEN_TO_TOP, old), SECOND_BYTE))
                        z := or(z, and(shl(RED_TO_TOP, old), THIRD_BYTE))
                        mstore(q, or(z, and(mload(q), BEHIND_PIXEL)))
                    }
                    p := add(p, 8)
                    if eq(p, end) { break }
                    q := add(q, 3)
                    attribute := add(attribute, mload(DX))
                    f := add(f, g)
                    g := add(g, mload(QUADRATIC_DXX))
                }
            }

            row := sub(mload(DEPTH_ORIGIN), mul(mload(DEPTH_STRIDE), row))
            last := sub(mload(DEPTH_ORIGIN), mul(mload(DEPTH_STRIDE), last))
            setBend(sar(1, mload(QUADRATIC_DXX)))
            for {} sgt(row, last) {} {
                let from := and(shr(EDGES_LEFT_COLUMN_AT, edges), EDGES_LEFT_COLUMN_MASK)
                let to := shr(EDGES_RIGHT_COLUMN_AT, edges)
                if mload(PATCH_SIZE) {
                    if lt(from, mload(PATCH_BEGIN)) { from := mload(PATCH_BEGIN) }
                    if gt(to, mload(PATCH_END)) { to := mload(PATCH_END) }
                }
                if gt(to, from) {
                    switch gt(sub(to, from), SHORT_SPAN)
                    case 0 {
                        if and(mload(MODE), IS_CROSSING) {
                            if lt(from, mload(COLUMN_BEGIN)) { from := mload(COLUMN_BEGIN) }
                            if gt(to, mload(COLUMN_END)) { to := mload(COLUMN_END) }
                        }
                        if gt(to, from) {
                            let f := add(mload(QUADRATIC_START), mul(shr(1, mul(from, sub(from, 1))), mload(QUADRATIC_DXX)))
                            f := add(f, mul(from, mload(QUADRATIC_DX)))
                            let g := add(mload(QUADRATIC_DX), mul(from, mload(QUADRATIC_DXX)))
                            narrow(add(row, shl(3, from)), add(row, shl(3, to)), add(start, mul(from, mload(DX))), f, g)
                        }
                    }
                    default {
                        let n := sub(to, from)
                        let r := 0
                        to := sub(to, 1)
                        if and(mload(MODE), IS_CROSSING) {
                            if lt(from, mload(COLUMN_BEGIN)) { n := sub(to, sub(mload(COLUMN_BEGIN), 1)) }
                            if gt(to, sub(mload(COLUMN_END), 1)) {
                                // groups of eight that lie outside
                                r := sub(to, sub(mload(COLUMN_END), 1))
                                from := and(r, not(7))
                                r := and(r, 7)
                                to := sub(to, from)
                                n := sub(n, from)
                            }
                        }
                        if sgt(n, r) {
                            let g := add(mload(QUADRATIC_DX), mul(to, mload(QUADRATIC_DXX)))
                            let f := add(mload(QUADRATIC_START), mul(shr(1, mul(to, sub(to, 1))), mload(QUADRATIC_DXX)))
                            f := add(f, mul(to, mload(QUADRATIC_DX)))
                            wide(
                                sub(add(row, shl(3, to)), 24),
                                n,
                                r,
                                add(start, mul(to, mload(DX))),
                                f,
                                sub(g, sar(1, mload(QUADRATIC_DXX)))
                            )
                        }
                    }
                }
                edges := add(edges, slopes)
                start := add(start, mload(DY))
                row := sub(row, mload(DEPTH_STRIDE))
                mstore(QUADRATIC_START, add(mload(QUADRATIC_START), mload(QUADRATIC_DY)))
                mstore(QUADRATIC_DY, add(mload(QUADRATIC_DY), mload(QUADRATIC_DYY)))
                mstore(QUADRATIC_DX, add(mload(QUADRATIC_DX), mload(QUADRATIC_DXY)))
            }
        }
    }
}
