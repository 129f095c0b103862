// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {SmoothShading} from "./SmoothShading.sol";
import {depthOf} from "../geometry/Screen.sol";
import "../../words/Registers.sol";

// Draws the edges of the triangles of objects that are wireframes: Wireframe as pixels, SampleWires as samples.
abstract contract Wires is SmoothShading {
    /// @notice Draws a line, with the mode of the triangle.
    /// @param p, q The screen words of the ends.
    /// @param attribute The accumulator at p.
    /// @param change The change of the attribute word from p to q.
    function line(uint256 p, uint256 q, uint256 attribute, uint256 change) internal pure virtual;

    function drawEdges(uint256 a, uint256 b, uint256 c, uint256 triangle) internal pure override {
        unchecked {
            shadeExact(a, b, c, (triangle >> TRIANGLE_CROSSING_SHIFT) & CROSSES_COLUMNS);
            (uint256 start, uint256 toB, uint256 toC) = (load(ATTRIBUTE_0), load(DELTA_1), load(DELTA_2));
            uint256 mode = load(MODE);
            if (mode & IS_DEEP != 0) {
                // lines have their depths in the accumulator
                uint256 depth = depthOf(a);
                start += depth << ACCUMULATOR_VERTEX_DEPTH_AT;
                toB += (depthOf(b) - depth) << ATTRIBUTE_DEPTH_AT;
                toC += (depthOf(c) - depth) << ATTRIBUTE_DEPTH_AT;
                store(MODE, mode ^ IS_DEEP);
            }
            if (triangle & EDGE_AB != 0) line(a, b, start, toB);
            if (triangle & EDGE_BC != 0) line(b, c, start + (toB << ACCUMULATOR_FRACTION), toC - toB);
            if (triangle & EDGE_CA != 0) line(c, a, start + (toC << ACCUMULATOR_FRACTION), 0 - toC);
        }
    }
}
