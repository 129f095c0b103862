// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import "../../words/Registers.sol";

// Rows of fragments whose colours are one quadratic function over a triangle: see Quadratic. For triangles of few fragments, of which most
// rows are short; PatchSpans draws eight at a time.

library QuadraticSpans {
    /// @notice Draws the fragments of a triangle: see PixelRasterizer.drawParts.
    function drawParts(uint256 edges, uint256 rows, uint256 row) internal pure {
        assembly ("memory-safe") {
            // the highlight of a lamp at a square of a cosine, Q24, above SPECULAR_BEGIN: lanes of 85 bits, Q58
            function shine(t, record) -> color {
                t := mul(sub(t, mload(SPECULAR_BEGIN)), mload(SPECULAR_SCALE)) // an index into the table, Q40
                if gt(t, SPECULAR_LAST) { t := SPECULAR_LAST } // min
                let entry := mload(add(SPECULAR_TABLE, and(shr(SPECULAR_ENTRY_SHIFT, t), SPECULAR_ENTRY_MASK))) // table[t]
                entry := add( // value + increase * fraction of the index, Q16
                    shr(SPECULAR_VALUE_AT, entry),
                    shr(Q16, mul(and(entry, LANE_32), and(shr(SPECULAR_REST_AT, t), SPECULAR_REST_MASK)))
                )
                t := mul(mload(add(record, LIGHT_COLOR)), entry) // colour * highlight
                entry := or(shl(MIDDLE_56_TO_85, and(t, MIDDLE_LANE_24)), shl(UPPER_56_TO_85, and(t, UPPER_LANE_24)))
                color := shl(SHINE_TO_Q58, or(and(t, LANE_24), entry))
            }

            // the same of the first lamp, by a table of its own
            function shineOfFirst(t) -> color {
                t := mul(sub(t, mload(SPECULAR_BEGIN)), mload(SPECULAR_SCALE)) // an index, Q40
                if gt(t, SPECULAR_LAST) { t := SPECULAR_LAST } // min
                let place := add(SHINE_TABLE, and(shr(SPECULAR_ENTRY_SHIFT, t), SPECULAR_ENTRY_MASK))
                color := mload(place)
                t := and(shr(SPECULAR_REST_AT, t), SPECULAR_REST_MASK) // the fraction, Q16
                color := add(shl(Q16, color), mul(sub(mload(add(place, 32)), color), t))
            }

            // the light of a lamp, f, on a colour: what it adds per unit of N * L is `diffuse`, Q34; lanes of 85 bits, Q58
            function lit(f, diffuse, record) -> color {
                let t := sar(N_DOT_L_Q72_AT, f) // N.L, Q24
                if sgt(t, 0) {
                    color := mul(diffuse, t)
                    t := sar(SHINE_AT, shl(LOWER_85_TO_TOP, f)) // (N.H)^2, Q24
                    if sgt(t, mload(SPECULAR_BEGIN)) { color := add(color, shine(t, record)) }
                }
            }

            // the light of two lamps, the second only if it is there, on the colours of an accumulator
            function varied(attribute, f, h) -> color {
                attribute := shr(ACCUMULATOR_FRACTION, attribute) // lanes of Q10
                color := add(HALF_85, shl(Q26_TO_Q58, times(attribute, mload(AMBIENT))))
                color := add(color, lit(f, shl(Q26_TO_Q34, times(attribute, mload(add(LIGHTS, LIGHT_DIFFUSE)))), LIGHTS))
                if and(mload(MODE), IS_TWICE_LIT) {
                    f := add(LIGHTS, LIGHT_SIZE)
                    color := add(color, lit(h, shl(Q26_TO_Q34, times(attribute, mload(add(f, LIGHT_DIFFUSE)))), f))
                }
            }

            // a colour, Q10, times light, Q16, both in lanes of 56 bits: in lanes of 85 bits, Q26
            function times(color, light) -> lanes {
                lanes := mul(and(color, LANE_24), and(light, LANE_32))
                lanes := add(lanes, shl(MIDDLE_85_AT, mul(and(shr(MIDDLE_AT, color), LANE_24), and(shr(MIDDLE_AT, light), LANE_32))))
                lanes := add(lanes, shl(UPPER_85_AT, mul(and(shr(UPPER_AT, color), LANE_24), shr(UPPER_AT, light))))
            }

            // the colour of a fragment
            function colorAt(attribute, f, h) -> color {
                if and(mload(MODE), IS_VARIED) {
                    color := varied(attribute, f, h)
                    leave
                }
                color := add(mload(SAME_AMBIENT), lit(f, mload(SAME_DIFFUSE), LIGHTS))
                if and(mload(MODE), IS_TWICE_LIT) { color := add(color, lit(h, mload(SAME_DIFFUSE_2), add(LIGHTS, LIGHT_SIZE))) }
            }

            // Fragments of a row: f is the colour at the first one, g its change to the next. A function of its own, since all variables
            // together do not fit the stack. h and k are the same of the second function, if it `twice`: a literal, for which the compiler is
            // to make two functions.
            function span(p, end, attribute, f, g, h, k, isPlain) {
                let pixel := add(mload(IMAGE_ORIGIN), mul(3, shr(DEPTH_SIZE_BITS, p))) // IMAGE_ORIGIN + 3 * (p / 8)
                for {} 1 {
                    pixel := add(pixel, 3)
                    attribute := add(attribute, mload(DX)) // the next pixel
                    f := add(f, g) // forward differences
                    g := add(g, mload(QUADRATIC_DXX))
                    if iszero(isPlain) {
                        h := add(h, k)
                        k := add(k, mload(SECOND_DXX))
                    }
                } {
                    if gt(attribute, or(mload(p), BEHIND_DEPTH)) { // depth > the one in the buffer
                        // copying a few bytes is cheaper than inserting them into a word
                        mstore(0, attribute) // depth uppermost
                        mcopy(p, 0, 8)
                        let color
                        switch isPlain
                        case 1 {
                            color := mload(SAME_AMBIENT)
                            let t := sar(N_DOT_L_Q72_AT, f) // N.L, Q24
                            if sgt(t, 0) {
                                color := add(color, mul(mload(SAME_DIFFUSE), t))
                                t := sar(SHINE_AT, shl(LOWER_85_TO_TOP, f)) // (N.H)^2, Q24
                                if sgt(t, mload(SPECULAR_BEGIN)) { color := add(color, shineOfFirst(t)) }
                            }
                        }
                        default { color := colorAt(attribute, f, h) }
                        if and(color, ABOVE_Q58) {
                            let beyond := and(add(and(color, ABOVE_Q58), ABOVE_Q58), CARRIES_85) // 1 above each lane below 0 or above 255
                            beyond := or(color, mul(shr(CARRY_85, beyond), BYTE_Q58)) // 255 there
                            color := and(beyond, not(mul(shr(SIGN_85, and(color, SIGNS_85)), BYTE_Q58))) // 0 where negative
                        }
                        mstore(0, mul(and(color, BYTES_Q58), Q58_TO_TOP)) // blue, green, red at the top
                        mcopy(pixel, 0, 3)
                    }
                    p := add(p, 8)
                    if eq(p, end) { break } // do .. while (p != end)
                }
            }

            function spanOfBoth(p, end, attribute, f, g, x) {
                span(
                    p,
                    end,
                    attribute,
                    f,
                    g,
                    add(add(mload(SECOND_START), mul(x, mload(SECOND_DX))), mul(shr(1, mul(x, sub(x, 1))), mload(SECOND_DXX))),
                    add(mload(SECOND_DX), mul(x, mload(SECOND_DXX))),
                    0
                )
            }

            let crosses := and(mload(MODE), CROSSES_COLUMNS_OR_ROWS)
            // START is relative to column 0; make it relative to address 0
            let start := sub(mload(START), mul(mload(DX_8), row))
            mstore(DX, shl(DEPTH_SIZE_BITS, mload(DX_8))) // 8 DX_8
            mstore(ROW_STEP, add(mload(DY), mul(mload(DX_8), mload(DEPTH_STRIDE)))) // a row down, from the same address
            let f := mload(QUADRATIC_START) // the colours at column 0 of the row
            let down := mload(QUADRATIC_DY) // their change to the next row
            for {} 1 {} {
                if crosses {
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
                for {} rows { rows := sub(rows, 1) } {
                    let p := and(shr(EDGE_ADDRESS_FRACTION, edges), ADDRESS) // the first pixel
                    let end := and(shr(EDGE_RIGHT_ADDRESS_AT, edges), ADDRESS) // the one after the last
                    if crosses {
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
                        let x := shr(DEPTH_SIZE_BITS, sub(p, row)) // the column
                        let value := add(add(f, mul(x, mload(QUADRATIC_DX))), mul(shr(1, mul(x, sub(x, 1))), mload(QUADRATIC_DXX)))
                        let g := add(mload(QUADRATIC_DX), mul(x, mload(QUADRATIC_DXX)))
                        switch and(mload(MODE), or(IS_VARIED, IS_TWICE_LIT))
                        case 0 { span(p, end, add(start, mul(mload(DX_8), p)), value, g, 0, 0, 1) }
                        default { spanOfBoth(p, end, add(start, mul(mload(DX_8), p)), value, g, x) }
                    }
                    edges := add(edges, mload(SLOPES)) // the next row
                    start := add(start, mload(ROW_STEP))
                    row := sub(row, mload(DEPTH_STRIDE))
                    f := add(f, down) // forward differences
                    down := add(down, mload(QUADRATIC_DYY))
                    mstore(QUADRATIC_DX, add(mload(QUADRATIC_DX), mload(QUADRATIC_DXY)))
                    if and(mload(MODE), IS_TWICE_LIT) {
                        mstore(SECOND_START, add(mload(SECOND_START), mload(SECOND_DY)))
                        mstore(SECOND_DY, add(mload(SECOND_DY), mload(SECOND_DYY)))
                        mstore(SECOND_DX, add(mload(SECOND_DX), mload(SECOND_DXY)))
                    }
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
