// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Rasterizer} from "../geometry/Rasterizer.sol";
import {firstRowOf, max, min} from "../geometry/Screen.sol";
import {Samples} from "./Samples.sol";
import "../../words/SampleRegisters.sol";

// Computes `fill` of picture.py for four samples per pixel, and `edge_functions` as columns of the edges.
// Rasterizes triangles to fragments with four samples per pixel (multisampling). A fragment is a pixel in which a triangle covers at least
// one sample. Its colour is computed once, its depth for each sample.
//
// A side of a triangle in a row is four columns, one for each sample, in lanes of 64 bits: the column at which the edge crosses the height
// of the sample, minus the offset of the sample in the pixel. Columns are represented by the addresses of their pixels' samples, Q37, which
// are columns in Q42. A pixel with its samples at p has a sample inside if p is not left of the left side and left of the right side. Sides
// are stored so that one addition or subtraction of p in all lanes yields the result in the highest bit of each:
//
//   left = 2^63 - side                  left + p  >= 2^63 where p >= side
//   right = 2^63 - 1 + side             right - p >= 2^63 where p < side
//
// Edges are defined by their upper vertex, independent of the triangle, so that adjacent triangles neither leave gaps nor overlap. Above
// the upper vertex of two edges and below the lower one, the sides are swapped, so that nothing lies between them.
//
// With x and y for the offsets of the samples in eighths of a pixel, a side is that of the pixel centre, at column c and with slope s, plus
// s * y - x eighths: its outermost samples are max(s + 3, 3 * s - 1, 1 - 3 * s) eighths from c. These are the bounds.

/// @dev Kinds of fragments: opaque; translucent, in either pass; some samples may be in shadow.
uint256 constant EXACT = 0;
uint256 constant BLENDED = 1;
uint256 constant PARTLY_DARK = 2;

