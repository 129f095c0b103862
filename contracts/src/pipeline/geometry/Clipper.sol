// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Mesh} from "../../scene/Mesh.sol";
import {doubleAreaOf} from "./Screen.sol";
import {Triangles} from "./Triangles.sol";
import {VertexShader} from "./VertexShader.sol";
import "../../words/Registers.sol";

// Computes `clipped` of picture.py, at five planes.
// Triangles that leave the guard band or reach behind the near plane are clipped, in homogeneous coordinates, before the perspective
// division. Source: I. Sutherland, G. Hodgman, "Reentrant polygon clipping", Communications of the ACM 17 (1974).
//
// An edge is always clipped from its inner end, and each end is classified in the same way for all faces, so faces that share an edge also
// share the new vertex. A polygon is a sequence of corners in memory, CORNER_SIZE bytes each.

/// @dev Near, left, right, top, bottom.
uint256 constant PLANES = 5;
/// @dev Each plane adds at most one corner to the three of a face.
uint256 constant MAX_CORNERS = 8;
/// @dev Room for a polygon in which rounding has put every second corner outside a plane.
uint256 constant POLYGON_SIZE = 3 * MAX_CORNERS / 2 * CORNER_SIZE;
/// @dev A polygon becomes a fan of triangles, one word each.
uint256 constant FAN_SIZE = (MAX_CORNERS - 2) * 32;

/// @dev Keeps the lanes of a normal positive; and the rest of that bias after a shift by 32 bits.
uint256 constant NORMAL_LANES_BIAS = 0x40000000000000000000020000000000000000000010000000000;
uint256 constant NORMAL_LANES = 0xfffffffffffffc00000003ffffffffffffe00000001fffffffffffff;

