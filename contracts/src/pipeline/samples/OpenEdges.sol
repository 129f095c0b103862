// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import "../../words/SampleRegisters.sol";

// Finds the pixels in which `fill` of picture.py needs all four samples.
// Silhouettes, borders and creases of smooth objects: the edges that do not lie between two triangles which are drawn. Only pixels that
// such an edge touches need four samples: they are marked with IS_EDGE before anything is drawn. Every other pixel belongs, with all its
// samples, to the triangle that covers its first sample. Which rule holds is a property of the pixel, so in each of them the triangles of a
// surface neither overlap nor leave gaps.
//
// An edge from u to v is closed if another triangle has the edge from v to u. Vertex records keep the numbers of the next vertices of the
// triangles around, 16 bits each, above VERTEX_STATE. There is room for 13; of a vertex with more triangles, its other next vertices keep
// its number, in VERTEX_REVERSED, which is written later. An edge must not count as closed because of triangles elsewhere: in a tile these
// are not listed. Edges that clipping made are open, and those of triangles with such a vertex.

/// @dev A row of pixels in the format of screen words.
uint256 constant ONE_ROW = 1 << 136;

library OpenEdges {
    /// @notice Finds the open edges of the triangles of a list.
    /// @param end The end of the list, where the address of the edges is written.
    /// @param records The address of the vertex records, 2^shift bytes each; those that clipping made are behind the list.
    /// @param edges The first address that is free, where the end of the edges is written, or behind it, and the edges.
    /// @return The first free address.
    function find(uint256 list, uint256 end, uint256 records, uint256 shift, uint256 edges) internal pure returns (uint256) {
        uint256 made = list;
        assembly ("memory-safe") {
            // adds the number of v to those of u or, if there is no room, that of u to those at v
            function enter(u, v, first, bits) {
                let numbers := mload(add(u, VERTEX_STATE))
                switch shr(LAST_NUMBER_AT, numbers)
                case 0 { mstore(add(u, VERTEX_STATE), or(shl(NUMBER_BITS, numbers), shl(FIRST_NUMBER_AT, shr(bits, sub(v, first))))) }
                default {
                    v := add(v, VERTEX_REVERSED)
                    mstore(v, or(shl(NUMBER_BITS, mload(v)), shr(bits, sub(u, first))))
                }
            }

            // writes the edge from u to v if it is open: if the one from v to u is neither among the numbers of v nor among those at u
            function check(place, u, v, first, bits) -> next {
                next := xor(mload(add(v, VERTEX_STATE)), mul(shr(bits, sub(u, first)), NUMBER_ONES)) // a lane is 0 if it is that of u
                if iszero(and(and(sub(next, NUMBER_ONES), not(next)), NUMBER_TOPS)) {
                    let other := shr(bits, sub(v, first))
                    for { next := mload(add(u, VERTEX_REVERSED)) } next { next := shr(NUMBER_BITS, next) } {
                        if eq(and(next, VERTEX_NUMBER_MASK), other) { break }
                    }
                    if iszero(next) {
                        mstore(place, or(shl(TRIANGLE_A_AT, u), v))
                        place := add(place, 32)
                    }
                }
                next := place
            }

            records := sub(records, shl(shift, 1)) // numbers are counted from 1
            for { let triangle := list } lt(triangle, end) { triangle := add(triangle, 32) } {
                let c := mload(triangle)
                let a := and(shr(TRIANGLE_A_AT, c), TRIANGLE_A_MASK)
                let b := and(shr(TRIANGLE_B_AT, c), TRIANGLE_B_MASK)
                c := and(c, TRIANGLE_C_MASK)
                if and(and(lt(a, made), lt(b, made)), lt(c, made)) {
                    enter(a, b, records, shift)
                    enter(b, c, records, shift)
                    enter(c, a, records, shift)
                }
            }
            edges := add(edges, 32)
            let place := add(edges, 32)
            for {} lt(list, end) { list := add(list, 32) } {
                let c := mload(list)
                let a := and(shr(TRIANGLE_A_AT, c), TRIANGLE_A_MASK)
                let b := and(shr(TRIANGLE_B_AT, c), TRIANGLE_B_MASK)
                c := and(c, TRIANGLE_C_MASK)
                place := check(place, a, b, records, shift)
                place := check(place, b, c, records, shift)
                place := check(place, c, a, records, shift)
            }
            mstore(end, edges)
            mstore(edges, place)
            edges := place
        }
        return edges;
    }

    /// @notice Marks the pixels of the band whose samples the edges may separate.
    /// @param edges The end of the list: see `find`.
    function mark(uint256 edges) internal pure {
        assembly ("memory-safe") {
            // The pixels that a line touches, where u is the axis along which it is longer, columns if it `isFlat`, else rows: in each row
            // across that axis, those within OUTERMOST_SAMPLE of the line where it passes the samples of the row. Bounds are inclusive,
            // `stride` are those of addresses.
            function along(u, v, endU, endV, isFlat) {
                let leastU := mload(INNER_BEGIN)
                let mostU := mload(INNER_END)
                let leastV := mload(SAMPLE_BEGIN)
                let mostV := sub(mload(SAMPLE_END), 1)
                let strideU := sub(0, mload(SAMPLE_STRIDE))
                let strideV := SAMPLE_SIZE
                if isFlat {
                    mostV := mostU
                    leastV := leastU
                    leastU := mload(SAMPLE_BEGIN)
                    mostU := sub(mload(SAMPLE_END), 1)
                    strideV := strideU
                    strideU := SAMPLE_SIZE
                }
                if gt(u, endU) {
                    let swapped := u
                    u := endU
                    endU := swapped
                    swapped := v
                    v := endV
                    endV := swapped
                }
                let slope := 0
                if xor(u, endU) { slope := sdiv(shl(Q16, sub(endV, v)), sub(endU, u)) } // at most 1, Q16
                // the line at row 0, Q16
                let at0 := sub(shl(Q16, v), mul(slope, u))
                let reach := mul(OUTERMOST_SAMPLE, add(xor(slope, sar(SIGN_AT, slope)), add(ONE_16, 1))) // 3/8 pixel * (1 + |slope|)
                // the least and the greatest column with OUTERMOST_SAMPLE around it
                if gt(v, endV) {
                    let swapped := v
                    v := endV
                    endV := swapped
                }
                v := shl(Q16, sub(v, OUTERMOST_SAMPLE))
                endV := shl(Q16, add(endV, OUTERMOST_SAMPLE))
                u := shr(SUBPIXEL_BITS, add(u, sub(SUBPIXEL_MASK, OUTERMOST_SAMPLE)))
                endU := shr(SUBPIXEL_BITS, add(endU, OUTERMOST_SAMPLE))
                if lt(u, leastU) { u := leastU }
                if gt(endU, mostU) { endU := mostU }
                for {} iszero(gt(u, endU)) { u := add(u, 1) } {
                    let first := add(at0, mul(slope, shl(SUBPIXEL_BITS, u)))
                    let last := add(first, reach)
                    first := sub(first, reach)
                    if slt(first, v) { first := v }
                    if sgt(last, endV) { last := endV }
                    first := sar(SUBPIXEL_Q16_BITS, add(first, SUBPIXEL_Q16_MASK))
                    last := sar(SUBPIXEL_Q16_BITS, last)
                    if slt(first, leastV) { first := leastV }
                    if sgt(last, mostV) { last := mostV }
                    for {} iszero(sgt(first, last)) { first := add(first, 1) } {
                        let p := add(mload(SAMPLE_ORIGIN), add(mul(u, strideU), mul(first, strideV)))
                        mstore(p, or(mload(p), IS_EDGE))
                    }
                }
            }

            let least := mload(BAND_TOP)
            let most := mload(BAND_BOTTOM)
            if lt(least, mload(SAMPLE_TOP)) { least := mload(SAMPLE_TOP) }
            if gt(most, mload(SAMPLE_BOTTOM)) { most := mload(SAMPLE_BOTTOM) }
            if and(lt(least, most), lt(mload(SAMPLE_BEGIN), mload(SAMPLE_END))) {
                most := sub(most, 1)
                mstore(INNER_BEGIN, least)
                mstore(INNER_END, most)
                let above := shl(SCREEN_PIXEL_ROW_AT, least) // in the format of screen words; a pixel more than needed
                let below := shl(SCREEN_PIXEL_ROW_AT, add(most, 1))
                edges := mload(edges) // the address of the edges
                let end := mload(edges)
                for { edges := add(edges, 32) } lt(edges, end) { edges := add(edges, 32) } {
                    let a := mload(edges)
                    let b := mload(and(a, TRIANGLE_C_MASK)) // screen words
                    a := mload(shr(TRIANGLE_A_AT, a))
                    if and(or(gt(add(a, ONE_ROW), above), gt(add(b, ONE_ROW), above)), or(lt(a, below), lt(b, below))) {
                        let x := and(shr(SCREEN_COLUMN_AT, a), SCREEN_COLUMN_MASK)
                        let endX := and(shr(SCREEN_COLUMN_AT, b), SCREEN_COLUMN_MASK)
                        a := shr(SCREEN_ROW_AT, a) // a, b: the rows from here on
                        b := shr(SCREEN_ROW_AT, b)
                        let dx := sub(endX, x)
                        let dy := sub(b, a)
                        let isFlat := gt(mul(dx, dx), mul(dy, dy))
                        if isFlat {
                            dx := a // swaps the axes
                            a := x
                            x := dx
                            dx := b
                            b := endX
                            endX := dx
                        }
                        along(a, x, b, endX, isFlat)
                    }
                }
            }
        }
    }
}
