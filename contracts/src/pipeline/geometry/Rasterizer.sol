// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {WIREFRAME} from "../../scene/Scene.sol";
import "../../words/Registers.sol";

// Computes `fill` of picture.py.
// Rasterizes triangles to fragments: PixelRasterizer samples pixel centres, SampleRasterizer four samples per pixel.
//
// Each engine implements the shading of triangles: see Engine and FragmentEngine.
abstract contract Rasterizer {
    /// @notice Returns whether the vertices of the current object have normals.
    function isSmooth() internal pure virtual returns (bool);

    /// @notice Returns whether they have second records for faces that are turned away: see VertexShader.
    function hasBacks() internal pure virtual returns (bool);

    /// @notice Selects how a triangle is shaded, and sets the registers for it: MODE, ATTRIBUTE_0, DELTA_1, DELTA_2 and others.
    /// @param a, b, c The screen words of its vertices, the topmost first, counter-clockwise.
    /// @param crossing The sum of CROSSES_COLUMNS, CROSSES_ROWS and IS_TURNED_AWAY, or of some of them.
    function shade(uint256 a, uint256 b, uint256 c, uint256 crossing) internal pure virtual;

    /// @notice Draws a triangle for which `shade` was called.
    /// @param a, b, c The screen words of its vertices, the topmost first, counter-clockwise.
    function drawTriangle(uint256 a, uint256 b, uint256 c) internal pure virtual;

    /// @dev Returns by how much the depth of the current triangle, which is turned away from the eye, is reduced, so that a face turned to
    /// the eye in the same place is seen: by at least its change over 1/64 of a pixel along the axes, since rounding moves vertices by up
    /// to 1/512 (not more than the sum of both), and two units of the depths of vertices. At most half of the least depth above a base, so
    /// that it remains above it; nothing if the triangle IS_DEEP. Removes IS_TURNED_AWAY from MODE.
    /// @param dx, dy The changes of the accumulator over 1/64 of a pixel.
    function setBack(uint256 dx, uint256 dy, uint256 base) internal pure returns (uint256 depth) {
        assembly ("memory-safe") {
            let mode := mload(MODE)
            mstore(MODE, xor(mode, IS_TURNED_AWAY))
            if iszero(and(mode, IS_DEEP)) {
                depth := add(shr(ACCUMULATOR_DEPTH_AT, or(xor(dx, sar(SIGN_AT, dx)), xor(dy, sar(SIGN_AT, dy)))), 512) // |dx| or |dy|, + 2
                // of the vertices: of the first, then of the farthest
                dx := mload(DELTA_1)
                dy := mload(DELTA_2) // dx, dy: the differences of the other vertices
                if slt(dy, dx) { dx := dy } // min
                // (the least depth - base) / 2
                dx := mul(sar(ATTRIBUTE_DEPTH_AT, dx), slt(dx, 0)) // min(dx, 0), of the depth
                dx := shl(7, sub(add(dx, shr(ACCUMULATOR_VERTEX_DEPTH_AT, mload(ATTRIBUTE_0))), sar(DEPTH_FRACTION, base)))
                if lt(dx, depth) { depth := dx } // min
            }
        }
    }

    /// @notice Returns whether a small triangle covers nothing. May return false even then.
    /// @param a, b, c As for `drawTriangle`.
    function coversNothing(uint256 a, uint256 b, uint256 c) internal pure virtual returns (bool);

    /// @notice Leaves each edge of a list of whole faces to one of them, if this engine draws wires.
    /// @param records The address of the vertex records, 2^shift bytes each.
    /// @return The end of the list of those that have edges.
    function dropShared(uint256 list, uint256 end, uint256 records, uint256 shift) internal pure virtual returns (uint256);

    /// @notice Draws the edges of a triangle that belong to its face, if this engine draws wires.
    /// @param a, b, c The screen words of its vertices.
    /// @param triangle The triangle of a list.
    function drawEdges(uint256 a, uint256 b, uint256 c, uint256 triangle) internal pure virtual;

    /// @notice Draws the triangles of a list, or their edges, into the current band.
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
                if (load(OBJECT_FLAGS) & WIREFRAME != 0) {
                    drawEdges(a, b, c, word);
                    continue;
                }
                uint256 mode = (word >> TRIANGLE_CROSSING_SHIFT) & (CROSSES_COLUMNS | IS_TURNED_AWAY);
                shade(a, b, c, mode | (top < bandTop || bottom > bandBottom ? CROSSES_ROWS : 0));
                drawTriangle(a, b, c);
            }
        }
    }
}
