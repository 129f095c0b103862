// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {BEYOND_BYTE_85, BEYOND_CARRY, BEYOND_SIGN} from "./ExactSpans.sol";
import {BLUE_Q10_AT, GREEN_Q10_AT, HALF_85, HALF_85_Q10, ONES_85, RED_Q10_AT} from "./ExactSpans.sol";
import "./Registers.sol";

// Fragments of four samples: see SampleRasterizer. In each lane of a pixel stand a depth and a colour; what is nearer replaces both. Where
// all four have one colour it is written to the picture at once. Other pixels are put on a list, and their mean is written in the end.
//
// Linear and quadratic colours are those of the centre of the pixel, as in OpenGL, even if the triangle covers only samples beside it.
// What is computed for each fragment, and would be unbounded outside the triangle, is taken in the middle of the samples that it covers
// (`centroid` in OpenGL).

library Samples {
    /// @notice Fragments whose colours are a quadratic function of the place: see Patches.
    function quadratic(uint256 left, uint256 right, uint256 column, uint256 end, uint256 row) internal pure {
        assembly ("memory-safe") {
            let attribute := add(add(mload(START), mul(sub(row, mload(START_ROW)), mload(DY))), mul(column, mload(DX)))
            let p := sub(mload(SAMPLE_ORIGIN), mul(row, mload(SAMPLE_STRIDE)))
            mstore(ROW_IMAGE, sub(mload(SAMPLE_IMAGE), mul(3, add(mul(row, mload(TILE_WIDTH)), sar(SAMPLE_SIZE_BITS, p)))))
            end := add(p, shl(SAMPLE_SIZE_BITS, end))
            p := add(p, shl(SAMPLE_SIZE_BITS, column))
            row := sub(row, mload(QUADRATIC_ROW))
            // the colour at column 0, Q58, then at the column; its change to the next
            let f := add(mload(QUADRATIC_START), mul(row, mload(QUADRATIC_DY)))
            f := add(f, mul(shr(1, mul(row, sub(row, 1))), mload(QUADRATIC_DYY)))
            let g := add(mload(QUADRATIC_DX), mul(row, mload(QUADRATIC_DXY)))
            f := add(f, add(mul(column, g), mul(shr(1, mul(column, sub(column, 1))), mload(QUADRATIC_DXX))))
            g := add(g, mul(column, mload(QUADRATIC_DXX)))
            column := mul(shl(COLUMN_FRACTION, column), ONES_64)
            for {} 1 {} {
                let z := mul(sub(shr(ACCUMULATOR_DEPTH_AT, attribute), mload(SAMPLE_BASE)), mload(SAMPLE_SCALE))
                z := and(add(z, mload(DEPTH_OFFSETS)), SAMPLE_DEPTHS)
                let old := mload(p)
                let seen := and(and(add(left, column), sub(right, column)), and(sub(add(z, BELOW_TOPS_64), old), TOPS_64))
                if seen {
                    row := f
                    if mload(PATCH_WEIGHT) {
                        // beside the triangle the depth may be anything
                        row := shr(ACCUMULATOR_DEPTH_AT, attribute)
                        if slt(shl(UPPER_LANE_64_AT, row), shl(UPPER_LANE_64_AT, mload(FARTHEST))) { row := mload(FARTHEST) }
                        row := div(shl(34, mload(PATCH_WEIGHT)), row)
                        row := add(mul(sub(and(shr(Q48, f), LANES_37), BIAS_36), row), HALF_85)
                    }
                    let color := and(row, BYTES_Q58)
                    {
                        let beyond := and(row, ABOVE_Q58)
                        if beyond {
                            beyond := and(add(beyond, ABOVE_Q58), CARRIES_85)
                            color := or(color, mul(shr(CARRY_85, beyond), BYTE_Q58))
                            color := and(color, not(mul(shr(SIGN_85, and(row, SIGNS_85)), BYTE_Q58)))
                        }
                    }
                    color := or(
                        or(shl(BLUE_TO_TOP, color), and(shl(GREEN_TO_TOP, color), SECOND_BYTE)),
                        and(shl(RED_TO_TOP, color), THIRD_BYTE)
                    )
                    color := shr(PIXEL_AT, color)
                    z := or(z, mul(color, ONES_64))
                    switch eq(seen, TOPS_64)
                    case 1 {
                        mstore(0, shl(PIXEL_AT, color))
                        mcopy(add(mload(ROW_IMAGE), mul(3, shr(SAMPLE_SIZE_BITS, p))), 0, 3)
                    }
                    default {
                        z := xor(old, and(xor(old, z), sub(shl(1, seen), shr(63, seen))))
                        z := or(z, IS_LISTED)
                        if iszero(and(old, IS_LISTED)) {
                            seen := add(mload(ROW_IMAGE), mul(3, shr(SAMPLE_SIZE_BITS, p)))
                            mstore(mload(MIXED_END), or(shl(MIXED_AT, p), shl(MIXED_PIXEL_AT, seen)))
                            mstore(MIXED_END, add(mload(MIXED_END), MIXED_SIZE))
                        }
                    }
                    mstore(p, z)
                }
                p := add(p, 32)
                if eq(p, end) { break }
                column := add(column, COLUMN_64)
                attribute := add(attribute, mload(DX))
                f := add(f, g)
                g := add(g, mload(QUADRATIC_DXX))
            }
        }
    }

    /// @dev The highest bit of each sample of a pixel that lies between two sides.
    function coverage(uint256 left, uint256 right, uint256 column) internal pure returns (uint256 lanes) {
        assembly ("memory-safe") {
            lanes := mul(shl(COLUMN_FRACTION, column), ONES_64)
            lanes := and(and(add(left, lanes), sub(right, lanes)), TOPS_64)
        }
    }

    /// @dev The middle of the samples that are covered, from the centre of their pixel, in eighths of it.
    function centroid(uint256 lanes) internal pure returns (uint256 x, uint256 y) {
        assembly ("memory-safe") {
            lanes := and(shr(SET_AT, mul(shr(63, lanes), COVERED_TO_SET)), SET_MASK)
            x := signextend(0, shr(add(8, lanes), CENTROIDS))
            y := signextend(0, shr(lanes, CENTROIDS))
        }
    }

    /// @dev The accumulator at a place so many eighths of a pixel away.
    function moved(uint256 attribute, uint256 x, uint256 y) internal pure returns (uint256 there) {
        assembly ("memory-safe") {
            there := add(attribute, add(mul(x, mload(DX_8)), mul(y, mload(DY_8))))
            if and(mload(MODE), IS_DEEP) {
                x := add(mul(x, sar(ATTRIBUTE_DEPTH_AT, mload(DEEP_DX))), mul(y, sar(ATTRIBUTE_DEPTH_AT, mload(DEEP_DY))))
                there := add(there, shl(ATTRIBUTE_DEPTH_AT, sar(3, x)))
            }
        }
    }

    /// @dev The depths of the four samples.
    function depthsOf(uint256 attribute) internal pure returns (uint256 z) {
        assembly ("memory-safe") {
            z := mul(sub(shr(ACCUMULATOR_DEPTH_AT, attribute), mload(SAMPLE_BASE)), mload(SAMPLE_SCALE))
            z := and(add(z, mload(DEPTH_OFFSETS)), SAMPLE_DEPTHS)
        }
    }

    /// @dev A colour of signed lanes of 85 bits, Q10, as three bytes, blue uppermost.
    function bytesOf(uint256 color) internal pure returns (uint256 pixel) {
        assembly ("memory-safe") {
            color := add(color, HALF_85_Q10)
            let beyond := and(color, BEYOND_BYTE_85)
            if beyond {
                // as in ExactSpans
                beyond := and(shr(BEYOND_CARRY, add(beyond, BEYOND_BYTE_85)), ONES_85)
                color := or(color, mul(beyond, BYTE_Q10))
                color := and(color, not(mul(and(shr(BEYOND_SIGN, color), ONES_85), BYTE_Q10)))
            }
            pixel := or(shl(16, and(shr(BLUE_Q10_AT, color), 0xff)), shl(8, and(shr(GREEN_Q10_AT, color), 0xff)))
            pixel := or(pixel, and(shr(RED_Q10_AT, color), 0xff))
        }
    }

    /// @dev Writes the samples of a pixel.
    /// @param z What those change to of which the highest bit is in `seen`.
    function write(uint256 row, uint256 column, uint256 z, uint256 seen) internal pure {
        assembly ("memory-safe") {
            let p := add(sub(mload(SAMPLE_ORIGIN), mul(row, mload(SAMPLE_STRIDE))), shl(SAMPLE_SIZE_BITS, column))
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

    /// @dev Where a pixel has its samples.
    function place(uint256 row, uint256 column) internal pure returns (uint256 p) {
        assembly ("memory-safe") {
            p := add(sub(mload(SAMPLE_ORIGIN), mul(row, mload(SAMPLE_STRIDE))), shl(SAMPLE_SIZE_BITS, column))
        }
    }
}
