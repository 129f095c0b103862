// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {TEXTURE_COLOR_BITS, TEXTURE_HEADER, UV_SIZE} from "./EffectRecords.sol";
import {TEXTURE_BILINEAR, TEXTURE_CLAMP} from "../words/Records.sol";
import {Triangles} from "../pipeline/geometry/Triangles.sol";
import {VertexShader} from "../pipeline/geometry/VertexShader.sol";
import "../words/EffectRegisters.sol";

// Computes `texture_at` of picture.py.
// Samples a texture at a fragment: see EffectRecords for its format.
//
// Texture coordinates are interpolated perspective-correctly, in two lanes of 128 bits: u below, v above. Texels are addressed as in
// OpenGL: with the coordinate x = u * width, the nearest texel is floor(x); for bilinear filtering, texel centres are at i + 0.5.

uint256 constant ONE_12 = 0x1000;
uint256 constant Q24_TO_Q12 = 12;
uint256 constant BELOW_ONE_24 = 0xffffff;
/// @dev Of texture coordinates: the last byte of the lane of u; the position of v, and of v as Q24; half its unit; the shift to Q24.
uint256 constant U_LAST_BYTE = 15;
uint256 constant V_AT = 128;
uint256 constant V_Q24_AT = 144;
uint256 constant HALF_V = 1 << 127;
uint256 constant Q40_TO_Q24 = 16;
/// @dev Of a vertex: a coordinate at the top of a word, and its bits.
uint256 constant UV_AT_TOP = 232;
uint256 constant UV_BITS = 24;
/// @dev A byte has 2^3 bits; the bits of a place in it.
uint256 constant BYTE_SHIFT = 3;
uint256 constant BIT_IN_BYTE = 7;
/// @dev The position of a half in Q16.
uint256 constant HALF_16_AT = 15;
/// @dev The position of opacities in colours, and a bias that keeps them positive.
uint256 constant OPACITY_AT = 168;
uint256 constant OPACITY_BIAS = 1 << (48 + OPACITY_AT);

