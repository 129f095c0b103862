// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Rasterizer} from "./Rasterizer.sol";
import "./Registers.sol";

// From triangles to fragments with four samples for each pixel (multisampling). A fragment is a pixel of which a triangle covers a sample.
// Its colour is computed once; its depth for each sample.
//
// A side of a triangle in a row is four columns, one for each sample, Q42 in lanes of 64 bits: where the edge crosses the height of the
// sample, less the place of the sample in the pixel. A pixel at column x has the sample inside if x is not left of the left side and left
// of the right one. Sides are kept so that one addition, or subtraction, of x in all lanes tells it by the highest bit of each:
//
//   left = 2^63 - side                  left + x  >= 2^63 where x >= side
//   right = 2^63 - 1 + side             right - x >= 2^63 where x < side
//
// Edges are told by their upper vertex, whichever triangle they belong to, so that triangles leave no gap between them and do not overlap.
// Above the upper vertex of two edges, and below the lower one, the sides have changed places, and nothing is between them.
abstract contract SampleRasterizer is Rasterizer {
    /// @notice Draws the fragments of a row from `column` to before `end`.
    function drawSpan(uint256 left, uint256 right, uint256 column, uint256 end, uint256 row) internal pure virtual;

    /// @notice Draws the rows from `row` to before `last` of the triangle that was set up, as its mode says.
    function drawFragments(uint256 row, uint256 last) internal pure virtual;

    /// @dev A triangle between the centres of pixels may cover samples.
    function coversNothing(uint256, uint256, uint256) internal pure override returns (bool) {
        return false;
    }

    function drawTriangle(uint256 a, uint256 b, uint256 c) internal pure override {
        unchecked {
            uint256 lowest = (b > c ? b : c) + ((OUTERMOST_SAMPLE + SUBPIXEL_MASK) << SCREEN_ROW_AT);
            uint256 row = max((a + ((SUBPIXEL_MASK - OUTERMOST_SAMPLE) << SCREEN_ROW_AT)) >> SCREEN_PIXEL_ROW_AT, load(BAND_TOP));
            uint256 last = min(lowest >> SCREEN_PIXEL_ROW_AT, load(BAND_BOTTOM));
            if (row >= last) return;
            setGradients(a, b, c);
            setSides(a, b, c, row);
            setReach(a, b, c);
            drawFragments(row, last);
        }
    }

    /// @dev The accumulator at column 0 of the row of the first pixel centres below the first vertex, and its changes.
    function setGradients(uint256 a, uint256 b, uint256 c) private pure {
        assembly ("memory-safe") {
            let x := and(shr(SCREEN_COLUMN_AT, a), SCREEN_COLUMN_MASK)
            let xb := sub(and(shr(SCREEN_COLUMN_AT, b), SCREEN_COLUMN_MASK), x)
            let xc := sub(and(shr(SCREEN_COLUMN_AT, c), SCREEN_COLUMN_MASK), x)
            a := shr(SCREEN_ROW_AT, a)
            b := sub(shr(SCREEN_ROW_AT, b), a)
            c := sub(shr(SCREEN_ROW_AT, c), a)
            let y := and(sub(0, a), SUBPIXEL_MASK)
            mstore(START_ROW, shr(SUBPIXEL_BITS, add(a, SUBPIXEL_MASK)))
            // as in Rasterizer
            a := sub(mul(xc, b), mul(xb, c))
            b := sdiv(shl(GRADIENT_SHIFT, b), a)
            xb := sdiv(shl(GRADIENT_SHIFT, xb), a)
            c := sdiv(shl(GRADIENT_SHIFT, c), a)
            xc := sdiv(shl(GRADIENT_SHIFT, xc), a)
            let toB := mload(DELTA_1)
            let toC := mload(DELTA_2)
            if iszero(and(mload(MODE), or(IS_PATCHED, IS_QUADRATIC))) {
                // Colours are taken up to a pixel outside the triangle. They fit their lanes if a barycentric coordinate changes by 16 at
                // most: triangles that are thinner have the colour of their first vertex.
                let steep := or(gt(add(b, LEAST_WIDTH), TWICE_LEAST_WIDTH), gt(add(xb, LEAST_WIDTH), TWICE_LEAST_WIDTH))
                steep := or(steep, gt(add(c, LEAST_WIDTH), TWICE_LEAST_WIDTH))
                if or(steep, gt(add(xc, LEAST_WIDTH), TWICE_LEAST_WIDTH)) {
                    toB := shl(ATTRIBUTE_DEPTH_AT, sar(ATTRIBUTE_DEPTH_AT, add(toB, HALF_DEPTH)))
                    toC := shl(ATTRIBUTE_DEPTH_AT, sar(ATTRIBUTE_DEPTH_AT, add(toC, HALF_DEPTH)))
                }
            }
            let start := sub(mload(ATTRIBUTE_0), mul(toC, sar(GRADIENT_TO_ACCUMULATOR, add(mul(x, b), mul(y, xb)))))
            start := add(start, mul(toB, sar(GRADIENT_TO_ACCUMULATOR, add(mul(x, c), mul(y, xc)))))
            let dx := sub(mul(toC, b), mul(toB, c))
            let dy := sub(mul(toB, xc), mul(toC, xb))
            mstore(DX_8, dx)
            mstore(DY_8, dy)
            dx := shl(3, dx)
            dy := shl(3, dy)
            if and(mload(MODE), IS_DEEP) {
                start := add(start, mload(DEEP_START))
                dx := add(dx, mload(DEEP_DX))
                dy := add(dy, mload(DEEP_DY))
            }
            mstore(START, start)
            mstore(DX, dx)
            mstore(DY, dy)
            mstore(
                DEPTH_OFFSETS,
                shl(mload(SAMPLE_SHIFT), add(mul(sar(DEPTH_8_AT, dx), SAMPLE_X_8), mul(sar(DEPTH_8_AT, dy), SAMPLE_Y_8)))
            )
        }
    }

    /// @dev The sides at the first row that is drawn, and where one of them continues with another edge.
    function setSides(uint256 a, uint256 b, uint256 c, uint256 row) private pure {
        assembly ("memory-safe") {
            // the edge between two vertices, the upper first, at a row; and its change per row
            function edge(u, v, row_) -> line, step {
                let y := shr(SCREEN_ROW_AT, u)
                let x := and(shr(SCREEN_COLUMN_AT, u), SCREEN_COLUMN_MASK)
                step := sdiv(
                    shl(COLUMN_FRACTION, sub(and(shr(SCREEN_COLUMN_AT, v), SCREEN_COLUMN_MASK), x)),
                    sub(shr(SCREEN_ROW_AT, v), y)
                )
                line := add(shl(SUBPIXEL_TO_COLUMN, x), sar(SUBPIXEL_BITS, mul(sub(shl(SUBPIXEL_BITS, row_), y), step)))
                line := sub(add(mul(line, ONES_64), mul(sar(3, step), SAMPLE_Y_8)), SAMPLE_COLUMNS)
                step := mul(step, ONES_64)
            }

            mstore(SIDE_ROW, row)
            let yb := shr(SCREEN_ROW_AT, b)
            let yc := shr(SCREEN_ROW_AT, c)
            {
                let left, step := edge(a, b, row)
                // a horizontal edge has no side below it
                if eq(yb, shr(SCREEN_ROW_AT, a)) { left := NEVER_LEFT }
                mstore(SIDE_LEFT, sub(TOPS_64, left))
                mstore(SIDE_LEFT_STEP, sub(0, step))
                let right
                right, step := edge(a, c, row)
                if eq(yc, shr(SCREEN_ROW_AT, a)) { right := sub(0, NEVER_LEFT) }
                mstore(SIDE_RIGHT, add(BELOW_TOPS_64, right))
                mstore(SIDE_RIGHT_STEP, step)
            }
            let other
            switch lt(yb, yc)
            case 1 {
                row := shr(SUBPIXEL_BITS, add(yb, sub(SUBPIXEL_MASK, OUTERMOST_SAMPLE)))
                other, a := edge(b, c, row)
                b := shr(SCREEN_COLUMN_AT, b)
                mstore(KINK_SIDE, SIDE_LEFT)
                mstore(KINK_EDGE, sub(TOPS_64, other))
                mstore(KINK_STEP, sub(0, a))
            }
            default {
                row := shr(SUBPIXEL_BITS, add(yc, sub(SUBPIXEL_MASK, OUTERMOST_SAMPLE)))
                other, a := edge(c, b, row)
                if eq(yb, yc) { other := sub(0, NEVER_LEFT) }
                b := shr(SCREEN_COLUMN_AT, c)
                mstore(KINK_SIDE, SIDE_RIGHT)
                mstore(KINK_EDGE, add(BELOW_TOPS_64, other))
                mstore(KINK_STEP, a)
                yb := yc
            }
            if slt(row, mload(SIDE_ROW)) {
                // only the lower edge is in the band
                row := mul(sub(mload(SIDE_ROW), row), mload(KINK_STEP))
                mstore(mload(KINK_SIDE), add(mload(KINK_EDGE), row))
                mstore(sub(add(mload(KINK_SIDE), SIDE_LEFT_STEP), SIDE_LEFT), mload(KINK_STEP))
                row := GUARD_BAND
            }
            mstore(KINK_ROW, row)
            b := and(b, SCREEN_COLUMN_MASK)
            mstore(KINK_BEGIN, shr(SUBPIXEL_BITS, add(b, sub(SUBPIXEL_MASK, OUTERMOST_SAMPLE))))
            mstore(KINK_END, add(shr(SUBPIXEL_BITS, add(b, OUTERMOST_SAMPLE)), 1))
            // samples above the vertex are still on the upper edge
            yb := sub(yb, shl(SUBPIXEL_BITS, row))
            yb := add(add(sgt(yb, sub(0, OUTERMOST_SAMPLE)), sgt(yb, sub(0, INNERMOST_SAMPLE))), sgt(yb, INNERMOST_SAMPLE))
            mstore(KINK_MASK, shl(shl(SAMPLE_LANE_BITS, yb), not(0)))
        }
    }

    /// @dev The columns that the triangle may touch, and what the ways to shade it need besides.
    function setReach(uint256 a, uint256 b, uint256 c) private pure {
        assembly ("memory-safe") {
            let x := and(a, SCREEN_COLUMNS)
            let end := x
            let other := and(b, SCREEN_COLUMNS)
            if lt(other, x) { x := other }
            if gt(other, end) { end := other }
            other := and(c, SCREEN_COLUMNS)
            if lt(other, x) { x := other }
            if gt(other, end) { end := other }
            x := shr(SCREEN_PIXEL_COLUMN_AT, add(x, FROM_FIRST_SAMPLE))
            end := add(shr(SCREEN_PIXEL_COLUMN_AT, add(end, TO_LAST_SAMPLE)), 1)
            if lt(x, mload(COLUMN_BEGIN)) { x := mload(COLUMN_BEGIN) }
            if gt(end, mload(COLUMN_END)) { end := mload(COLUMN_END) }
            mstore(SPAN_BEGIN, x)
            mstore(SPAN_END, end)
            mstore(SPAN_BEGIN_BYTES, shl(SAMPLE_SIZE_BITS, x))
            mstore(SPAN_END_BYTES, shl(SAMPLE_SIZE_BITS, end))
        }
        unchecked {
            if (load(MODE) & (IS_PATCHED | IS_QUADRATIC) == 0) return;
            uint256 farthest = load((a & SCREEN_RECORD_MASK) + VERTEX_ATTRIBUTES);
            farthest = min(farthest, load((b & SCREEN_RECORD_MASK) + VERTEX_ATTRIBUTES));
            farthest = min(farthest, load((c & SCREEN_RECORD_MASK) + VERTEX_ATTRIBUTES));
            store(FARTHEST, farthest >> ATTRIBUTE_DEPTH_AT << DEPTH_FRACTION);
            store(QUADRATIC_ROW, max((a + (SUBPIXEL_MASK << SCREEN_ROW_AT)) >> SCREEN_PIXEL_ROW_AT, load(BAND_TOP)));
        }
    }

    /// @dev Draws the rows from `row` to before `last`, between SPAN_BEGIN and SPAN_END.
    function drawSpans(uint256 row, uint256 last) internal pure {
        unchecked {
            uint256 kink = load(KINK_ROW);
            while (row != last) {
                // the rows above the kink, the one that has it, the rows below
                uint256 next = row < kink ? min(kink, last) : row == kink ? row + 1 : last;
                (uint256 left, uint256 right, uint256 leftStep, uint256 rightStep) = sidesAt(row);
                for (; row != next; ++row) {
                    (uint256 first, uint256 end) = columnsBetween(left, right, row);
                    if (first < end) drawSpan(left, right, first, end, row);
                    left += leftStep;
                    right += rightStep;
                }
            }
        }
    }

    /// @dev The sides at a row, and their changes to the next, which the row of the kink does not have.
    function sidesAt(uint256 row) private pure returns (uint256 left, uint256 right, uint256 leftStep, uint256 rightStep) {
        unchecked {
            uint256 n = row - load(SIDE_ROW);
            (leftStep, rightStep) = (load(SIDE_LEFT_STEP), load(SIDE_RIGHT_STEP));
            (left, right) = (load(SIDE_LEFT) + n * leftStep, load(SIDE_RIGHT) + n * rightStep);
            n = row - load(KINK_ROW);
            if (int256(n) < 0) return (left, right, leftStep, rightStep);
            bool isLeft = load(KINK_SIDE) == SIDE_LEFT;
            uint256 step = load(KINK_STEP);
            uint256 edge = load(KINK_EDGE) + n * step;
            if (n == 0) {
                uint256 mask = load(KINK_MASK);
                edge = (edge & mask) | ((isLeft ? left : right) & ~mask);
            }
            if (isLeft) return (edge, right, step, rightStep);
            return (left, edge, leftStep, step);
        }
    }

    /// @dev The first column of a row that may have a fragment, and the one after the last; none if they are not in this order.
    function columnsBetween(uint256 left, uint256 right, uint256 row) private pure returns (uint256 first, uint256 end) {
        assembly ("memory-safe") {
            let isKink := eq(row, mload(KINK_ROW))
            end := shr(UPPER_LANE_64_AT, left)
            first := and(left, LANE_64)
            if gt(end, first) { first := end }
            first := sar(COLUMN_FRACTION, sub(TO_FIRST_COLUMN, first))
            if and(isKink, slt(mload(KINK_BEGIN), first)) { first := mload(KINK_BEGIN) }
            if slt(first, mload(SPAN_BEGIN)) { first := mload(SPAN_BEGIN) }
            end := shr(UPPER_LANE_64_AT, right)
            let lowest := and(right, LANE_64)
            if gt(lowest, end) { end := lowest }
            end := sar(COLUMN_FRACTION, sub(end, TO_LAST_COLUMN))
            if and(isKink, sgt(mload(KINK_END), end)) { end := mload(KINK_END) }
            if sgt(end, mload(SPAN_END)) { end := mload(SPAN_END) }
            end := mul(end, sgt(end, 0))
        }
    }

    /// @dev The same of the rows from `row` to before `last`.
    function columnsOf(uint256 row, uint256 last) internal pure returns (uint256 first, uint256 end) {
        unchecked {
            uint256 kink = load(KINK_ROW);
            (uint256 left, uint256 right,,) = sidesAt(row);
            (first, end) = columnsBetween(left, right, row);
            // sides are straight but for the kink
            if (kink > row && kink < last) (first, end) = widened(first, end, kink);
            return widened(first, end, last - 1);
        }
    }

    function widened(uint256 first, uint256 end, uint256 row) private pure returns (uint256, uint256) {
        (uint256 left, uint256 right,,) = sidesAt(row);
        (uint256 begin, uint256 last) = columnsBetween(left, right, row);
        return (min(first, begin), max(end, last));
    }

    function min(uint256 a, uint256 b) internal pure returns (uint256) {
        return a < b ? a : b;
    }

    function max(uint256 a, uint256 b) internal pure returns (uint256) {
        return a > b ? a : b;
    }
}
