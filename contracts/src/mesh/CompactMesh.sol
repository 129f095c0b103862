// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {NORMALS, WIDE} from "../scene/Mesh.sol";
import {LAST_FORMAT, number} from "./Kinds.sol";
import {MeshErrors} from "../interfaces/MeshErrors.sol";

// A mesh in at most half the bytes of the format of `Mesh.sol`, all numbers big-endian:
//
//   kind      1 byte     COMPACT
//   format    1 byte     as in `Mesh.sol`
//   n, m, e   3 x 2      numbers of vertices, of faces, of bytes of explicit vertex references
//   widths    3 x 1      bits of x, y, z: at most those of a coordinate
//   base      3 x 3      the offsets of x, y, z. The stored coordinates are unsigned: half of their range is added
//   palette   2 bytes    the number of its colours; 0: each vertex has its colour in 24 bits
//   colour    1 byte     bits of a colour or of its palette index, at most 24
//   normal    1 byte     bits of each coordinate of a normal, at most 10; 0 if there are none
//   palette              3 bytes for each colour
//   faces     m bytes    see below
//   explicit  e bytes    the explicit vertex references
//   vertices             n times x, y, z, colour, normal, with the given bits, without gaps; padded with zeros to a whole byte
//
// Vertices are numbered in the order in which the faces first use them. A face (a, b, c) adds two edges for the following faces: (b, a),
// and then (c, b), the latest. The upper half of a face's byte selects an edge (p, q), 0 being the latest, and its lower half selects the
// vertex v that completes the face (q, v, p): 0 is the next new vertex; 1 to 14 is one of the vertices that were most recently new or
// explicitly referenced, 1 being the latest; 15 is an explicit reference: one byte, its distance behind the newest vertex, or 255 followed
// by its index in two bytes. If the upper half is 15, the face uses no edge, and the three lowest bits tell for each corner whether it is
// an explicit reference (1) or new (0), the first corner in the lowest bit.