library Clipper {
    /// @notice Clips the faces that primitive assembly left, and appends the resulting triangles to its list.
    /// @param hasBacks Whether the normals of faces that are turned away are turned, too.
    /// @return end The end of the list.
    /// @return free The first address after the list and the new vertices.
    /// @return drawn The number of faces with a visible part: see PrimitiveAssembly.
    function run(Mesh memory mesh, uint256 records, uint256 shift, uint256 list, bool cull, bool hasBacks)
        internal pure returns (uint256 end, uint256 free, uint256 drawn)
    {
        unchecked {
            uint256 count = countFaces(mesh, records, shift);
            uint256 polygon = list + count * FAN_SIZE;
            free = polygon + 2 * POLYGON_SIZE;
            end = list;
            for (uint256 face; count != 0; ++face) {
                (bool isCut, bool isOutside) = readFace(mesh, records, shift, face, polygon);
                if (!isCut) continue;
                --count;
                if (isOutside) continue;
                (uint256 start, uint256 corners) = cut(polygon);
                if (corners < 3) continue;
                for (uint256 i; i != corners; ++i) project(start + i * CORNER_SIZE, free + (i << shift));
                if (hasBacks) turnBack(free, corners, shift);
                store(FACE, mesh.faces + FACE_SIZE * face);
                bool isDrawn;
                (end, isDrawn) = fan(start, corners, free, shift, end, cull);
                if (isDrawn) ++drawn;
                free += corners << shift;
            }
            // a record of 64 bytes has no room for the normal, which is written after it: into the next record, which is made later, or
            // here
            free += 32;
        }
    }

    /// @dev Returns the number of faces to clip.
    function countFaces(Mesh memory mesh, uint256 records, uint256 shift) private pure returns (uint256 count) {
        unchecked {
            for (uint256 face; face != mesh.faceCount; ++face) {
                uint256 indices = Triangles.readIndices(mesh.faces + FACE_SIZE * face);
                uint256 all = load(records + (indices >> FACE_FIRST_AT << shift)) | load(records + ((indices & FACE_INDEX_MASK) << shift))
                    | load(records + (((indices >> FACE_SECOND_AT) & FACE_INDEX_MASK) << shift));
                if (all & MUST_CLIP != 0) ++count;
            }
        }
    }

    /// @notice Reads the three corners of a face if it must be clipped.
    /// @return isCut Whether it must be clipped.
    /// @return isOutside Whether it lies entirely outside one plane.
    function readFace(Mesh memory mesh, uint256 records, uint256 shift, uint256 face, uint256 polygon)
        private pure returns (bool isCut, bool isOutside)
    {
        unchecked {
            uint256 indices = Triangles.readIndices(mesh.faces + FACE_SIZE * face);
            uint256 outcodes = type(uint256).max;
            for (uint256 i; i != 3; ++i) {
                uint256 index = (indices >> (FACE_FIRST_AT - FACE_SECOND_AT * i)) & FACE_INDEX_MASK;
                uint256 record = records + (index << shift);
                bool mustClip = load(record) & MUST_CLIP != 0;
                isCut = isCut || mustClip;
                outcodes &= mustClip ? load(record + VERTEX_ATTRIBUTES) : 0;
                VertexShader.clipCoordinates(index, polygon);
                store(polygon + CORNER_NORMAL, load(record + VERTEX_NORMAL));
                store(polygon + CORNER_IS_EDGE, 1);
                polygon += CORNER_SIZE;
            }
            isOutside = outcodes != 0;
        }
    }

    /// @notice Clips a triangle by all planes.
    /// @param start The address of the polygon; POLYGON_SIZE bytes for the other buffer follow it.
    function cut(uint256 start) private pure returns (uint256, uint256 corners) {
        unchecked {
            uint256 places = 2 * start + POLYGON_SIZE;
            corners = 3;
            for (uint256 plane; plane != PLANES; ++plane) {
                uint256 target = places - start;
                uint256 write = target;
                uint256 last = start + corners * CORNER_SIZE;
                int256 distance = distanceInside(start, plane);
                for (uint256 corner = start; corner < last; corner += CORNER_SIZE) {
                    uint256 next = corner + CORNER_SIZE == last ? start : corner + CORNER_SIZE;
                    int256 nextDistance = distanceInside(next, plane);
                    if (distance >= 0) {
                        copy(write, corner);
                        write += CORNER_SIZE;
                    }
                    if (distance ^ nextDistance < 0) {
                        if (distance < 0) intersect(next, corner, nextDistance, distance, write);
                        else intersect(corner, next, distance, nextDistance, write);
                        // going inward, the rest of the edge follows; going outward, the edge along the plane
                        store(write + CORNER_IS_EDGE, distance < 0 ? load(corner + CORNER_IS_EDGE) : 0);
                        if (plane == 0) store(write + CORNER_W, load(NEAR));
                        write += CORNER_SIZE;
                    }
                    distance = nextDistance;
                }
                start = target;
                corners = (write - target) / CORNER_SIZE;
                if (corners > MAX_CORNERS) corners = MAX_CORNERS;
            }
            return (start, corners);
        }
    }

    function copy(uint256 target, uint256 source) private pure {
        assembly ("memory-safe") {
            mcopy(target, source, CORNER_SIZE)
        }
    }

    /// @notice Returns a measure of the distance from a plane, not negative inside.
    function distanceInside(uint256 corner, uint256 plane) private pure returns (int256) {
        unchecked {
            int256 w = loadSigned(corner + CORNER_W);
            if (plane == 0) return w - loadSigned(NEAR);
            int256 value = loadSigned(corner + (plane < 3 ? CORNER_X : CORNER_Y));
            if (plane & 1 == 1) return value;
            return (divisor(w) << GUARD_BITS) - value - 1;
        }
    }

    /// @dev Returns the divisor of clip coordinates.
    function divisor(int256 w) private pure returns (int256) {
        return load(FRAME_IS_ORTHOGRAPHIC) == 0 ? w : int256(ONE_32);
    }

    /// @notice Computes the point between two corners at which the distance is zero.
    function intersect(uint256 inside, uint256 outside, int256 inner, int256 outer, uint256 target) private pure {
        unchecked {
            int256 whole = inner - outer;
            for (uint256 offset; offset != CORNER_COLOR; offset += 32) {
                int256 value = loadSigned(inside + offset);
                storeSigned(target + offset, value + (loadSigned(outside + offset) - value) * inner / whole);
            }
            // colours and normals keep 32 more bits until they are summed
            uint256 part = uint256((inner << Q32) / whole);
            uint256 lanes = load(inside + CORNER_COLOR);
            lanes = (lanes << Q32) + (load(outside + CORNER_COLOR) - lanes) * part;
            store(target + CORNER_COLOR, (lanes >> Q32) & LANES_24);
            lanes = load(inside + CORNER_NORMAL);
            lanes = (lanes << Q32) + (load(outside + CORNER_NORMAL) - lanes) * part + (NORMAL_LANES_BIAS << Q32);
            store(target + CORNER_NORMAL, ((lanes >> Q32) & NORMAL_LANES) - NORMAL_LANES_BIAS);
        }
    }

    /// @notice Makes a vertex record from a corner.
    function project(uint256 corner, uint256 record) private pure {
        unchecked {
            int256 w = loadSigned(corner + CORNER_W);
            uint256 x = inGuardBand(loadSigned(corner + CORNER_X) / divisor(w));
            uint256 y = inGuardBand(loadSigned(corner + CORNER_Y) / divisor(w));
            uint256 depth = load(DEPTH_SCALE);
            depth = load(FRAME_IS_ORTHOGRAPHIC) == 0 ? depth / uint256(w) : depth - uint256(w >> Q32_TO_Q24);
            store(record, VertexShader.screenWord(x, y, record));
            store(record + VERTEX_ATTRIBUTES, (depth << ATTRIBUTE_DEPTH_AT) | load(corner + CORNER_COLOR));
            store(record + VERTEX_NORMAL, load(corner + CORNER_NORMAL));
        }
    }

    /// @dev Turns the normals of a polygon's vertices if it is seen from behind.
    function turnBack(uint256 first, uint256 corners, uint256 shift) private pure {
        unchecked {
            uint256 end = first + (corners << shift);
            uint256 size = 1 << shift;
            int256 area;
            for (uint256 p = first + 2 * size; p != end; p += size) area += doubleAreaOf(load(first), load(p - size), load(p));
            if (area >= 0) return;
            for (; first != end; first += size) store(first + VERTEX_NORMAL, 0 - load(first + VERTEX_NORMAL));
        }
    }

    /// @dev Clamps: rounding may have put a point slightly outside.
    function inGuardBand(int256 value) internal pure returns (uint256) {
        if (value < 0) return 0;
        return uint256(value) >> GUARD_BITS == 0 ? uint256(value) : (1 << GUARD_BITS) - 1;
    }

    /// @notice Appends the triangles of a polygon to the list. Its vertices are at `records`.
    function fan(uint256 corner, uint256 corners, uint256 records, uint256 shift, uint256 list, bool cull)
        private pure returns (uint256 end, bool isDrawn)
    {
        unchecked {
            end = list;
            uint256 first = load(records);
            uint256 edges = load(corner + CORNER_IS_EDGE);
            for (uint256 i = 2; i != corners; ++i) {
                corner += CORNER_SIZE;
                records += 1 << shift;
                edges |= load(corner + CORNER_IS_EDGE) << 1;
                if (i == corners - 1) edges |= load(corner + CORNER_SIZE + CORNER_IS_EDGE) << 2;
                uint256 drawn;
                (end, drawn) = Triangles.append(end, first, load(records), load(records + (1 << shift)), edges, cull);
                isDrawn = isDrawn || drawn != 0;
                edges = 0;
            }
        }
    }
}
