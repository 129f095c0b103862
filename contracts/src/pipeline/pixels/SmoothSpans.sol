// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import "../../words/Registers.sol";

// Computes `fill` and `radiance` of picture.py for smooth triangles with one light.
// Rows of fragments of smooth triangles with one light: quadratic products, see SmoothTriangle.

library SmoothSpans {
    /// @notice Draws the fragments of a smooth triangle: see PixelRasterizer.drawParts.
    function drawParts(uint256 edges, uint256 rows, uint256 row) internal pure {
        assembly ("memory-safe") {
            // Fragments of a row; `light` contains the products at the first one, `step` their change to the next. `plain` is a literal, so
            // that the compiler generates two functions: 1 for grey light on linear colours.
            function span(p, end, attribute, light, step, plain) {
                let pixel := add(mload(IMAGE_ORIGIN), mul(3, shr(DEPTH_SIZE_BITS, p))) // IMAGE_ORIGIN + 3 * (p / 8)
                for {} 1 {} {
                    if gt(attribute, or(mload(p), BEHIND_DEPTH)) { // depth > the one in the buffer
                        // copying a few bytes is cheaper than inserting them into a word
                        mstore(0, attribute) // depth uppermost
                        mcopy(p, 0, 8)
                        // N * N, Q68, and twice its root, Q34
                        let square := shr(UPPER_85_AT, light)
                        let length := add(shr(ROOT_SHIFT, mul(ROOT_SLOPE, square)), ROOT_AT_0) // l, near 2 |N|
                        length := add(length, div(square, length)) // Newton: 2 |N| = l / 2 + 2 N * N / l, in the unit of l
                        let factor := mload(FACE_LIGHT_40) // diffuse light, lanes of Q40
                        let sum := HALF_LEVEL // the highlight, lanes of Q10, rounded in the end
                        // N * L, Q59
                        let t := sar(N_DOT_L_AT, shl(MIDDLE_85_TO_TOP, light))
                        if sgt(t, 0) { // the light is before the surface
                            // divided by |N|, Q24
                            factor := add(factor, mul(mload(add(LIGHTS, LIGHT_DIFFUSE)), div(t, length))) // + diffuse * N.L / |N|
                            // N * H, Q46
                            t := sar(N_DOT_H_AT, shl(LOWER_85_TO_TOP, light))
                            if sgt(t, 0) { // H is before the surface
                                t := div(mul(t, t), square) // (N.H)^2 / N.N, Q24
                                if gt(t, mload(SPECULAR_BEGIN)) {
                                    t := mul(sub(t, mload(SPECULAR_BEGIN)), mload(SPECULAR_SCALE)) // index into the table, Q40
                                    if gt(t, SPECULAR_LAST) { t := SPECULAR_LAST }
                                    let entry := mload(add(SPECULAR_TABLE, and(shr(SPECULAR_ENTRY_SHIFT, t), SPECULAR_ENTRY_MASK)))
                                    entry := add( // value + increase * fraction of the index, Q16
                                        shr(SPECULAR_VALUE_AT, entry),
                                        shr(Q16, mul(and(entry, LANE_32), and(shr(SPECULAR_REST_AT, t), SPECULAR_REST_MASK)))
                                    )
                                    // + colour * highlight
                                    sum := add(sum, and(shr(Q16_TO_Q10, mul(mload(add(LIGHTS, LIGHT_COLOR)), entry)), LANES_24))
                                }
                            }
                        }
                        t := and(shr(ACCUMULATOR_FRACTION, attribute), LANES_24) // the surface's colour, lanes of Q10
                        switch plain
                        case 1 { t := add(sum, and(shr(Q16, mul(t, and(shr(BLUE_Q40_AT, factor), LANE_32))), LANES_24)) }
                        default {
                            if and(mload(MODE), IS_STEEP) { // colour * nearest / depth
                                t := and(shr(Q16, mul(t, div(mload(NEAREST), shr(ACCUMULATOR_DEPTH_AT, attribute)))), LANES_24)
                            }
                            factor := shr(Q40_TO_Q16, factor)
                            sum := add(sum, shr(Q16, mul(and(t, LANE_24), and(factor, LANE_32)))) // + blue * light
                            t := shr(MIDDLE_AT, t) // green lowest
                            // + green * light, + red * light
                            sum := add(sum, shl(MIDDLE_AT, shr(Q16, mul(and(t, LANE_24), and(shr(MIDDLE_AT, factor), LANE_32)))))
                            t := add(sum, shl(UPPER_AT, shr(Q16, mul(shr(MIDDLE_AT, t), shr(UPPER_AT, factor)))))
                        }
                        // lanes above 255 get all bits of 255
                        if and(t, OVERFLOW) { t := or(t, mul(and(shr(OVERFLOW_CARRY_AT, add(t, OVERFLOW_TO_CARRY)), ONES), BYTE_Q10)) }
                        mstore(0, mul(and(t, BYTES_Q10), Q10_TO_PIXEL)) // blue, green, red at the top
                        mcopy(pixel, 0, 3)
                    }
                    p := add(p, 8)
                    if eq(p, end) { break } // do .. while (p != end)
                    pixel := add(pixel, 3)
                    attribute := add(attribute, mload(DX)) // the next pixel
                    light := add(light, step) // forward differences
                    step := add(step, mload(QUADRATIC_DXX))
                }
            }
            let mode := mload(MODE)
            // 0 for most triangles, 1 if only the light or the colours need more
            mode := or(and(mode, CROSSES_COLUMNS_OR_ROWS), iszero(eq(and(mode, IS_GREY_OR_STEEP), IS_GREY)))
            // START is relative to column 0; make it relative to address 0
            let start := sub(mload(START), mul(mload(DX_8), row))
            mstore(DX, shl(DEPTH_SIZE_BITS, mload(DX_8))) // 8 DX_8
            mstore(ROW_STEP, add(mload(DY), mul(mload(DX_8), mload(DEPTH_STRIDE)))) // a row down, from the same address
            let light := mload(QUADRATIC_START) // products at column 0 of the row
            let down := mload(QUADRATIC_DY) // their change to the next row
            // half the second difference, and the first difference without it: the value at column x is then that at column 0 plus x * (DX
            // + x * HALF_DXX). The bit lost at the top does no harm: x * (x - 1) is even.
            mstore(QUADRATIC_HALF_DXX, shr(1, mload(QUADRATIC_DXX)))
            mstore(QUADRATIC_DX, sub(mload(QUADRATIC_DX), mload(QUADRATIC_HALF_DXX)))
            for {} 1 {} {
                if gt(mode, 1) {
                    // only the rows in the band
                    let stride := mload(DEPTH_STRIDE)
                    let count := sdiv(sub(add(row, mul(stride, mload(BAND_TOP))), mload(DEPTH_ORIGIN)), stride) // rows above it
                    if sgt(count, 0) {
                        if gt(count, rows) { count := rows }
                        rows := sub(rows, count) // skips them
                        row := sub(row, mul(stride, count))
                        edges := add(edges, mul(mload(SLOPES), count))
                        start := add(start, mul(mload(ROW_STEP), count))
                    }
                    count := sdiv(sub(add(row, mul(stride, mload(BAND_BOTTOM))), mload(DEPTH_ORIGIN)), stride) // rows above its end
                    if slt(count, rows) {
                        rows := mul(count, sgt(count, 0)) // max(count, 0)
                        mstore(LOWER_ROWS, 0)
                    }
                }
                for {} rows {} {
                    let p := and(shr(EDGE_ADDRESS_FRACTION, edges), ADDRESS) // the first pixel
                    let end := and(shr(EDGE_RIGHT_ADDRESS_AT, edges), ADDRESS) // the one after the last
                    if gt(mode, 1) {
                        // addresses may be negative beside the tile, columns are not
                        end := sub(edges, mul(shl(EDGE_ADDRESS_FRACTION, row), ONES_128)) // the edges as columns; then p, end columns
                        p := and(shr(EDGES_LEFT_COLUMN_AT, end), EDGES_LEFT_COLUMN_MASK)
                        end := shr(EDGES_RIGHT_COLUMN_AT, end)
                        if lt(p, mload(COLUMN_BEGIN)) { p := mload(COLUMN_BEGIN) }
                        if gt(end, mload(COLUMN_END)) { end := mload(COLUMN_END) }
                        // a row without pixels remains empty if addresses are negative
                        if gt(p, end) { end := p }
                        p := add(row, shl(DEPTH_SIZE_BITS, p)) // addresses again
                        end := add(row, shl(DEPTH_SIZE_BITS, end))
                    }
                    if lt(p, end) {
                        let step := shr(DEPTH_SIZE_BITS, sub(p, row)) // x, the column
                        let first := mul(step, mload(QUADRATIC_HALF_DXX)) // x * HALF_DXX
                        {
                            let mean := add(mload(QUADRATIC_DX), first) // DX + x * HALF_DXX
                            first := add(add(mean, first), mload(QUADRATIC_HALF_DXX)) // DX + (2 x + 1) * HALF_DXX, the difference there
                            mean := add(light, mul(step, mean)) // light + x * (DX + x * HALF_DXX), the value there
                            step := first // from here on the difference
                            first := mean // from here on the value
                        }
                        switch and(mode, 1)
                        case 0 { span(p, end, add(start, mul(mload(DX_8), p)), first, step, 1) }
                        default { span(p, end, add(start, mul(mload(DX_8), p)), first, step, 0) }
                    }
                    edges := add(edges, mload(SLOPES)) // the next row
                    start := add(start, mload(ROW_STEP))
                    row := sub(row, mload(DEPTH_STRIDE))
                    light := add(light, down) // forward differences
                    down := add(down, mload(QUADRATIC_DYY))
                    mstore(QUADRATIC_DX, add(mload(QUADRATIC_DX), mload(QUADRATIC_DXY)))
                    rows := sub(rows, 1) // while (rows)
                }
                rows := mload(LOWER_ROWS) // the lower part, once
                if iszero(rows) { break }
                edges := or(and(edges, mload(LOWER_KEPT)), mload(LOWER_EDGE)) // one edge goes on, the other is replaced
                mstore(SLOPES, mload(LOWER_SLOPES))
                mstore(LOWER_ROWS, 0) // no third part
            }
        }
    }
}
