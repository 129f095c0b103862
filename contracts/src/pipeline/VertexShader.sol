// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Fixed} from "../math/Fixed.sol";
import {Vector} from "../math/Vector.sol";
import {Matrix} from "../math/Quaternion.sol";
import {Object} from "../scene/Scene.sol";
import {Mesh} from "../scene/Mesh.sol";
import {View} from "./View.sol";
import "./Registers.sol";

// From mesh to screen. Each vertex becomes a record in memory:
//
//   +0x00  screen word: sub-pixel row in bits 128.., sub-pixel column in bits 64..83, flags in bits 40..41, address of the record
//   +0x20  attribute word: depth in bits 168.., red at 112, green at 56, blue at 0 (Q10)
//   +0x40  smooth shading: normal in camera space, signed lanes of Q20 at bits 0, 85 and 170
//          flat shading with highlights: length of the ray, Q24, and from +0x60 on a denominator for each light
//   +0x60  smooth shading with one light: what FragmentShader.setVaryings tells, to +0xdf
//
// What flat shading keeps at +0x40 and smooth shading from +0x60 on is filled when it is first needed; zero says that it is not yet. So
// nothing may ever be written beyond the free memory before a record is made there, and no Solidity object be made between
// `freeMemory()` and `setFreeMemory()` in Pipeline.assembleObject. Pipeline.recordShift tells the size.
//
// Comparing screen words as numbers compares rows. The attribute word of a vertex that has to be clipped holds its outcode instead.

/// @dev Bits of a screen word: the triangle must be clipped; the vertex lies left or right of the tile.
uint256 constant MUST_CLIP = 0x10000000000;
uint256 constant IS_OUTSIDE = 0x20000000000;

/// @dev Lanes of the clip coordinates x * distance, y * distance (96 bits each, biased by 2^95) and distance (64 bits), all Q32.
uint256 constant CLIP_BIAS = (1 << 95) | (1 << 191);

