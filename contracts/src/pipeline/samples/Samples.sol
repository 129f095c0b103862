// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {FragmentLight} from "../shading/FragmentLight.sol";
import "../../words/SampleRegisters.sol";

// Computes the depth test of `fill` of picture.py for the samples of a pixel.
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
            lanes := mul(p, ADDRESS_64) // the address in each lane, Q37
            lanes := and(and(add(left, lanes), sub(right, lanes)), TOPS_64) // p >= left side, p < right side
        }
    }

    /// @dev Returns the accumulator and the ray at the centroid of the covered samples.
    function centroid(uint256 attribute, uint256 covered, uint256 column, uint256 row)
        internal pure returns (uint256 there, uint256 rayX, uint256 rayY)
    {
        assembly ("memory-safe") {
            there := attribute
            rayX := add(mload(RAY_LEFT), mul(column, mload(RAY_STEP))) // left + column * step
            rayY := add(mload(RAY_TOP), mul(row, mload(RAY_STEP)))
            if xor(covered, TOPS_64) { // not all samples
                // relative to the centre of the pixel, in eighths of a pixel
                let set := and(shr(SET_AT, mul(shr(TOP_64_AT, covered), COVERED_TO_SET)), SET_MASK) // 16 * the number of the set
                let x := signextend(0, shr(add(8, set), CENTROIDS)) // the upper byte of two, signed
                let y := signextend(0, shr(set, CENTROIDS)) // the lower
                there := add(there, add(mul(x, mload(DX_8)), mul(y, mload(DY_8)))) // + x DX / 8 + y DY / 8
                if and(mload(MODE), IS_DEEP) {
                    let depth := add(mul(x, mload(DEEP_DX)), mul(y, mload(DEEP_DY))) // 8 times the change of the depth
                    there := add(there, shl(ATTRIBUTE_DEPTH_AT, sar(EIGHTH_BITS, depth)))
                }
                rayX := add(rayX, sar(EIGHTH_BITS, mul(x, mload(RAY_STEP)))) // + x step / 8
                rayY := add(rayY, sar(EIGHTH_BITS, mul(y, mload(RAY_STEP)))) // + y step / 8
            }
        }
    }

    /// @dev Returns the depths of the four samples.
    function depthsOf(uint256 attribute) internal pure returns (uint256 z) {
        assembly ("memory-safe") {
            z := mul(shr(ACCUMULATOR_DEPTH_AT, attribute), mload(SAMPLE_SCALE))
            z := and(add(z, mload(DEPTH_OFFSETS)), SAMPLE_DEPTHS) // z_i = z * scale + offset_i
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
    /// @param z The new samples, of one colour.
    function paint(uint256 p, uint256 z) internal pure {
        assembly ("memory-safe") {
            mstore(p, z)
            mstore(0, shl(PIXEL_AT, z)) // the colour of the lowest lane
            mcopy(add(mload(ROW_IMAGE), mul(3, shr(SAMPLE_SIZE_BITS, p))), 0, 3)
        }
    }

    /// @dev Writes samples of a pixel, and lists it.
    /// @param p The address of the pixel's samples.
    /// @param z The new samples; only those whose highest bit is set in `seen` are written.
    function write(uint256 p, uint256 z, uint256 seen) internal pure {
        assembly ("memory-safe") {
            let old := mload(p) // what is there
            z := or(xor(old, and(xor(old, z), sub(shl(1, seen), shr(TOP_64_AT, seen)))), IS_LISTED) // z where seen, else old
            if iszero(and(old, IS_LISTED)) { // once
                let pixel := add(mload(ROW_IMAGE), mul(3, shr(SAMPLE_SIZE_BITS, p)))
                mstore(mload(MIXED_END), or(shl(MIXED_AT, p), shl(MIXED_PIXEL_AT, pixel))) // append (p, pixel)
                mstore(MIXED_END, add(mload(MIXED_END), MIXED_SIZE))
            }
            mstore(p, z)
        }
    }

    /// @dev Returns the address of the samples of column 0, and sets ROW_IMAGE.
    function openRow(uint256 row) internal pure returns (uint256 p) {
        assembly ("memory-safe") {
            p := sub(mload(SAMPLE_ORIGIN), mul(row, mload(SAMPLE_STRIDE)))
            mstore(ROW_IMAGE, sub(mload(SAMPLE_IMAGE), mul(3, add(mul(row, mload(TILE_WIDTH)), sar(SAMPLE_SIZE_BITS, p)))))
        }
    }
}
