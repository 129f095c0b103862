// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {columnOf, firstRowOf, max, min, rowOf} from "../geometry/Screen.sol";
import {PixelRasterizer} from "./PixelRasterizer.sol";
import {Wires} from "../shading/Wires.sol";
import "../../words/Registers.sol";

// Computes `wires` of picture.py for one sample per pixel.
// Rasterizes the edges of triangles to fragments. A line has one pixel in each column, or in each row if it is steeper than 45 degrees: the
// pixel nearest to it, with the depth and colour of the line at the centre of that column or row.

/// @dev Divided by the length of a line in sub-pixels (Q8), this is the fraction of the line per pixel, Q32.
int256 constant STEP_ONE = 1 << 40;

abstract contract Wireframe is PixelRasterizer, Wires {
    function line(uint256 p, uint256 q, uint256 attribute, uint256 change) internal pure override {
        unchecked {
            int256 dx = columnOf(q) - columnOf(p);
            int256 dy = rowOf(q) - rowOf(p);
            bool steep = dy * dy >= dx * dx;
            // the same pixels for both faces that share the edge
            if (steep ? dy < 0 : dx < 0) {
                (p, q) = (q, p);
                (dx, dy) = (-dx, -dy);
                attribute += change << ACCUMULATOR_FRACTION;
                change = 0 - change;
            }
            if (steep) steepLine(p, q, dx, dy, attribute, change);
            else flatLine(p, q, dx, dy, attribute, change);
        }
    }

    /// @param attribute The accumulator at the upper end.
    /// @param change The change of the attribute word along the line.
    function steepLine(uint256 p, uint256 q, int256 dx, int256 dy, uint256 attribute, uint256 change) private pure {
        unchecked {
            uint256 top = max(load(BAND_TOP), firstRowOf(p));
            uint256 bottom = min(load(BAND_BOTTOM), firstRowOf(q));
            if (top >= bottom) return;
            int256 below = int256(top << SUBPIXEL_BITS) - rowOf(p);
            int256 slope = (dx << EDGE_FRACTION) / dy;
            uint256 step = uint256(STEP_ONE / dy);
            // the pixel whose centre is nearest
            uint256 left = uint256((columnOf(p) << EDGE_SUBPIXEL_SHIFT) + ((below * slope) >> SUBPIXEL_BITS) + int256(HALF_COLUMN));
            store(DX, 0);
            store(DY, change * step);
            attribute += change * ((uint256(below) * step) >> SUBPIXEL_BITS);
            uint256 slopes = uint256(slope) + (uint256(slope) << RIGHT_EDGE_AT);
            draw(left + ((left + (1 << EDGE_FRACTION)) << RIGHT_EDGE_AT), slopes, attribute, top, bottom);
        }
    }

    function flatLine(uint256 p, uint256 q, int256 dx, int256 dy, uint256 attribute, uint256 change) private pure {
        unchecked {
            int256 begin = (columnOf(p) + int256(SUBPIXEL_MASK)) >> SUBPIXEL_BITS;
            int256 end = (columnOf(q) + int256(SUBPIXEL_MASK)) >> SUBPIXEL_BITS;
            if (begin >= end) return;
            uint256 top = max(load(BAND_TOP), (min(p, q) + (HALF_PIXEL << SCREEN_ROW_AT)) >> SCREEN_PIXEL_ROW_AT);
            uint256 bottom = min(load(BAND_BOTTOM), ((max(p, q) + (HALF_PIXEL << SCREEN_ROW_AT)) >> SCREEN_PIXEL_ROW_AT) + 1);
            uint256 step = uint256(STEP_ONE / dx);
            store(DX, change * step);
            store(DY, 0);
            attribute += change * uint256((-columnOf(p) * int256(step)) >> SUBPIXEL_BITS);
            // the column at which the line enters the first row, and its change per row
            int256 enter = begin << EDGE_FRACTION;
            int256 slope = (end - begin) << EDGE_FRACTION;
            if (dy != 0) {
                slope = (dx << EDGE_FRACTION) / dy;
                enter = (columnOf(p) << EDGE_SUBPIXEL_SHIFT)
                    + (((int256(top << SUBPIXEL_BITS) - int256(HALF_PIXEL) - rowOf(p)) * slope) >> SUBPIXEL_BITS) + int256(CEIL_48);
            }
            for (; top < bottom; ++top) {
                int256 exit = enter + slope;
                (int256 left, int256 right) = dy < 0 ? (exit, enter) : (enter, exit);
                enter = exit;
                left >>= EDGE_FRACTION;
                right >>= EDGE_FRACTION;
                if (left < begin) left = begin;
                if (right > end) right = end;
                uint256 edges = uint256(left << EDGES_LEFT_COLUMN_AT) | (uint256(right) << EDGES_RIGHT_COLUMN_AT);
                // a single row, so the slopes make no difference
                if (left < right) draw(edges, uint256(slope), attribute, top, top + 1);
            }
        }
    }

    /// @dev Draws the fragments of the rows from `top` (inclusive) to `bottom` (exclusive).
    function draw(uint256 edges, uint256 slopes, uint256 attribute, uint256 top, uint256 bottom) private pure {
        unchecked {
            (uint256 origin, uint256 stride) = (load(DEPTH_ORIGIN), load(DEPTH_STRIDE));
            drawRows(edges, slopes, attribute, origin - stride * top, origin - stride * bottom);
        }
    }
}
