// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Mesh} from "../scene/Mesh.sol";
import "../words/Registers.sol";

// Computes the range of `Camera.nearness` of picture.py in a scene.
// A sample has 36 bits for its depth, which are fitted to the depths of the scene: these are shifted so that the nearest vertex has the
// highest bit or the one below; depths of an orthographic camera, which are differences, are relative to the farthest vertex. All vertices
// of the scene are included, so that tiles match the whole picture.

/// @dev The distance by which depths may leave the range of the vertices; larger than rounding errors.
uint256 constant SLACK = 1 << 20;
/// @dev The bits of a lane that a depth may occupy.
uint256 constant SAMPLE_DEPTH_BITS = 62;
/// @dev Twice the lowest bit of a lane that is kept: every visible depth has it set, at any distance, that of a back face too.
uint256 constant LOWEST_SAMPLE_DEPTH = 1 << 28;

library SampleDepths {
    /// @notice Widens a range of distances, Q32, by those of the vertices of a mesh. The registers must contain the matrix of the object.
    function widen(Mesh memory mesh, int256[2] memory range) internal pure {
        unchecked {
            (uint256 bits, uint256 stride, uint256 vertex) = (mesh.bits, mesh.stride, mesh.vertices);
            uint256 end = vertex + mesh.vertexCount * stride;
            (int256 least, int256 most) = (range[0], range[1]);
            assembly ("memory-safe") {
                let rest := sub(256, bits)
                for {} lt(vertex, end) { vertex := add(vertex, stride) } {
                    // as in VertexShader
                    let data := calldataload(vertex)
                    let clip := add(mul(sar(rest, data), mload(MATRIX_X)), mload(MATRIX_T))
                    data := shl(bits, data)
                    clip := add(clip, mul(sar(rest, data), mload(MATRIX_Y)))
                    clip := add(clip, mul(sar(rest, shl(bits, data)), mload(MATRIX_Z)))
                    clip := sar(CLIP_W_AT, add(clip, CLIP_BIAS))
                    if slt(clip, least) { least := clip }
                    if sgt(clip, most) { most := clip }
                }
            }
            (range[0], range[1]) = (least, most);
        }
    }

    /// @notice Sets the base and scale of sample depths in the calldata of an engine.
    /// @param frame The address of the frame registers in the calldata.
    /// @param range The minimum and maximum distance of a vertex.
    function set(uint256 frame, int256[2] memory range) internal pure {
        unchecked {
            int256 nearest = range[0] > loadSigned(NEAR) ? range[0] : loadSigned(NEAR);
            uint256 base;
            uint256 most;
            if (load(FRAME_IS_ORTHOGRAPHIC) == 0) {
                most = load(DEPTH_SCALE) / uint256(nearest) << DEPTH_FRACTION;
            } else {
                int256 farthest = range[1] > nearest ? range[1] : nearest;
                // a sixteenth more, by part of which back faces may be moved: see Rasterizer.setBack
                most = uint256((farthest >> 8) - (nearest >> 8)) * (17 << (DEPTH_FRACTION - 4));
                base = ((load(DEPTH_SCALE) - uint256(nearest >> 8)) << DEPTH_FRACTION) - most - SLACK;
            }
            most += 2 * SLACK;
            uint256 shift = SAMPLE_DEPTH_BITS;
            while (shift != 0 && most >> (SAMPLE_DEPTH_BITS - shift) != 0) --shift;
            base -= LOWEST_SAMPLE_DEPTH >> shift;
            store(frame + SAMPLE_BASE - FRAME_BEGIN, base);
            store(frame + SAMPLE_SHIFT - FRAME_BEGIN, shift);
            store(frame + SAMPLE_SCALE - FRAME_BEGIN, ONES_64 << shift);
        }
    }
}
