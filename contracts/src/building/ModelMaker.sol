// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {sqrt} from "../math/Roots.sol";
import {FACE_SIZE, HEADER_SIZE, VERTEX_SIZE} from "../mesh/PackedMesh.sol";
import {NORMALS} from "../scene/Mesh.sol";
import {Lettering} from "./Lettering.sol";
import {Shapes} from "./Shapes.sol";

/// @notice A mesh under construction, which grows on demand.
/// @param vertices Memory address of the next vertex.
/// @param faces Memory address of the next face.
/// @param vertexCount Number of vertices.
/// @param faceCount Number of faces.
/// @param maxVertices Capacity for vertices.
/// @param maxFaces Capacity for faces.
struct Model {
    uint256 vertices;
    uint256 faces;
    uint256 vertexCount;
    uint256 faceCount;
    uint256 maxVertices;
    uint256 maxFaces;
}

using ModelMaker for Model global;
using Shapes for Model global;
using Lettering for Model global;

/// @title ModelMaker: builds meshes of coloured triangles on chain, step by step.
/// @notice Coordinates are whole numbers from -32,768 to 32,767. Make a mesh a few hundred units large, and scale the object that uses it.
library ModelMaker {
    /// @notice A mesh has at most 65,535 vertices and 65,535 faces.
    error ModelTooLarge(uint256 vertices, uint256 faces);
    /// @notice The mesh already has `most` vertices, the maximum.
    error TooManyVertices(uint256 most);
    /// @notice The mesh already has `most` faces, the maximum.
    error TooManyFaces(uint256 most);
    /// @notice Coordinates must be from -32,768 to 32,767.
    error PositionOutOfRange(int256 x, int256 y, int256 z);
    /// @notice A colour must be 0xRRGGBB.
    error NotAColor(uint256 color);
    /// @notice A face refers to a missing vertex.
    error NoSuchVertex(uint256 vertex, uint256 vertexCount);

    /// @dev Vertices and faces are counted in 16 bits.
    uint256 private constant MOST = 65535;
    /// @dev A unit normal is stored as a vector of this length.
    uint256 private constant NORMAL_UNIT = 511;
    /// @dev Bits of a lane of a word that holds a sum of vectors, each coordinate below 2^51: see `sumsOfNormals`.
    uint256 private constant LANE = 85;

    /// @notice Returns an empty mesh.
    function model() internal pure returns (Model memory) {
        return model(64, 96);
    }

    /// @notice Returns an empty mesh with an initial capacity; the right numbers save the gas of growing.
    function model(uint256 maxVertices, uint256 maxFaces) internal pure returns (Model memory made) {
        if (maxVertices > MOST || maxFaces > MOST) revert ModelTooLarge(maxVertices, maxFaces);
        setRoom(made, maxVertices, maxFaces);
    }

    /// @notice Adds a vertex.
    /// @param color 0xRRGGBB.
    /// @return index Its index, for faces.
    function vertex(Model memory m, int256 x, int256 y, int256 z, uint256 color) internal pure returns (uint256 index) {
        unchecked {
            index = m.vertexCount;
            if (index == m.maxVertices) {
                if (index == MOST) revert TooManyVertices(MOST);
                grow(m);
            }
            if (int16(x) != x || int16(y) != y || int16(z) != z) revert PositionOutOfRange(x, y, z);
            if (color > 0xffffff) revert NotAColor(color);
            uint256 packed = (uint256(uint16(int16(x))) << 56) | (uint256(uint16(int16(y))) << 40)
                | (uint256(uint16(int16(z))) << 24) | color;
            uint256 target = m.vertices;
            assembly ("memory-safe") {
                mstore(target, shl(184, packed))
            }
            m.vertices = target + VERTEX_SIZE;
            m.vertexCount = index + 1;
        }
    }

    /// @notice Adds a face of three vertices, counter-clockwise as seen from the front.
    function face(Model memory m, uint256 a, uint256 b, uint256 c) internal pure {
        unchecked {
            uint256 count = m.vertexCount;
            if (a >= count || b >= count || c >= count) revert NoSuchVertex(a >= count ? a : b >= count ? b : c, count);
            if (m.faceCount == m.maxFaces) {
                if (m.faceCount == MOST) revert TooManyFaces(MOST);
                grow(m);
            }
            uint256 target = m.faces;
            assembly ("memory-safe") {
                mstore(target, shl(208, or(or(shl(32, a), shl(16, b)), c)))
            }
            m.faces = target + FACE_SIZE;
            ++m.faceCount;
        }
    }

    /// @notice Adds two faces: a, b, c, d counter-clockwise as seen from the front.
    function quad(Model memory m, uint256 a, uint256 b, uint256 c, uint256 d) internal pure {
        face(m, a, b, c);
        face(m, a, c, d);
    }

    /// @notice Returns the packed mesh without normals, for unlit and flat materials. It does not change if more is added to the model
    /// afterwards; without changes, each call returns the same bytes.
    function pack(Model memory m) internal pure returns (bytes memory mesh) {
        unchecked {
            uint256 vertexSize = VERTEX_SIZE * m.vertexCount;
            uint256 faceSize = FACE_SIZE * m.faceCount;
            uint256 end = m.vertices;
            uint256 first = m.faces - faceSize;
            uint256 header = (m.vertexCount << 16) | m.faceCount;
            copyWords(end, first, faceSize);
            assembly ("memory-safe") {
                let begin := sub(end, vertexSize)
                mesh := sub(begin, 37)
                // the word that ends where the vertices begin holds the header, after bytes that are zero
                mstore(mesh, add(HEADER_SIZE, add(vertexSize, faceSize)))
                mstore(sub(begin, 5), or(shl(216, header), shr(40, mload(begin))))
                // clear the bytes of the last word beyond the faces
                mstore(add(end, faceSize), 0)
            }
            // the faces have moved; no capacity is left, so that the next addition allocates
            m.faces = end + faceSize;
            (m.maxVertices, m.maxFaces) = (m.vertexCount, m.faceCount);
        }
    }

    /// @notice Returns the packed mesh with a normal per vertex, for smooth materials: the mean of the normals of its faces, weighted by
    /// their areas, or zero without faces. Faces that share vertices look smooth; an edge is sharp if its faces do not share vertices.
    function packSmooth(Model memory m) internal pure returns (bytes memory mesh) {
        unchecked {
            uint256[] memory sums = sumsOfNormals(m);
            uint256 count = m.vertexCount;
            uint256 faceSize = FACE_SIZE * m.faceCount;
            uint256 source = m.vertices - VERTEX_SIZE * count;
            uint256 size = HEADER_SIZE + (VERTEX_SIZE + 4) * count + faceSize;
            // one extra word, because whole words are written
            mesh = new bytes(size + 32);
            uint256 target;
            uint256 header = (NORMALS << 32) | (count << 16) | m.faceCount;
            assembly ("memory-safe") {
                mstore(mesh, size)
                target := add(mesh, 32)
                mstore(target, shl(216, header))
                target := add(target, HEADER_SIZE)
            }
            for (uint256 k; k != count; ++k) {
                uint256 normal = unitNormal(sums[k]);
                assembly ("memory-safe") {
                    // the vertex has 72 bits, the normal 32
                    mstore(target, shl(152, or(shl(32, shr(184, mload(source))), normal)))
                }
                source += VERTEX_SIZE;
                target += VERTEX_SIZE + 4;
            }
            copyWords(target, m.faces - faceSize, faceSize);
            assembly ("memory-safe") {
                mstore(add(target, faceSize), 0)
            }
        }
    }

    /// @dev Returns for each vertex the sum of the normals of its faces, each with twice the face's area as length, packed as
    /// x * 2^170 + y * 2^85 + z. Such words can be added.
    function sumsOfNormals(Model memory m) private pure returns (uint256[] memory sums) {
        unchecked {
            sums = new uint256[](m.vertexCount);
            uint256 begin = m.vertices - VERTEX_SIZE * m.vertexCount;
            uint256 end = m.faces;
            uint256 place = end - FACE_SIZE * m.faceCount;
            assembly ("memory-safe") {
                // (b - a) x (c - a) of three vertices
                function normal(a, b, c) -> word {
                    let x := sar(240, a)
                    let y := sar(240, shl(16, a))
                    let z := sar(240, shl(32, a))
                    let bx := sub(sar(240, b), x)
                    let by := sub(sar(240, shl(16, b)), y)
                    let bz := sub(sar(240, shl(32, b)), z)
                    x := sub(sar(240, c), x)
                    y := sub(sar(240, shl(16, c)), y)
                    z := sub(sar(240, shl(32, c)), z)
                    word := shl(170, sub(mul(by, z), mul(bz, y)))
                    word := add(word, shl(85, sub(mul(bz, x), mul(bx, z))))
                    word := add(word, sub(mul(bx, y), mul(by, x)))
                }

                for {} lt(place, end) { place := add(place, 6) } {
                    let corners := mload(place)
                    let a := shr(240, corners)
                    let b := and(shr(224, corners), 0xffff)
                    let c := and(shr(208, corners), 0xffff)
                    let word := normal(mload(add(begin, mul(9, a))), mload(add(begin, mul(9, b))), mload(add(begin, mul(9, c))))
                    a := add(sums, add(32, shl(5, a)))
                    mstore(a, add(mload(a), word))
                    b := add(sums, add(32, shl(5, b)))
                    mstore(b, add(mload(b), word))
                    c := add(sums, add(32, shl(5, c)))
                    mstore(c, add(mload(c), word))
                }
            }
        }
    }

    /// @dev Returns the direction of a sum in the encoding of `Mesh.sol`: three numbers of 10 bits, then two zero bits.
    function unitNormal(uint256 sum) private pure returns (uint256) {
        unchecked {
            int256 rest = int256(sum);
            int256 z = (rest << 256 - LANE) >> 256 - LANE;
            rest = (rest - z) >> LANE;
            int256 y = (rest << 256 - LANE) >> 256 - LANE;
            int256 x = (rest - y) >> LANE;
            // 20 more bits of precision, for short vectors
            uint256 length = sqrt(uint256(x * x + y * y + z * z) << 40);
            if (length == 0) return 0;
            // 511 / length, Q128, without the 20 extra bits
            int256 unit = int256((NORMAL_UNIT << 148) / length);
            return part(x * unit) << 22 | part(y * unit) << 12 | part(z * unit) << 2;
        }
    }

    /// @dev Rounds a Q128 number to the nearest integer, in 10 bits.
    function part(int256 value) private pure returns (uint256) {
        unchecked {
            return uint256((value + (1 << 127)) >> 128) & 0x3ff;
        }
    }

    /// @dev Doubles the capacity for vertices or faces, whichever is used up.
    function grow(Model memory m) private pure {
        unchecked {
            uint256 vertexSize = VERTEX_SIZE * m.vertexCount;
            uint256 faceSize = FACE_SIZE * m.faceCount;
            (uint256 vertices, uint256 faces) = (m.vertices - vertexSize, m.faces - faceSize);
            setRoom(m, more(m.vertexCount, m.maxVertices), more(m.faceCount, m.maxFaces));
            copyWords(m.vertices, vertices, vertexSize);
            copyWords(m.faces, faces, faceSize);
            m.vertices += vertexSize;
            m.faces += faceSize;
        }
    }

    function more(uint256 count, uint256 room) private pure returns (uint256) {
        unchecked {
            if (count < room) return room;
            return room > MOST / 2 - 16 ? MOST : 2 * room + 16;
        }
    }

    /// @dev Allocates memory, and sets the addresses of the first vertex and the first face in it.
    function setRoom(Model memory m, uint256 maxVertices, uint256 maxFaces) private pure {
        (m.maxVertices, m.maxFaces) = (maxVertices, maxFaces);
        assembly ("memory-safe") {
            // the length and the header, the vertices, and a word that may be written past their end; the same for the faces
            let begin := add(mload(0x40), 37)
            let faces := add(begin, add(mul(maxVertices, VERTEX_SIZE), 32))
            mstore(m, begin)
            mstore(add(m, 0x20), faces)
            mstore(0x40, and(add(add(faces, mul(maxFaces, FACE_SIZE)), 63), not(31)))
        }
    }

    /// @dev Copies bytes, and up to 31 bytes past their end. Overlapping ranges must move to lower addresses.
    function copyWords(uint256 target, uint256 source, uint256 size) private pure {
        assembly ("memory-safe") {
            for { let k := 0 } lt(k, size) { k := add(k, 32) } { mstore(add(target, k), mload(add(source, k))) }
        }
    }
}
