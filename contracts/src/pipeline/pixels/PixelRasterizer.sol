// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Rasterizer} from "../geometry/Rasterizer.sol";
import "../../words/Registers.sol";

// Computes `fill` of picture.py for one sample per pixel, and `edge_functions` as columns of the edges.
// Rasterizes triangles to fragments at pixel centres, by a digital differential analyzer.
//
// Edges are two columns, Q48, in lanes of 128 bits, such that the integer part is the first pixel whose centre is not left of the edge: the
// left edge in the lower lane, the right one in the upper lane. Rows are represented by the addresses of their depths at column 0, which
// decrease downward. A Q48 column is a Q45 offset of depths in bytes, so with the address of the row added, edges are addresses of depths.

/// @dev Shifts by which a number is divided by 8 and by 64, or multiplied.
uint256 constant EIGHTH = 3;
uint256 constant SIXTY_FOURTH = 6;
/// @dev The position of whole pixels in a sub-pixel coordinate with 16 more bits.
uint256 constant PIXELS_Q16_AT = 24;

abstract contract PixelRasterizer is Rasterizer {
    /// @notice Draws the fragments of a triangle.
    /// @param edges Addresses at the upper part; SLOPES are their changes.
    /// @param rows The number of rows of the upper part.
    /// @param row The address of the first row.
    function drawParts(uint256 edges, uint256 rows, uint256 row) internal pure virtual;

    /// @notice Draws the fragments between two edges in the rows from `row` (inclusive) to `end` (exclusive), given by addresses.
    /// @param edges, slopes Columns, Q48.
    /// @param start The accumulator at column 0 of the first row; DX and DY are its changes.
    function drawRows(uint256 edges, uint256 slopes, uint256 start, uint256 row, uint256 end) internal pure virtual;

    /// @notice Draws a triangle for which `shade` was called.
    /// @param a, b, c The screen words of its vertices, the topmost first, counter-clockwise.
    function drawTriangle(uint256 a, uint256 b, uint256 c) internal pure override {
        uint256 edges;
        assembly ("memory-safe") {
            let x := and(shr(SCREEN_COLUMN_AT, a), SCREEN_COLUMN_MASK) // xa, in sub-pixels
            let xb := sub(and(shr(SCREEN_COLUMN_AT, b), SCREEN_COLUMN_MASK), x) // column of b - xa
            let xc := sub(and(shr(SCREEN_COLUMN_AT, c), SCREEN_COLUMN_MASK), x) // column of c - xa
            a := shr(SCREEN_ROW_AT, a) // a from here on: ya, in sub-pixels
            b := sub(shr(SCREEN_ROW_AT, b), a) // b from here on: row of b - ya
            c := sub(shr(SCREEN_ROW_AT, c), a) // c from here on: row of c - ya
            // from the first vertex to the centres of the first row
            let y := and(sub(0, a), SUBPIXEL_MASK) // -ya mod 256
            {
                // The gradients of the barycentric coordinates t (of c) and s (of b), Q29 per pixel: dt/dx = yb / area, dt/dy = -xb / area,
                // ds/dx = -yc / area, ds/dy = xc / area. Rounded to 2^-29, over the 4,096 pixels of the guard band in both directions they
                // leave s + t within 2^-15.
                let area := sub(mul(xc, b), mul(xb, c)) // xc * yb - xb * yc: twice the area, in sub-pixels
                let tDx := sdiv(shl(GRADIENT_SHIFT, b), area) // dt/dx = yb / area
                let tDy := sdiv(shl(GRADIENT_SHIFT, xb), area) // -dt/dy = xb / area
                let sDy := sdiv(shl(GRADIENT_SHIFT, xc), area) // ds/dy = xc / area
                area := sdiv(shl(GRADIENT_SHIFT, c), area) // area: -ds/dx = yc / area
                let toB := mload(DELTA_1)
                let toC := mload(DELTA_2)
                // from the first vertex to the centre of pixel 0 in the first row: + toB * s + toC * t
                mstore(START, add(
                    sub(mload(ATTRIBUTE_0), mul(toC, sar(GRADIENT_TO_ACCUMULATOR, add(mul(x, tDx), mul(y, tDy))))),
                    mul(toB, sar(GRADIENT_TO_ACCUMULATOR, add(mul(x, area), mul(y, sDy))))
                ))
                // toC * dt/dx + toB * ds/dx; Q29 per pixel is Q32 per byte of depths, of which a pixel has 8
                mstore(DX_8, sub(mul(toC, tDx), mul(toB, area)))
                mstore(DY, shl(EIGHTH, sub(mul(toB, sDy), mul(toC, tDy)))) // the same with d/dy, Q32 per pixel
            }
            // columns per row, Q48: left (xb / yb) and right (xc / yc)
            let slopes := add(sdiv(shl(EDGE_FRACTION, xb), b), shl(RIGHT_EDGE_AT, sdiv(shl(EDGE_FRACTION, xc), c)))
            // In the shifted product, 8 bits of the upper lane enter the top of the lower one, where they do no harm.
            edges := sar(SUBPIXEL_BITS, mul(y, slopes)) // y * slope, Q48
            // the edge between b and c; y from here on: its slope, columns per row, Q48
            y := sdiv(shl(EDGE_FRACTION, sub(xc, xb)), sub(c, b))
            switch lt(b, c)
            case 1 {
                // b is above c: the lower part begins at b, and its left edge is that from b to c
                c := shr(SUBPIXEL_BITS, add(add(a, c), SUBPIXEL_MASK)) // c from here on: ceil(yc), the row after the last
                xc := add(a, b) // xc from here on: yb, from row 0
                b := shr(SUBPIXEL_BITS, add(xc, SUBPIXEL_MASK)) // b from here on: ceil(yb), the first row of the lower part
                mstore(LOWER_ROWS, sub(c, b)) // ceil(yc) - ceil(yb)
                mstore(LOWER_EDGE, and(LANE_128, add(
                    add(
                        shl(EDGE_SUBPIXEL_SHIFT, add(x, xb)), // the column of b, Q48
                        // rounded up, plus the address of row b
                        add(CEIL_48, shl(EDGE_ADDRESS_FRACTION, sub(mload(DEPTH_ORIGIN), mul(mload(DEPTH_STRIDE), b))))
                    ),
                    sar(SUBPIXEL_BITS, mul(sub(shl(SUBPIXEL_BITS, b), xc), y)) // (ceil(yb) - yb) * slope
                )))
                mstore(LOWER_KEPT, UPPER_LANE_128) // the right edge goes on
                mstore(LOWER_SLOPES, sub(add(sub(slopes, signextend(15, slopes)), y), mload(STRIDE_LANES))) // left: y in place of the old
            }
            default {
                // c is above b: the lower part begins at c, and its right edge is that from c to b
                xb := add(a, c) // xb from here on: yc, from row 0
                c := shr(SUBPIXEL_BITS, add(xb, SUBPIXEL_MASK)) // c from here on: ceil(yc), the first row of the lower part
                mstore(LOWER_ROWS, sub(shr(SUBPIXEL_BITS, add(add(a, b), SUBPIXEL_MASK)), c)) // ceil(yb) - ceil(yc)
                b := c // b from here on: the first row of the lower part, as in the other case
                mstore(LOWER_EDGE, shl(RIGHT_EDGE_AT, add(
                    add(
                        shl(EDGE_SUBPIXEL_SHIFT, add(x, xc)), // the column of c, Q48
                        add(CEIL_48, shl(EDGE_ADDRESS_FRACTION, sub(mload(DEPTH_ORIGIN), mul(mload(DEPTH_STRIDE), b))))
                    ),
                    sar(SUBPIXEL_BITS, mul(sub(shl(SUBPIXEL_BITS, b), xb), y)) // (ceil(yc) - yc) * slope
                )))
                mstore(LOWER_KEPT, LANE_128) // the left edge goes on
                mstore(LOWER_SLOPES, sub(add(signextend(15, slopes), shl(RIGHT_EDGE_AT, y)), mload(STRIDE_LANES))) // right: y
            }
            a := shr(SUBPIXEL_BITS, add(a, SUBPIXEL_MASK)) // a from here on: ceil(ya), the first row
            b := sub(b, a) // b from here on: the number of rows of the upper part
            a := sub(mload(DEPTH_ORIGIN), mul(mload(DEPTH_STRIDE), a)) // a from here on: the address of the first row
            // both edges begin at the first vertex: + (xa rounded up + address) in each lane
            edges := add(edges, mul(add(add(shl(EDGE_SUBPIXEL_SHIFT, x), CEIL_48), shl(EDGE_ADDRESS_FRACTION, a)), ONES_128))
            mstore(SLOPES, sub(slopes, mload(STRIDE_LANES))) // a row down is a lower address
        }
        if (load(MODE) & IS_TURNED_AWAY != 0) {
            // over a 64th of a pixel: DX_8 is the change over an eighth of a pixel, DY over a pixel
            unchecked {
                uint256 depth = setBack(uint256(loadSigned(DX_8) >> EIGHTH), uint256(loadSigned(DY) >> SIXTY_FOURTH), 0);
                store(START, load(START) - (depth << ACCUMULATOR_DEPTH_AT));
            }
        }
        drawParts(edges, b, a);
    }

    /// @dev Returns whether a triangle covers no pixel centre. Returns false if one lies on an edge, since the rasterized edges are
    /// rounded.
    /// @param a, b, c The screen words of its vertices, the topmost first, counter-clockwise.
    function coversNothing(uint256 a, uint256 b, uint256 c) internal pure override returns (bool nothing) {
        assembly ("memory-safe") {
            let x := and(shr(SCREEN_COLUMN_AT, a), SCREEN_COLUMN_MASK)
            let xb := sub(and(shr(SCREEN_COLUMN_AT, b), SCREEN_COLUMN_MASK), x)
            let xc := sub(and(shr(SCREEN_COLUMN_AT, c), SCREEN_COLUMN_MASK), x)
            x := shl(Q16, x) // x from here on: Q16
            a := shr(SCREEN_ROW_AT, a) // a, b, c from here on: ya, yb - ya, yc - ya
            b := sub(shr(SCREEN_ROW_AT, b), a)
            c := sub(shr(SCREEN_ROW_AT, c), a)
            nothing := 1
            // rows from the first one, in sub-pixels below the first vertex
            for { let y := and(sub(0, a), SUBPIXEL_MASK) } or(lt(y, b), lt(y, c)) { y := add(y, ONE_PIXEL) } {
                // columns, Q16 in sub-pixels: on the left from a via b to c; on the right from a to c, or via c to b
                // xb + (y - yb) * (xc - xb) / (yc - yb)
                let left := add(shl(Q16, xb), sdiv(mul(sub(y, b), shl(Q16, sub(xc, xb))), sub(c, b)))
                let right := left
                if lt(y, b) { left := sdiv(mul(y, shl(Q16, xb)), b) } // y * xb / yb
                if lt(y, c) { right := sdiv(mul(y, shl(Q16, xc)), c) } // y * xc / yc
                // floor(left - 2 units) < floor(right + 1 unit), in pixels: a centre between them, or nearly
                if lt(shr(PIXELS_Q16_AT, add(x, sub(left, 2))), shr(PIXELS_Q16_AT, add(x, add(right, 1)))) {
                    nothing := 0
                    break
                }
            }
        }
    }

    /// @dev Draws the fragments of a triangle with rows that may lie outside the band, or whose fragments the plain loop cannot draw.
    function drawBothParts(uint256 edges, uint256 rows, uint256 row) internal pure {
        unchecked {
            uint256 start = load(START);
            store(DX, load(DX_8) << EIGHTH);
            if (load(MODE) & IS_DEEP != 0) {
                start += load(DEEP_START);
                store(DX, load(DX) + (load(DEEP_DX) << ATTRIBUTE_DEPTH_AT));
                store(DY, load(DY) + (load(DEEP_DY) << ATTRIBUTE_DEPTH_AT));
            }
            uint256 stride = load(DEPTH_STRIDE);
            uint256 slopes = load(SLOPES);
            fill(edges, slopes, start, row, row - stride * rows);
            row -= stride * rows;
            fill(
                ((edges + slopes * rows) & load(LOWER_KEPT)) | load(LOWER_EDGE),
                load(LOWER_SLOPES),
                start + load(DY) * rows,
                row,
                row - stride * load(LOWER_ROWS)
            );
        }
    }

    /// @notice Draws the fragments between two edges in the rows from `row` (inclusive) to `end` (exclusive) that lie in the band.
    /// @param start The accumulator at column 0 of row `row`; DX and DY are its changes.
    function fill(uint256 edges, uint256 slopes, uint256 start, uint256 row, uint256 end) internal pure {
        unchecked {
            uint256 stride = load(DEPTH_STRIDE);
            uint256 first = load(DEPTH_ORIGIN) - stride * load(BAND_TOP);
            uint256 last = load(DEPTH_ORIGIN) - stride * load(BAND_BOTTOM);
            if (int256(row) > int256(first)) {
                uint256 skipped = (row - first) / stride;
                edges += slopes * skipped;
                start += load(DY) * skipped;
                row = first;
            }
            if (int256(end) < int256(last)) end = last;
            if (int256(row) <= int256(end)) return;
            drawRows(edges - (row << EDGE_ADDRESS_FRACTION) * ONES_128, slopes + load(STRIDE_LANES), start, row, end);
        }
    }
}