library Texture {
    /// @notice Sets the texture coordinates of a triangle: at the first vertex (Q40), and the differences to the others (Q16).
    /// @param a, b, c The screen words of its vertices.
    function setTriangle(uint256 a, uint256 b, uint256 c) internal pure {
        unchecked {
            uint256 first = coordinatesOf(a, false);
            store(UV_0, first << Q24);
            store(UV_1, coordinatesOf(b, false) - first);
            store(UV_2, coordinatesOf(c, false) - first);
        }
    }

    /// @notice Adds the opacities of a triangle to its colours, as a fourth lane.
    function setOpacities(uint256 a, uint256 b, uint256 c) internal pure {
        unchecked {
            uint256 first = coordinatesOf(a, true);
            store(COLOR_0, load(COLOR_0) + OPACITY_BIAS + (first << (OPACITY_AT + Q34 - Q16)));
            store(COLOR_1, load(COLOR_1) + (toQ10(coordinatesOf(b, true) - first) << OPACITY_AT));
            store(COLOR_2, load(COLOR_2) + (toQ10(coordinatesOf(c, true) - first) << OPACITY_AT));
        }
    }

    function toQ10(uint256 change) private pure returns (uint256) {
        return uint256(int256(change) >> (Q16 - Q10));
    }

    /// @notice Returns the colour at perspective-correct barycentric coordinates, Q24: lanes of Q16, where 255 is one. Multiplies OPACITY
    /// by the opacity there; sets it to 0 where nothing is drawn.
    function colorAt(uint256 s, uint256 t) internal pure returns (uint256) {
        assembly ("memory-safe") {
            t := add(add(mload(UV_0), mul(mload(UV_1), s)), mul(mload(UV_2), t)) // from here on, both coordinates, Q40
            s := sar(Q40_TO_Q24, signextend(U_LAST_BYTE, t)) // from here on, u
            t := sar(V_Q24_AT, add(t, HALF_V)) // from here on, v: a negative u has borrowed from its lane
        }
        if (load(ALPHA) != 0) {
            unchecked {
                uint256 alpha = sample(load(ALPHA), s, t) & LANE_24;
                if (alpha < load(ALPHA_LEAST)) store(OPACITY, 0);
                else if (load(ALPHA_LEAST) == 1) store(OPACITY, (load(OPACITY) * alpha - 1) >> Q16); // below OPAQUE: see EffectSamples
            }
        }
        return sample(load(TEXTURE), s, t);
    }

    /// @notice Returns the colour of the texture at this calldata offset, lanes of Q16, where 255 is one.
    /// @param u, v Q24, signed.
    function sample(uint256 texture, uint256 u, uint256 v) internal pure returns (uint256 color) {
        assembly ("memory-safe") {
            // the n-th texel, lanes of Q10
            function texel(texels, palette, bits, n) -> lanes {
                n := mul(n, bits) // from here on, the bit at which it begins
                lanes := shr(sub(256, bits), shl(and(n, BIT_IN_BYTE), calldataload(add(texels, shr(BYTE_SHIFT, n))))) // its bits
                if palette { lanes := shr(PIXEL_AT, calldataload(add(palette, mul(3, lanes)))) } // the colour with this number
                lanes := and(mul(lanes, COLOR_SPREAD), BYTES_Q10) // lanes of Q10
            }

            function clamped(x) -> inside {
                inside := mul(x, sgt(x, 0)) // at least 0
                if gt(inside, BELOW_ONE_24) { inside := BELOW_ONE_24 } // below 1
            }

            // the texels along a side whose centres enclose a coordinate (Q24)
            function around(x, size, flags) -> first, second {
                first := sar(Q24, x) // floor(x), -1 to size - 1
                second := add(first, 1) // the texel after it
                if slt(first, 0) { first := mul(iszero(and(flags, TEXTURE_CLAMP)), sub(size, 1)) } // 0, or the last if it repeats
                if eq(second, size) { second := mul(gt(and(flags, TEXTURE_CLAMP), 0), first) } // the last, or 0
            }

            let header := calldataload(texture) // flags, width - 1, height - 1, bits of a texel
            let flags := byte(0, header)
            if and(flags, TEXTURE_CLAMP) { // else coordinates repeat
                u := clamped(u)
                v := clamped(v)
            }
            let width := add(byte(1, header), 1)
            let height := add(byte(2, header), 1)
            u := mul(and(u, BELOW_ONE_24), width) // from here on, in texels, Q24
            v := mul(and(v, BELOW_ONE_24), height) // as u
            let bits := byte(3, header)
            let texels := add(texture, TEXTURE_HEADER) // behind the header
            let palette := 0 // 0: texels are colours
            if lt(bits, TEXTURE_COLOR_BITS) { // they are numbers of colours
                palette := texels
                texels := add(texels, mul(3, shl(bits, 1))) // behind 2^bits colours
            }
            switch and(flags, TEXTURE_BILINEAR)
            case 0 { color := shl(Q24, texel(texels, palette, bits, add(mul(shr(Q24, v), width), shr(Q24, u)))) } // the nearest, Q34
            default {
                u := sub(u, HALF_24) // from here on, relative to the centre of the first texel
                v := sub(v, HALF_24) // as u
                let row, below := around(v, height, flags) // the rows above and below the centre
                let column, right := around(u, width, flags) // the columns
                u := and(shr(Q24_TO_Q12, u), sub(ONE_12, 1)) // from here on, the weights of the second texels, Q12
                v := and(shr(Q24_TO_Q12, v), sub(ONE_12, 1)) // as u
                for { let isLast := 0 } 1 { isLast := 1 } { // twice: `row`, then `below`
                    row := mul(row, width) // from here on, the number of its first texel
                    let mixed := mul(sub(ONE_12, u), texel(texels, palette, bits, add(row, column))) // the left texel, Q22
                    mixed := add(mixed, mul(u, texel(texels, palette, bits, add(row, right)))) // Q22
                    color := add(color, mul(sub(ONE_12, v), mixed)) // Q34
                    if isLast { break }
                    row := below // from here on, a row again
                    v := sub(ONE_12, v) // the weight of the other row
                }
            }
            color := and(shr(Q34, mul(color, 257)), LANES_24) // lanes of Q16, 0xffff for 255
            color := add(color, and(shr(HALF_16_AT, color), ONES)) // one more from a half on, so that 255 is one
        }
    }

    /// @dev Returns the texture coordinates, or the opacity, of a vertex, Q16: from the record in calldata; for a new vertex of a clipped
    /// face, those of its position on the face.
    function coordinatesOf(uint256 screen, bool isOpacity) private pure returns (uint256) {
        unchecked {
            uint256 index = ((screen & SCREEN_RECORD_MASK) - load(RECORDS)) >> load(RECORD_SHIFT);
            uint256 count = load(MESH_VERTEX_COUNT);
            return index < count + load(BACK_COUNT) ? readCoordinates(index % count, isOpacity) : cutCoordinates(screen, isOpacity);
        }
    }

    function readCoordinates(uint256 index, bool isOpacity) private pure returns (uint256 uv) {
        assembly ("memory-safe") {
            switch isOpacity // texture coordinates, or opacity
            case 0 {
                uv := calldataload(add(mload(TEXTURE_UVS), mul(index, UV_SIZE))) // u, v: 24 bits each
                uv := add(sar(UV_AT_TOP, uv), shl(V_AT, sar(UV_AT_TOP, shl(UV_BITS, uv)))) // u + 2^128 v
            }
            default { uv := shl(Q16, byte(0, calldataload(add(mload(OPACITIES), index)))) } // a byte for each vertex
        }
    }

    /// @dev With the clip coordinates P of the vertices of the face, (x, y, 1) of the position is a multiple of their sum with the weights
    /// e0 = det((x, y, 1), P1, P2), e1 = det((x, y, 1), P2, P0), e2 = det((x, y, 1), P0, P1).
    function cutCoordinates(uint256 screen, bool isOpacity) private pure returns (uint256 uv) {
        unchecked {
            uint256 indices = Triangles.readIndices(load(FACE));
            for (uint256 i; i != 3; ++i) {
                uint256 corner = TEXTURE_CORNERS + CORNER_SIZE * i;
                uint256 index = (indices >> (FACE_FIRST_AT - FACE_SECOND_AT * i)) & FACE_INDEX_MASK;
                VertexShader.clipCoordinates(index, corner);
                if (load(FRAME_IS_ORTHOGRAPHIC) != 0) store(corner + CORNER_W, ONE_32);
                store(corner + CORNER_COLOR, readCoordinates(index, isOpacity));
            }
            int256 x = int256((screen >> SCREEN_COLUMN_AT) & SCREEN_COLUMN_MASK);
            int256 y = int256(screen >> SCREEN_ROW_AT);
            (int256 u, int256 v, int256 sum) = (0, 0, 0);
            for (uint256 i; i != 3; ++i) {
                int256 weight = determinant(x, y, (i + 1) % 3, (i + 2) % 3);
                uint256 place = load(TEXTURE_CORNERS + CORNER_SIZE * i + CORNER_COLOR);
                u += weight * int128(int256(place));
                v += weight * (int256(place + HALF_V) >> V_AT);
                sum += weight;
            }
            if (sum == 0) return 0;
            return uint256(u / sum) + (uint256(v / sum) << V_AT);
        }
    }

    function determinant(int256 x, int256 y, uint256 i, uint256 j) private pure returns (int256) {
        unchecked {
            uint256 p = TEXTURE_CORNERS + CORNER_SIZE * i;
            uint256 q = TEXTURE_CORNERS + CORNER_SIZE * j;
            (int256 px, int256 py, int256 pw) = (loadSigned(p), loadSigned(p + CORNER_Y), loadSigned(p + CORNER_W));
            (int256 qx, int256 qy, int256 qw) = (loadSigned(q), loadSigned(q + CORNER_Y), loadSigned(q + CORNER_W));
            return x * (py * qw - pw * qy) - y * (px * qw - pw * qx) + px * qy - py * qx;
        }
    }
}
