// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {sqrt} from "../math/Roots.sol";
import "./Registers.sol";

// From fragments to pixels: depth test, perspective-correct attributes, Blinn-Phong. The colour of a fragment depends on its
// triangle and its place only, never on what was drawn before or on the tile, so that tiles equal the whole picture.

// A literal of 40 hexadecimal digits would be an address, hence the zeros in front of some.
uint256 constant LANES_24 = 0xffffff00000000ffffff00000000ffffff;
uint256 constant LANES_32 = 0xffffffff000000ffffffff000000ffffffff;
uint256 constant HALF_LEVEL = 0x2000000000000020000000000000200;

/// @dev What is set in lanes of Q10 above 255.
uint256 constant OVERFLOW = 0xfc000000000000fc000000000000fc0000;

/// @dev Keeps colours (Q34) positive, whatever the weights are, by a bit that is looked at and taken away. It stands above the brightest
/// that a flat face may have before its highlights, 20 * 255 levels, at three corners.
uint256 constant WEIGHTED_BIAS = 0x010000000400000100000004000001000000040000;

uint256 constant LINE_BIAS = 0x000002000000000002000000000000020000000000;

/// @dev Half the range of a lane of 85 bits, for vectors of Q20 and their sums of Q36.
uint256 constant VECTOR_BIAS = 0x100000000000000000000080000000000000000000040000000;
uint256 constant NORMAL_BIAS = 0x10000000000000000000008000000000000000000004000000000;