library VertexShader {
    /// @notice Combines rotation, scale, position, camera and viewport into one affine map from the mesh to clip coordinates.
    function setMatrix(View memory view_, Object calldata object, Matrix memory rotation) internal pure {
        Fixed scale = object.scale;
        store(MATRIX_X, clipLanes(view_, view_.toCamera(rotation.x).scale(scale), 0));
        store(MATRIX_Y, clipLanes(view_, view_.toCamera(rotation.y).scale(scale), 0));
        store(MATRIX_Z, clipLanes(view_, view_.toCamera(rotation.z).scale(scale), 0));
        Vector memory position = object.position;
        unchecked {
            store(MATRIX_T, clipLanes(view_, view_.toCamera(position.sub(view_.eye)), 1 << 32) + CLIP_BIAS);
        }
    }

    /// @dev One column of the map. `w` is the last coordinate of the column, Q32: 1 for the translation.
    function clipLanes(View memory view_, Vector memory v, int256 w) private pure returns (uint256) {
        unchecked {
            if (!view_.orthographic) w = v.z.raw();
            int256 x = ((view_.focal * v.x.raw()) >> 32) + ((view_.centerX * w) >> 1);
            int256 y = ((view_.focal * v.y.raw()) >> 32) + ((view_.centerY * w) >> 1);
            return uint256(x) + (uint256(y) << 96) + (uint256(v.z.raw()) << 192);
        }
    }

    /// @notice The rotation of normals into camera space, divided by the 511 of the mesh format.
    function setNormalMatrix(View memory view_, Matrix memory rotation) internal pure {
        store(NORMAL_X, normalLanes(view_.toCamera(rotation.x)));
        store(NORMAL_Y, normalLanes(view_.toCamera(rotation.y)));
        store(NORMAL_Z, normalLanes(view_.toCamera(rotation.z)));
    }

    function normalLanes(Vector memory v) private pure returns (uint256) {
        unchecked {
            return uint256(v.x.raw() / (4096 * 511)) + (uint256(v.y.raw() / (4096 * 511)) << 85) + (uint256(v.z.raw() / (4096 * 511)) << 170);
        }
    }

    /// @notice Writes the records of all vertices of a mesh, from `record` on.
    function run(Mesh memory mesh, uint256 record, uint256 recordSize, bool smooth) internal pure {
        unchecked {
            project(mesh.vertices, record, record + mesh.vertexCount * recordSize, mesh.bits, mesh.stride, recordSize);
            if (smooth) turnNormals(mesh, record, recordSize);
        }
    }

    function project(uint256 vertex, uint256 record, uint256 end, uint256 bits, uint256 stride, uint256 recordSize) private pure {
        assembly ("memory-safe") {
            for {} lt(record, end) {} {
                let data := calldataload(vertex)
                let rest := sub(256, bits)
                // clip = x * MATRIX_X + y * MATRIX_Y + z * MATRIX_Z + MATRIX_T
                let clip := add(mul(sar(rest, data), mload(MATRIX_X)), mload(MATRIX_T))
                data := shl(bits, data)
                clip := add(clip, mul(sar(rest, data), mload(MATRIX_Y)))
                data := shl(bits, data)
                clip := add(clip, mul(sar(rest, data), mload(MATRIX_Z)))
                data := shr(232, shl(bits, data))
                let distance := sar(192, clip)
                let divisor := distance
                let depth := div(mload(DEPTH_SCALE), distance)
                if mload(FRAME_IS_ORTHOGRAPHIC) {
                    divisor := 0x100000000
                    depth := sub(mload(DEPTH_SCALE), sar(8, distance))
                }
                let x := div(sub(and(clip, 0xffffffffffffffffffffffff), 0x800000000000000000000000), divisor)
                let y := div(sub(and(shr(96, clip), 0xffffffffffffffffffffffff), 0x800000000000000000000000), divisor)
                // colour bytes spread to their lanes, times 2^10
                mstore(add(record, 32), or(shl(168, depth), and(mul(data, 0x400000000000400000000000400), 0x3fc000000000003fc000000000003fc00)))
                mstore(record, or(or(or(shl(128, y), shl(64, x)), record), shl(41, gt(sub(x, mload(TILE_LEFT)), mload(TILE_SPAN)))))
                if or(slt(distance, mload(NEAR)), shr(20, or(x, y))) {
                    // outcode: nearer than the near plane, left, right, above, below the guard band
                    x := sub(and(clip, 0xffffffffffffffffffffffff), 0x800000000000000000000000)
                    y := sub(and(shr(96, clip), 0xffffffffffffffffffffffff), 0x800000000000000000000000)
                    divisor := shl(20, divisor)
                    mstore(add(record, 32), or(or(slt(distance, mload(NEAR)), or(shl(1, slt(x, 0)), shl(2, iszero(slt(x, divisor))))), or(shl(3, slt(y, 0)), shl(4, iszero(slt(y, divisor))))))
                    mstore(record, or(0x10000000000, record))
                }
                record := add(record, recordSize)
                vertex := add(vertex, stride)
            }
        }
    }

    /// @notice The clip coordinates and the colour of a vertex, as `project` computes them, in the first four words of `corner`.
    function clipCoordinates(Mesh memory mesh, uint256 index, uint256 corner) internal pure {
        uint256 vertex = mesh.vertices;
        uint256 bits = mesh.bits;
        uint256 stride = mesh.stride;
        assembly ("memory-safe") {
            let data := calldataload(add(vertex, mul(index, stride)))
            let rest := sub(256, bits)
            let clip := add(mul(sar(rest, data), mload(MATRIX_X)), mload(MATRIX_T))
            data := shl(bits, data)
            clip := add(clip, mul(sar(rest, data), mload(MATRIX_Y)))
            data := shl(bits, data)
            clip := add(clip, mul(sar(rest, data), mload(MATRIX_Z)))
            data := shr(232, shl(bits, data))
            mstore(corner, sub(and(clip, 0xffffffffffffffffffffffff), 0x800000000000000000000000))
            mstore(add(corner, 32), sub(and(shr(96, clip), 0xffffffffffffffffffffffff), 0x800000000000000000000000))
            mstore(add(corner, 64), sar(192, clip))
            mstore(add(corner, 96), and(mul(data, 0x400000000000400000000000400), 0x3fc000000000003fc000000000003fc00))
        }
    }

    /// @notice The first word of a record.
    function screenWord(uint256 x, uint256 y, uint256 record) internal pure returns (uint256 word) {
        assembly ("memory-safe") {
            word := or(or(or(shl(128, y), shl(64, x)), record), shl(41, gt(sub(x, mload(TILE_LEFT)), mload(TILE_SPAN))))
        }
    }

    function turnNormals(Mesh memory mesh, uint256 record, uint256 recordSize) private pure {
        unchecked {
            uint256 end = record + mesh.vertexCount * recordSize;
            uint256 normal = mesh.vertices + 3 * mesh.bits / 8 + 3;
            uint256 stride = mesh.stride;
            assembly ("memory-safe") {
                for {} lt(record, end) {} {
                    let data := calldataload(normal)
                    let n := mul(sar(246, data), mload(NORMAL_X))
                    n := add(n, mul(sar(246, shl(10, data)), mload(NORMAL_Y)))
                    n := add(n, mul(sar(246, shl(20, data)), mload(NORMAL_Z)))
                    mstore(add(record, 0x40), n)
                    record := add(record, recordSize)
                    normal := add(normal, stride)
                }
            }
        }
    }
}
