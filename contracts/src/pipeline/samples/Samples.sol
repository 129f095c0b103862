// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {FragmentLight} from "../shading/FragmentLight.sol";
import "../../words/SampleRegisters.sol";

// Fragments of four samples: see SampleRasterizer. Each lane of a pixel contains a depth and a colour; a nearer fragment replaces both. If
// all four samples have one colour, it is written to the picture immediately. Other pixels are listed, and their means are written at the
// end.
//
// Linear and quadratic colours are those of the pixel centre, as in OpenGL, even if the triangle covers only samples beside it. Values that
// are computed per fragment, and would be unbounded outside the triangle, are evaluated at the centroid of the covered samples (`centroid`
// in OpenGL).

library Samples {
    /// @dev Returns the highest bits of the samples of a pixel that lie between two sides.
    /// @param p The address of the pixel's samples.
    function coverage(uint256 left, uint256 right, uint256 p) internal pure returns (uint256 lanes) {
        assembly ("memory-safe") {
            lanes := mul(p, ADDRESS_64)
            lanes := and(and(add(left, lanes), sub(right, lanes)), TOPS_64)
        }
    }

    /// @dev Returns the centroid of the covered samples, relative to the centre of the pixel, in eighths of a pixel.
    function centroid(uint256 lanes) internal pure returns (uint256 x, uint256 y) {
        assembly ("memory-safe") {
            lanes := and(shr(SET_AT, mul(shr(63, lanes), COVERED_TO_SET)), SET_MASK)
            x := signextend(0, shr(add(8, lanes), CENTROIDS))
            y := signextend(0, shr(lanes, CENTROIDS))
        }
    }

    /// @dev Returns the accumulator at an offset in eighths of a pixel.
    function moved(uint256 attribute, uint256 x, uint256 y) internal pure returns (uint256 there) {
        assembly ("memory-safe") {
            there := add(attribute, add(mul(x, mload(DX_8)), mul(y, mload(DY_8))))
            if and(mload(MODE), IS_DEEP) {
                x := add(mul(x, mload(DEEP_DX)), mul(y, mload(DEEP_DY)))
                there := add(there, shl(ATTRIBUTE_DEPTH_AT, sar(3, x)))
            }
        }
    }

    /// @dev Returns the depths of the four samples.
    function depthsOf(uint256 attribute) internal pure returns (uint256 z) {
        assembly ("memory-safe") {
            z := mul(shr(ACCUMULATOR_DEPTH_AT, attribute), mload(SAMPLE_SCALE))
            z := and(add(z, mload(DEPTH_OFFSETS)), SAMPLE_DEPTHS)
        }
    }

    /// @dev Converts a colour from signed lanes of 85 bits, Q10, to three bytes, blue uppermost.
    function bytesOf(uint256 color) internal pure returns (uint256 pixel) {
        unchecked {
            color += HALF_85_Q10;
            if (color & BEYOND_BYTE_85 != 0) color = FragmentLight.clamped(color);
        }
        assembly ("memory-safe") {
            pixel := or(shl(16, and(shr(BLUE_Q10_AT, color), 0xff)), shl(8, and(shr(GREEN_Q10_AT, color), 0xff)))
            pixel := or(pixel, and(shr(RED_Q10_AT, color), 0xff))
        }
    }

    /// @dev Writes all samples of a pixel, and the pixel of the picture.
    /// @param p The address of the pixel's samples.
    /// @param z The depths of the samples.
    function paint(uint256 p, uint256 row, uint256 column, uint256 z, uint256 color) internal pure {
        assembly ("memory-safe") {
            mstore(p, or(z, mul(color, ONES_64)))
            mstore(0, shl(PIXEL_AT, color))
            mcopy(add(mload(SAMPLE_IMAGE), mul(3, sub(column, mul(row, mload(TILE_WIDTH))))), 0, 3)
        }
    }

    /// @dev Writes samples of a pixel.
    /// @param p The address of the pixel's samples.
    /// @param z The new samples; only those whose highest bit is set in `seen` are written.
    function write(uint256 p, uint256 row, uint256 column, uint256 z, uint256 seen) internal pure {
        assembly ("memory-safe") {
            let old := mload(p)
            z := xor(old, and(xor(old, z), sub(shl(1, seen), shr(63, seen))))
            z := or(z, IS_LISTED)
            if iszero(and(old, IS_LISTED)) {
                let pixel := add(mload(SAMPLE_IMAGE), mul(3, sub(column, mul(row, mload(TILE_WIDTH)))))
                mstore(mload(MIXED_END), or(shl(MIXED_AT, p), shl(MIXED_PIXEL_AT, pixel)))
                mstore(MIXED_END, add(mload(MIXED_END), MIXED_SIZE))
            }
            mstore(p, z)
        }
    }

    /// @dev Returns the address of a pixel's samples.
    function place(uint256 row, uint256 column) internal pure returns (uint256 p) {
        assembly ("memory-safe") {
            p := add(sub(mload(SAMPLE_ORIGIN), mul(row, mload(SAMPLE_STRIDE))), shl(SAMPLE_SIZE_BITS, column))
        }
    }
}