abstract contract SampleRasterizer is Rasterizer {
    /// @notice Draws the fragments of a row from `column` (inclusive) to `end` (exclusive).
    function drawSpan(uint256 left, uint256 right, uint256 column, uint256 end, uint256 row) internal pure virtual;

    /// @notice Draws a fragment of the kind EXACT, for drawEach.
    /// @param p The address of the pixel's samples.
    /// @param attribute The accumulator at the pixel centre.
    /// @param covered The highest bits of the samples that the triangle covers, at least one.
    function drawExact(uint256 p, uint256 attribute, uint256 covered, uint256 column, uint256 row) internal pure virtual;

    /// @notice The same for BLENDED and for PARTLY_DARK, if this engine draws them.
    function drawBlended(uint256 p, uint256 attribute, uint256 covered, uint256 column, uint256 row) internal pure virtual;

    function drawPartlyDark(uint256 p, uint256 attribute, uint256 covered, uint256 column, uint256 row) internal pure virtual;

    /// @notice Calls setGradients, and sets further registers that shading requires.
    /// @param a, b, c As for `drawTriangle`. The first row to draw is SIDE_ROW.
    function prepare(uint256 a, uint256 b, uint256 c) internal pure virtual;

    /// @notice Draws the rows from `row` (inclusive) to `last` (exclusive) of the current triangle, as its mode selects.
    function drawFragments(uint256 row, uint256 last) internal pure virtual;

    /// @dev A triangle between pixel centres may cover samples.
    function coversNothing(uint256, uint256, uint256) internal pure override returns (bool) {
        return false;
    }

    function drawTriangle(uint256 a, uint256 b, uint256 c) internal pure override {
        unchecked {
            uint256 lowest = (b > c ? b : c) + ((OUTERMOST_SAMPLE + SUBPIXEL_MASK) << SCREEN_ROW_AT);
            uint256 row = max((a + ((SUBPIXEL_MASK - OUTERMOST_SAMPLE) << SCREEN_ROW_AT)) >> SCREEN_PIXEL_ROW_AT, load(BAND_TOP));
            uint256 last = min(lowest >> SCREEN_PIXEL_ROW_AT, load(BAND_BOTTOM));
            if (row >= last) return;
            setSides(a, b, c, row);
            prepare(a, b, c);
            if (load(MODE) & IS_TURNED_AWAY != 0) {
                (int256 dx, int256 dy) = (loadSigned(DX) >> PIXEL_64_BITS, loadSigned(DY) >> PIXEL_64_BITS);
                uint256 depth = setBack(uint256(dx), uint256(dy), load(SAMPLE_BASE));
                depth <<= load(SAMPLE_SHIFT);
                store(DEPTH_OFFSETS, load(DEPTH_OFFSETS) - depth * ONES_64 - SAMPLE_DEPTH_UNIT);
            }
            if (load(IS_CLAMPED) != 0) setSpan(a, b, c);
            drawFragments(row, last);
        }
    }

    /// @dev Sets the row to which quadratic functions refer: the first of the triangle in the band.
    /// @param a The screen word of the topmost vertex.
    function setQuadraticRow(uint256 a) internal pure {
        store(QUADRATIC_ROW, max(firstRowOf(a), load(BAND_TOP)));
    }

    /// @dev Sets the accumulator at column 0 of the row of the first pixel centres below the first vertex, and its changes.
    /// @param bits How many more bits barycentric coordinates have: FINE_BITS or 0, a literal, for which the compiler makes a copy. Their
    /// error, of gradients that are rounded, grows with the distance from the first vertex, which may be thousands of pixels away where a
    /// face is clipped, and in perspective with the ratio of depths, which may be 1,000 there: too much for textures.
    function setGradients(uint256 a, uint256 b, uint256 c, uint256 bits) internal pure {
        assembly ("memory-safe") {
            // moves the depth of an attribute word, which the larger gradients move back
            function fine(word) -> moved {
                moved := signextend(WEIGHTS_LAST_BYTE, word) // the weights
                moved := add(moved, sar(FINE_BITS, sub(word, moved))) // weights + depth / 2^12
            }

            let x := and(shr(SCREEN_COLUMN_AT, a), SCREEN_COLUMN_MASK) // column of a
            let xb := sub(and(shr(SCREEN_COLUMN_AT, b), SCREEN_COLUMN_MASK), x) // columns from a to b
            let xc := sub(and(shr(SCREEN_COLUMN_AT, c), SCREEN_COLUMN_MASK), x) // and to c
            a := shr(SCREEN_ROW_AT, a) // a: its row
            b := sub(shr(SCREEN_ROW_AT, b), a) // b, c: rows from a to b, and to c
            c := sub(shr(SCREEN_ROW_AT, c), a)
            let y := and(sub(0, a), SUBPIXEL_MASK) // sub-pixels down to the centres of the next row
            mstore(START_ROW, shr(SUBPIXEL_BITS, add(a, SUBPIXEL_MASK))) // ceil(a)
            // a: twice the area; b, xb, c, xc from here on: the gradients of barycentric coordinates, as in PixelRasterizer
            a := sub(mul(xc, b), mul(xb, c)) // xc * yb - xb * yc
            b := sdiv(shl(add(GRADIENT_SHIFT, bits), b), a) // dt/dx = yb / area, Q29
            xb := sdiv(shl(add(GRADIENT_SHIFT, bits), xb), a) // -dt/dy = xb / area
            c := sdiv(shl(add(GRADIENT_SHIFT, bits), c), a) // -ds/dx = yc / area
            xc := sdiv(shl(add(GRADIENT_SHIFT, bits), xc), a) // ds/dy = xc / area
            let start := mload(ATTRIBUTE_0)
            let toB := mload(DELTA_1)
            let toC := mload(DELTA_2)
            switch bits
            case 0 {
                // Colours are extrapolated up to a pixel outside the triangle. They fit their lanes if a barycentric coordinate changes by
                // at most 16 per pixel: thinner triangles have the colour of their first vertex.
                a := or(or(add(b, LEAST_WIDTH), add(xb, LEAST_WIDTH)), or(add(c, LEAST_WIDTH), add(xc, LEAST_WIDTH))) // some gradient + 16
                if and(a, ABOVE_LEAST_WIDTH) { // some gradient < -16 or >= 16
                    if iszero(and(mload(MODE), or(IS_PATCHED, IS_QUADRATIC))) {
                        toB := shl(ATTRIBUTE_DEPTH_AT, sar(ATTRIBUTE_DEPTH_AT, add(toB, HALF_DEPTH))) // the depth alone, rounded
                        toC := shl(ATTRIBUTE_DEPTH_AT, sar(ATTRIBUTE_DEPTH_AT, add(toC, HALF_DEPTH)))
                    }
                }
            }
            default {
                toB := fine(toB)
                toC := fine(toC)
                // the ends of lines have coordinates of 1
                start := add(start, mul(signextend(WEIGHTS_LAST_BYTE, sub(start, WEIGHT_BIAS)), FINE_FACTOR_LESS_1))
            }
            start := sub(start, mul(toC, sar(GRADIENT_TO_ACCUMULATOR, add(mul(x, b), mul(y, xb))))) // + toC * t
            start := add(start, mul(toB, sar(GRADIENT_TO_ACCUMULATOR, add(mul(x, c), mul(y, xc))))) // + toB * s
            // from here on the changes of the accumulator over an eighth of a pixel: b to the right, c downward
            b := sub(mul(toC, b), mul(toB, c)) // toC * dt/dx + toB * ds/dx
            c := sub(mul(toB, xc), mul(toC, xb)) // toB * ds/dy + toC * dt/dy
            // Depths of thin triangles change by more than a lane holds. Where a sample is covered, its depth is right modulo 2^64, if
            // eighths are taken before they overflow.
            x := sar(ACCUMULATOR_DEPTH_AT, b) // x, y: the changes of the depth over an eighth of a pixel
            y := sar(ACCUMULATOR_DEPTH_AT, c)
            mstore(DX, shl(EIGHTH_BITS, b))
            mstore(DY, shl(EIGHTH_BITS, c))
            if and(mload(MODE), or(IS_PATCHED, IS_QUADRATIC)) {
                mstore(DX_8, b)
                mstore(DY_8, c)
                if and(mload(MODE), IS_DEEP) {
                    start := add(start, mload(DEEP_START))
                    b := mload(DEEP_DX)
                    c := mload(DEEP_DY)
                    x := add(x, signextend(LANE_64_LAST_BYTE, sar(DEEP_8_AT, b)))
                    y := add(y, signextend(LANE_64_LAST_BYTE, sar(DEEP_8_AT, c)))
                    mstore(DX, add(mload(DX), shl(ATTRIBUTE_DEPTH_AT, b)))
                    mstore(DY, add(mload(DY), shl(ATTRIBUTE_DEPTH_AT, c)))
                }
            }
            mstore(START, start)
            mstore(DEPTH_OFFSETS, sub(shl(mload(SAMPLE_SHIFT), add(mul(x, SAMPLE_X_8), mul(y, SAMPLE_Y_8))), mload(DEPTH_BASE)))
        }
    }

    /// @dev Sets the sides and bounds at the first row, and the row in which one of the sides continues with another edge (the kink).
    function setSides(uint256 a, uint256 b, uint256 c, uint256 row) private pure {
        assembly ("memory-safe") {
            // An edge with the direction (dx, dy) that starts `below` sub-pixels above the row, at the address `at`. Returns a left side,
            // whose complement is a right side; its change per row; its position, rounded up; and the distance of its outermost samples.
            function edge(dx, dy, at, below) -> side, step, line, reach {
                step := sdiv(shl(COLUMN_FRACTION, dx), dy) // dx / dy, Q42 columns per row
                line := add(at, sar(SUBPIXEL_BITS, mul(below, step))) // at + below * step: the edge at the pixel centre
                reach := sar(EIGHTH_BITS, step) // s, in eighths, if s is the slope
                side := sub(LEFT_AT_0, add(mul(line, ONES_64), mul(reach, SAMPLE_Y_8))) // 2^63 + x / 8 - line - s * y / 8 in each lane
                line := add(line, CEIL_42) // ceil(line)
                step := sub(step, mload(STRIDE_37)) // with the change of addresses to the next row
                dx := sub(mul(3, reach), EIGHTH_42) // 3 * s - 1
                dx := xor(dx, sar(SIGN_AT, dx)) // |3 * s - 1|
                reach := add(reach, THREE_EIGHTHS_42) // s + 3
                if sgt(dx, reach) { reach := dx } // max(s + 3, |3 * s - 1|)
            }

            let x := and(shr(SCREEN_COLUMN_AT, a), SCREEN_COLUMN_MASK) // column of a
            let xb := sub(and(shr(SCREEN_COLUMN_AT, b), SCREEN_COLUMN_MASK), x) // columns from a to b
            let xc := sub(and(shr(SCREEN_COLUMN_AT, c), SCREEN_COLUMN_MASK), x) // and to c
            a := shr(SCREEN_ROW_AT, a) // a: its row
            b := sub(shr(SCREEN_ROW_AT, b), a) // b, c: rows from a to b, and to c
            c := sub(shr(SCREEN_ROW_AT, c), a)
            mstore(SIDE_ROW, row)
            // the position of the first vertex
            x := add(shl(ADDRESS_FRACTION, sub(mload(SAMPLE_ORIGIN), mul(row, mload(SAMPLE_STRIDE)))), shl(SUBPIXEL_TO_COLUMN, x))
            row := sub(shl(SUBPIXEL_BITS, row), a) // row: sub-pixels from the first vertex to the first row
            {
                // to the second vertex on the left
                let side, step, line, reach := edge(xb, b, x, row)
                mstore(SIDE_LEFT, side)
                mstore(SIDE_LEFT_STEP, mul(sub(0, step), ONES_64)) // -step in each lane
                mstore(BOUNDS, sub(line, reach)) // lower lane: ceil(line - reach)
                mstore(BOUND_STEPS, step) // lower lane
                mstore(INSETS, reach) // lower lane: + reach
                mstore(IS_CLAMPED, reach) // for now, the bits of all three: see FAR_42
                // to the third vertex on the right; a horizontal edge has no side below it: nothing is left of address 0
                side, step, line, reach := edge(xc, c, mul(x, gt(c, 0)), row)
                mstore(SIDE_RIGHT, not(side)) // 2^63 - 1 - (side - 2^63) in each lane
                mstore(SIDE_RIGHT_STEP, mul(step, ONES_64)) // step in each lane
                mstore(BOUNDS, add(mload(BOUNDS), shl(UPPER_BOUND_AT, add(line, reach)))) // upper lane: ceil(line + reach)
                mstore(BOUND_STEPS, add(mload(BOUND_STEPS), shl(UPPER_BOUND_AT, step)))
                mstore(INSETS, sub(mload(INSETS), shl(UPPER_BOUND_AT, reach))) // upper lane: - reach
                mstore(IS_CLAMPED, or(mload(IS_CLAMPED), reach))
            }
            // from the upper to the lower of both; shift and sign are 0 and -1 on the left, 128 and 1 on the right
            let shift := shl(7, iszero(lt(b, c))) // b < c ? 0 : 128
            let sign := sub(shr(6, shift), 1) // b < c ? -1 : 1
            mstore(KINK_SIDE, add(SIDE_LEFT, shr(2, shift))) // b < c ? SIDE_LEFT : SIDE_RIGHT
            let kept := shl(sub(128, shift), LANE_128) // the lane of the other side
            mstore(KINK_KEPT, kept)
            // the beginning of the kink: the first row with a sample below it; samples above it are still on the upper edge
            switch shift
            case 0 {
                row := add(a, b) // row: of the vertex of the kink
                x := add(x, shl(SUBPIXEL_TO_COLUMN, xb)) // x: the address of the vertex of the kink
            }
            default {
                row := add(a, c)
                x := add(x, shl(SUBPIXEL_TO_COLUMN, xc))
            }
            a := add(row, TO_FIRST_ROW) // a: row of the kink in sub-pixels, and samples above it
            mstore(KINK_MASK, shl(and(a, SAMPLES_ABOVE), not(0))) // all but 64 * (samples above) bits
            a := shr(SUBPIXEL_BITS, a) // whole rows
            mstore(KINK_ROW, a)
            row := sub(shl(SUBPIXEL_BITS, a), row) // sub-pixels from the vertex of the kink to that row
            a := sub(a, mload(SIDE_ROW)) // a: rows from the first one to the kink
            {
                x := mul(sub(x, mul(a, mload(STRIDE_37))), iszero(eq(b, c))) // b == c ? 0 : its address in the row of the kink
                let side, step, line, reach := edge(sub(xc, xb), sub(c, b), x, row)
                mstore(KINK_EDGE, xor(side, sub(0, gt(shift, 0)))) // left ? side : ~side
                mstore(KINK_STEP, mul(mul(sign, step), ONES_64)) // left ? -step : step
                // the borrow between lanes is less than the rounding of the bounds
                step := shl(shift, step) // in the lane of that side
                mstore(KINK_BOUND, and(shl(shift, add(line, mul(sign, reach))), not(kept)))
                mstore(KINK_BOUND_STEPS, add(and(mload(BOUND_STEPS), kept), step))
                mstore(KINK_INSETS, sub(and(mload(INSETS), kept), shl(shift, mul(sign, reach))))
                mstore(IS_CLAMPED, or(and(or(mload(IS_CLAMPED), reach), FAR_42), and(mload(MODE), IS_CLAMPED_MODE)))
                if eq(b, c) {
                    // there is no edge below
                    mstore(KINK_KEPT, not(0))
                    mstore(KINK_BOUND, 0)
                }
                if slt(a, 0) {
                    // only the lower edge is in the band
                    a := sub(0, a)
                    mstore(mload(KINK_SIDE), add(mload(KINK_EDGE), mul(a, mload(KINK_STEP)))) // edge + a * step
                    mstore(sub(add(mload(KINK_SIDE), SIDE_LEFT_STEP), SIDE_LEFT), mload(KINK_STEP))
                    mstore(BOUNDS, add(or(and(mload(BOUNDS), mload(KINK_KEPT)), mload(KINK_BOUND)), mul(a, step)))
                    mstore(BOUND_STEPS, mload(KINK_BOUND_STEPS)) // the changes below the kink
                    mstore(INSETS, mload(KINK_INSETS))
                    mstore(KINK_ROW, GUARD_BAND) // no kink in the band
                }
            }
        }
    }

    /// @dev Sets the columns that the triangle may touch.
    function setSpan(uint256 a, uint256 b, uint256 c) private pure {
        assembly ("memory-safe") {
            let x := and(a, SCREEN_COLUMNS)
            let end := x
            let other := and(b, SCREEN_COLUMNS) // columns in the format of screen words
            if lt(other, x) { x := other } // x = min(columns)
            if gt(other, end) { end := other } // end = max(columns)
            other := and(c, SCREEN_COLUMNS)
            if lt(other, x) { x := other } // x = min(columns)
            if gt(other, end) { end := other } // end = max(columns)
            x := shr(SCREEN_PIXEL_COLUMN_AT, add(x, FROM_FIRST_SAMPLE)) // the first column with a sample
            end := add(shr(SCREEN_PIXEL_COLUMN_AT, add(end, TO_LAST_SAMPLE)), 1) // the one after the last
            if lt(x, mload(COLUMN_BEGIN)) { x := mload(COLUMN_BEGIN) }
            if gt(end, mload(COLUMN_END)) { end := mload(COLUMN_END) }
            mstore(SPAN_BEGIN, x)
            mstore(SPAN_END, end)
        }
    }

    /// @dev Draws the rows from `row` (inclusive) to `last` (exclusive), between SPAN_BEGIN and SPAN_END.
    function drawSpans(uint256 row, uint256 last) internal pure {
        unchecked {
            uint256 kink = load(KINK_ROW);
            while (row != last) {
                // the rows above the kink, the row of the kink, the rows below
                uint256 next = row < kink ? min(kink, last) : row == kink ? row + 1 : last;
                (uint256 left, uint256 right) = sidesAt(row);
                for (; row != next; ++row) {
                    (uint256 first, uint256 end) = columnsBetween(row);
                    if (first < end) drawSpan(left, right, first, end, row);
                    left += load(ROW_LEFT_STEP);
                    right += load(ROW_RIGHT_STEP);
                    store(ROW_BOUNDS, load(ROW_BOUNDS) + load(ROW_BOUND_STEPS));
                }
            }
        }
    }

    /// @dev Draws the fragments of a row one by one.
    /// @param kind EXACT, BLENDED or PARTLY_DARK. If it is a literal, the compiler makes a loop for it alone.
    function drawEach(uint256 left, uint256 right, uint256 column, uint256 end, uint256 row, uint256 kind) internal pure {
        unchecked {
            uint256 attribute = load(START) + (row - load(START_ROW)) * load(DY) + column * load(DX);
            uint256 p = Samples.openRow(row) + (column << SAMPLE_SIZE_BITS);
            for (; column != end; ++column) {
                uint256 covered = Samples.coverage(left, right, p);
                if (covered != 0) {
                    if (kind == EXACT) drawExact(p, attribute, covered, column, row);
                    else if (kind == BLENDED) drawBlended(p, attribute, covered, column, row);
                    else drawPartlyDark(p, attribute, covered, column, row);
                }
                p += SAMPLE_SIZE;
                attribute += load(DX);
            }
        }
    }

    /// @dev Returns the sides at a row; sets the registers of their changes to the next row and of the bounds.
    function sidesAt(uint256 row) internal pure returns (uint256 left, uint256 right) {
        unchecked {
            uint256 n = row - load(SIDE_ROW);
            store(ROW_LEFT_STEP, load(SIDE_LEFT_STEP));
            store(ROW_RIGHT_STEP, load(SIDE_RIGHT_STEP));
            store(ROW_BOUND_STEPS, load(BOUND_STEPS));
            (left, right) = (load(SIDE_LEFT) + n * load(SIDE_LEFT_STEP), load(SIDE_RIGHT) + n * load(SIDE_RIGHT_STEP));
            uint256 bounds = load(BOUNDS) + n * load(BOUND_STEPS);
            n = row - load(KINK_ROW);
            if (int256(n) >= 0) {
                bool isLeft = load(KINK_SIDE) == SIDE_LEFT;
                uint256 step = load(KINK_STEP);
                uint256 edge = load(KINK_EDGE) + n * step;
                if (n == 0) {
                    uint256 mask = load(KINK_MASK);
                    edge = (edge & mask) | ((isLeft ? left : right) & ~mask);
                }
                if (isLeft) {
                    left = edge;
                    store(ROW_LEFT_STEP, step);
                    step = signed128(load(KINK_BOUND_STEPS));
                } else {
                    right = edge;
                    store(ROW_RIGHT_STEP, step);
                    step = load(KINK_BOUND_STEPS) - signed128(load(KINK_BOUND_STEPS));
                }
                bounds = ((bounds & load(KINK_KEPT)) | load(KINK_BOUND)) + n * step;
                store(ROW_BOUND_STEPS, load(KINK_BOUND_STEPS));
            }
            store(ROW_BOUNDS, bounds);
        }
    }

    function signed128(uint256 word) private pure returns (uint256) {
        return uint256(int256(int128(int256(word))));
    }

    /// @dev Returns the first column of a row that may have a fragment, and the one after the last; there are none if they are not in this
    /// order.
    function columnsBetween(uint256 row) internal pure returns (uint256 first, uint256 end) {
        assembly ("memory-safe") {
            let base := sub(mload(SAMPLE_ORIGIN), mul(row, mload(SAMPLE_STRIDE))) // of column 0
            let bounds := mload(ROW_BOUNDS)
            first := sar(SAMPLE_SIZE_BITS, sub(sar(ADDRESS_FRACTION, signextend(LANE_128_LAST_BYTE, bounds)), base))
            if slt(first, mload(SPAN_BEGIN)) { first := mload(SPAN_BEGIN) } // max
            end := sar(SAMPLE_SIZE_BITS, sub(sar(UPPER_ADDRESS_AT, bounds), base))
            if sgt(end, mload(SPAN_END)) { end := mload(SPAN_END) } // min
            end := mul(end, sgt(end, 0)) // max(end, 0)
        }
    }

    /// @dev Returns the same for the rows from `row` (inclusive) to `last` (exclusive).
    function columnsOf(uint256 row, uint256 last) internal pure returns (uint256 first, uint256 end) {
        unchecked {
            uint256 kink = load(KINK_ROW);
            (first, end) = (load(SPAN_END), 0);
            // sides are straight except for the kink
            (first, end) = widened(first, end, row);
            if (kink >= row && kink < last) {
                if (kink != row) (first, end) = widened(first, end, kink - 1);
                (first, end) = widened(first, end, kink);
            }
            return widened(first, end, last - 1);
        }
    }

    function widened(uint256 first, uint256 end, uint256 row) private pure returns (uint256, uint256) {
        sidesAt(row);
        (uint256 begin, uint256 last) = columnsBetween(row);
        return (min(first, begin), max(end, last));
    }
}