/// @notice Expands compact meshes to the format of `Mesh.sol`.
library CompactMesh {
    uint256 private constant HEADER = 24;

    /// @dev The properties that all vertices share.
    /// @param stream The position of their bits.
    /// @param bits The bits of a vertex.
    /// @param maskX The mask of x, in the lowest bits.
    /// @param maskY The mask of y.
    /// @param maskZ The mask of z.
    /// @param maskColor The mask of the colour.
    /// @param maskNormal The mask of a coordinate of the normal.
    /// @param base The sum of the offsets of all coordinates, at their places.
    /// @param top The uppermost bits of all coordinates, and the colour if there is only one.
    /// @param palette The position of the palette if it has several colours; otherwise 0.
    /// @param normalHalf The replacement for the omitted lower bits of normals.
    /// @param stride The size of a vertex in the result, in bytes.
    /// @param shifts See `open`.
    struct Plan {
        uint256 stream;
        uint256 bits;
        uint256 maskX;
        uint256 maskY;
        uint256 maskZ;
        uint256 maskColor;
        uint256 maskNormal;
        uint256 base;
        uint256 top;
        uint256 palette;
        uint256 normalHalf;
        uint256 stride;
        uint256 shifts;
    }

    /// @notice Returns the mesh in the format of `Mesh.sol`. The renderer checks the vertex indices.
    function expand(bytes memory data) internal pure returns (bytes memory mesh) {
        unchecked {
            if (data.length < HEADER) revert MeshErrors.CompactMeshLength(HEADER, data.length);
            Plan memory plan;
            (uint256 n, uint256 m, uint256 e) = (number(data, 2, 2), number(data, 4, 2), number(data, 6, 2));
            uint256 colors = number(data, 20, 2);
            uint256 format = number(data, 1, 1);
            open(plan, data, format, colors);
            uint256 codes = HEADER + 3 * colors;
            uint256 expected = codes + m + e + (n * plan.bits + 7) / 8;
            if (data.length != expected) revert MeshErrors.CompactMeshLength(expected, data.length);
            uint256 target;
            assembly ("memory-safe") {
                let begin := add(data, 32)
                mstore(plan, add(begin, add(codes, add(m, e))))
                switch colors
                case 0 {}
                case 1 { mstore(add(plan, 0x100), or(mload(add(plan, 0x100)), shr(232, mload(add(begin, HEADER))))) }
                default { mstore(add(plan, 0x120), add(begin, HEADER)) }
                codes := add(begin, codes)
                mesh := mload(0x40)
                target := add(mesh, 37)
                mstore(add(mesh, 32), shl(216, or(shl(32, format), or(shl(16, n), m))))
            }
            target = readVertices(plan, target, n);
            target = readFaces(codes, m, e, target, n);
            assembly ("memory-safe") {
                mstore(mesh, sub(target, add(mesh, 32)))
                mstore(target, 0)
                mstore(0x40, and(add(target, 63), not(31)))
            }
        }
    }

    function open(Plan memory plan, bytes memory data, uint256 format, uint256 colors) private pure {
        unchecked {
            uint256 lane = format & WIDE == 0 ? 16 : 24;
            (uint256 x, uint256 y, uint256 z) = (number(data, 8, 1), number(data, 9, 1), number(data, 10, 1));
            uint256 color = number(data, 22, 1);
            uint256 normal = number(data, 23, 1);
            bool known = format <= LAST_FORMAT && x <= lane && y <= lane && z <= lane && color <= 24 && normal <= 10
                && (normal == 0) == (format & NORMALS == 0) && (colors == 0 || 1 << color < 2 * colors);
            if (!known) revert MeshErrors.CompactMeshHeader();
            plan.bits = x + y + z + color + 3 * normal;
            (plan.maskX, plan.maskY, plan.maskZ) = ((1 << x) - 1, (1 << y) - 1, (1 << z) - 1);
            (plan.maskColor, plan.maskNormal) = ((1 << color) - 1, (1 << normal) - 1);
            plan.base = (number(data, 11, 3) << (2 * lane)) + (number(data, 14, 3) << lane) + number(data, 17, 3);
            plan.top = ((1 << (2 * lane)) | (1 << lane) | 1) << (lane + 23);
            plan.stride = 3 * lane / 8 + (normal == 0 ? 3 : 7);
            if (normal != 0 && normal < 10) plan.normalHalf = uint256(0x00401004) << (9 - normal);
            // one byte each, from the lowest: the distances of x, y, z and colour from the last bit of the vertex; the left shifts of x and
            // y in the result, and of the vertex in its word
            plan.shifts = (y + z + color + 3 * normal) | ((z + color + 3 * normal) << 8) | ((color + 3 * normal) << 16)
                | ((3 * normal) << 24) | ((2 * lane) << 32) | (lane << 40) | ((256 - 8 * plan.stride) << 48) | (normal << 56)
                | ((10 - normal) << 64);
        }
    }

    function readVertices(Plan memory plan, uint256 target, uint256 n) private pure returns (uint256) {
        assembly ("memory-safe") {
            let shifts := mload(add(plan, 0x180))
            let stride := mload(add(plan, 0x160))
            let end := add(target, mul(n, stride))
            let base := mload(add(plan, 0xe0))
            let top := mload(add(plan, 0x100))
            let palette := mload(add(plan, 0x120))
            let bits := mload(add(plan, 0x20))
            // the bit position of the end of a vertex in memory, less a word; its low bits are 7 minus the number of bits below the vertex
            // in its last byte
            let place := sub(shl(3, mload(plan)), 249)
            for {} lt(target, end) { target := add(target, stride) } {
                place := add(place, bits)
                let word := shr(and(not(place), 7), mload(shr(3, place)))
                // all three coordinates as one sum
                let vertex := or(
                    or(
                        shl(byte(27, shifts), and(shr(byte(31, shifts), word), mload(add(plan, 0x40)))),
                        shl(byte(26, shifts), and(shr(byte(30, shifts), word), mload(add(plan, 0x60))))
                    ),
                    and(shr(byte(29, shifts), word), mload(add(plan, 0x80)))
                )
                vertex := xor(shl(24, add(vertex, base)), top)
                let color := and(shr(byte(28, shifts), word), mload(add(plan, 0xa0)))
                if palette { color := shr(232, mload(add(palette, mul(3, color)))) }
                vertex := or(vertex, color)
                switch byte(24, shifts)
                case 0 {}
                case 10 { vertex := or(shl(32, vertex), xor(shl(2, and(word, 0x3fffffff)), 0x80200800)) }
                default {
                    // extend to 10 bits, with the middle of the omitted range, and make signed
                    let size := byte(24, shifts)
                    let mask := mload(add(plan, 0xc0))
                    let normal := or(
                        or(shl(22, and(shr(add(size, size), word), mask)), shl(12, and(shr(size, word), mask))), shl(2, and(word, mask))
                    )
                    normal := xor(or(shl(byte(23, shifts), normal), mload(add(plan, 0x140))), 0x80200800)
                    vertex := or(shl(32, vertex), normal)
                }
                mstore(target, shl(byte(25, shifts), vertex))
            }
            target := end
        }
        return target;
    }

    function readFaces(uint256 codes, uint256 m, uint256 e, uint256 target, uint256 n) private pure returns (uint256) {
        bool wrong;
        assembly ("memory-safe") {
            // read an explicit vertex reference
            function read(told, met) -> vertex, next {
                vertex := byte(0, mload(told))
                switch vertex
                case 255 {
                    vertex := shr(240, mload(add(told, 1)))
                    next := add(told, 3)
                }
                default {
                    vertex := and(sub(sub(met, 1), vertex), 0xffff)
                    next := add(told, 1)
                }
            }

            let end := add(codes, m)
            let told := end
            let met := 0
            // the most recent vertices, 16 bits each, the latest in the lowest bits
            let recent := 0
            for {} lt(codes, end) { codes := add(codes, 1) } {
                let code := byte(0, mload(codes))
                if gt(code, 0xef) {
                    let face := 0
                    for { let corner := 0 } lt(corner, 3) { corner := add(corner, 1) } {
                        let vertex := met
                        switch and(code, 1)
                        case 0 { met := add(met, 1) }
                        default { vertex, told := read(told, met) }
                        recent := or(shl(16, recent), vertex)
                        face := or(shl(16, face), vertex)
                        code := shr(1, code)
                    }
                    mstore(target, shl(208, face))
                    target := add(target, 6)
                    continue
                }
                // the two corners (q, p) of the face that added the edge
                let edge := shr(
                    224,
                    mload(sub(target, byte(shr(4, code), 0x04060a0c101216181c1e2224282a2e0000000000000000000000000000000000)))
                )
                code := and(code, 15)
                switch code
                case 0 {
                    code := met
                    recent := or(shl(16, recent), code)
                    met := add(met, 1)
                }
                case 15 {
                    code := byte(0, mload(told))
                    switch code
                    case 255 { code, told := read(told, met) }
                    default {
                        code := and(sub(sub(met, 1), code), 0xffff)
                        told := add(told, 1)
                    }
                    recent := or(shl(16, recent), code)
                }
                default { code := and(shr(shl(4, sub(code, 1)), recent), 0xffff) }
                mstore(target, or(shl(208, or(shl(16, code), and(edge, 0xffff))), shl(224, and(edge, 0xffff0000))))
                target := add(target, 6)
            }
            wrong := or(gt(met, n), iszero(eq(told, add(end, e))))
        }
        if (wrong) revert MeshErrors.CompactMeshFaces();
        return target;
    }
}
