// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import "../../words/SampleRegisters.sol";

// Computes `fill` and `radiance` of picture.py where the light of a triangle is one quadratic function.
// Draws triangles whose colours are one quadratic function, with four samples per pixel in pixels that open edges touch, and whole pixels
// elsewhere: see OpenEdges. The colour is that of the pixel centre, in a pixel of which some samples are covered that of their centroid.

/// @dev The additional bits of 128 times a colour.
uint256 constant MORE_BITS = 7;

library QuadraticSamples {
    /// @notice Draws the rows from `row`, for which the sides are given, to `last` (exclusive). Changes the steps of the sides.
    function draw(uint256 row, uint256 last) internal pure {
        assembly ("memory-safe") {
            // three bytes, blue uppermost, of lanes that may lie below 0 or above 255
            function clamped(f) -> color {
                color := and(add(and(f, ABOVE_Q58), ABOVE_Q58), CARRIES_85) // 1 above each lane below 0 or above 255
                color := or(f, mul(shr(CARRY_85, color), BYTE_Q58)) // 255 there
                color := and(color, not(mul(shr(SIGN_85, and(f, SIGNS_85)), BYTE_Q58))) // 0 where negative
            }

            // N * L and N * H of unit vectors, Q24, from products: see SmoothTriangle
            function lightOf(f) -> diffuse, cosine {
                let square := shr(UPPER_85_AT, f) // N.N, Q68
                let t := add(shr(ROOT_SHIFT, mul(ROOT_SLOPE, square)), ROOT_AT_0) // about |N|, Q34
                t := shr(1, add(t, div(square, t))) // a step of Newton
                t := add(t, div(square, t)) // another one: 2 |N|
                diffuse := sdiv(sar(N_DOT_L_AT, shl(MIDDLE_85_TO_TOP, f)), t)
                cosine := sdiv(sar(N_DOT_L_AT, shl(LOWER_85_TO_TOP, f)), t)
            }

            // the highlight of the lamp with a table at a cosine, Q24, above COSINE_BEGIN: lanes of 85 bits, Q58
            function shine(t, table) -> color {
                t := mul(sub(shr(Q24, mul(t, t)), mload(SPECULAR_BEGIN)), mload(SPECULAR_SCALE)) // an index, Q40
                if gt(t, SPECULAR_LAST) { t := SPECULAR_LAST } // min
                table := add(table, and(shr(SPECULAR_ENTRY_SHIFT, t), SPECULAR_ENTRY_MASK)) // the entry from here on
                color := mload(table)
                t := and(shr(SPECULAR_REST_AT, t), SPECULAR_REST_MASK) // the fraction, Q16
                color := add(shl(Q16, color), mul(sub(mload(add(table, 32)), color), t))
            }

            // A colour, Q10 in 24 bits with a sign, times light, Q16, both in lanes of 56 bits: in lanes of 85 bits, Q26. Pixels that a
            // triangle covers in part may have their centres outside of it, where colours may lie below 0.
            function times(color, light) -> lanes {
                lanes := mul(signextend(2, color), and(light, LANE_32))
                lanes := add(lanes, shl(MIDDLE_85_AT, mul(signextend(2, shr(MIDDLE_AT, color)), and(shr(MIDDLE_AT, light), LANE_32))))
                lanes := add(lanes, shl(UPPER_85_AT, mul(signextend(2, shr(UPPER_AT, color)), shr(UPPER_AT, light))))
            }

            // the colour of a fragment, Q58, with an accumulator and the function of the light
            function colorAt(attribute, f) -> color {
                let t
                let cosine
                switch and(mload(MODE), IS_NORMALISED)
                case 0 {
                    t, cosine := lightOf(f)
                    f := 0 // no second lamp
                }
                default {
                    t := sar(LIGHT_AT, shl(LANE_1_TO_TOP, f)) // N.L, Q24
                    cosine := sar(LIGHT_AT, shl(LANE_0_TO_TOP, f)) // N.H, Q24
                }
                color := mload(SAME_AMBIENT)
                let gleam := 0 // the highlights
                if sgt(t, 0) {
                    color := add(color, mul(mload(SAME_DIFFUSE), t))
                    if sgt(cosine, mload(COSINE_BEGIN)) { gleam := shine(cosine, SHINE_TABLE) }
                }
                t := sar(LIGHT_AT, f) // that of the second lamp, or the sign
                if sgt(t, 0) {
                    color := add(color, mul(mload(SAME_DIFFUSE_2), t))
                    cosine := sar(LIGHT_AT, shl(LANE_2_TO_TOP, f))
                    if sgt(cosine, mload(COSINE_BEGIN)) { gleam := add(gleam, shine(cosine, add(SHINE_TABLE, SPECULAR_SIZE))) }
                }
                if and(mload(MODE), IS_VARIED) {
                    // light, lanes of Q16, times the colour of the accumulator, Q10
                    color := times(shr(ACCUMULATOR_FRACTION, attribute), shr(Q40_TO_Q16, color))
                    color := add(HALF_85, shl(Q26_TO_Q58, color))
                }
                color := add(color, gleam)
            }

            // the lanes x and y eighths of a pixel beside the centre of the pixel in column c; g is their change to the next column
            function beside(f, g, c, x, y) -> there {
                // the differences to the next row at the same column: the next row at this address is w columns to the right
                let w := mload(ROW_COLUMNS)
                let dxx := mload(QUADRATIC_DXX)
                let across := mul(w, dxx) // w dxx
                let dy := add(mload(QUADRATIC_DY), mul(c, mload(QUADRATIC_DXY))) // dy' + c dxy'
                c := sub(mload(QUADRATIC_DXY), across) // c: dxy = dxy' - w dxx
                // - w (g + dxy) - w (w - 1) / 2 dxx
                dy := sub(dy, add(mul(w, add(g, c)), mul(shr(1, mul(w, sub(w, 1))), dxx)))
                across := sub(mload(QUADRATIC_DYY), mul(w, add(shl(1, c), across))) // across: dyy = dyy' - w (2 dxy + w dxx)
                // With the forward differences d at the centre the quadratic function is
                // f + (x dx + y dy) / 8 + (x (x - 8) dxx + 2 x y dxy + y (y - 8) dyy) / 128 there: exact, however thin the triangle
                dxx := add(mul(sub(x, 8), dxx), mul(shl(1, y), c)) // dxx: (x - 8) dxx + 2 y dxy
                there := add(shl(MORE_BITS, f), mul(x, add(shl(4, g), dxx))) // 128 f + x (16 dx + (x - 8) dxx + 2 y dxy)
                there := add(there, mul(y, add(shl(4, dy), mul(sub(y, 8), across)))) // + y (16 dy + (y - 8) dyy)
                // as before: positive for the shift
                let bias := LANES_BIAS_85
                let less := LANES_LESS_85
                if and(mload(MODE), IS_NORMALISED) {
                    bias := LANES_BIAS_64
                    less := LANES_LESS_64
                }
                there := sub(and(shr(MORE_BITS, add(there, bias)), less), shr(MORE_BITS, bias))
            }

            // writes those samples of a pixel that are seen, and lists it
            function mix(p, old, z, seen) {
                mstore(p, or(xor(old, and(xor(old, z), sub(shl(1, seen), shr(TOP_64_AT, seen)))), IS_LISTED))
                if iszero(and(old, IS_LISTED)) {
                    let pixel := add(mload(ROW_IMAGE), mul(3, shr(SAMPLE_SIZE_BITS, p)))
                    mstore(mload(MIXED_END), or(shl(MIXED_AT, p), shl(MIXED_PIXEL_AT, pixel))) // append (p, pixel)
                    mstore(MIXED_END, add(mload(MIXED_END), MIXED_SIZE))
                }
            }

            // draws a fragment: of those samples that the triangle covers if an open edge touches the pixel
            function atPixel(p, attribute) {
                let old := mload(p)
                let isEdge := and(old, IS_EDGE)
                let covered := TOPS_64
                let z := mload(WHOLE_OFFSETS)
                if isEdge {
                    covered := mul(p, ADDRESS_64) // the address in each lane, Q37
                    covered := and(and(add(mload(ROW_LEFT), covered), sub(mload(ROW_RIGHT), covered)), TOPS_64)
                    z := mload(DEPTH_OFFSETS)
                }
                z := and(add(z, mul(shr(ACCUMULATOR_DEPTH_AT, attribute), mload(SAMPLE_SCALE))), SAMPLE_DEPTHS) // of the pixel centre
                let seen := and(sub(add(z, BELOW_TOPS_64), old), covered)
                if seen {
                    let c := shr(SAMPLE_SIZE_BITS, p)
                    let f := valueAt(c)
                    if xor(covered, TOPS_64) {
                        // the centroid of the samples; covered: 16 * the number of the set
                        covered := and(shr(SET_AT, mul(shr(TOP_64_AT, covered), COVERED_TO_SET)), SET_MASK)
                        let x := signextend(0, shr(add(8, covered), CENTROIDS))
                        let y := signextend(0, shr(covered, CENTROIDS))
                        attribute := add(attribute, add(mul(x, mload(DX_8)), mul(y, mload(DY_8)))) // + x DX / 8 + y DY / 8
                        f := beside(f, changeAt(c), c, x, y)
                    }
                    f := colorAt(attribute, f)
                    if and(f, ABOVE_Q58) { f := clamped(f) }
                    f := mul(and(f, BYTES_Q58), Q58_TO_TOP)
                    z := or(or(z, isEdge), mul(shr(PIXEL_AT, f), ONES_64))
                    switch xor(seen, TOPS_64)
                    case 0 {
                        mstore(p, z)
                        mstore(0, f) // three bytes
                        mcopy(add(mload(ROW_IMAGE), mul(3, shr(SAMPLE_SIZE_BITS, p))), 0, 3)
                    }
                    default { mix(p, old, z, seen) }
                }
            }

            // draws fragments of a row: of those in pixels that open edges touch, or all
            function pixels(p, end, isAll) {
                for {} 1 {} {
                    if or(isAll, and(mload(p), IS_EDGE)) { atPixel(p, attributeAt(shr(SAMPLE_SIZE_BITS, p))) }
                    p := add(p, SAMPLE_SIZE)
                    if iszero(slt(p, end)) { break }
                }
            }

            // Fragments of a row whose first samples are covered, with normalised light on one colour; f is the function at the first one,
            // g its change to the next. `isPair` is a literal, for which the compiler is to make two functions. `continue` in place of
            // branches, at whose ends the compiler moves the stack.
            function span(p, end, attribute, f, g, isPair) {
                for {} 1 {
                    attribute := add(attribute, mload(DX)) // the next column
                    f := add(f, g)
                    g := add(g, mload(QUADRATIC_DXX))
                } {
                    let old := mload(p) // what is there
                    p := add(p, SAMPLE_SIZE) // the next pixel from here on
                    if and(old, IS_EDGE) {
                        atPixel(sub(p, SAMPLE_SIZE), attribute)
                        if eq(p, end) { break }
                        continue
                    }
                    let z := mul(shr(ACCUMULATOR_DEPTH_AT, attribute), mload(SAMPLE_SCALE)) // of the pixel centre
                    z := and(add(z, mload(WHOLE_OFFSETS)), SAMPLE_DEPTHS) // the depths of four samples
                    let seen := and(sub(add(z, BELOW_TOPS_64), old), TOPS_64) // nearer by at least one
                    if iszero(seen) {
                        if eq(p, end) { break }
                        continue
                    }
                    let color := mload(SAME_AMBIENT)
                    let t
                    switch isPair
                    case 0 { t := sar(N_DOT_L_Q53_AT, f) } // N.L, Q24
                    default { t := sar(LIGHT_AT, shl(LANE_1_TO_TOP, f)) }
                    if sgt(t, 0) {
                        color := add(color, mul(mload(SAME_DIFFUSE), t))
                        t := sar(LIGHT_AT, shl(LANE_0_TO_TOP, f)) // N.H, Q24
                        if sgt(t, mload(COSINE_BEGIN)) { color := add(color, shine(t, SHINE_TABLE)) }
                    }
                    if isPair {
                        t := sar(LIGHT_AT, f)
                        if sgt(t, 0) {
                            color := add(color, mul(mload(SAME_DIFFUSE_2), t))
                            t := sar(LIGHT_AT, shl(LANE_2_TO_TOP, f))
                            if sgt(t, mload(COSINE_BEGIN)) {
                                color := add(color, shine(t, add(SHINE_TABLE, SPECULAR_SIZE)))
                            }
                        }
                    }
                    if and(color, ABOVE_Q58) { color := clamped(color) }
                    color := mul(and(color, BYTES_Q58), Q58_TO_TOP)
                    z := or(z, mul(shr(PIXEL_AT, color), ONES_64)) // the colour in each sample
                    if xor(seen, TOPS_64) {
                        mix(sub(p, SAMPLE_SIZE), old, z, seen)
                        if eq(p, end) { break }
                        continue
                    }
                    mstore(sub(p, SAMPLE_SIZE), z)
                    mstore(0, color) // three bytes
                    mcopy(add(mload(ROW_IMAGE), mul(3, shr(SAMPLE_SIZE_BITS, sub(p, SAMPLE_SIZE)))), 0, 3)
                    if eq(p, end) { break }
                }
            }

            function attributeAt(c) -> attribute { attribute := add(mload(ROW_START), mul(c, mload(DX))) }

            function changeAt(c) -> g { g := add(mload(QUADRATIC_DX), mul(c, mload(QUADRATIC_DXX))) }

            function valueAt(c) -> f { // START + c DX + c (c - 1) / 2 DXX
                f := add(add(mload(QUADRATIC_START), mul(c, mload(QUADRATIC_DX))), mul(shr(1, mul(c, sub(c, 1))), mload(QUADRATIC_DXX)))
            }

            {
                // Everything refers to addresses in place of columns: with c = address / 32, the colour in a row is
                // START + c DX + c (c - 1) / 2 DXX. In the next row, the same address is ROW_COLUMNS columns to the right: see
                // Quadratic.setDifferences.
                let base := sub(mload(SAMPLE_ORIGIN), mul(row, mload(SAMPLE_STRIDE))) // of column 0
                let x := sar(SAMPLE_SIZE_BITS, base)
                mstore(ROW_IMAGE, sub(mload(SAMPLE_IMAGE), mul(3, add(mul(row, mload(TILE_WIDTH)), x))))
                let w := shr(SAMPLE_SIZE_BITS, mload(SAMPLE_STRIDE))
                mstore(ROW_COLUMNS, w)
                mstore(ROW_STEP_32, add(mload(DY), mul(w, mload(DX)))) // rows go up in memory
                mstore(ROW_START, sub(add(mload(START), mul(sub(row, mload(START_ROW)), mload(DY))), mul(x, mload(DX))))
                if mload(IS_CLAMPED) {
                    mstore(SPAN_BEGIN, add(base, shl(SAMPLE_SIZE_BITS, mload(SPAN_BEGIN)))) // base + 32 * column
                    mstore(SPAN_END, add(base, shl(SAMPLE_SIZE_BITS, mload(SPAN_END))))
                }
            }
            let left := mload(SIDE_LEFT)
            let right := mload(SIDE_RIGHT) // four columns each: see SampleRasterizer
            // plus or minus the first sample's column, these yield the bounds
            mstore(OUTER_LEFT, add(signextend(LANE_128_LAST_BYTE, mload(BOUNDS)), and(left, LANE_64)))
            mstore(OUTER_RIGHT, sub(sar(UPPER_BOUND_AT, mload(BOUNDS)), and(right, LANE_64)))
            // the rows above the row of the kink; the number of rows from that one on
            let rows := sub(last, row) // the number of rows
            last := sub(last, mload(KINK_ROW)) // last: the number of rows from the kink on
            if sgt(last, 0) { rows := sub(rows, last) }
            row := 1 // row: 1 above the kink, then 0
            for {} 1 {} {
                for {} rows { rows := sub(rows, 1) } {
                    // the pixels whose first sample is covered, and those of which any sample may be
                    let first := and(left, LANE_64)
                    let p := and(sar(ADDRESS_FRACTION, sub(mload(OUTER_LEFT), first)), WHOLE_SAMPLES)
                    first := and(sar(ADDRESS_FRACTION, sub(FIRST_SAMPLE_LEFT, first)), WHOLE_SAMPLES)
                    let behind := and(right, LANE_64)
                    let end := and(sar(ADDRESS_FRACTION, add(mload(OUTER_RIGHT), behind)), WHOLE_SAMPLES)
                    behind := and(sar(ADDRESS_FRACTION, sub(behind, FIRST_SAMPLE_RIGHT)), WHOLE_SAMPLES)
                    if mload(IS_CLAMPED) {
                        if slt(p, mload(SPAN_BEGIN)) { p := mload(SPAN_BEGIN) } // max
                        if slt(first, p) { first := p }
                        if sgt(end, mload(SPAN_END)) { end := mload(SPAN_END) } // min
                        if sgt(behind, end) { behind := end }
                        mstore(SPAN_BEGIN, sub(mload(SPAN_BEGIN), mload(SAMPLE_STRIDE)))
                        mstore(SPAN_END, sub(mload(SPAN_END), mload(SAMPLE_STRIDE)))
                    }
                    mstore(ROW_LEFT, left)
                    mstore(ROW_RIGHT, right)
                    switch slt(first, behind)
                    case 0 { if slt(p, end) { pixels(p, end, 0) } }
                    default {
                        if slt(p, first) { pixels(p, first, 0) }
                        p := shr(SAMPLE_SIZE_BITS, first) // c
                        let mode := mload(MODE)
                        switch eq(and(mode, or(IS_NORMALISED, IS_VARIED)), IS_NORMALISED)
                        case 0 { pixels(first, behind, 1) }
                        default {
                            switch and(mode, IS_PAIR)
                            case 0 { span(first, behind, attributeAt(p), valueAt(p), changeAt(p), 0) }
                            default { span(first, behind, attributeAt(p), valueAt(p), changeAt(p), 1) }
                        }
                        if slt(behind, end) { pixels(behind, end, 0) }
                    }
                    left := add(left, mload(SIDE_LEFT_STEP)) // the next row
                    right := add(right, mload(SIDE_RIGHT_STEP))
                    mstore(ROW_START, add(mload(ROW_START), mload(ROW_STEP_32)))
                    mstore(ROW_IMAGE, sub(mload(ROW_IMAGE), mload(ROW_IMAGE_STEP)))
                    mstore(QUADRATIC_START, add(mload(QUADRATIC_START), mload(QUADRATIC_DY)))
                    mstore(QUADRATIC_DY, add(mload(QUADRATIC_DY), mload(QUADRATIC_DYY)))
                    mstore(QUADRATIC_DX, add(mload(QUADRATIC_DX), mload(QUADRATIC_DXY)))
                }
                if slt(last, 1) { break }
                switch row
                case 0 {
                    // the rows below the kink
                    mstore(sub(add(mload(KINK_SIDE), SIDE_LEFT_STEP), SIDE_LEFT), mload(KINK_STEP)) // the step of that side
                    switch xor(mload(KINK_SIDE), SIDE_LEFT)
                    case 0 { mstore(OUTER_LEFT, add(mload(KINK_OUTER), and(left, LANE_64))) }
                    default { mstore(OUTER_RIGHT, sub(mload(KINK_OUTER), and(right, LANE_64))) }
                    rows := last // the rest
                    last := 0
                }
                default {
                    // the row of the kink is drawn separately, with samples on both edges; its step leads to the lower edge
                    row := 0 // the kink is drawn next
                    rows := 1 // it alone
                    last := sub(last, 1)
                    let mask := mload(KINK_MASK) // the samples below the kink
                    let edge := mload(KINK_EDGE) // the lower edge in this row
                    switch xor(mload(KINK_SIDE), SIDE_LEFT)
                    case 0 {
                        left := or(and(left, not(mask)), and(edge, mask)) // the edge in the lanes below the kink
                        mstore(SIDE_LEFT_STEP, sub(add(edge, mload(KINK_STEP)), left)) // to the edge in the next row
                        edge := signextend(LANE_128_LAST_BYTE, mload(KINK_BOUND)) // edge from here on: the bound
                        mstore(OUTER_LEFT, add(edge, and(left, LANE_64)))
                        mstore(KINK_OUTER, add(edge, signextend(LANE_128_LAST_BYTE, mload(KINK_BOUND_STEPS)))) // in the next row
                    }
                    default {
                        let bound := sar(UPPER_BOUND_AT, mload(KINK_BOUND))
                        // no edge below a horizontal one: that of the upper edge
                        if iszero(not(mload(KINK_KEPT))) { bound := add(mload(OUTER_RIGHT), and(right, LANE_64)) }
                        right := or(and(right, not(mask)), and(edge, mask))
                        mstore(SIDE_RIGHT_STEP, sub(add(edge, mload(KINK_STEP)), right))
                        edge := bound
                        mstore(OUTER_RIGHT, sub(edge, and(right, LANE_64)))
                        mstore(KINK_OUTER, add(edge, sar(UPPER_BOUND_AT, mload(KINK_BOUND_STEPS))))
                    }
                }
            }
        }
    }
}
