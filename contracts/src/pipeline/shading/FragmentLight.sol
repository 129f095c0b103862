// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import "../../words/Registers.sol";

// Computes the colour of a triangle at any point: perspective-correct interpolated colours times diffuse light, plus highlights
// (Blinn-Phong).
//
//   colour = interpolated colour * (ambient + sum over the lights of diffuse * N.L) + sum of specular * (N.H)^shininess
//
// The half vector H between the direction L to the light and the direction -r / |r| to the eye, where r is the ray to the point, is never
// computed:
//
//   N.H = (N.L |r| - N.r) / sqrt(2 |r| (|r| - L.r))
//
// and the table of the highlight is indexed by its square. For vectors of any length, with d = |L|, it is
//
//   (N.H)^2 = (N.L |r| - N.r d)^2 / (N.N * 2 d |r| (d |r| - L.r))

/// @dev Keeps colours (Q34) positive for any weights, by a bit that is removed in the end. It exceeds the maximum brightness of a flat face
/// without highlights, 20 * 255 levels, at three corners.
uint256 constant WEIGHTED_BIAS = 0x010000000400000100000004000001000000040000;
/// @dev The bit of WEIGHTED_BIAS above a colour of Q10, in lanes of 85 bits.
uint256 constant BIAS_85 = 0x4000000000000000000002000000000000000000001000000;

