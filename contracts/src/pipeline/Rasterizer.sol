// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {FragmentShader, LANES_24} from "./FragmentShader.sol";
import {Shading} from "./Shading.sol";
import "./Registers.sol";

// From triangles to fragments, by a digital differential analyzer.
library Rasterizer {
    /// @notice Draws the triangles of a list into the current band.
    function run(uint256 list, uint256 end) internal pure {
        unchecked {
            (uint256 bandTop, uint256 bandBottom) = (load(BAND_TOP), load(BAND_BOTTOM));
            for (; list != end; list += 32) {
                uint256 word = load(list);
                uint256 top = (word >> 96) & 0xffff;
                uint256 bottom = (word >> 112) & 0xffff;
                if (top < bandTop) top = bandTop;
                if (bottom > bandBottom) bottom = bandBottom;
                if (top < bottom) triangle(word, top, bottom);
            }
        }
    }

    function triangle(uint256 word, uint256 top, uint256 bottom) private pure {
        unchecked {
            Shading.prepare(word);
            (uint256 edges, uint256 slopes, uint256 middle) = setUp(word, top);
            if (middle > bottom) middle = bottom;
            if (top < middle) fill(edges, slopes, load(START), top, middle);
            else middle = top;
            if (middle < bottom) {
                (edges, slopes) = lowerEdges(edges, slopes, word, top, middle);
                fill(edges, slopes, load(START) + load(DY) * (middle - top), middle, bottom);
            }
        }
    }

    /// @notice Draws the fragments between two edges, in the rows from `top` to before `bottom`.
    /// @param edges, slopes As `setUp` says.
    /// @param start The accumulator at column 0 of row `top`; DX and DY are its changes.
    function fill(uint256 edges, uint256 slopes, uint256 start, uint256 top, uint256 bottom) internal pure {
        uint256 mode = load(MODE);
        if (mode > IS_LINEAR) FragmentShader.shadeRows(edges, slopes, start, top, bottom);
        else if (mode == 0) rows(edges, slopes, start, top, bottom, 0);
        else rows(edges, slopes, start, top, bottom, 1);
    }

    /// @notice What changes linearly over a triangle, at row `top`. Stores the accumulator at column 0 (START) and its changes (DX, DY).
    /// @return edges The left edge, from the first vertex to the second, and the right one, from the first to the third: columns, Q48,
    /// such that the integer part is the first pixel whose centre is not left of the edge, in lanes of 128 bits.
    /// @return slopes Their change per row.
    /// @return middle The first row below the upper of the two lower vertices, where one edge ends and another begins.
    function setUp(uint256 word, uint256 top) private pure returns (uint256 edges, uint256 slopes, uint256 middle) {
        assembly ("memory-safe") {
            let a := mload(and(shr(64, word), 0xffffffff))
            let b := mload(and(shr(32, word), 0xffffffff))
            let c := mload(and(word, 0xffffffff))
            let x := and(shr(64, a), 0xfffff)
            a := shr(128, a)
            let xb := sub(and(shr(64, b), 0xfffff), x)
            let xc := sub(and(shr(64, c), 0xfffff), x)
            b := sub(shr(128, b), a)
            c := sub(shr(128, c), a)
            middle := b
            if lt(c, b) { middle := c }
            middle := shr(8, add(add(middle, a), 255))
            // from the first vertex to the centres of the row
            let y := sub(shl(8, top), a)

            slopes := sdiv(shl(48, xb), b)
            a := sdiv(shl(48, xc), c)
            edges := add(shl(40, x), 0xffffffffc000)
            edges := add(add(edges, sar(8, mul(y, slopes))), shl(128, add(edges, sar(8, mul(y, a)))))
            slopes := add(slopes, shl(128, a))

            // change of the barycentric coordinates per pixel, Q32
            a := sub(mul(xc, b), mul(xb, c))
            if and(mload(MODE), IS_DEEP) {
                // depths by themselves, Q32, for which barycentric coordinates are too coarse
                let z := shr(168, mload(ATTRIBUTE_0))
                let zb := sub(shr(168, mload(ATTRIBUTE_1)), z)
                let zc := sub(shr(168, mload(ATTRIBUTE_2)), z)
                let dy := sdiv(shl(40, sub(mul(zb, xc), mul(zc, xb))), a)
                zb := sdiv(shl(40, sub(mul(zc, b), mul(zb, c))), a)
                mstore(LANE_BIAS, add(mload(LANE_BIAS), shl(168, add(shl(32, z), sar(8, sub(mul(y, dy), mul(x, zb)))))))
                mstore(DX, shl(168, zb))
                mstore(DY, shl(168, dy))
                mstore(ATTRIBUTE_0, 0)
                mstore(ATTRIBUTE_1, shl(56, 1))
                mstore(ATTRIBUTE_2, 1)
            }
            xb := sdiv(shl(40, xb), a)
            xc := sdiv(shl(40, xc), a)
            b := sdiv(shl(40, b), a)
            c := sdiv(shl(40, c), a)
            a := mload(ATTRIBUTE_0)
            let deltaB := sub(mload(ATTRIBUTE_1), a)
            let deltaC := sub(mload(ATTRIBUTE_2), a)
            // from the first vertex to the centre of pixel 0 in row `top`
            a := add(add(shl(32, a), mload(LANE_BIAS)), mul(deltaB, sar(8, add(mul(y, xc), mul(x, c)))))
            mstore(START, sub(a, mul(deltaC, sar(8, add(mul(x, b), mul(y, xb))))))
            b := sub(mul(deltaC, b), mul(deltaB, c))
            c := sub(mul(deltaB, xc), mul(deltaC, xb))
            if and(mload(MODE), IS_DEEP) {
                b := add(b, mload(DX))
                c := add(c, mload(DY))
            }
            mstore(DX, b)
            mstore(DY, c)
        }
    }

    /// @notice The same at row `middle`, where the edge between b and c takes the place of the one that has ended.
    function lowerEdges(uint256 upper, uint256 upperSlopes, uint256 word, uint256 top, uint256 middle)
        private
        pure
        returns (uint256 edges, uint256 slopes)
    {
        assembly ("memory-safe") {
            edges := add(upper, mul(upperSlopes, sub(middle, top)))
            let b := mload(and(shr(32, word), 0xffffffff))
            let c := mload(and(word, 0xffffffff))
            let side := 0
            if lt(c, b) {
                side := 128
                let t := b
                b := c
                c := t
            }
            upper := and(shr(64, b), 0xfffff)
            b := shr(128, b)
            let slope := sdiv(shl(48, sub(and(shr(64, c), 0xfffff), upper)), sub(shr(128, c), b))
            upper := add(add(shl(40, upper), 0xffffffffc000), sar(8, mul(sub(shl(8, middle), b), slope)))
            // keep the lane of the other edge
            b := signextend(15, upperSlopes)
            switch side
            case 0 {
                edges := or(shl(128, shr(128, edges)), upper)
                slopes := add(sub(upperSlopes, b), slope)
            }
            default {
                edges := or(and(edges, 0xffffffffffffffffffffffffffffffff), shl(128, upper))
                slopes := add(b, shl(128, slope))
            }
        }
    }

    /// @param saturate 1 if colours may be above 255, else 0; a literal, of which the compiler makes two functions.
    function rows(uint256 edges, uint256 slopes, uint256 start, uint256 row, uint256 end, uint256 saturate) private pure {
        assembly ("memory-safe") {
            row := sub(mload(DEPTH_ORIGIN), mul(mload(DEPTH_STRIDE), row))
            end := sub(mload(DEPTH_ORIGIN), mul(mload(DEPTH_STRIDE), end))
            let dx := mload(DX)
            for {} sgt(row, end) {} {
                let p := and(shr(48, edges), 0xffff)
                if lt(p, shr(176, edges)) {
                    let attribute := add(start, mul(dx, p))
                    p := add(row, shl(3, p))
                    let last := add(row, shl(3, shr(176, edges)))
                    let pixel := add(mload(IMAGE_ORIGIN), mul(3, shr(3, p)))
                    for {} 1 {} {
                        let old := mload(p)
                        if gt(attribute, or(old, 0xffffffffffffffffffffffffffffffffffffffffffffffff)) {
                            mstore(p, xor(old, and(xor(old, attribute), 0xffffffffffffffff000000000000000000000000000000000000000000000000)))
                            switch saturate
                            case 0 {
                                old := mload(pixel)
                                mstore(pixel, xor(old, and(xor(old, mul(and(attribute, 0x3fc000000000003fc000000000003fc0000000000), 0x4000000000000000400000000000000040000000000000000000)), 0xffffff0000000000000000000000000000000000000000000000000000000000)))
                            }
                            default {
                                // lanes above 255 get all the bits of 255
                                let color := and(shr(32, attribute), LANES_24)
                                color := or(color, mul(and(shr(30, add(color, 0x3ffc00000000003ffc00000000003ffc0000)), ONES), 0x3fc00))
                                color := mul(and(color, 0x3fc000000000003fc000000000003fc00), 0x400000000000000040000000000000004000000000000000000000000000)
                                old := mload(pixel)
                                mstore(pixel, xor(old, and(xor(old, color), 0xffffff0000000000000000000000000000000000000000000000000000000000)))
                            }
                        }
                        p := add(p, 8)
                        if eq(p, last) { break }
                        pixel := add(pixel, 3)
                        attribute := add(attribute, dx)
                    }
                }
                edges := add(edges, slopes)
                start := add(start, mload(DY))
                row := sub(row, mload(DEPTH_STRIDE))
            }
        }
    }
}