library FragmentShader {
    /// @notice Shades the fragments of the rows from `row` to before `last`, between two edges.
    /// @param start Depth and colour, or depth and barycentric coordinates, at column 0; DX and DY are their changes.
    function shadeRows(uint256 edges, uint256 slopes, uint256 start, uint256 row, uint256 last) internal pure {
        assembly ("memory-safe") {
            // ---- square roots ----

            // sqrt(value), where `hint` remembers the magnitude of the last one, so that it need not be found again
            function root(value, hint) -> r {
                let h := mload(hint)
                if gt(sub(shr(shl(1, h), value), 1), 2) {
                    // as in Roots.sol: the search of solady's LibBit
                    h := shl(7, lt(0xffffffffffffffffffffffffffffffff, value))
                    h := or(h, shl(6, lt(0xffffffffffffffff, shr(h, value))))
                    h := or(h, shl(5, lt(0xffffffff, shr(h, value))))
                    h := or(h, shl(4, lt(0xffff, shr(h, value))))
                    h := or(h, shl(3, lt(0xff, shr(h, value))))
                    h := or(h, shl(2, lt(0xf, shr(h, value))))
                    h := shr(1, or(h, shl(1, lt(0x3, shr(h, value)))))
                    mstore(hint, h)
                }
                r := shr(10, mul(351, add(shr(h, value), shl(h, 2))))
                r := shr(1, add(r, div(value, r)))
                r := shr(1, add(r, div(value, r)))
            }

            // length of the ray (x, y, 1)
            function rayLength(x, y) -> length {
                x := add(add(mul(x, x), mul(y, y)), 0x1000000000000)
                length := add(mload(LENGTH_AT_0), shr(48, mul(x, mload(LENGTH_SLOPE))))
                length := shr(1, add(length, div(x, length)))
                for { let steps := mload(LENGTH_STEPS) } steps { steps := sub(steps, 1) } {
                    length := shr(1, add(length, div(x, length)))
                }
            }

            // ---- light ----

            // the highlight, Q16, from the square of its cosine, Q24
            function gloss(square) -> value {
                switch gt(square, mload(SPECULAR_BEGIN))
                case 0 {
                    if mload(SPECULAR_ROOT) {
                        if gt(square, 0x1000000) { square := 0x1000000 }
                        value := shr(24, mul(mload(SPECULAR_ROOT), root(shl(24, square), NORMAL_HINT)))
                    }
                }
                default {
                    square := mul(sub(square, mload(SPECULAR_BEGIN)), mload(SPECULAR_SCALE))
                    if gt(square, 0x400000000000) { square := 0x400000000000 }
                    value := mload(add(SPECULAR_TABLE, and(shr(35, square), 0xffffe0)))
                    value := add(shr(128, value), shr(16, mul(and(value, 0xffffffff), and(shr(24, square), 0xffff))))
                }
            }

            function highlights(depth, x, y) -> sum {
                let length := rayLength(x, y)
                // normal * ray
                depth := add(mload(FACE_FACING), sar(95, mul(mload(FACE_FACING_SLOPE), depth)))
                for { let record := LIGHTS } 1 {} {
                    if sgt(mload(add(record, LIGHT_FACING)), 0) {
                        let half := sub(mul(mload(add(record, LIGHT_FACING)), length), depth)
                        if sgt(half, 0) {
                            let lightRay := add(add(mul(mload(add(record, LIGHT_X)), x), mul(mload(add(record, LIGHT_Y)), y)), shl(24, mload(add(record, LIGHT_Z))))
                            sum := add(sum, mul(mload(add(record, LIGHT_COLOR)), gloss(div(mul(half, half), mul(shl(1, length), sub(shl(24, length), lightRay))))))
                        }
                    }
                    record := add(record, LIGHT_SIZE)
                    if eq(record, mload(LIGHTS_END)) { break }
                }
                sum := and(shr(6, sum), LANES_24)
            }

            function light(depth, x, y) -> sum {
                let length := rayLength(x, y)
                mstore(FRAGMENT_LIGHT, shl(24, mload(FACE_LIGHT)))
                for { let record := LIGHTS } 1 {} {
                    let lx := mload(add(record, LIGHT_X))
                    let ly := mload(add(record, LIGHT_Y))
                    let lz := mload(add(record, LIGHT_Z))
                    let distance := 0x1000000
                    if mload(add(record, LIGHT_IS_POINT)) {
                        // from the fragment to the light, Q16
                        distance := div(shl(8, mload(DEPTH_SCALE)), depth)
                        switch and(mload(MODE), IS_ORTHOGRAPHIC)
                        case 0 {
                            lx := sub(lx, sar(40, mul(x, distance)))
                            ly := sub(ly, sar(40, mul(y, distance)))
                            lz := sub(lz, shr(16, distance))
                        }
                        default {
                            lx := sub(lx, mload(FRAGMENT_PLACE_X))
                            ly := sub(ly, mload(FRAGMENT_PLACE_Y))
                            lz := sub(lz, sar(16, sub(shl(8, mload(DEPTH_SCALE)), depth)))
                        }
                        distance := root(add(add(mul(lx, lx), mul(ly, ly)), mul(lz, lz)), add(record, LIGHT_HINT))
                    }
                    let facing
                    switch and(mload(MODE), IS_SMOOTH)
                    case 0 { facing := shl(24, mload(add(record, LIGHT_FACING))) }
                    default { facing := add(add(mul(mload(FRAGMENT_NORMAL_X), lx), mul(mload(FRAGMENT_NORMAL_Y), ly)), mul(mload(FRAGMENT_NORMAL_Z), lz)) }
                    if sgt(facing, 0) {
                        mstore(FRAGMENT_LIGHT, add(mload(FRAGMENT_LIGHT), mul(mload(add(record, LIGHT_DIFFUSE)), div(shl(24, facing), mul(distance, mload(FRAGMENT_NORMAL_LENGTH))))))
                        facing := sub(mul(facing, length), mul(distance, mload(FRAGMENT_NORMAL_RAY)))
                        if sgt(facing, 0) {
                            // light * ray
                            lx := add(add(mul(lx, x), mul(ly, y)), shl(24, lz))
                            lx := mul(mul(distance, shl(1, length)), sub(mul(distance, length), lx))
                            sum := add(sum, mul(mload(add(record, LIGHT_COLOR)), gloss(div(shl(24, mul(facing, facing)), mul(mload(FRAGMENT_SQUARE), lx)))))
                        }
                    }
                    record := add(record, LIGHT_SIZE)
                    if eq(record, mload(LIGHTS_END)) { break }
                }
                sum := and(shr(6, sum), LANES_24)
            }

            // lanes of Q10 times lanes of Q40
            function modulated(color, factor) -> product {
                factor := and(shr(24, factor), LANES_32)
                product := and(factor, 0xffffffff)
                switch eq(factor, mul(product, ONES))
                case 1 { product := and(shr(16, mul(color, product)), LANES_24) }
                default {
                    product := shr(16, mul(product, and(color, 0xffffff)))
                    product := or(product, shl(56, shr(16, mul(and(shr(56, factor), 0xffffffff), and(shr(56, color), 0xffffff)))))
                    product := or(product, shl(112, shr(16, mul(shr(112, factor), shr(112, color)))))
                }
            }

            // the normal at a fragment, Q24, between those of the vertices
            function interpolateNormal(second, third, x, y) {
                third := add(add(add(mload(NORMALS_0), mul(mload(NORMALS_1), shr(8, second))), mul(mload(NORMALS_2), shr(8, third))), NORMAL_BIAS)
                second := sub(and(shr(12, third), 0x7ffffff), 0x4000000)
                mstore(FRAGMENT_NORMAL_X, second)
                let square := mul(second, second)
                x := mul(second, x)
                second := sub(and(shr(97, third), 0x7ffffff), 0x4000000)
                mstore(FRAGMENT_NORMAL_Y, second)
                square := add(square, mul(second, second))
                x := add(x, mul(second, y))
                second := sub(shr(182, third), 0x4000000)
                mstore(FRAGMENT_NORMAL_Z, second)
                square := add(square, mul(second, second))
                mstore(FRAGMENT_NORMAL_RAY, add(x, shl(24, second)))
                mstore(FRAGMENT_SQUARE, square)
                mstore(FRAGMENT_NORMAL_LENGTH, root(square, NORMAL_HINT))
            }

            // the colour of a fragment of known barycentric coordinates, lanes of Q10
            function shade(attribute, x, y) -> color {
                let mode := mload(MODE)
                let second := and(shr(64, attribute), 0xffffffffffff)
                let third := and(shr(8, attribute), 0xffffffffffff)
                attribute := shr(192, attribute)
                switch and(mode, IS_ORTHOGRAPHIC)
                case 0 {
                    second := div(mul(second, mload(DEPTH_1)), attribute)
                    third := div(mul(third, mload(DEPTH_2)), attribute)
                    if and(mode, IS_STEEP) {
                        // rounding counts much where a near vertex meets a far fragment
                        if gt(second, 0x1000000) { second := 0x1000000 }
                        if gt(third, 0x1000000) { third := 0x1000000 }
                    }
                }
                default {
                    mstore(FRAGMENT_PLACE_X, sar(16, x))
                    mstore(FRAGMENT_PLACE_Y, sar(16, y))
                    x := 0
                    y := 0
                }
                color := shr(24, add(add(mload(COLOR_0), mul(mload(COLOR_1), second)), mul(mload(COLOR_2), third)))
                // lanes that were rounded below zero have lost the bit of the bias
                color := and(color, mul(and(shr(24, color), ONES), 0xffffff))
                switch and(mode, IS_DIFFUSE)
                case 0 {
                    if and(mode, IS_LIT) { color := add(color, highlights(attribute, x, y)) }
                }
                default {
                    switch and(mode, IS_SMOOTH)
                    case 0 { mstore(FRAGMENT_NORMAL_RAY, add(mload(FACE_FACING), sar(95, mul(mload(FACE_FACING_SLOPE), attribute)))) }
                    default { interpolateNormal(second, third, x, y) }
                    attribute := light(attribute, x, y)
                    color := add(modulated(color, mload(FRAGMENT_LIGHT)), attribute)
                }
            }

            // ---- pixels ----

            // lanes of Q10 as the bytes blue, green, red at the top of a word; what is below them has no meaning
            function pack(color) -> packed {
                // lanes above 255 get all the bits of 255
                if and(color, OVERFLOW) { color := or(color, mul(and(shr(30, add(color, 0x3ffc00000000003ffc00000000003ffc0000)), ONES), 0x3fc00)) }
                packed := mul(and(color, 0x3fc000000000003fc000000000003fc00), 0x400000000000000040000000000000004000000000000000000000000000)
            }

            // colours that change linearly
            function gradient(base, first, end, attribute, step) {
                if lt(first, mload(COLUMN_BEGIN)) {
                    attribute := add(attribute, mul(step, sub(mload(COLUMN_BEGIN), first)))
                    first := mload(COLUMN_BEGIN)
                }
                if gt(end, mload(COLUMN_END)) { end := mload(COLUMN_END) }
                if lt(first, end) {
                    first := add(base, shl(3, first))
                    end := add(base, shl(3, end))
                    base := add(mload(IMAGE_ORIGIN), mul(3, shr(3, first)))
                    for {} 1 {} {
                        let old := mload(first)
                        if gt(attribute, or(old, 0xffffffffffffffffffffffffffffffffffffffffffffffff)) {
                            mstore(first, xor(old, and(xor(old, attribute), 0xffffffffffffffff000000000000000000000000000000000000000000000000)))
                            let color := and(shr(32, attribute), LANES_24)
                            color := or(color, mul(and(shr(30, add(color, 0x3ffc00000000003ffc00000000003ffc0000)), ONES), 0x3fc00))
                            color := mul(and(color, 0x3fc000000000003fc000000000003fc00), 0x400000000000000040000000000000004000000000000000000000000000)
                            old := mload(base)
                            mstore(base, xor(old, and(xor(old, color), 0xffffff0000000000000000000000000000000000000000000000000000000000)))
                        }
                        first := add(first, 8)
                        if eq(first, end) { break }
                        base := add(base, 3)
                        attribute := add(attribute, step)
                    }
                }
            }

            // every fragment for itself
            function exact(p, end, attribute, x, y) {
                for {} 1 {} {
                    let old := mload(p)
                    if gt(attribute, or(old, 0xffffffffffffffffffffffffffffffffffffffffffffffff)) {
                        mstore(p, xor(old, and(xor(old, attribute), 0xffffffffffffffff000000000000000000000000000000000000000000000000)))
                        let color := pack(add(shade(attribute, x, y), HALF_LEVEL))
                        let pixel := add(mload(IMAGE_ORIGIN), mul(3, shr(3, p)))
                        old := mload(pixel)
                        mstore(pixel, xor(old, and(xor(old, color), 0xffffff0000000000000000000000000000000000000000000000000000000000)))
                    }
                    p := add(p, 8)
                    if eq(p, end) { break }
                    attribute := add(attribute, mload(DX))
                    x := add(x, mload(RAY_STEP))
                }
            }

            // every fragment for itself, with the vectors to light and eye interpolated from the vertices
            function varying(p, end, attribute) {
                for {} 1 {} {
                    let old := mload(p)
                    if gt(attribute, or(old, 0xffffffffffffffffffffffffffffffffffffffffffffffff)) {
                        mstore(p, xor(old, and(xor(old, attribute), 0xffffffffffffffff000000000000000000000000000000000000000000000000)))
                        // barycentric coordinates, Q16
                        let s := and(shr(72, attribute), 0xffffffffff)
                        let t := and(shr(16, attribute), 0xffffffffff)
                        if and(mload(MODE), IS_STEEP) {
                            s := div(mul(s, mload(DEPTH_1)), shr(192, attribute))
                            t := div(mul(t, mload(DEPTH_2)), shr(192, attribute))
                        }
                        let n := add(add(mload(NORMALS_0), mul(mload(NORMALS_1), s)), mul(mload(NORMALS_2), t))
                        let square := add(add(mload(REVERSED_0), mul(mload(REVERSED_1), s)), mul(mload(REVERSED_2), t))
                        square := sar(171, shl(1, mul(n, square)))
                        // twice the root, by a line that is within 3 % of it from 1/4 to 1, and one step of Newton's method
                        let length := add(shr(46, mul(702, square)), 23570660229)
                        length := add(length, div(square, length))
                        let factor := mload(FACE_LIGHT_40)
                        let sum := 0
                        // normal * light
                        old := add(add(mload(TO_LIGHT_0), mul(mload(TO_LIGHT_1), s)), mul(mload(TO_LIGHT_2), t))
                        old := sar(171, shl(1, mul(n, old)))
                        if sgt(old, 0) {
                            factor := add(factor, mul(mload(add(LIGHTS, LIGHT_DIFFUSE)), div(old, shl(11, length))))
                            let half := add(add(mload(HALF_REVERSED_0), mul(mload(HALF_REVERSED_1), s)), mul(mload(HALF_REVERSED_2), t))
                            old := sar(171, shl(1, mul(n, half)))
                            if sgt(old, 0) {
                                half := mul(half, add(add(mload(HALF_0), mul(mload(HALF_1), s)), mul(mload(HALF_2), t)))
                                old := div(shl(24, mul(old, old)), mul(square, sar(171, shl(1, half))))
                                if gt(old, mload(SPECULAR_BEGIN)) {
                                    old := mul(sub(old, mload(SPECULAR_BEGIN)), mload(SPECULAR_SCALE))
                                    if gt(old, 0x400000000000) { old := 0x400000000000 }
                                    half := mload(add(SPECULAR_TABLE, and(shr(35, old), 0xffffe0)))
                                    half := add(shr(128, half), shr(16, mul(and(half, 0xffffffff), and(shr(24, old), 0xffff))))
                                    sum := and(shr(6, mul(mload(add(LIGHTS, LIGHT_COLOR)), half)), LANES_24)
                                }
                            }
                        }
                        n := shr(16, add(add(mload(COLOR_0), mul(mload(COLOR_1), s)), mul(mload(COLOR_2), t)))
                        switch and(mload(MODE), IS_GREY)
                        case 0 { n := modulated(and(n, LANES_24), factor) }
                        default { n := and(shr(16, mul(and(n, LANES_24), and(shr(24, factor), 0xffffffff))), LANES_24) }
                        n := add(n, add(sum, HALF_LEVEL))
                        if and(n, OVERFLOW) { n := or(n, mul(and(shr(30, add(n, 0x3ffc00000000003ffc00000000003ffc0000)), ONES), 0x3fc00)) }
                        n := mul(and(n, 0x3fc000000000003fc000000000003fc00), 0x400000000000000040000000000000004000000000000000000000000000)
                        s := add(mload(IMAGE_ORIGIN), mul(3, shr(3, p)))
                        old := mload(s)
                        mstore(s, xor(old, and(xor(old, n), 0xffffff0000000000000000000000000000000000000000000000000000000000)))
                    }
                    p := add(p, 8)
                    if eq(p, end) { break }
                    attribute := add(attribute, mload(DX))
                }
            }

            // shades at the ends of the row and where the columns are multiples of the block size, and linearly between
            function blocks(base, first, end, attribute, x, y) {
                let color := shade(attribute, x, y)
                for {} 1 {} {
                    let next := sub(add(first, mload(BLOCK)), mod(first, mload(BLOCK)))
                    if iszero(lt(next, end)) { next := sub(end, 1) }
                    let length := sub(next, first)
                    // the depth of the accumulator with the colour
                    let colored := or(shl(168, shr(168, attribute)), add(shl(32, color), LINE_BIAS))
                    if iszero(length) {
                        gradient(base, first, end, colored, length)
                        break
                    }
                    attribute := add(attribute, mul(length, mload(DX)))
                    x := add(x, mul(length, mload(RAY_STEP)))
                    let nextColor := shade(attribute, x, y)
                    gradient(base, first, next, colored, add(shl(168, shr(168, mload(DX))), mul(sub(nextColor, color), div(0x100000000, length))))
                    color := nextColor
                    first := next
                    if iszero(lt(first, mload(COLUMN_END))) { break }
                }
            }

            last := sub(mload(DEPTH_ORIGIN), mul(mload(DEPTH_STRIDE), last))
            let base := sub(mload(DEPTH_ORIGIN), mul(mload(DEPTH_STRIDE), row))
            let mode := mload(MODE)
            switch and(mode, IS_VARYING)
            case 0 {
                row := add(mload(RAY_TOP), mul(row, mload(RAY_STEP)))
                for {} sgt(base, last) {} {
                    let from := and(shr(48, edges), 0xffff)
                    let to := shr(176, edges)
                    if lt(from, to) {
                        if and(mode, IS_CROSSING) {
                            if lt(from, mload(COLUMN_BEGIN)) { from := mload(COLUMN_BEGIN) }
                            if gt(to, mload(COLUMN_END)) { to := mload(COLUMN_END) }
                        }
                        if lt(from, to) {
                            switch and(mode, 0x240)
                            case 0 { gradient(base, from, to, add(start, mul(from, mload(DX))), mload(DX)) }
                            case 0x40 { exact(add(base, shl(3, from)), add(base, shl(3, to)), add(start, mul(from, mload(DX))), add(mload(RAY_LEFT), mul(from, mload(RAY_STEP))), row) }
                            default {
                                // blocks begin with the row or at a multiple of their size, wherever the tile does
                                from := and(shr(48, edges), 0xffff)
                                if lt(from, mload(BLOCK_BEGIN)) { from := mload(BLOCK_BEGIN) }
                                blocks(base, from, shr(176, edges), add(start, mul(from, mload(DX))), add(mload(RAY_LEFT), mul(from, mload(RAY_STEP))), row)
                            }
                        }
                    }
                    edges := add(edges, slopes)
                    start := add(start, mload(DY))
                    base := sub(base, mload(DEPTH_STRIDE))
                    row := add(row, mload(RAY_STEP))
                }
            }
            default {
                mode := and(mode, IS_CROSSING)
                for {} sgt(base, last) {} {
                    let from := and(shr(48, edges), 0xffff)
                    let to := shr(176, edges)
                    if mode {
                        if lt(from, mload(COLUMN_BEGIN)) { from := mload(COLUMN_BEGIN) }
                        if gt(to, mload(COLUMN_END)) { to := mload(COLUMN_END) }
                    }
                    if lt(from, to) { varying(add(base, shl(3, from)), add(base, shl(3, to)), add(start, mul(from, mload(DX)))) }
                    edges := add(edges, slopes)
                    start := add(start, mload(DY))
                    base := sub(base, mload(DEPTH_STRIDE))
                }
            }
        }
    }

    /// @notice The same at a vertex, whose record keeps what does not depend on the face.
    /// @param word Attribute word of the vertex, with the light of the face on its colour.
    function vertexHighlights(uint256 word, uint256 screenWord) internal pure returns (uint256 sum) {
        assembly ("memory-safe") {
            let vertex := and(screenWord, 0xffffffff)
            if iszero(mload(add(vertex, 0x40))) {
                let x := add(mload(RAY_LEFT), sar(8, mul(and(shr(64, screenWord), 0xfffff), mload(RAY_STEP))))
                let y := add(mload(RAY_TOP), sar(8, mul(shr(128, screenWord), mload(RAY_STEP))))
                if mload(FRAME_IS_ORTHOGRAPHIC) {
                    x := 0
                    y := 0
                }
                let square := add(add(mul(x, x), mul(y, y)), 0x1000000000000)
                let length := add(mload(LENGTH_AT_0), shr(48, mul(square, mload(LENGTH_SLOPE))))
                length := shr(1, add(length, div(square, length)))
                for { let steps := mload(LENGTH_STEPS) } steps { steps := sub(steps, 1) } {
                    length := shr(1, add(length, div(square, length)))
                }
                mstore(add(vertex, 0x40), length)
                let place := add(vertex, 0x60)
                for { let record := LIGHTS } lt(record, mload(LIGHTS_END)) { record := add(record, LIGHT_SIZE) } {
                    square := add(add(mul(mload(add(record, LIGHT_X)), x), mul(mload(add(record, LIGHT_Y)), y)), shl(24, mload(add(record, LIGHT_Z))))
                    mstore(place, mul(shl(1, length), sub(shl(24, length), square)))
                    place := add(place, 32)
                }
            }
            // normal * ray
            let normalRay := add(mload(FACE_FACING), sar(95, mul(mload(FACE_FACING_SLOPE), shl(8, shr(168, word)))))
            let length := mload(add(vertex, 0x40))
            vertex := add(vertex, 0x60)
            for { let record := LIGHTS } 1 {} {
                if sgt(mload(add(record, LIGHT_FACING)), 0) {
                    let half := sub(mul(mload(add(record, LIGHT_FACING)), length), normalRay)
                    if sgt(half, 0) {
                        half := div(mul(half, half), mload(vertex))
                        if gt(half, mload(SPECULAR_BEGIN)) {
                            half := mul(sub(half, mload(SPECULAR_BEGIN)), mload(SPECULAR_SCALE))
                            if gt(half, 0x400000000000) { half := 0x400000000000 }
                            let entry := mload(add(SPECULAR_TABLE, and(shr(35, half), 0xffffe0)))
                            entry := add(shr(128, entry), shr(16, mul(and(entry, 0xffffffff), and(shr(24, half), 0xffff))))
                            sum := add(sum, mul(mload(add(record, LIGHT_COLOR)), entry))
                        }
                    }
                }
                record := add(record, LIGHT_SIZE)
                if eq(record, mload(LIGHTS_END)) { break }
                vertex := add(vertex, 32)
            }
            sum := add(word, and(shr(6, sum), LANES_24))
        }
    }


    /// @notice Fills the record of a vertex with the vectors that the fragments of smooth triangles interpolate, Q20 in lanes of 85
    /// bits: the normal the other way round, the direction to the one light the other way round, the half vector, and that the other
    /// way round.
    function setVaryings(uint256 screenWord) internal pure {
        unchecked {
            uint256 vertex = screenWord & 0xffffffff;
            uint256 depth;
            int256 x;
            int256 y;
            assembly ("memory-safe") {
                depth := shl(8, shr(168, mload(add(vertex, 0x20))))
                x := add(mload(RAY_LEFT), sar(8, mul(and(shr(64, screenWord), 0xfffff), mload(RAY_STEP))))
                y := add(mload(RAY_TOP), sar(8, mul(shr(128, screenWord), mload(RAY_STEP))))
                let lanes := add(mload(add(vertex, 0x40)), VECTOR_BIAS)
                lanes := or(or(shl(170, and(lanes, 0x1fffffffffffffffffffff)), shr(170, lanes)), and(lanes, 0x3ffffffffffffffffffffe00000000000000000000))
                mstore(add(vertex, 0x60), sub(lanes, VECTOR_BIAS))
            }
            bool orthographic = load(FRAME_IS_ORTHOGRAPHIC) != 0;
            int256 lx = loadSigned(LIGHTS + LIGHT_X);
            int256 ly = loadSigned(LIGHTS + LIGHT_Y);
            int256 lz = loadSigned(LIGHTS + LIGHT_Z);
            if (load(LIGHTS + LIGHT_IS_POINT) != 0) {
                if (orthographic) {
                    lx -= x >> 16;
                    ly -= y >> 16;
                    lz -= (int256(load(DEPTH_SCALE) << 8) - int256(depth)) >> 16;
                } else {
                    int256 distance;
                    assembly ("memory-safe") {
                        // a depth may be zero, and then this is
                        distance := div(shl(8, mload(DEPTH_SCALE)), depth)
                    }
                    lx -= (x * distance) >> 40;
                    ly -= (y * distance) >> 40;
                    lz -= distance >> 16;
                }
            }
            if (orthographic) (x, y) = (0, 0);
            int256 length = int256(sqrt(uint256(x * x + y * y + (1 << 48))));
            int256 distanceToLight = int256(sqrt(uint256(lx * lx + ly * ly + lz * lz)));
            assembly ("memory-safe") {
                lx := sdiv(shl(20, lx), distanceToLight)
                ly := sdiv(shl(20, ly), distanceToLight)
                lz := sdiv(shl(20, lz), distanceToLight)
                mstore(add(vertex, 0x80), add(add(lz, shl(85, ly)), shl(170, lx)))
                // H = L + V
                lx := sub(lx, sdiv(shl(20, x), length))
                ly := sub(ly, sdiv(shl(20, y), length))
                lz := sub(lz, sdiv(0x100000000000, length))
                mstore(add(vertex, 0xa0), add(add(lx, shl(85, ly)), shl(170, lz)))
                mstore(add(vertex, 0xc0), add(add(lz, shl(85, ly)), shl(170, lx)))
            }
        }
    }
}
