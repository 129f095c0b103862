// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Mesh} from "../scene/Mesh.sol";
import {Scene} from "../scene/Scene.sol";
import {Indices} from "../pipeline/Indices.sol";
import "../pipeline/Registers.sol";

// Where only a part of the canvas is drawn, most faces lie beyond one of its borders. Those are left out of the call of the engine, and
// with them the vertices that no other face has, before anything else is computed for them.
//
// A border of the tile is a plane through the eye, and the side of it on which a vertex lies is the sign of a linear function of the place
// in the mesh: with the clip coordinates X = column * distance and w = distance, the vertex is left of the column `left` where
//
//   left * w - X > 0
//
// Nine such functions, each divided by the most that it can be, stand in lanes of one word, so that three multiplications tell all signs:
// those of the borders of the tile, and of what a vertex must not pass if it is not to be clipped. A face is left out if its three
// vertices lie beyond the same border of the tile: then the primitive assembly would leave it out, too, and neither pixels nor counts
// change. Faces of which a vertex may have to be clipped are kept, since cutting rounds.
//
// The order of the faces is kept. That of the vertices is not: numbers put only vertices at the same place in order, and a face with two
// of those is not drawn.

/// @dev Meshes of fewer faces are kept whole. The functions take 16,000 gas, and culling n faces pays only where more than about
/// 0.37 n + 27 of them are left out: never below 43.
uint256 constant LEAST_FACES = 48;
/// @dev Meshes are kept whole, too, if fewer than 3/4 of their vertices lie beyond borders, where one beyond two borders counts twice: the
/// faces that are kept would cost more to write anew than the others save.
uint256 constant CULLED_SHARE = 3;
uint256 constant CULLED_SHARE_OF = 4;
/// @dev Borders of the tile; how many vertices lie beyond one, counted in its lane from the sign on.
uint256 constant BORDERS = 4;
uint256 constant COUNT_SHIFT = 27;
uint256 constant COUNT_MASK = 0xfffffff;
/// @dev Bits of a coordinate that are used.
uint256 constant COORDINATE_BITS = 16;
uint256 constant COORDINATE_SHIFT = 240;
/// @dev Bits of a value before it is rounded; of a coefficient, which is such a value by 2^15, below the point.
uint256 constant VALUE_BITS = 40;
uint256 constant COEFFICIENT_FRACTION = 28;
/// @dev Scratch memory: of the columns of the matrix X, Y, the distance from the near plane and w, four words each; then the values of a
/// function.
uint256 constant PLACES_Y = 0x80;
uint256 constant PLACES_NEAR = 0x100;
uint256 constant PLACES_W = 0x180;
uint256 constant PLACES_VALUE = 0x200;
/// @dev 1 for each number of a face.
uint256 constant FACE_ONES = 0x100010001;
/// @dev Where in an entry of the table of vertices the new number stands, counted from 1, below the lowest sign.
uint256 constant NUMBER_MASK = 0x1ffff;
/// @dev Bits of the offset of an entry of that table, a word long, that are 0; and where the offset is if a number of a face, at FACE_AT +
/// FACE_FIRST_AT, FACE_AT + FACE_SECOND_AT and FACE_AT, is multiplied by 32; and
/// the same of the next face.
uint256 constant ENTRY_BITS = 5;
uint256 constant FIRST_ENTRY_AT = 235;
uint256 constant SECOND_ENTRY_AT = 219;
uint256 constant THIRD_ENTRY_AT = 203;
uint256 constant NEXT_FIRST_ENTRY_AT = 187;
uint256 constant NEXT_SECOND_ENTRY_AT = 171;
uint256 constant NEXT_THIRD_ENTRY_AT = 155;
/// @dev Bytes of two faces.
uint256 constant FACE_PAIR = 12;

library TileCulling {
    /// @notice Whether the meshes stand one behind the other in the call, so that each can be changed by itself. They do in all calls that
    /// the ABI's encoders make; but offsets of two objects may lead to the same bytes.
    function areApart(Scene calldata scene) internal pure returns (bool) {
        unchecked {
            uint256 behind;
            for (uint256 i; i != scene.objects.length; ++i) {
                bytes calldata data = scene.objects[i].mesh;
                uint256 begin;
                assembly ("memory-safe") {
                    begin := data.offset
                }
                // the word before it, its length, is not read by the engine
                if (begin < behind + 32) return false;
                behind = begin + data.length;
            }
            return true;
        }
    }

    /// @notice Leaves only those faces and vertices in the copy of a mesh that may touch the tile. The registers have the matrix of the
    /// object and the tile.
    /// @param mesh Where it is in calldata; its counts are changed.
    /// @param copied What is to be added to get the address of the copy. Up to 26 bytes behind the copy are lost.
    /// @param object The number of the object. Reverts if a face has a vertex number that is out of range.
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

    /// @notice The functions of the borders.
    /// @param columns What in them is multiplied by x, y and z of a vertex, and what is added.
    /// @param dropped How many of the lowest bits of coordinates are not used.
    function setColumns(uint256[4] memory columns, uint256 dropped) private pure {
        unchecked {
            uint256 places = freeMemory();
            for (uint256 i; i != 4; ++i) {
                uint256 column = load(MATRIX_X + 32 * i) + CLIP_BIAS;
                bool isLast = i == 3;
                // times the most that a coordinate can be
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

    /// @notice Adds one function, place - border * w, or its negative in an even lane. Divided by a little more than the most that they can
    /// be, values are below 2^27 by 2^18. Of that rounding takes 2^15.7 at most: three coefficients by 0.501 times 2^15, and the bits
    /// that coordinates have lost, times coefficients that are 2^12 together.
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
                // the last is no coefficient
                if eq(i, 0x60) { rounded := sub(COEFFICIENT_FRACTION, sub(COORDINATE_BITS, 1)) }
                value := sdiv(shl(VALUE_BITS, mload(add(add(places, i), PLACES_VALUE))), divisor)
                value := sar(rounded, add(value, shl(sub(rounded, 1), 1)))
                let column := add(columns, i)
                mstore(column, add(mload(column), shl(mul(BORDER_BITS, lane), value)))
            }
        }
    }

    /// @notice Writes the table of vertices: for each beyond which borders of the tile it lies; none if it may have to be clipped.
    /// @return beyond How many lie beyond each border, in lanes of BORDER_BITS from COUNT_SHIFT on.
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

    /// @notice Moves the faces that are kept, and their vertices, to the front.
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

    /// @notice The first face from `face` on that is kept; `end`, or the place of a face behind it, if there is none.
    function nextFace(uint256 face, uint256 end, uint256 table, uint256 mask) private pure returns (uint256) {
        assembly ("memory-safe") {
            for {} lt(face, end) { face := add(face, FACE_PAIR) } {
                // Two at a time. Of the last the second may be no face: the mask keeps its numbers small, and nobody asks for it.
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

    /// @notice The new number of a vertex, counted from 1; the first time it is copied there.
    /// @param offset That of its entry in the table.
    /// @param vertices The address of the vertices that are kept.
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
