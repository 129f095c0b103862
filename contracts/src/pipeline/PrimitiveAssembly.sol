// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Mesh} from "../scene/Mesh.sol";
import {WIREFRAME} from "../scene/Scene.sol";
import {Rasterizer} from "./Rasterizer.sol";
import {ALL_EDGES, Triangles} from "./Triangles.sol";
import "./Registers.sol";

// From vertices and faces to triangles that are to be drawn: those that face the viewer (or all). Where the depths of the whole tile fit
// one band, each is drawn at once. Else, and where lines are drawn, and after clipping, it is listed: see Triangles. The first vertex is
// the topmost, and the three run counter-clockwise on the screen.

/// @dev Twice the area of a face that faces the viewer is above this, Q192.
int256 constant HALF_AREA = 0x800000000000000000000000000000000000000000000000;
/// @dev Twice the area, Q192, below which a face may lie between the pixel centres: that of one pixel.
int256 constant SMALL_AREA = 0x20000 << 192;

abstract contract PrimitiveAssembly is Rasterizer {
    /// @notice Draws the faces, or lists them for later, besides those that have to be clipped.
    /// @param records Address of the vertex records, 2^shift bytes each.
    /// @param list Where to write the triangles; 0 to draw them at once.
    /// @return end The end of the list.
    /// @return drawn How many faces are to be drawn: they face the viewer, or both sides are drawn, and they do not lie beyond one border
    /// of the tile.
    function assemble(Mesh memory mesh, uint256 records, uint256 shift, uint256 list, bool cull)
        internal
        pure
        returns (uint256 end, uint256 drawn)
    {
        unchecked {
            store(LIST, list);
            store(DRAWN, 0);
            storeSigned(LEAST_AREA, cull ? HALF_AREA : type(int256).min);
            store(FACES_END, mesh.faces + FACE_SIZE * mesh.faceCount);
            loop(mesh.faces, records, FACE_AT - shift, FACE_INDEX_MASK << shift);
            return (load(LIST), load(DRAWN));
        }
    }

    /// @param down How far the numbers of a face are shifted down to be offsets of records, which `mask` cuts out.
    function loop(uint256 face, uint256 records, uint256 down, uint256 mask) private pure {
        unchecked {
            while (face < load(FACES_END)) {
                uint256 a;
                uint256 b;
                uint256 c;
                int256 area;
                assembly ("memory-safe") {
                    c := shr(down, calldataload(face))
                    face := add(face, FACE_SIZE)
                    a := mload(add(records, and(shr(FACE_FIRST_AT, c), mask)))
                    b := mload(add(records, and(shr(FACE_SECOND_AT, c), mask)))
                    c := mload(add(records, and(c, mask)))
                    // Twice the area, (xc - xa) * (yb - ya) - (xb - xa) * (yc - ya), as the upper part of the product of
                    // K^2 * (yb - ya) + K * (xb - xa) and K * (xc - xa) - K^2 * (yc - ya), where K = 2^64; what is below K is noise,
                    // and so are all bits of the product below 2^186. Columns are turned round by taking them from 2^20 - 1.
                    area := mul(sub(b, a), sub(xor(a, SCREEN_COLUMNS), xor(c, SCREEN_COLUMNS)))
                }
                if (area <= loadSigned(LEAST_AREA)) continue;
                if (area < HALF_AREA) {
                    if (area > -HALF_AREA) continue;
                    (b, c) = (c, b);
                    area = -area;
                }
                uint256 crossing = (a | b | c) & IS_NOT_PLAIN;
                if (crossing != 0) {
                    if (crossing & MUST_CLIP != 0 || a & b & c & IS_OUTSIDE != 0) continue;
                    crossing = crossingOf(crossing);
                }
                assembly ("memory-safe") {
                    mstore(DRAWN, add(mload(DRAWN), 1))
                    mstore(FACE, sub(face, FACE_SIZE))
                }
                // the topmost first, without changing the sense of rotation
                if (b < a) {
                    if (b < c) (a, b, c) = (b, c, a);
                }
                if (c < a) (a, b, c) = (c, a, b);
                if (area < SMALL_AREA && load(OBJECT_FLAGS) & WIREFRAME == 0 && coversNothing(a, b, c)) continue;
                if (load(LIST) == 0) {
                    shade(a, b, c, crossing);
                    drawTriangle(a, b, c);
                } else {
                    store(LIST, Triangles.pack(load(LIST), a, b, c, ALL_EDGES));
                }
            }
        }
    }

    /// @dev What the flags of the vertices of a triangle, taken together, mean for its mode.
    function crossingOf(uint256 flags) private pure returns (uint256) {
        return (flags & IS_BESIDE != 0 ? IS_CROSSING : 0) | (flags & IS_OVER != 0 ? IS_CUT : 0);
    }
}
