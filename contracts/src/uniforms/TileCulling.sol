// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Mesh} from "../scene/Mesh.sol";
import {Scene} from "../scene/Scene.sol";
import {Indices} from "../pipeline/geometry/Indices.sol";
import "../words/Registers.sol";

// Leaves out faces of which `fill` of picture.py covers no pixel of a tile.
// If only a part of the canvas is drawn, most faces lie beyond one of its borders. These faces, and the vertices that no other face uses,
// are omitted from the calldata of the engine before anything else is computed for them.
//
// A border of the tile is a plane through the eye. The side on which a vertex lies is the sign of a linear function of its position in the
// mesh: with the clip coordinates X = column * distance and w = distance, the vertex is left of the column `left` if
//
//   left * w - X > 0
//
// Nine such functions, each divided by its maximum, are the lanes of one word, so that three multiplications yield all signs: those of the
// borders of the tile, and those of the limits beyond which a vertex is clipped. A face is omitted if its three vertices lie beyond the
// same border of the tile: primitive assembly would omit it too, so neither pixels nor counts change. Faces with a vertex that may have to
// be clipped are kept, since clipping rounds.
//
// The order of the faces is kept. That of the vertices is not: indices only break ties between vertices at the same place, and a face with
// two of those is not drawn.

/// @dev Meshes with fewer faces are kept whole. The functions take 16,000 gas, and culling n faces pays only if more than about 0.37 n + 27
/// of them are omitted: never below 43.
uint256 constant LEAST_FACES = 48;
/// @dev Meshes are also kept whole if fewer than 3/4 of their vertices lie beyond borders, where a vertex beyond two borders counts twice:
/// rewriting the remaining faces would cost more than is saved.
uint256 constant CULLED_SHARE = 3;
uint256 constant CULLED_SHARE_OF = 4;
/// @dev The borders of the tile; the numbers of vertices beyond each, counted in lanes at the signs.
uint256 constant BORDERS = 4;
uint256 constant COUNT_SHIFT = 27;
uint256 constant COUNT_MASK = 0xfffffff;
/// @dev The bits of a coordinate that are used.
uint256 constant COORDINATE_BITS = 16;
uint256 constant COORDINATE_SHIFT = 240;
/// @dev The bits of a value before rounding; the fraction bits of a coefficient, which is such a value divided by 2^15.
uint256 constant VALUE_BITS = 40;
uint256 constant COEFFICIENT_FRACTION = 28;
/// @dev Scratch memory: of the columns of the matrix X, Y, the distance from the near plane and w, four words each; then the values of a
/// function.
uint256 constant PLACES_Y = 0x80;
uint256 constant PLACES_NEAR = 0x100;
uint256 constant PLACES_W = 0x180;
uint256 constant PLACES_VALUE = 0x200;
/// @dev 1 for each vertex index of a face.
uint256 constant FACE_ONES = 0x100010001;
/// @dev The mask of the new index in an entry of the vertex table, counted from 1, below the lowest sign.
uint256 constant NUMBER_MASK = 0x1ffff;
/// @dev The zero bits of an entry's offset in that table, since entries are words; the positions of the offset if a vertex index of a face,
/// at FACE_AT + FACE_FIRST_AT, FACE_AT + FACE_SECOND_AT and FACE_AT, is multiplied by 32; and the same for the next face.
uint256 constant ENTRY_BITS = 5;
uint256 constant FIRST_ENTRY_AT = 235;
uint256 constant SECOND_ENTRY_AT = 219;
uint256 constant THIRD_ENTRY_AT = 203;
uint256 constant NEXT_FIRST_ENTRY_AT = 187;
uint256 constant NEXT_SECOND_ENTRY_AT = 171;
uint256 constant NEXT_THIRD_ENTRY_AT = 155;
/// @dev The size of two faces in bytes.
uint256 constant FACE_PAIR = 12;

