// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Rasterizer} from "./Rasterizer.sol";
import {Shading} from "./Shading.sol";
import "./Registers.sol";

// From the edges of triangles to fragments. A line has one pixel in each column, or in each row if it is steeper than 45 degrees: the
// pixel that is nearest to it, with the depth and the colour of the line at the centre of that column or row.

/// @dev Makes the integer part of a Q48 number the next integer, as far as such numbers are exact: see Rasterizer.setUp.
int256 constant CEIL = 0xffffffffc000;

library Wireframe {
    /// @notice Draws the edges of the triangles of a list into the current band.
    function run(uint256 list, uint256 end) internal pure {
        unchecked {
            (uint256 bandTop, uint256 bandBottom) = (load(BAND_TOP), load(BAND_BOTTOM));
            for (; list != end; list += 32) {
                uint256 word = load(list);
                if ((word >> 112) & 0xffff <= bandTop || (word >> 96) & 0xffff >= bandBottom) continue;
                Shading.prepare(word);
                uint256 a = load((word >> 64) & 0xffffffff);
                uint256 b = load((word >> 32) & 0xffffffff);
                uint256 c = load(word & 0xffffffff);
                if (word & (1 << 144) != 0) line(a, b, load(ATTRIBUTE_0), load(ATTRIBUTE_1), bandTop, bandBottom);
                if (word & (2 << 144) != 0) line(b, c, load(ATTRIBUTE_1), load(ATTRIBUTE_2), bandTop, bandBottom);
                if (word & (4 << 144) != 0) line(c, a, load(ATTRIBUTE_2), load(ATTRIBUTE_0), bandTop, bandBottom);
            }
        }
    }

    /// @param p, q The screen words of its ends.
    /// @param attributeP, attributeQ Their attribute words.
    function line(uint256 p, uint256 q, uint256 attributeP, uint256 attributeQ, uint256 top, uint256 bottom) private pure {
        unchecked {
            int256 dx = column(q) - column(p);
            int256 dy = row(q) - row(p);
            bool steep = dy * dy >= dx * dx;
            // the same pixels, whichever face the line belongs to
            if (steep ? dy < 0 : dx < 0) {
                (p, q, attributeP, attributeQ) = (q, p, attributeQ, attributeP);
                (dx, dy) = (-dx, -dy);
            }
            attributeQ -= attributeP;
            attributeP = (attributeP << 32) + load(LANE_BIAS);
            if (steep) steepLine(p, q, dx, dy, attributeP, attributeQ, top, bottom);
            else flatLine(p, q, dx, dy, attributeP, attributeQ, top, bottom);
        }
    }

    /// @param attribute The accumulator at the upper end.
    /// @param change What its attribute word changes along the line.
    function steepLine(uint256 p, uint256 q, int256 dx, int256 dy, uint256 attribute, uint256 change, uint256 top, uint256 bottom)
        private
        pure
    {
        unchecked {
            top = max(top, (p + (255 << 128)) >> 136);
            bottom = min(bottom, (q + (255 << 128)) >> 136);
            if (top >= bottom) return;
            int256 below = int256(top << 8) - row(p);
            int256 slope = (dx << 48) / dy;
            uint256 step = uint256((1 << 40) / dy);
            // the pixel whose middle is nearest
            uint256 left = uint256((column(p) << 40) + ((below * slope) >> 8) + (1 << 47));
            store(DX, 0);
            store(DY, change * step);
            attribute += change * ((uint256(below) * step) >> 8);
            uint256 slopes = uint256(slope) + (uint256(slope) << 128);
            Rasterizer.fill(left + ((left + (1 << 48)) << 128), slopes, attribute, top, bottom);
        }
    }

    function flatLine(uint256 p, uint256 q, int256 dx, int256 dy, uint256 attribute, uint256 change, uint256 top, uint256 bottom)
        private
        pure
    {
        unchecked {
            int256 begin = (column(p) + 255) >> 8;
            int256 end = (column(q) + 255) >> 8;
            if (begin >= end) return;
            top = max(top, (min(p, q) + (128 << 128)) >> 136);
            bottom = min(bottom, ((max(p, q) + (128 << 128)) >> 136) + 1);
            uint256 step = uint256((1 << 40) / dx);
            store(DX, change * step);
            store(DY, 0);
            attribute += change * uint256((-column(p) * int256(step)) >> 8);
            int256 slope = dy == 0 ? int256(0) : (dx << 48) / dy;
            for (; top < bottom; ++top) {
                (int256 left, int256 right) = (begin, end);
                if (dy != 0) {
                    // where the line enters and leaves the row
                    int256 enter = (column(p) << 40) + (((int256(top << 8) - 128 - row(p)) * slope) >> 8) + CEIL;
                    int256 exit = (enter + slope) >> 48;
                    enter >>= 48;
                    if (dy < 0) (enter, exit) = (exit, enter);
                    if (enter > left) left = enter;
                    if (exit < right) right = exit;
                }
                // one row only, so that the slopes make no difference
                uint256 edges = uint256(left << 48) | (uint256(right) << 176);
                if (left < right) Rasterizer.fill(edges, uint256(slope), attribute, top, top + 1);
            }
        }
    }

    function column(uint256 screenWord) private pure returns (int256) {
        return int256((screenWord >> 64) & 0xfffff);
    }

    function row(uint256 screenWord) private pure returns (int256) {
        return int256(screenWord >> 128);
    }

    function min(uint256 a, uint256 b) private pure returns (uint256) {
        return a < b ? a : b;
    }

    function max(uint256 a, uint256 b) private pure returns (uint256) {
        return a > b ? a : b;
    }
}
