// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import "../../words/SampleRegisters.sol";

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

            // N * L of unit vectors and the square of the cosine to the half vector, both Q24, from products: see SmoothTriangle
            function lightOf(f) -> t, square {
                square := shr(UPPER_85_AT, f) // N.N, Q68
                t := add(shr(ROOT_SHIFT, mul(ROOT_SLOPE, square)), ROOT_AT_0) // about 2 sqrt(N.N), Q34
                let length := add(t, div(square, t)) // one step of Newton: 2 |N|
                t := sar(N_DOT_H_AT, shl(LOWER_85_TO_TOP, f)) // N.H
                t := mul(t, sgt(t, 0))
                square := div(mul(t, t), square) // cos^2 = (N.H)^2 / N.N
                t := sdiv(sar(N_DOT_L_AT, shl(MIDDLE_85_TO_TOP, f)), length) // N.L / |N|
            }

            // the highlight at the square of a cosine, Q24, above SPECULAR_BEGIN: lanes of 85 bits, Q58
            function shine(square) -> color {
                let t := mul(sub(square, mload(SPECULAR_BEGIN)), mload(SPECULAR_SCALE)) // an index, Q40
                if gt(t, SPECULAR_LAST) { t := SPECULAR_LAST } // min
                square := add(SHINE_TABLE, and(shr(SPECULAR_ENTRY_SHIFT, t), SPECULAR_ENTRY_MASK)) // square: the address of the entry
                color := mload(square)
                t := and(shr(SPECULAR_REST_AT, t), SPECULAR_REST_MASK) // the fraction, Q16
                color := add(shl(Q16, color), mul(sub(mload(add(square, 32)), color), t))
            }

            // a colour, Q10, times light, Q16, both in lanes of 56 bits: in lanes of 85 bits, Q26
            function times(color, light) -> lanes {
                lanes := mul(and(color, LANE_24), and(light, LANE_32))
                lanes := add(lanes, shl(MIDDLE_85_AT, mul(and(shr(MIDDLE_AT, color), LANE_24), and(shr(MIDDLE_AT, light), LANE_32))))
                lanes := add(lanes, shl(UPPER_85_AT, mul(and(shr(UPPER_AT, color), LANE_24), shr(UPPER_AT, light))))
            }

            // the colour of a fragment, Q58, with an accumulator and the function of the light
            function colorAt(attribute, f) -> color {
                let t := sar(N_DOT_L_Q72_AT, f) // N.L, Q24
                let square := sar(SHINE_AT, shl(LOWER_85_TO_TOP, f)) // (N.H)^2, Q24
                if iszero(and(mload(MODE), IS_NORMALISED)) { t, square := lightOf(f) }
                t := mul(t, sgt(t, 0)) // max(N.L, 0)
                switch and(mload(MODE), IS_VARIED)
                case 0 { color := add(mload(SAME_AMBIENT), mul(mload(SAME_DIFFUSE), t)) }
                default {
                    // light, lanes of Q16, times the colour of the accumulator, Q10
                    f := shr(Q40_TO_Q16, add(shl(Q40_TO_Q16, mload(AMBIENT)), mul(mload(add(LIGHTS, LIGHT_DIFFUSE)), t)))
                    color := add(HALF_85, shl(Q26_TO_Q58, times(and(shr(ACCUMULATOR_FRACTION, attribute), LANES_24), f)))
                }
                if and(gt(t, 0), sgt(square, mload(SPECULAR_BEGIN))) { color := add(color, shine(square)) }
            }

            // the lanes at the centroid of some samples; g is their change to the next column
            function atCentroid(f, g, covered, p) -> there {
                covered := and(shr(SET_AT, mul(shr(TOP_64_AT, covered), COVERED_TO_SET)), SET_MASK) // 16 * the number of the set
                let x := signextend(0, shr(add(8, covered), CENTROIDS))
                let y := signextend(0, shr(covered, CENTROIDS))
                // the differences to the next row at the same column: the next row at this address is w columns to the right
                covered := mload(ROW_COLUMNS) // covered: w
                let dxx := mload(QUADRATIC_DXX)
                let across := mul(covered, dxx) // w dxx
                p := shr(SAMPLE_SIZE_BITS, p) // p: c
                let dy := add(mload(QUADRATIC_DY), mul(p, mload(QUADRATIC_DXY))) // dy' + c dxy'
                p := sub(mload(QUADRATIC_DXY), across) // p: dxy = dxy' - w dxx
                // - w (g + dxy) - w (w - 1) / 2 dxx
                dy := sub(dy, add(mul(covered, add(g, p)), mul(shr(1, mul(covered, sub(covered, 1))), dxx)))
                across := sub(mload(QUADRATIC_DYY), mul(covered, add(shl(1, p), across))) // across: dyy = dyy' - w (2 dxy + w dxx)
                // With the forward differences d at the centre, and x and y in eighths of a pixel, the quadratic function is
                // f + (x dx + y dy) / 8 + (x (x - 8) dxx + 2 x y dxy + y (y - 8) dyy) / 128 there: exact, however thin the triangle
                dxx := add(mul(sub(x, 8), dxx), mul(shl(1, y), p)) // dxx: (x - 8) dxx + 2 y dxy
                there := add(shl(MORE_BITS, f), mul(x, add(shl(4, g), dxx))) // 128 f + x (16 dx + (x - 8) dxx + 2 y dxy)
                there := add(there, mul(y, add(shl(4, dy), mul(sub(y, 8), across)))) // + y (16 dy + (y - 8) dyy)
                // as before: positive for the shift
                there := add(there, LANES_BIAS_85)
                there := sub(and(shr(MORE_BITS, there), LANES_LESS_85), shr(MORE_BITS, LANES_BIAS_85))
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

            // draws a fragment in a pixel that an open edge touches
            function atEdge(p, attribute, f, g) {
                let covered := mul(p, ADDRESS_64) // the address in each lane, Q37
                covered := and(and(add(mload(ROW_LEFT), covered), sub(mload(ROW_RIGHT), covered)), TOPS_64)
                let old := mload(p)
                let z := mul(shr(ACCUMULATOR_DEPTH_AT, attribute), mload(SAMPLE_SCALE)) // of the pixel centre
                z := and(add(z, mload(DEPTH_OFFSETS)), SAMPLE_DEPTHS)
                let seen := and(sub(add(z, BELOW_TOPS_64), old), covered)
                if seen {
                    if xor(covered, TOPS_64) {
                        f := atCentroid(f, g, covered, p)
                        g := and(shr(SET_AT, mul(shr(TOP_64_AT, covered), COVERED_TO_SET)), SET_MASK) // 16 * the number of the set
                        attribute := add(attribute, mul(signextend(0, shr(add(8, g), CENTROIDS)), mload(DX_8))) // + x DX / 8 + y DY / 8
                        attribute := add(attribute, mul(signextend(0, shr(g, CENTROIDS)), mload(DY_8)))
                    }
                    f := colorAt(attribute, f)
                    if and(f, ABOVE_Q58) { f := clamped(f) }
                    f := mul(and(f, BYTES_Q58), Q58_TO_TOP)
                    z := or(or(z, IS_EDGE), mul(shr(PIXEL_AT, f), ONES_64))
                    switch xor(seen, TOPS_64)
                    case 0 {
                        mstore(p, z)
                        mstore(0, f) // three bytes
                        mcopy(add(mload(ROW_IMAGE), mul(3, shr(SAMPLE_SIZE_BITS, p))), 0, 3)
                    }
                    default { mix(p, old, z, seen) }
                }
            }

            // draws fragments of a row whose first samples are not covered
            function besides(p, end) {
                for {} 1 {} {
                    if and(mload(p), IS_EDGE) {
                        let c := shr(SAMPLE_SIZE_BITS, p)
                        atEdge(p, attributeAt(c), valueAt(c), changeAt(c))
                    }
                    p := add(p, SAMPLE_SIZE)
                    if iszero(slt(p, end)) { break }
                }
            }

            // Fragments of a row whose first samples are covered; f is the function at the first one, g its change to the next. `isPlain`
            // is a literal, for which the compiler is to make two functions: 1 for normalised light on one colour. `continue` in place of
            // branches, at whose ends the compiler moves the stack.
            function span(p, end, attribute, f, g, isPlain) {
                for {} 1 {
                    attribute := add(attribute, mload(DX)) // the next column
                    f := add(f, g)
                    g := add(g, mload(QUADRATIC_DXX))
                } {
                    let old := mload(p) // what is there
                    p := add(p, SAMPLE_SIZE) // the next pixel from here on
                    if and(old, IS_EDGE) {
                        atEdge(sub(p, SAMPLE_SIZE), attribute, f, g)
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
                    let color
                    switch isPlain
                    case 0 { color := colorAt(attribute, f) }
                    default {
                        color := mload(SAME_AMBIENT)
                        let t := sar(N_DOT_L_Q72_AT, f) // N.L, Q24
                        if sgt(t, 0) {
                            color := add(color, mul(mload(SAME_DIFFUSE), t))
                            t := sar(SHINE_AT, shl(LOWER_85_TO_TOP, f)) // (N.H)^2, Q24
                            if sgt(t, mload(SPECULAR_BEGIN)) { color := add(color, shine(t)) }
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
                    case 0 { if slt(p, end) { besides(p, end) } }
                    default {
                        if slt(p, first) { besides(p, first) }
                        p := shr(SAMPLE_SIZE_BITS, first) // c
                        switch and(mload(MODE), IS_NORMALISED)
                        case 0 { span(first, behind, attributeAt(p), valueAt(p), changeAt(p), 0) }
                        default { span(first, behind, attributeAt(p), valueAt(p), changeAt(p), 1) }
                        if slt(behind, end) { besides(behind, end) }
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
                        right := or(and(right, not(mask)), and(edge, mask))
                        mstore(SIDE_RIGHT_STEP, sub(add(edge, mload(KINK_STEP)), right))
                        edge := sar(UPPER_BOUND_AT, mload(KINK_BOUND))
                        mstore(OUTER_RIGHT, sub(edge, and(right, LANE_64)))
                        mstore(KINK_OUTER, add(edge, sar(UPPER_BOUND_AT, mload(KINK_BOUND_STEPS))))
                    }
                }
            }
        }
    }
}
