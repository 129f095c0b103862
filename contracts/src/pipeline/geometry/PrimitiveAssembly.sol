// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Mesh} from "../../scene/Mesh.sol";
import {WIREFRAME} from "../../scene/Scene.sol";
import {Rasterizer} from "./Rasterizer.sol";
import {ALL_EDGES, Triangles} from "./Triangles.sol";
import "../../words/Registers.sol";

// Computes `triangles` of picture.py.
// Assembles the triangles to draw from vertices and faces: those that face the viewer, or all if both sides are visible. If the depths of
// the whole tile fit one band, each triangle is drawn immediately. Otherwise, and for lines and after clipping, it is listed: see
// Triangles. The first vertex is the topmost, and the vertices are counter-clockwise on the screen.

/// @dev Twice the area of a front face is above this, Q192.
int256 constant HALF_AREA = 0x800000000000000000000000000000000000000000000000;
/// @dev Faces with twice an area, Q192, below this may lie between the pixel centres: the area of one pixel.
int256 constant SMALL_AREA = 0x20000 << 192;

abstract contract PrimitiveAssembly is Rasterizer {
    /// @notice Draws the faces, or lists them for later; skips those to be clipped.
    /// @param records The address of the vertex records, 2^shift bytes each.
    /// @param list The address for the list of triangles; 0 to draw them immediately.
    /// @return end The end of the list.
    /// @return drawn The number of faces to draw: they face the viewer, or both sides are visible, and they do not lie entirely beyond one
    /// edge of the tile.
    function assemble(Mesh memory mesh, uint256 records, uint256 shift, uint256 list, bool cull)
        internal pure returns (uint256 end, uint256 drawn)
    {
        unchecked {
            store(LIST, list);
            store(DRAWN, 0);
            store(BACK_OFFSET, load(BACK_COUNT) << shift);
            storeSigned(LEAST_AREA, cull ? HALF_AREA : type(int256).min);
            store(FACES_END, mesh.faces + FACE_SIZE * mesh.faceCount);
            loop(mesh.faces, records, FACE_AT - shift, FACE_INDEX_MASK << shift);
            return (load(LIST), load(DRAWN));
        }
    }

    /// @param down The shift of a face's vertex indices that makes them offsets of records, which `mask` extracts.
    function loop(uint256 face, uint256 records, uint256 down, uint256 mask) private pure {
        unchecked {
            while (face < load(FACES_END)) {
                uint256 a;
                uint256 b;
                uint256 c;
                int256 area;
                uint256 crossing;
                assembly ("memory-safe") {
                    c := shr(down, calldataload(face)) // c: the three indices
                    face := add(face, FACE_SIZE)
                    a := mload(add(records, and(shr(FACE_FIRST_AT, c), mask))) // a, b, c: the screen words
                    b := mload(add(records, and(shr(FACE_SECOND_AT, c), mask)))
                    c := mload(add(records, and(c, mask)))
                    // Twice the area, (xc - xa) * (yb - ya) - (xb - xa) * (yc - ya), as the upper part of the product of K^2 * (yb - ya) +
                    // K * (xb - xa) and K * (xc - xa) - K^2 * (yc - ya), where K = 2^64; what is below K is noise, and so are all bits of
                    // the product below 2^186. Columns are mirrored by subtracting them from 2^20 - 1.
                    area := mul(sub(b, a), sub(xor(a, SCREEN_COLUMNS), xor(c, SCREEN_COLUMNS))) // (b - a) * (mirrored a - mirrored c)
                }
                if (area <= loadSigned(LEAST_AREA)) continue;
                if (area < HALF_AREA) {
                    if (area > -HALF_AREA) continue;
                    (a, b, c) = (a + load(BACK_OFFSET), c + load(BACK_OFFSET), b + load(BACK_OFFSET));
                    area = -area;
                    crossing = IS_TURNED_AWAY;
                }
                uint256 flags = (a | b | c) & NEEDS_CARE;
                if (flags != 0) {
                    if (flags & MUST_CLIP != 0 || a & b & c & IS_OUTSIDE != 0) continue;
                    crossing |= crossingOf(flags);
                }
                assembly ("memory-safe") {
                    mstore(DRAWN, add(mload(DRAWN), 1))
                    mstore(FACE, sub(face, FACE_SIZE))
                }
                // rotate the topmost vertex to the front, without changing the orientation
                if (b < a) {
                    if (b < c) (a, b, c) = (b, c, a);
                }
                if (c < a) (a, b, c) = (c, a, b);
                if (area < SMALL_AREA && load(OBJECT_FLAGS) & WIREFRAME == 0 && coversNothing(a, b, c)) continue;
                if (load(LIST) == 0) {
                    shade(a, b, c, crossing);
                    drawTriangle(a, b, c);
                } else {
                    store(LIST, Triangles.pack(load(LIST), a, b, c, ALL_EDGES + load(ZERO_SLOT), crossing & IS_TURNED_AWAY));
                }
            }
        }
    }

    /// @dev Converts the combined flags of a triangle's vertices to bits of its mode.
    function crossingOf(uint256 flags) private pure returns (uint256 mode) {
        assembly ("memory-safe") {
            mode := add(mul(CROSSES_COLUMNS, gt(and(flags, OUTSIDE_COLUMNS), 0)), mul(CROSSES_ROWS, gt(and(flags, OUTSIDE_ROWS), 0)))
        }
    }
}
