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
            // Three bytes, blue uppermost, from the accumulator and 128 times the products. This is the light of SmoothSpans: there it is
            // part of a loop over lanes that are not scaled, and no call.
            function colorAt(attribute, light) -> color {
                let square := shr(add(UPPER_85_AT, MORE_BITS), light) // N.N, Q68
                let length := add(shr(ROOT_SHIFT, mul(ROOT_SLOPE, square)), ROOT_AT_0) // about 2 sqrt(N.N), Q34
                length := add(length, div(square, length)) // one step of Newton: 2 |N|
                let factor := mload(FACE_LIGHT_40)
                color := HALF_LEVEL
                let t := sar(add(N_DOT_L_AT, MORE_BITS), shl(MIDDLE_85_TO_TOP, light)) // N.L
                if sgt(t, 0) {
                    factor := add(factor, mul(mload(add(LIGHTS, LIGHT_DIFFUSE)), div(t, length))) // + diffuse * N.L / |N|
                    t := sar(add(N_DOT_H_AT, MORE_BITS), shl(LOWER_85_TO_TOP, light)) // N.H
                    if sgt(t, 0) {
                        t := div(mul(t, t), square) // cos^2 = (N.H)^2 / N.N
                        if gt(t, mload(SPECULAR_BEGIN)) {
                            t := mul(sub(t, mload(SPECULAR_BEGIN)), mload(SPECULAR_SCALE)) // an index into the table, Q40
                            if gt(t, SPECULAR_LAST) { t := SPECULAR_LAST } // min
                            let entry := mload(add(SPECULAR_TABLE, and(shr(SPECULAR_ENTRY_SHIFT, t), SPECULAR_ENTRY_MASK))) // table[t]
                            entry := add(
                                shr(SPECULAR_VALUE_AT, entry),
                                shr(Q16, mul(and(entry, LANE_32), and(shr(SPECULAR_REST_AT, t), SPECULAR_REST_MASK)))
                            )
                            color := add(color, and(shr(Q16_TO_Q10, mul(mload(add(LIGHTS, LIGHT_COLOR)), entry)), LANES_24)) // + cos^n
                        }
                    }
                }
                t := and(shr(ACCUMULATOR_FRACTION, attribute), LANES_24) // the surface's colour, Q10
                let mode := and(mload(MODE), IS_GREY_OR_STEEP) // which of the three products
                switch eq(mode, IS_GREY)
                case 1 { color := add(color, and(shr(Q16, mul(t, and(shr(BLUE_Q40_AT, factor), LANE_32))), LANES_24)) } // all lanes at once
                default {
                    if and(mode, IS_STEEP) {
                        t := and(shr(Q16, mul(t, div(mload(NEAREST), shr(ACCUMULATOR_DEPTH_AT, attribute)))), LANES_24)
                    }
                    factor := shr(Q40_TO_Q16, factor) // lanes of Q16
                    color := add(color, shr(Q16, mul(and(t, LANE_24), and(factor, LANE_32)))) // + blue
                    t := shr(MIDDLE_AT, t) // green and red
                    color := add(color, shl(MIDDLE_AT, shr(Q16, mul(and(t, LANE_24), and(shr(MIDDLE_AT, factor), LANE_32))))) // + green
                    color := add(color, shl(UPPER_AT, shr(Q16, mul(shr(MIDDLE_AT, t), shr(UPPER_AT, factor))))) // + red
                }
                // lanes above 255 get all bits of 255
                if and(color, OVERFLOW) {
                    color := or(color, mul(and(shr(OVERFLOW_CARRY_AT, add(color, OVERFLOW_TO_CARRY)), ONES), BYTE_Q10))
                }
                color := shr(PIXEL_AT, mul(and(color, BYTES_Q10), Q10_TO_PIXEL)) // 0xBBGGRR
            }

            let attribute := add(add(mload(START), mul(sub(row, mload(START_ROW)), mload(DY))), mul(column, mload(DX))) // at the column
            let p := sub(mload(SAMPLE_ORIGIN), mul(row, mload(SAMPLE_STRIDE))) // of column 0
            mstore(ROW_IMAGE, sub(mload(SAMPLE_IMAGE), mul(3, add(mul(row, mload(TILE_WIDTH)), sar(SAMPLE_SIZE_BITS, p)))))
            end := add(p, shl(SAMPLE_SIZE_BITS, end)) // p + 32 * end
            p := add(p, shl(SAMPLE_SIZE_BITS, column))
            row := sub(row, mload(QUADRATIC_ROW)) // from here on relative to QUADRATIC_ROW
            // products at the column, their change to the next
            let light := add(mload(QUADRATIC_START), mul(row, mload(QUADRATIC_DY))) // f + y dy
            light := add(light, mul(shr(1, mul(row, sub(row, 1))), mload(QUADRATIC_DYY))) // + y (y - 1) / 2 dyy
            let step := add(mload(QUADRATIC_DX), mul(row, mload(QUADRATIC_DXY))) // dx + y dxy
            light := add(light, add(mul(column, step), mul(shr(1, mul(column, sub(column, 1))), mload(QUADRATIC_DXX)))) // at the column
            step := add(step, mul(column, mload(QUADRATIC_DXX))) // + x dxx
            // and to the next row
            mstore(QUADRATIC_DOWN, add(mload(QUADRATIC_DY), mul(row, mload(QUADRATIC_DYY))))
            for {} 1 {} {
                let z := mul(shr(ACCUMULATOR_DEPTH_AT, attribute), mload(SAMPLE_SCALE)) // of the pixel centre
                z := and(add(z, mload(DEPTH_OFFSETS)), SAMPLE_DEPTHS) // the depths of four samples
                let old := mload(p) // what is there
                let covered := mul(p, ADDRESS_64)
                covered := and(add(left, covered), sub(right, covered)) // see SampleRasterizer
                let seen := and(and(covered, sub(add(z, BELOW_TOPS_64), old)), TOPS_64) // covered, and nearer: z - 1 >= old
                if seen {
                    // from here on the accumulator and the products where the colour is computed
                    row := attribute
                    let color := shl(MORE_BITS, light)
                    covered := and(covered, TOPS_64)
                    if xor(covered, TOPS_64) { // not all samples
                        // from here on the number of the set
                        covered := and(shr(SET_AT, mul(shr(TOP_64_AT, covered), COVERED_TO_SET)), SET_MASK)
                        // With the forward differences d at the centre, and x and y in eighths of a pixel, the quadratic function is
                        // f + (x dx + y dy) / 8 + (x (x - 8) dxx + 2 x y dxy + y (y - 8) dyy) / 128 there: exact, however thin the triangle
                        let x := signextend(0, shr(add(8, covered), CENTROIDS))
                        let y := signextend(0, shr(covered, CENTROIDS))
                        row := add(row, add(mul(x, mload(DX_8)), mul(y, mload(DY_8)))) // + x DX / 8 + y DY / 8
                        let slope := add(mul(sub(x, 8), mload(QUADRATIC_DXX)), mul(shl(1, y), mload(QUADRATIC_DXY))) // (x-8)dxx + 2y dxy
                        color := add(color, mul(x, add(shl(4, step), slope))) // + x (16 dx + slope)
                        slope := add(mload(QUADRATIC_DOWN), mul(column, mload(QUADRATIC_DXY))) // dy at the column
                        color := add(color, mul(y, add(shl(4, slope), mul(sub(y, 8), mload(QUADRATIC_DYY))))) // + y (16 dy + (y - 8) dyy)
                    }
                    color := colorAt(row, color)
                    // as Samples.paint and write, without their calls for each fragment
                    z := or(z, mul(color, ONES_64)) // the colour in each sample
                    switch eq(seen, TOPS_64)
                    case 1 {
                        mstore(0, shl(PIXEL_AT, color))
                        mcopy(add(mload(ROW_IMAGE), mul(3, shr(SAMPLE_SIZE_BITS, p))), 0, 3)
                    }
                    default {
                        z := xor(old, and(xor(old, z), sub(shl(1, seen), shr(TOP_64_AT, seen)))) // z where seen, else old
                        z := or(z, IS_LISTED)
                        if iszero(and(old, IS_LISTED)) {
                            seen := add(mload(ROW_IMAGE), mul(3, shr(SAMPLE_SIZE_BITS, p)))
                            mstore(mload(MIXED_END), or(shl(MIXED_AT, p), shl(MIXED_PIXEL_AT, seen))) // append (p, pixel)
                            mstore(MIXED_END, add(mload(MIXED_END), MIXED_SIZE))
                        }
                    }
                    mstore(p, z)
                }
                p := add(p, SAMPLE_SIZE)
                if eq(p, end) { break }
                column := add(column, 1)
                attribute := add(attribute, mload(DX))
                light := add(light, step) // the next column
                step := add(step, mload(QUADRATIC_DXX))
            }
        }
    }
}
