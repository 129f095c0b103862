// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {BEYOND_BYTE_85, BEYOND_CARRY, BEYOND_SIGN, BLUE_Q10_AT, GREEN_Q10_AT, HALF_85, HALF_85_Q10, ONES_85, RED_Q10_AT} from "./ExactSpans.sol";
import {BYTES_OF_LANES, LANES_TO_BYTES, ABOVE_BYTES, NEXT_LANES, NEXT_LANE_TO_BYTE} from "./LinearSpans.sol";
import "./Registers.sol";

// Fragments of four samples: see SampleRasterizer. A fragment is shaded at the middle of the samples that its triangle covers, so that
// nothing is computed outside the triangle; quadratic colours, which may leave it by a pixel, in the centre of the pixel.
//
// In each lane of a pixel stand a depth and a colour. What is nearer replaces both; the pixel of the picture is the mean of the four
// colours, and is written with them.

library Samples {
    /// @notice Fragments of which the accumulator holds the colour.
    function linear(uint256 left, uint256 right, uint256 column, uint256 end, uint256 row) internal pure {
        assembly ("memory-safe") {
            let attribute := add(add(mload(START), mul(sub(row, mload(START_ROW)), mload(DY))), mul(column, mload(DX)))
            let pixel := add(mload(SAMPLE_IMAGE), mul(3, sub(column, mul(row, mload(TILE_WIDTH)))))
            let p := sub(mload(SAMPLE_ORIGIN), mul(row, mload(SAMPLE_STRIDE)))
            end := add(p, shl(SAMPLE_SIZE_BITS, end))
            p := add(p, shl(SAMPLE_SIZE_BITS, column))
            column := mul(shl(COLUMN_FRACTION, column), ONES_64)
            for {} 1 {} {
                let z := and(add(mul(shr(ACCUMULATOR_DEPTH_AT, attribute), ONES_64), mload(DEPTH_OFFSETS)), SAMPLE_DEPTHS)
                let old := mload(p)
                let covered := and(add(left, column), sub(right, column))
                let seen := and(and(covered, sub(or(z, TOPS_64), or(old, SAMPLE_COLORS))), TOPS_64)
                if seen {
                    let color := attribute
                    covered := and(covered, TOPS_64)
                    if xor(covered, TOPS_64) {
                        covered := and(shr(SET_AT, mul(shr(63, covered), COVERED_TO_SET)), SET_MASK)
                        color := add(color, mul(signextend(0, shr(add(8, covered), CENTROIDS)), mload(DX_8)))
                        color := add(color, mul(signextend(0, shr(covered, CENTROIDS)), mload(DY_8)))
                    }
                    if and(color, ABOVE_BYTES) {
                        // as in LinearSpans
                        covered := and(add(and(color, ABOVE_BYTES), ABOVE_BYTES), NEXT_LANES)
                        color := or(color, shr(NEXT_LANE_TO_BYTE, mul(covered, 0xff)))
                    }
                    color := shr(PIXEL_AT, mul(and(color, BYTES_OF_LANES), LANES_TO_BYTES))
                    z := or(z, mul(color, ONES_64))
                    if xor(seen, TOPS_64) {
                        z := xor(old, and(xor(old, z), sub(shl(1, seen), shr(63, seen))))
                        color := add(
                            shr(UPPER_LANE_64_AT, mul(or(and(z, RED_BLUE_64), shl(GREEN_OF_SUM, and(z, GREEN_64))), ONES_64)),
                            ROUND_SUM
                        )
                        color := or(and(shr(2, color), RED_BLUE), and(shr(MEAN_OF_GREEN_AT, color), GREEN))
                    }
                    mstore(p, z)
                    mstore(0, shl(PIXEL_AT, color))
                    mcopy(pixel, 0, 3)
                }
                p := add(p, 32)
                if eq(p, end) { break }
                pixel := add(pixel, 3)
                column := add(column, COLUMN_64)
                attribute := add(attribute, mload(DX))
            }
        }
    }

    /// @notice Fragments whose colours are a quadratic function of the place: see Patches.
    function quadratic(uint256 left, uint256 right, uint256 column, uint256 end, uint256 row) internal pure {
        assembly ("memory-safe") {
            let attribute := add(add(mload(START), mul(sub(row, mload(START_ROW)), mload(DY))), mul(column, mload(DX)))
            let pixel := add(mload(SAMPLE_IMAGE), mul(3, sub(column, mul(row, mload(TILE_WIDTH)))))
            let p := sub(mload(SAMPLE_ORIGIN), mul(row, mload(SAMPLE_STRIDE)))
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
                let z := and(add(mul(shr(ACCUMULATOR_DEPTH_AT, attribute), ONES_64), mload(DEPTH_OFFSETS)), SAMPLE_DEPTHS)
                let old := mload(p)
                let seen := and(and(add(left, column), sub(right, column)), sub(or(z, TOPS_64), or(old, SAMPLE_COLORS)))
                seen := and(seen, TOPS_64)
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
                    if xor(seen, TOPS_64) {
                        z := xor(old, and(xor(old, z), sub(shl(1, seen), shr(63, seen))))
                        color := add(
                            shr(UPPER_LANE_64_AT, mul(or(and(z, RED_BLUE_64), shl(GREEN_OF_SUM, and(z, GREEN_64))), ONES_64)),
                            ROUND_SUM
                        )
                        color := or(and(shr(2, color), RED_BLUE), and(shr(MEAN_OF_GREEN_AT, color), GREEN))
                    }
                    mstore(p, z)
                    mstore(0, shl(PIXEL_AT, color))
                    mcopy(pixel, 0, 3)
                }
                p := add(p, 32)
                if eq(p, end) { break }
                pixel := add(pixel, 3)
                column := add(column, COLUMN_64)
                attribute := add(attribute, mload(DX))
                f := add(f, g)
                g := add(g, mload(QUADRATIC_DXX))
            }
        }
    }

    /// @dev The middle of the samples that are covered, from the centre of their pixel, in eighths of it.
    function centroid(uint256 covered) internal pure returns (uint256 x, uint256 y) {
        assembly ("memory-safe") {
            covered := and(shr(SET_AT, mul(shr(63, and(covered, TOPS_64)), COVERED_TO_SET)), SET_MASK)
            x := signextend(0, shr(add(8, covered), CENTROIDS))
            y := signextend(0, shr(covered, CENTROIDS))
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
    function depths(uint256 attribute) internal pure returns (uint256 z) {
        assembly ("memory-safe") {
            z := and(add(mul(shr(ACCUMULATOR_DEPTH_AT, attribute), ONES_64), mload(DEPTH_OFFSETS)), SAMPLE_DEPTHS)
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

    /// @dev Writes the samples of a pixel, and their mean.
    /// @param seen The highest bit of each lane that changes to what it is in `changed`.
    function write(uint256 p, uint256 pixel, uint256 changed, uint256 seen) internal pure {
        assembly ("memory-safe") {
            let z := mload(p)
            z := xor(z, and(xor(z, changed), sub(shl(1, seen), shr(63, seen))))
            mstore(p, z)
            z := add(shr(UPPER_LANE_64_AT, mul(or(and(z, RED_BLUE_64), shl(GREEN_OF_SUM, and(z, GREEN_64))), ONES_64)), ROUND_SUM)
            z := or(and(shr(2, z), RED_BLUE), and(shr(MEAN_OF_GREEN_AT, z), GREEN))
            mstore(0, shl(PIXEL_AT, z))
            mcopy(pixel, 0, 3)
        }
    }
}
