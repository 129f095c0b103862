// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Mesh} from "../../scene/Mesh.sol";
import "../../words/Registers.sol";

// Computes `Camera.project` and `Camera.nearness` of picture.py.
// Transforms vertices from the mesh to the screen. Each vertex becomes a record in memory:
//
//   +0x00  screen word: sub-pixel row and column, flags, address of the record
//   +0x20  attribute word: depth and colours
//   +0x40  smooth shading: normal in camera space, signed lanes of Q20 at bits 0, 85 and 170
//          flat shading with highlights: half vector in mesh space and its square, for each light: see VertexHighlights
//   +0x60  smooth shading with one light: the words of SmoothVertex, to +0xff; with two, another record for the second one follows
//
// The words at +0x40 for flat shading, and from +0x60 on for smooth shading, are filled on first use; zero means not yet. Therefore nothing
// may be written beyond the free memory before a record is made there, and no Solidity object may be allocated between `freeMemory()` and
// `setFreeMemory()` in Pipeline.assembleObject. Pipeline.recordShift returns the size.
//
// If both sides of a smooth surface are lit, records with the opposite normals follow: faces that are turned away have these vertices.
//
// Words.sol defines the layout of the words. Comparing screen words as numbers compares rows. The attribute word of a vertex that must be
// clipped contains its outcode instead.

