// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Rasterizer} from "../geometry/Rasterizer.sol";
import "../../words/Registers.sol";

// Rasterizes triangles to fragments at pixel centres, by a digital differential analyzer.
//
// Edges are two columns, Q48, in lanes of 128 bits, such that the integer part is the first pixel whose centre is not left of the edge: the
// left edge in the lower lane, the right one in the upper lane. Rows are represented by the addresses of their depths at column 0, which
// decrease downward. A Q48 column is a Q45 offset of depths in bytes, so with the address of the row added, edges are addresses of depths.
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
            let x := and(shr(SCREEN_COLUMN_AT, a), SCREEN_COLUMN_MASK)
            let xb := sub(and(shr(SCREEN_COLUMN_AT, b), SCREEN_COLUMN_MASK), x)
            let xc := sub(and(shr(SCREEN_COLUMN_AT, c), SCREEN_COLUMN_MASK), x)
            a := shr(SCREEN_ROW_AT, a)
            b := sub(shr(SCREEN_ROW_AT, b), a)
            c := sub(shr(SCREEN_ROW_AT, c), a)
            // from the first vertex to the centres of the first row
            let y := and(sub(0, a), SUBPIXEL_MASK)
            {
                // The gradients of the barycentric coordinates t (of c) and s (of b), Q29 per pixel: dt/dx = yb / area, dt/dy = -xb / area,
                // ds/dx = -yc / area, ds/dy = xc / area. Rounded to 2^-29, over the 4,096 pixels of the guard band in both directions they
                // leave s + t within 2^-15.
                let area := sub(mul(xc, b), mul(xb, c)) // xc * yb - xb * yc: twice the area, in sub-pixels
                let dx := sdiv(shl(GRADIENT_SHIFT, b), area)
                let dy := sdiv(shl(GRADIENT_SHIFT, xb), area)
                let delta := mload(DELTA_2)
                mstore(DX_8, mul(delta, dx)) // (c - a) * dt/dx; Q29 per pixel is Q32 per byte of depths, of which a pixel has 8
                mstore(DY, mul(delta, dy))
                // from the first vertex to the centre of pixel 0 in the first row
                mstore(START, sub(mload(ATTRIBUTE_0), mul(delta, sar(GRADIENT_TO_ACCUMULATOR, add(mul(x, dx), mul(y, dy))))))
                dx := sdiv(shl(GRADIENT_SHIFT, c), area)
                dy := sdiv(shl(GRADIENT_SHIFT, xc), area)
                delta := mload(DELTA_1)
                mstore(START, add(mload(START), mul(delta, sar(GRADIENT_TO_ACCUMULATOR, add(mul(x, dx), mul(y, dy))))))
                mstore(DX_8, sub(mload(DX_8), mul(delta, dx)))
                mstore(DY, shl(3, sub(mul(delta, dy), mload(DY))))
            }
            // columns per row, Q48: left (xb / yb) and right (xc / yc)
            let slopes := add(sdiv(shl(EDGE_FRACTION, xb), b), shl(RIGHT_EDGE_AT, sdiv(shl(EDGE_FRACTION, xc), c)))
            // In the shifted product, 8 bits of the upper lane enter the top of the lower one, where they do no harm.
            edges := sar(SUBPIXEL_BITS, mul(y, slopes)) // y * slope, Q48
            // the edge between b and c
            y := sdiv(shl(EDGE_FRACTION, sub(xc, xb)), sub(c, b))
            switch lt(b, c)
            case 1 {
                c := shr(SUBPIXEL_BITS, add(add(a, c), SUBPIXEL_MASK))
                xc := add(a, b)
                b := shr(SUBPIXEL_BITS, add(xc, SUBPIXEL_MASK))
                mstore(LOWER_ROWS, sub(c, b))
                mstore(LOWER_EDGE, and(LANE_128, add(
                    add(
                        shl(EDGE_SUBPIXEL_SHIFT, add(x, xb)),
                        add(CEIL_48, shl(EDGE_ADDRESS_FRACTION, sub(mload(DEPTH_ORIGIN), mul(mload(DEPTH_STRIDE), b))))
                    ),
                    sar(SUBPIXEL_BITS, mul(sub(shl(SUBPIXEL_BITS, b), xc), y))
                )))
                mstore(LOWER_KEPT, UPPER_LANE_128)
                mstore(LOWER_SLOPES, sub(add(sub(slopes, signextend(15, slopes)), y), mload(STRIDE_LANES)))
            }
            default {
                xb := add(a, c)
                c := shr(SUBPIXEL_BITS, add(xb, SUBPIXEL_MASK))
                mstore(LOWER_ROWS, sub(shr(SUBPIXEL_BITS, add(add(a, b), SUBPIXEL_MASK)), c))
                b := c
                mstore(LOWER_EDGE, shl(RIGHT_EDGE_AT, add(
                    add(
                        shl(EDGE_SUBPIXEL_SHIFT, add(x, xc)),
                        add(CEIL_48, shl(EDGE_ADDRESS_FRACTION, sub(mload(DEPTH_ORIGIN), mul(mload(DEPTH_STRIDE), b))))
                    ),
                    sar(SUBPIXEL_BITS, mul(sub(shl(SUBPIXEL_BITS, b), xb), y))
                )))
                mstore(LOWER_KEPT, LANE_128)
                mstore(LOWER_SLOPES, sub(add(signextend(15, slopes), shl(RIGHT_EDGE_AT, y)), mload(STRIDE_LANES)))
            }
            // the address of the first row; the number of rows of the upper part
            a := shr(SUBPIXEL_BITS, add(a, SUBPIXEL_MASK))
            b := sub(b, a)
            a := sub(mload(DEPTH_ORIGIN), mul(mload(DEPTH_STRIDE), a))
            edges := add(edges, mul(add(add(shl(EDGE_SUBPIXEL_SHIFT, x), CEIL_48), shl(EDGE_ADDRESS_FRACTION, a)), ONES_128))
            mstore(SLOPES, sub(slopes, mload(STRIDE_LANES)))
        }
        if (load(MODE) & IS_TURNED_AWAY != 0) {
            // DX_8 is the change over an eighth of a pixel, DY over a pixel
            unchecked {
                uint256 depth = setBack(uint256(loadSigned(DX_8) >> 3), uint256(loadSigned(DY) >> 6), 0);
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
            x := shl(16, x)
            a := shr(SCREEN_ROW_AT, a)
            b := sub(shr(SCREEN_ROW_AT, b), a)
            c := sub(shr(SCREEN_ROW_AT, c), a)
            nothing := 1
            // rows from the first one, in sub-pixels below the first vertex
            for { let y := and(sub(0, a), SUBPIXEL_MASK) } or(lt(y, b), lt(y, c)) { y := add(y, 256) } {
                // columns, Q16 in sub-pixels: on the left from a via b to c; on the right from a to c, or via c to b
                let left := add(shl(16, xb), sdiv(mul(sub(y, b), shl(16, sub(xc, xb))), sub(c, b)))
                let right := left
                if lt(y, b) { left := sdiv(mul(y, shl(16, xb)), b) }
                if lt(y, c) { right := sdiv(mul(y, shl(16, xc)), c) }
                if lt(shr(24, add(x, sub(left, 2))), shr(24, add(x, add(right, 1)))) {
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
            store(DX, load(DX_8) << 3);
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

    /// @dev Returns the row of which this is the address of the depth at column 0.
    function rowAt(uint256 position) internal pure returns (uint256) {
        unchecked {
            return (load(DEPTH_ORIGIN) - position) / load(DEPTH_STRIDE);
        }
    }
}