library FragmentLight {
    /// @param depth, s, t The depth (with 8 more bits than in a vertex) and the screen-space barycentric coordinates, Q24; outside the
    /// triangle these can be negative or above 1.
    /// @param x, y The ray through the point, Q24; for an orthographic camera the point itself, Q32.
    /// @param isSurface Whether s and t are already perspective-correct, and only highlights are returned; the diffuse light is then left
    /// in FRAGMENT_LIGHT, and the length of the ray in FRAGMENT_RAY_LENGTH.
    /// @return color Signed lanes of 85 bits, Q10, not clamped to 0..255; lanes of 56 bits if `isSurface`.
    function colorAt(uint256 depth, uint256 s, uint256 t, uint256 x, uint256 y, bool isSurface) internal pure returns (uint256 color) {
        assembly ("memory-safe") {
            // sqrt(value); `hint` stores the magnitude of the previous result as a first guess
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
            function rayLength(x_, y_) -> length {
                x_ := add(add(mul(x_, x_), mul(y_, y_)), ONE_48)
                length := add(mload(LENGTH_AT_0), shr(48, mul(x_, mload(LENGTH_SLOPE))))
                length := shr(1, add(length, div(x_, length)))
                for { let steps := mload(LENGTH_STEPS) } steps { steps := sub(steps, 1) } {
                    length := shr(1, add(length, div(x_, length)))
                }
            }

            // the highlight, Q16, from the square of its cosine, Q24
            function specular(square) -> value {
                switch gt(square, mload(SPECULAR_BEGIN))
                case 0 {
                    if mload(SPECULAR_ROOT) {
                        if gt(square, ONE_24) { square := ONE_24 }
                        value := shr(24, mul(mload(SPECULAR_ROOT), root(shl(24, square), NORMAL_HINT)))
                    }
                }
                default {
                    square := mul(sub(square, mload(SPECULAR_BEGIN)), mload(SPECULAR_SCALE))
                    if gt(square, SPECULAR_LAST) { square := SPECULAR_LAST }
                    value := mload(add(SPECULAR_TABLE, and(shr(SPECULAR_ENTRY_SHIFT, square), SPECULAR_ENTRY_MASK)))
                    value := add(shr(SPECULAR_VALUE_AT, value), shr(16, mul(and(value, LANE_32), and(shr(24, square), SPECULAR_REST_MASK))))
                }
            }

            // highlights of directional lights; their diffuse light is in the colour
            function highlights(normalRay, x_, y_) -> sum {
                let length := rayLength(x_, y_)
                for { let record := LIGHTS } 1 {} {
                    if sgt(mload(add(record, LIGHT_N_DOT_L)), 0) {
                        // (N.H)^2 = (N.L |r| - N.r)^2 / (2 |r| (|r| - L.r)), where |r| = length, Q24
                        let nDotH := sub(mul(mload(add(record, LIGHT_N_DOT_L)), length), normalRay)
                        if sgt(nDotH, 0) {
                            // L.r, Q48
                            let lightRay := add(mul(mload(add(record, LIGHT_X)), x_), mul(mload(add(record, LIGHT_Y)), y_))
                            lightRay := add(lightRay, shl(24, mload(add(record, LIGHT_Z))))
                            nDotH := div(mul(nDotH, nDotH), mul(shl(1, length), sub(shl(24, length), lightRay)))
                            sum := add(sum, mul(mload(add(record, LIGHT_COLOR)), specular(nDotH)))
                        }
                    }
                    record := add(record, LIGHT_SIZE)
                    if eq(record, mload(LIGHTS_END)) { break }
                }
            }

            // The attenuation of a spot light for a direction of length `distance` (Q16): the square of a linear function of the cosine to
            // its axis, 1 at the inner angle and 0 at the outer one, as in the glTF extension KHR_lights_punctual; Q16
            function cone(record, lx, ly, lz, distance) -> strength {
                strength := ONE_16
                if mload(add(record, LIGHT_CONE)) {
                    let cosine := add(mul(mload(add(record, LIGHT_AXIS_X)), lx), mul(mload(add(record, LIGHT_AXIS_Y)), ly))
                    cosine := add(cosine, mul(mload(add(record, LIGHT_AXIS_Z)), lz))
                    cosine := sub(sub(0, sdiv(cosine, distance)), mload(add(record, LIGHT_COS_OUTER)))
                    if slt(cosine, 0) { cosine := 0 }
                    cosine := div(shl(16, cosine), mload(add(record, LIGHT_CONE)))
                    if lt(cosine, ONE_16) { strength := shr(16, mul(cosine, cosine)) }
                }
            }

            // light of all kinds of lights; leaves the diffuse light in FRAGMENT_LIGHT
            function light(depth_, x_, y_) -> sum {
                let length := rayLength(x_, y_)
                mstore(FRAGMENT_RAY_LENGTH, length)
                mstore(FRAGMENT_LIGHT, shl(24, mload(AMBIENT)))
                for { let record := LIGHTS } 1 {} {
                    let lx := mload(add(record, LIGHT_X))
                    let ly := mload(add(record, LIGHT_Y))
                    let lz := mload(add(record, LIGHT_Z))
                    let distance := ONE_24
                    if mload(add(record, LIGHT_IS_POINT)) {
                        // from the fragment to the light, Q16
                        distance := div(shl(8, mload(DEPTH_SCALE)), depth_)
                        switch and(mload(MODE), IS_ORTHOGRAPHIC)
                        case 0 {
                            lx := sub(lx, sar(40, mul(x_, distance)))
                            ly := sub(ly, sar(40, mul(y_, distance)))
                            lz := sub(lz, shr(16, distance))
                        }
                        default {
                            lx := sub(lx, mload(FRAGMENT_PLACE_X))
                            ly := sub(ly, mload(FRAGMENT_PLACE_Y))
                            lz := sub(lz, sar(16, sub(shl(8, mload(DEPTH_SCALE)), depth_)))
                        }
                        distance := root(add(add(mul(lx, lx), mul(ly, ly)), mul(lz, lz)), add(record, LIGHT_HINT))
                    }
                    mstore(FRAGMENT_CONE, cone(record, lx, ly, lz, distance))
                    // N.L: Q48 for a directional light, Q40 for a point light
                    let nDotL
                    switch and(mload(MODE), IS_SMOOTH)
                    case 0 { nDotL := shl(24, mload(add(record, LIGHT_N_DOT_L))) }
                    default {
                        nDotL := add(mul(mload(FRAGMENT_NORMAL_X), lx), mul(mload(FRAGMENT_NORMAL_Y), ly))
                        nDotL := add(nDotL, mul(mload(FRAGMENT_NORMAL_Z), lz))
                    }
                    if sgt(nDotL, 0) {
                        // N.L of unit vectors, Q24; then multiplied by the cone, Q24
                        let lambert := div(shl(24, nDotL), mul(distance, mload(FRAGMENT_NORMAL_LENGTH)))
                        lambert := shr(16, mul(lambert, mload(FRAGMENT_CONE)))
                        mstore(FRAGMENT_LIGHT, add(mload(FRAGMENT_LIGHT), mul(mload(add(record, LIGHT_DIFFUSE)), lambert)))
                        // the numerator of N.H in the formula above
                        nDotL := sub(mul(nDotL, length), mul(distance, mload(FRAGMENT_NORMAL_RAY)))
                        if sgt(nDotL, 0) {
                            lx := add(add(mul(lx, x_), mul(ly, y_)), shl(24, lz))
                            lx := mul(mul(distance, shl(1, length)), sub(mul(distance, length), lx))
                            // its square, Q24
                            nDotL := div(shl(24, mul(nDotL, nDotL)), mul(mload(FRAGMENT_SQUARE), lx))
                            nDotL := shr(16, mul(specular(nDotL), mload(FRAGMENT_CONE)))
                            sum := add(sum, mul(mload(add(record, LIGHT_COLOR)), nDotL))
                        }
                    }
                    record := add(record, LIGHT_SIZE)
                    if eq(record, mload(LIGHTS_END)) { break }
                }
            }

            // interpolates the vertex normals at a fragment, Q24
            function interpolateNormal(second, third, x_, y_) {
                third := add(mul(mload(NORMALS_1), shr(8, second)), mul(mload(NORMALS_2), shr(8, third)))
                third := add(add(mload(NORMALS_0), third), NORMAL_BIAS)
                second := sub(and(shr(NORMAL_X_AT, third), NORMAL_MASK), NORMAL_HALF)
                mstore(FRAGMENT_NORMAL_X, second)
                let square := mul(second, second)
                x_ := mul(second, x_)
                second := sub(and(shr(NORMAL_Y_AT, third), NORMAL_MASK), NORMAL_HALF)
                mstore(FRAGMENT_NORMAL_Y, second)
                square := add(square, mul(second, second))
                x_ := add(x_, mul(second, y_))
                second := sub(shr(NORMAL_Z_AT, third), NORMAL_HALF)
                mstore(FRAGMENT_NORMAL_Z, second)
                square := add(square, mul(second, second))
                mstore(FRAGMENT_NORMAL_RAY, add(x_, shl(24, second)))
                mstore(FRAGMENT_SQUARE, square)
                mstore(FRAGMENT_NORMAL_LENGTH, root(square, NORMAL_HINT))
            }

            let mode := mload(MODE)
            switch and(mode, IS_ORTHOGRAPHIC)
            case 0 {
                if iszero(isSurface) {
                    // perspective-correct: s * vertex depth / depth of the point, Q24
                    s := sdiv(mul(s, mload(DEPTH_1)), depth)
                    t := sdiv(mul(t, mload(DEPTH_2)), depth)
                    if and(mode, IS_STEEP) {
                        // rounding errors are large if a near vertex meets a far fragment
                        if sgt(s, ONE_24) { s := ONE_24 }
                        if sgt(t, ONE_24) { t := ONE_24 }
                    }
                }
            }
            default {
                mstore(FRAGMENT_PLACE_X, sar(16, x))
                mstore(FRAGMENT_PLACE_Y, sar(16, y))
                x := 0
                y := 0
            }
            switch isSurface
            case 1 {
                switch and(mode, IS_SMOOTH)
                case 0 { mstore(FRAGMENT_NORMAL_RAY, add(mload(FACE_N_DOT_RAY), sar(94, mul(mload(FACE_N_DOT_RAY_SLOPE), depth)))) }
                default { interpolateNormal(s, t, x, y) }
                // colours of lights are Q10 with effects
                color := and(shr(16, light(depth, x, y)), LANES_24)
            }
            default {
                // each lane has a bias of 2^24, so that it is positive
                color := shr(24, add(add(mload(COLOR_0), mul(mload(COLOR_1), s)), mul(mload(COLOR_2), t)))
                if and(mode, IS_LIT) {
                    // N.r, Q48
                    let normalRay := add(mload(FACE_N_DOT_RAY), sar(94, mul(mload(FACE_N_DOT_RAY_SLOPE), depth)))
                    switch and(mode, IS_DIFFUSE)
                    case 0 { color := add(color, and(shr(6, highlights(normalRay, x, y)), LANES_24)) }
                    default {
                        switch and(mode, IS_SMOOTH)
                        case 0 { mstore(FRAGMENT_NORMAL_RAY, normalRay) }
                        default { interpolateNormal(s, t, x, y) }
                        s := and(shr(6, light(depth, x, y)), LANES_24)
                        t := mload(FRAGMENT_LIGHT)
                        // colours of Q10 times light of Q40
                        y := sar(16, mul(sub(and(color, LANE_32), ONE_24), and(shr(BLUE_Q40_AT, t), LANE_32)))
                        x := sar(16, mul(sub(and(shr(MIDDLE_AT, color), LANE_32), ONE_24), and(shr(GREEN_Q40_AT, t), LANE_32)))
                        color := sar(16, mul(sub(and(shr(UPPER_AT, color), LANE_32), ONE_24), and(shr(RED_Q40_AT, t), LANE_32)))
                        color := add(
                            add(shl(UPPER_85_AT, add(color, shr(UPPER_AT, s))), shl(MIDDLE_85_AT, add(x, and(shr(MIDDLE_AT, s), LANE_24)))),
                            add(y, and(s, LANE_24))
                        )
                    }
                }
                if iszero(and(mode, IS_DIFFUSE)) {
                    color := add(
                        add(and(color, LANE_32), shl(MIDDLE_85_AT, and(shr(MIDDLE_AT, color), LANE_32))),
                        shl(UPPER_85_AT, and(shr(UPPER_AT, color), LANE_32))
                    )
                    color := sub(color, BIAS_85)
                }
            }
        }
    }
}