library VertexShader {
    /// @notice Writes the records of all vertices of a mesh, from `record` on.
    function run(Mesh memory mesh, uint256 record, uint256 recordSize, bool smooth) internal pure {
        unchecked {
            project(mesh.vertices, record, record + mesh.vertexCount * recordSize, mesh.bits, mesh.stride, recordSize);
            if (smooth) turnNormals(mesh, record, recordSize);
        }
    }

    /// @notice Adds a record with the opposite normal for each vertex, in the same order, from `end` on: of smooth surfaces with two sides.
    /// @return The end of these.
    function addBacks(uint256 records, uint256 end, uint256 recordSize) internal pure returns (uint256) {
        unchecked {
            uint256 offset = end - records;
            for (; records != end; records += recordSize) {
                store(records + offset, load(records) + offset);
                store(records + offset + VERTEX_ATTRIBUTES, load(records + VERTEX_ATTRIBUTES));
                store(records + offset + VERTEX_NORMAL, 0 - load(records + VERTEX_NORMAL));
            }
            return end + offset;
        }
    }

    function project(uint256 vertex, uint256 record, uint256 end, uint256 bits, uint256 stride, uint256 recordSize) private pure {
        unchecked {
            uint256 rest = 256 - bits;
            while (record < end) {
                uint256 clip;
                uint256 isPlain;
                assembly ("memory-safe") {
                    let data := calldataload(vertex)
                    // clip = x * MATRIX_X + y * MATRIX_Y + z * MATRIX_Z + MATRIX_T
                    clip := add(mul(sar(rest, data), mload(MATRIX_X)), mload(MATRIX_T)) // x * X + T, three lanes
                    data := shl(bits, data) // the next coordinate
                    clip := add(clip, mul(sar(rest, data), mload(MATRIX_Y))) // + y * Y
                    data := shl(bits, data) // the next coordinate
                    clip := add(clip, mul(sar(rest, data), mload(MATRIX_Z))) // + z * Z
                    data := shr(MESH_COLOR_AT, shl(bits, data)) // from here on the colour, 0xRRGGBB
                    let divisor := sar(CLIP_W_AT, clip) // distance, Q32
                    isPlain := slt(divisor, mload(NEAR)) // the opposite, until its last assignment
                    let depth := div(mload(DEPTH_SCALE), divisor) // scale / distance
                    if mload(FRAME_IS_ORTHOGRAPHIC) {
                        depth := sub(mload(DEPTH_SCALE), sar(Q32_TO_Q24, divisor)) // scale - distance
                        divisor := ONE_32
                    }
                    // spread colour bytes to their lanes, times 2^10
                    mstore(add(record, VERTEX_ATTRIBUTES), or(shl(ATTRIBUTE_DEPTH_AT, depth), and(mul(data, COLOR_SPREAD), BYTES_Q10)))
                    // a negative lane, which has borrowed from the one above, yields a value far beyond the guard band
                    let x := div(and(clip, CLIP_X_MASK), divisor) // column * distance / distance, sub-pixels
                    let y := div(and(shr(CLIP_Y_AT, clip), CLIP_Y_MASK), divisor) // row * distance / distance
                    mstore(record, or(or(shl(SCREEN_ROW_AT, y), shl(SCREEN_COLUMN_AT, x)), record))
                    isPlain := iszero(or(
                        or(isPlain, gt(sub(x, mload(TILE_LEFT)), mload(TILE_SPAN))), // x < left or x > right
                        gt(sub(y, mload(TILE_TOP)), mload(TILE_ROWS)) // y < top or y > bottom
                    ))
                }
                if (isPlain == 0) setFlags(record, clip);
                record += recordSize;
                vertex += stride;
            }
        }
    }

    /// @dev Sets the flags of a vertex that lies outside the tile or nearer than the near plane; and the outcode of a vertex that must be
    /// clipped: nearer than the near plane; left of, right of, above, below the guard band.
    function setFlags(uint256 record, uint256 clip) private pure {
        unchecked {
            clip += CLIP_BIAS;
            int256 distance = int256(clip) >> CLIP_W_AT;
            int256 x = int256(clip & CLIP_X_MASK) - int256(CLIP_HALF);
            int256 y = int256((clip >> CLIP_Y_AT) & CLIP_Y_MASK) - int256(CLIP_HALF);
            int256 divisor = load(FRAME_IS_ORTHOGRAPHIC) == 0 ? distance : int256(ONE_32);
            uint256 outcode = distance < loadSigned(NEAR) ? 1 : 0;
            if (x < 0) outcode |= 2;
            if (x >= divisor << GUARD_BITS) outcode |= 4;
            if (y < 0) outcode |= 8;
            if (y >= divisor << GUARD_BITS) outcode |= 16;
            if (outcode == 0) {
                store(record, screenWord(uint256(x / divisor), uint256(y / divisor), record));
            } else {
                store(HAS_CLIPPED, 1);
                store(record + VERTEX_ATTRIBUTES, outcode);
                store(record, MUST_CLIP | record);
            }
        }
    }

    /// @notice Computes the clip coordinates and the colour of a vertex as `project` does, in the first four words of `corner`.
    function clipCoordinates(uint256 index, uint256 corner) internal pure {
        uint256 bits = load(MESH_BITS);
        assembly ("memory-safe") {
            let data := calldataload(add(mload(MESH_VERTICES), mul(index, mload(MESH_STRIDE))))
            let rest := sub(256, bits)
            let clip := add(mul(sar(rest, data), mload(MATRIX_X)), add(mload(MATRIX_T), CLIP_BIAS)) // as in project
            data := shl(bits, data) // the next coordinate
            clip := add(clip, mul(sar(rest, data), mload(MATRIX_Y))) // + y * Y
            data := shl(bits, data) // the next coordinate
            clip := add(clip, mul(sar(rest, data), mload(MATRIX_Z))) // + z * Z
            data := shr(MESH_COLOR_AT, shl(bits, data)) // from here on the colour, 0xRRGGBB
            mstore(corner, sub(and(clip, CLIP_X_MASK), CLIP_HALF)) // x without the bias
            mstore(add(corner, CORNER_Y), sub(and(shr(CLIP_Y_AT, clip), CLIP_Y_MASK), CLIP_HALF)) // y
            mstore(add(corner, CORNER_W), sar(CLIP_W_AT, clip)) // w
            mstore(add(corner, CORNER_COLOR), and(mul(data, COLOR_SPREAD), BYTES_Q10)) // lanes of Q10
        }
    }

    /// @notice Returns the first word of a record.
    function screenWord(uint256 x, uint256 y, uint256 record) internal pure returns (uint256 word) {
        unchecked {
            word = (y << SCREEN_ROW_AT) | (x << SCREEN_COLUMN_AT) | record;
            (uint256 left, uint256 top) = (load(TILE_LEFT), load(TILE_TOP));
            if (x < left) word |= IS_LEFT;
            if (x > left + load(TILE_SPAN)) word |= IS_RIGHT;
            if (y < top) word |= IS_ABOVE;
            if (y > top + load(TILE_ROWS)) word |= IS_BELOW;
        }
    }

    function turnNormals(Mesh memory mesh, uint256 record, uint256 recordSize) private pure {
        unchecked {
            uint256 end = record + mesh.vertexCount * recordSize;
            uint256 normal = mesh.vertices + 3 * mesh.bits / 8 + 3;
            uint256 stride = mesh.stride;
            assembly ("memory-safe") {
                for {} lt(record, end) {} {
                    let data := calldataload(normal) // three components at the top
                    let n := mul(sar(MESH_NORMAL_AT, data), mload(NORMAL_X)) // x * X, three lanes
                    n := add(n, mul(sar(MESH_NORMAL_AT, shl(MESH_NORMAL_Y, data)), mload(NORMAL_Y))) // + y * Y
                    n := add(n, mul(sar(MESH_NORMAL_AT, shl(MESH_NORMAL_Z, data)), mload(NORMAL_Z))) // + z * Z
                    mstore(add(record, VERTEX_NORMAL), n)
                    record := add(record, recordSize)
                    normal := add(normal, stride)
                }
            }
        }
    }
}
