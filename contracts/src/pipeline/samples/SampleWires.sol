// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {sqrt} from "../../math/Roots.sol";
import {columnOf, doubleAreaOf, rowOf} from "../geometry/Screen.sol";
import {Clipper} from "../geometry/Clipper.sol";
import {Wires} from "../shading/Wires.sol";
import {SampleRasterizer} from "./SampleRasterizer.sol";
import "../../words/Registers.sol";

// Rasterizes the edges of triangles to fragments of four samples: a line is a rectangle, one pixel wide, as in OpenGL with multisampling.
// It is drawn as two triangles.
abstract contract SampleWires is SampleRasterizer, Wires {
    function line(uint256 p, uint256 q, uint256 attribute, uint256 change) internal pure override {
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
            int256 area = doubleAreaOf(a, b, c);
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
        return (Clipper.inGuardBand(y) << SCREEN_ROW_AT) | (Clipper.inGuardBand(x) << SCREEN_COLUMN_AT);
    }
}
