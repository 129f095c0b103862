// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {sqrt} from "../../math/Roots.sol";
import {SampleRasterizer} from "./SampleRasterizer.sol";
import {SmoothShading} from "../shading/SmoothShading.sol";
import "../../words/Registers.sol";

// Rasterizes the edges of triangles to fragments of four samples: a line is a rectangle, one pixel wide, as in OpenGL with multisampling.
// It is drawn as two triangles.
abstract contract SampleWires is SampleRasterizer, SmoothShading {
    /// @notice Draws the edges of the triangles of a list into the current band.
    function drawWires(uint256 list, uint256 end) internal pure virtual {
        unchecked {
            for (; list != end; list += 32) {
                uint256 word = load(list);
                if (
                    (word >> TRIANGLE_BOTTOM_AT) & TRIANGLE_BOTTOM_MASK <= load(BAND_TOP)
                        || (word >> TRIANGLE_TOP_AT) & TRIANGLE_TOP_MASK >= load(BAND_BOTTOM)
                ) continue;
                uint256 a = load((word >> TRIANGLE_A_AT) & TRIANGLE_A_MASK);
                uint256 b = load((word >> TRIANGLE_B_AT) & TRIANGLE_B_MASK);
                uint256 c = load(word & TRIANGLE_C_MASK);
                store(FACE, load(MESH_FACES) + FACE_SIZE * ((word >> TRIANGLE_FACE_AT) & TRIANGLE_FACE_MASK));
                // not a literal, for which the compiler would make a copy of each function that is called
                shadeExact(a, b, c, load(ZERO_SLOT));
                (uint256 start, uint256 toB, uint256 toC) = (load(ATTRIBUTE_0), load(DELTA_1), load(DELTA_2));
                uint256 mode = load(MODE);
                if (mode & IS_DEEP != 0) {
                    // lines have their depths in the accumulator
                    uint256 depth = depthOf(a);
                    start += depth << ACCUMULATOR_VERTEX_DEPTH_AT;
                    toB += (depthOf(b) - depth) << ATTRIBUTE_DEPTH_AT;
                    toC += (depthOf(c) - depth) << ATTRIBUTE_DEPTH_AT;
                    store(MODE, mode & ~IS_DEEP);
                }
                if (word & EDGE_AB != 0) line(a, b, start, toB);
                if (word & EDGE_BC != 0) line(b, c, start + (toB << ACCUMULATOR_FRACTION), toC - toB);
                if (word & EDGE_CA != 0) line(c, a, start + (toC << ACCUMULATOR_FRACTION), 0 - toC);
            }
        }
    }

    function depthOf(uint256 vertex) private pure returns (uint256) {
        return load((vertex & SCREEN_RECORD_MASK) + VERTEX_ATTRIBUTES) >> ATTRIBUTE_DEPTH_AT;
    }

    /// @param p, q The screen words of the ends.
    /// @param attribute The accumulator at p.
    /// @param change The change of the attribute word from p to q.
    function line(uint256 p, uint256 q, uint256 attribute, uint256 change) private pure {
        unchecked {
            // the same rectangle for both faces that share the edge
            if (q < p) {
                (p, q) = (q, p);
                attribute += change << ACCUMULATOR_FRACTION;
                change = 0 - change;
            }
            (int256 x, int256 y) = (columnOf(p), rowOf(p));
            (int256 dx, int256 dy) = (columnOf(q) - x, rowOf(q) - y);
            int256 length = int256(sqrt(uint256(dx * dx + dy * dy)));
            if (length == 0) return;
            // half a pixel to the right of the line, and to its left
            int256 acrossX = (dy * int256(HALF_PIXEL)) / length;
            int256 acrossY = -(dx * int256(HALF_PIXEL)) / length;
            uint256 a = screenWord(x + acrossX, y + acrossY);
            uint256 b = screenWord(x - acrossX, y - acrossY);
            uint256 c = screenWord(x + dx - acrossX, y + dy - acrossY);
            uint256 d = screenWord(x + dx + acrossX, y + dy + acrossY);
            // a and b have the attributes of p, c and d those of q
            triangle(a, b, c, attribute, load(ZERO_SLOT), change);
            triangle(a, c, d, attribute, change, change);
        }
    }

    /// @dev Draws a triangle whose first two vertices are the corners at one end of the line.
    /// @param toB, toC The changes of the attribute word from the first vertex to the others.
    function triangle(uint256 a, uint256 b, uint256 c, uint256 attribute, uint256 toB, uint256 toC) private pure {
        unchecked {
            int256 area = (columnOf(c) - columnOf(a)) * (rowOf(b) - rowOf(a)) - (columnOf(b) - columnOf(a)) * (rowOf(c) - rowOf(a));
            if (area == 0) return;
            if (area < 0) (b, c, toB, toC) = (c, b, toC, toB);
            // the topmost first
            while (a > b || a > c) {
                attribute += toB << ACCUMULATOR_FRACTION;
                (a, b, c, toB, toC) = (b, c, a, toC - toB, 0 - toB);
            }
            store(ATTRIBUTE_0, attribute);
            store(DELTA_1, toB);
            store(DELTA_2, toC);
            drawTriangle(a, b, c);
        }
    }

    /// @dev Clamps to the guard band: corners beyond it are far from the picture.
    function screenWord(int256 x, int256 y) private pure returns (uint256) {
        return (inGuardBand(y) << SCREEN_ROW_AT) | (inGuardBand(x) << SCREEN_COLUMN_AT);
    }

    function inGuardBand(int256 value) private pure returns (uint256) {
        if (value < 0) return 0;
        return value > int256(SCREEN_COLUMN_MASK) ? SCREEN_COLUMN_MASK : uint256(value);
    }

    function columnOf(uint256 word) private pure returns (int256) {
        return int256((word >> SCREEN_COLUMN_AT) & SCREEN_COLUMN_MASK);
    }

    function rowOf(uint256 word) private pure returns (int256) {
        return int256(word >> SCREEN_ROW_AT);
    }
}