library TileCulling {
    /// @notice Returns whether the meshes follow one another in the calldata without overlap, so that each can be changed separately. This
    /// holds for all calldata made by ABI encoders, but the offsets of two objects may point to the same bytes.
    function areApart(Scene calldata scene) internal pure returns (bool) {
        unchecked {
            uint256 behind;
            for (uint256 i; i != scene.objects.length; ++i) {
                bytes calldata data = scene.objects[i].mesh;
                uint256 begin;
                assembly ("memory-safe") {
                    begin := data.offset
                }
                // the engine does not read the preceding word, the length of the mesh
                if (begin < behind + 32) return false;
                behind = begin + data.length;
            }
            return true;
        }
    }

    /// @notice Keeps only those faces and vertices in the copy of a mesh that may touch the tile. The registers must contain the matrix of
    /// the object and the tile.
    /// @param mesh The mesh in calldata. Its counts are changed.
    /// @param copied The difference between the address of the copy and the calldata offset. Up to 26 bytes after the copy are overwritten.
    /// @param object The number of the object. Reverts if a face has a vertex index out of range.
    function run(Mesh memory mesh, uint256 copied, uint256 object) internal pure {
        unchecked {
            Indices.check(mesh, object);
            if (mesh.faceCount < LEAST_FACES) return;
            uint256[4] memory columns;
            setColumns(columns, mesh.bits - COORDINATE_BITS);
            uint256 table = freeMemory();
            uint256 beyond = classify(mesh, columns, table);
            uint256 sum;
            for (uint256 border; border != BORDERS; ++border) {
                uint256 count = (beyond >> (COUNT_SHIFT + BORDER_BITS * border)) & COUNT_MASK;
                if (count == mesh.vertexCount) {
                    mesh.faceCount = 0;
                    return;
                }
                sum += count;
            }
            if (CULLED_SHARE_OF * sum > CULLED_SHARE * mesh.vertexCount) cull(mesh, table, copied);
        }
    }

    /// @notice Computes the functions of the borders.
    /// @param columns Their coefficients of x, y and z of a vertex, and their constants.
    /// @param dropped The number of the lowest coordinate bits that are not used.
    function setColumns(uint256[4] memory columns, uint256 dropped) private pure {
        unchecked {
            uint256 places = freeMemory();
            for (uint256 i; i != 4; ++i) {
                uint256 column = load(MATRIX_X + 32 * i) + CLIP_BIAS;
                bool isLast = i == 3;
                // times the maximum of a coordinate
                uint256 shift = isLast ? 0 : dropped + COORDINATE_BITS - 1;
                uint256 place = places + 32 * i;
                int256 w = int256(column) >> CLIP_W_AT;
                storeSigned(place, (int256(column & CLIP_X_MASK) - int256(CLIP_HALF)) << shift);
                storeSigned(place + PLACES_Y, (int256((column >> CLIP_Y_AT) & CLIP_Y_MASK) - int256(CLIP_HALF)) << shift);
                storeSigned(place + PLACES_NEAR, (isLast ? w - loadSigned(NEAR) : w) << shift);
                if (load(FRAME_IS_ORTHOGRAPHIC) != 0) w = isLast ? int256(ONE_32) : int256(0);
                storeSigned(place + PLACES_W, w << shift);
            }
            for (uint256 lane; lane != BORDER_COUNT; ++lane) {
                // left, right, above, below: of the tile, then of the guard band; then the near plane
                uint256 axis = (lane >> 1) & 1;
                uint256 border;
                if (lane < 4) border = load(TILE_LEFT + 64 * axis) + (lane & 1) * (load(TILE_SPAN + 64 * axis) + 1);
                else border = (lane & 1) << GUARD_BITS;
                setLane(columns, places, (axis + 2 * (lane >> 3)) * PLACES_Y, border, lane);
            }
            columns[3] += BORDER_BIAS;
        }
    }

    /// @notice Adds one function, place - border * w, negated in an even lane. Divided by a little more than their maximum, values are at
    /// most 2^27 - 2^18. Rounding changes them by at most 2^15.7: three coefficients by 0.501 each, times 2^15, and the dropped coordinate
    /// bits, times coefficients with a sum of 2^12.
    function setLane(uint256[4] memory columns, uint256 places, uint256 axis, uint256 border, uint256 lane) private pure {
        assembly ("memory-safe") {
            let divisor := 1
            let value
            for { let i := 0 } lt(i, 0x80) { i := add(i, 0x20) } {
                let place := add(places, i)
                value := sub(mload(add(place, axis)), mul(border, mload(add(place, PLACES_W))))
                mstore(add(place, PLACES_VALUE), value)
                let sign := sar(255, value)
                divisor := add(divisor, sub(xor(value, sign), sign))
            }
            divisor := add(divisor, shr(8, divisor))
            if iszero(and(lane, 1)) { divisor := sub(0, divisor) }
            let rounded := COEFFICIENT_FRACTION
            for { let i := 0 } lt(i, 0x80) { i := add(i, 0x20) } {
                // the last one is not a coefficient
                if eq(i, 0x60) { rounded := sub(COEFFICIENT_FRACTION, sub(COORDINATE_BITS, 1)) }
                value := sdiv(shl(VALUE_BITS, mload(add(add(places, i), PLACES_VALUE))), divisor)
                value := sar(rounded, add(value, shl(sub(rounded, 1), 1)))
                let column := add(columns, i)
                mstore(column, add(mload(column), shl(mul(BORDER_BITS, lane), value)))
            }
        }
    }

    /// @notice Writes the vertex table: for each vertex, the borders of the tile beyond which it lies; none if it may have to be clipped.
    /// @return beyond The numbers of vertices beyond each border, in lanes of BORDER_BITS from COUNT_SHIFT on.
    function classify(Mesh memory mesh, uint256[4] memory columns, uint256 table) private pure returns (uint256 beyond) {
        unchecked {
            (uint256 bits, uint256 stride, uint256 vertex) = (mesh.bits, mesh.stride, mesh.vertices);
            uint256 end = table + (mesh.vertexCount << ENTRY_BITS);
            (uint256 x, uint256 y, uint256 z, uint256 t) = (columns[0], columns[1], columns[2], columns[3]);
            assembly ("memory-safe") {
                for {} lt(table, end) {} {
                    let data := calldataload(vertex)
                    let signs := add(t, mul(sar(COORDINATE_SHIFT, data), x))
                    data := shl(bits, data)
                    signs := add(signs, mul(sar(COORDINATE_SHIFT, data), y))
                    signs := add(signs, mul(sar(COORDINATE_SHIFT, shl(bits, data)), z))
                    signs := mul(and(signs, BORDER_SIGNS), iszero(and(signs, GUARD_SIGNS)))
                    mstore(table, signs)
                    beyond := add(beyond, signs)
                    table := add(table, 32)
                    vertex := add(vertex, stride)
                }
            }
        }
    }

    /// @notice Moves the kept faces and their vertices to the front.
    function cull(Mesh memory mesh, uint256 table, uint256 copied) private pure {
        unchecked {
            // the bits of offsets of entries
            uint256 mask = mesh.vertexCount - 1;
            mask |= mask >> 1;
            mask |= mask >> 2;
            mask |= mask >> 4;
            mask = (mask | (mask >> 8)) << ENTRY_BITS;
            uint256 end = mesh.faces + FACE_SIZE * mesh.faceCount;
            uint256 face = nextFace(mesh.faces, end, table, mask);
            uint256 target = mesh.faces + copied;
            uint256 vertices = mesh.vertices + copied;
            mesh.vertexCount = 0;
            while (face < end) {
                uint256 numbers;
                assembly ("memory-safe") {
                    numbers := calldataload(face)
                }
                uint256 moved = numberOf(mesh, table, (numbers >> FIRST_ENTRY_AT) & mask, vertices) << FACE_FIRST_AT;
                moved += numberOf(mesh, table, (numbers >> SECOND_ENTRY_AT) & mask, vertices) << FACE_SECOND_AT;
                moved += numberOf(mesh, table, (numbers >> THIRD_ENTRY_AT) & mask, vertices);
                store(target, (moved - FACE_ONES) << FACE_AT);
                target += FACE_SIZE;
                face = nextFace(face + FACE_SIZE, end, table, mask);
            }
            mesh.faceCount = (target - copied - mesh.faces) / FACE_SIZE;
        }
    }

    /// @notice Returns the first face from `face` on that is kept; `end` or a later position if there is none.
    function nextFace(uint256 face, uint256 end, uint256 table, uint256 mask) private pure returns (uint256) {
        assembly ("memory-safe") {
            for {} lt(face, end) { face := add(face, FACE_PAIR) } {
                // Two at a time. The second one may be beyond the last face: the mask bounds its indices, and its result is not used.
                let numbers := calldataload(face)
                let first := and(
                    and(
                        mload(add(table, and(shr(FIRST_ENTRY_AT, numbers), mask))),
                        mload(add(table, and(shr(SECOND_ENTRY_AT, numbers), mask)))
                    ),
                    and(mload(add(table, and(shr(THIRD_ENTRY_AT, numbers), mask))), BORDER_SIGNS)
                )
                let second := and(
                    and(
                        mload(add(table, and(shr(NEXT_FIRST_ENTRY_AT, numbers), mask))),
                        mload(add(table, and(shr(NEXT_SECOND_ENTRY_AT, numbers), mask)))
                    ),
                    and(mload(add(table, and(shr(NEXT_THIRD_ENTRY_AT, numbers), mask))), BORDER_SIGNS)
                )
                // signs are below 2^112
                if iszero(mul(first, second)) {
                    if first { face := add(face, FACE_SIZE) }
                    break
                }
            }
        }
        return face;
    }

    /// @notice Returns the new index of a vertex, counted from 1. Copies the vertex the first time.
    /// @param offset The offset of its entry in the table.
    /// @param vertices The address of the kept vertices.
    function numberOf(Mesh memory mesh, uint256 table, uint256 offset, uint256 vertices) private pure returns (uint256 number) {
        unchecked {
            uint256 signs = load(table + offset);
            number = signs & NUMBER_MASK;
            if (number == 0) {
                uint256 stride = mesh.stride;
                vertices += mesh.vertexCount * stride;
                number = ++mesh.vertexCount;
                store(table + offset, signs | number);
                uint256 source = mesh.vertices + (offset >> ENTRY_BITS) * stride;
                assembly ("memory-safe") {
                    calldatacopy(vertices, source, stride)
                }
            }
        }
    }
}
