// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import "./Registers.sol";

// Rasterizes triangles to fragments: PixelRasterizer samples pixel centres, SampleRasterizer four samples per pixel.
//
// Each engine implements the shading of triangles: see Engine and FragmentEngine.
abstract contract Rasterizer {
    /// @notice Selects how a triangle is shaded, and sets the registers for it: MODE, ATTRIBUTE_0, DELTA_1, DELTA_2 and others.
    /// @param a, b, c The screen words of its vertices, the topmost first, counter-clockwise.
    /// @param crossing IS_CROSSING, IS_CUT, both or neither.
    function shade(uint256 a, uint256 b, uint256 c, uint256 crossing) internal pure virtual;

    /// @notice Draws a triangle for which `shade` was called.
    /// @param a, b, c The screen words of its vertices, the topmost first, counter-clockwise.
    function drawTriangle(uint256 a, uint256 b, uint256 c) internal pure virtual;

    /// @notice Returns whether a small triangle covers nothing. May return false even then.
    /// @param a, b, c As for `drawTriangle`.
    function coversNothing(uint256 a, uint256 b, uint256 c) internal pure virtual returns (bool);

    /// @notice Draws the triangles of a list into the current band.
    function drawList(uint256 list, uint256 end) internal pure {
        unchecked {
            (uint256 bandTop, uint256 bandBottom) = (load(BAND_TOP), load(BAND_BOTTOM));
            for (; list != end; list += 32) {
                uint256 word = load(list);
                uint256 top = (word >> TRIANGLE_TOP_AT) & TRIANGLE_TOP_MASK;
                uint256 bottom = (word >> TRIANGLE_BOTTOM_AT) & TRIANGLE_BOTTOM_MASK;
                if (top >= bandBottom || bottom <= bandTop) continue;
                store(FACE, load(MESH_FACES) + FACE_SIZE * ((word >> TRIANGLE_FACE_AT) & TRIANGLE_FACE_MASK));
                uint256 a = load((word >> TRIANGLE_A_AT) & TRIANGLE_A_MASK);
                uint256 b = load((word >> TRIANGLE_B_AT) & TRIANGLE_B_MASK);
                uint256 c = load(word & TRIANGLE_C_MASK);
                shade(a, b, c, ((word >> TRIANGLE_CROSSING_SHIFT) & IS_CROSSING) | (top < bandTop || bottom > bandBottom ? IS_CUT : 0));
                drawTriangle(a, b, c);
            }
        }
    }
}
