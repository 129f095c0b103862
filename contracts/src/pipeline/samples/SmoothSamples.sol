// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import "../../words/SampleRegisters.sol";

// Smooth surfaces lit by a single lamp, with four samples per pixel: the products of SmoothTriangle, at the centroid of the samples that
// the triangle covers.

/// @dev The additional bits of 128 times a product.
uint256 constant MORE_BITS = 7;

library SmoothSamples {
    /// @notice Draws the fragments of a row: see SampleRasterizer.drawSpan.
    function draw(uint256 left, uint256 right, uint256 column, uint256 end, uint256 row) internal pure {
        assembly ("memory-safe") {
            // a colour in lanes of Q10, from the accumulator and 128 times the products: see SmoothSpans
            function colorAt(attribute, light) -> color {
                let square := shr(add(UPPER_85_AT, MORE_BITS), light)
                let length := add(shr(ROOT_SHIFT, mul(ROOT_SLOPE, square)), ROOT_AT_0)
                length := add(length, div(square, length))
                let factor := mload(FACE_LIGHT_40)
                color := HALF_LEVEL
                let t := sar(add(N_DOT_L_AT, MORE_BITS), shl(MIDDLE_85_TO_TOP, light))
                if sgt(t, 0) {
                    factor := add(factor, mul(mload(add(LIGHTS, LIGHT_DIFFUSE)), div(t, length)))
                    t := sar(add(N_DOT_H_AT, MORE_BITS), shl(LOWER_85_TO_TOP, light))
                    if sgt(t, 0) {
                        t := div(mul(t, t), square)
                        if gt(t, mload(SPECULAR_BEGIN)) {
                            t := mul(sub(t, mload(SPECULAR_BEGIN)), mload(SPECULAR_SCALE))
                            if gt(t, SPECULAR_LAST) { t := SPECULAR_LAST }
                            let entry := mload(add(SPECULAR_TABLE, and(shr(SPECULAR_ENTRY_SHIFT, t), SPECULAR_ENTRY_MASK)))
                            entry := add(
                                shr(SPECULAR_VALUE_AT, entry),
                                shr(Q16, mul(and(entry, LANE_32), and(shr(SPECULAR_REST_AT, t), SPECULAR_REST_MASK)))
                            )
                            color := add(color, and(shr(Q16_TO_Q10, mul(mload(add(LIGHTS, LIGHT_COLOR)), entry)), LANES_24))
                        }
                    }
                }
                t := and(shr(ACCUMULATOR_FRACTION, attribute), LANES_24)
                let mode := and(mload(MODE), IS_GREY_OR_STEEP)
                switch eq(mode, IS_GREY)
                case 1 { color := add(color, and(shr(Q16, mul(t, and(shr(BLUE_Q40_AT, factor), LANE_32))), LANES_24)) }
                default {
                    if and(mode, IS_STEEP) {
                        t := and(shr(Q16, mul(t, div(mload(NEAREST), shr(ACCUMULATOR_DEPTH_AT, attribute)))), LANES_24)
                    }
                    factor := shr(Q40_TO_Q16, factor)
                    color := add(color, shr(Q16, mul(and(t, LANE_24), and(factor, LANE_32))))
                    t := shr(MIDDLE_AT, t)
                    color := add(color, shl(MIDDLE_AT, shr(Q16, mul(and(t, LANE_24), and(shr(MIDDLE_AT, factor), LANE_32)))))
                    color := add(color, shl(UPPER_AT, shr(Q16, mul(shr(MIDDLE_AT, t), shr(UPPER_AT, factor)))))
                }
                // lanes above 255 get all bits of 255
                if and(color, OVERFLOW) {
                    color := or(color, mul(and(shr(OVERFLOW_CARRY_AT, add(color, OVERFLOW_TO_CARRY)), ONES), BYTE_Q10))
                }
                color := shr(PIXEL_AT, mul(and(color, BYTES_Q10), Q10_TO_PIXEL))
            }

            let attribute := add(add(mload(START), mul(sub(row, mload(START_ROW)), mload(DY))), mul(column, mload(DX)))
            let p := sub(mload(SAMPLE_ORIGIN), mul(row, mload(SAMPLE_STRIDE)))
            mstore(ROW_IMAGE, sub(mload(SAMPLE_IMAGE), mul(3, add(mul(row, mload(TILE_WIDTH)), sar(SAMPLE_SIZE_BITS, p)))))
            end := add(p, shl(SAMPLE_SIZE_BITS, end))
            p := add(p, shl(SAMPLE_SIZE_BITS, column))
            row := sub(row, mload(QUADRATIC_ROW))
            // products at the column, their change to the next
            let light := add(mload(QUADRATIC_START), mul(row, mload(QUADRATIC_DY)))
            light := add(light, mul(shr(1, mul(row, sub(row, 1))), mload(QUADRATIC_DYY)))
            let step := add(mload(QUADRATIC_DX), mul(row, mload(QUADRATIC_DXY)))
            light := add(light, add(mul(column, step), mul(shr(1, mul(column, sub(column, 1))), mload(QUADRATIC_DXX))))
            step := add(step, mul(column, mload(QUADRATIC_DXX)))
            // and to the next row
            mstore(QUADRATIC_DOWN, add(mload(QUADRATIC_DY), mul(row, mload(QUADRATIC_DYY))))
            for {} 1 {} {
                let z := mul(shr(ACCUMULATOR_DEPTH_AT, attribute), mload(SAMPLE_SCALE))
                z := and(add(z, mload(DEPTH_OFFSETS)), SAMPLE_DEPTHS)
                let old := mload(p)
                let covered := mul(p, ADDRESS_64)
                covered := and(add(left, covered), sub(right, covered))
                let seen := and(and(covered, sub(add(z, BELOW_TOPS_64), old)), TOPS_64)
                if seen {
                    row := attribute
                    let color := shl(MORE_BITS, light)
                    covered := and(covered, TOPS_64)
                    if xor(covered, TOPS_64) {
                        covered := and(shr(SET_AT, mul(shr(63, covered), COVERED_TO_SET)), SET_MASK)
                        // With the forward differences d at the centre, and x and y in eighths of a pixel, the quadratic function is
                        // f + (x dx + y dy) / 8 + (x (x - 8) dxx + 2 x y dxy + y (y - 8) dyy) / 128 there: exact, however thin the triangle
                        let x := signextend(0, shr(add(8, covered), CENTROIDS))
                        let y := signextend(0, shr(covered, CENTROIDS))
                        row := add(row, add(mul(x, mload(DX_8)), mul(y, mload(DY_8))))
                        let slope := add(mul(sub(x, 8), mload(QUADRATIC_DXX)), mul(shl(1, y), mload(QUADRATIC_DXY)))
                        color := add(color, mul(x, add(shl(4, step), slope)))
                        slope := add(mload(QUADRATIC_DOWN), mul(column, mload(QUADRATIC_DXY)))
                        color := add(color, mul(y, add(shl(4, slope), mul(sub(y, 8), mload(QUADRATIC_DYY)))))
                    }
                    color := colorAt(row, color)
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
                column := add(column, 1)
                attribute := add(attribute, mload(DX))
                light := add(light, step)
                step := add(step, mload(QUADRATIC_DXX))
            }
        }
    }
}
