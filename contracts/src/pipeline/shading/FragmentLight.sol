// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {sqrtNear} from "../../math/Roots.sol";
import "../../words/Registers.sol";

// Computes `weights_at` and `radiance` of picture.py, by their formulas.
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
/// @dev From FACE_N_DOT_RAY_SLOPE times a depth with DEPTH_FRACTION bits to Q48.
uint256 constant Q142_TO_Q48 = 94;

/// @dev What is lit: anything; a smooth surface without spot lights; a surface whose colour is not known yet. Literals, for which the
/// compiler is to make functions of their own.
uint256 constant ANY = 0;
uint256 constant SMOOTH_ONLY = 1;
uint256 constant SURFACE = 2;

library FragmentLight {
    /// @notice Returns the colour for an accumulator with barycentric coordinates, and a ray: see colorAt.
    function colorOf(uint256 attribute, uint256 x, uint256 y) internal pure returns (uint256 color) {
        uint256 s;
        uint256 t;
        assembly ("memory-safe") {
            s := sar(ACCUMULATOR_S_AT, signextend(ACCUMULATOR_S_LAST_BYTE, attribute)) // Q24
            t := sar(ACCUMULATOR_T_AT, signextend(ACCUMULATOR_T_LAST_BYTE, attribute))
        }
        return colorAt(attribute >> ACCUMULATOR_DEPTH_AT, s, t, x, y, ANY);
    }

    /// @notice The same for SMOOTH_ONLY.
    function smoothColorOf(uint256 attribute, uint256 x, uint256 y) internal pure returns (uint256 color) {
        uint256 s;
        uint256 t;
        assembly ("memory-safe") {
            s := sar(ACCUMULATOR_S_AT, signextend(ACCUMULATOR_S_LAST_BYTE, attribute)) // Q24
            t := sar(ACCUMULATOR_T_AT, signextend(ACCUMULATOR_T_LAST_BYTE, attribute))
        }
        return colorAt(attribute >> ACCUMULATOR_DEPTH_AT, s, t, x, y, SMOOTH_ONLY);
    }

    /// @notice Returns a colour, Q10 in signed lanes of 85 bits to which half a level was added, with the bytes of 0 or 255 in lanes
    /// beyond these. Needed if a bit of BEYOND_BYTE_85 is set.
    function clamped(uint256 color) internal pure returns (uint256 inside) {
        assembly ("memory-safe") {
            // 255 in lanes above 255 or below 0, then 0 in those below 0
            inside := and(shr(BEYOND_CARRY, add(and(color, BEYOND_BYTE_85), BEYOND_BYTE_85)), ONES_85)
            inside := or(color, mul(inside, BYTE_Q10))
            inside := and(inside, not(mul(and(shr(BEYOND_SIGN, color), ONES_85), BYTE_Q10)))
        }
    }

    /// @param depth, s, t The depth (with 8 more bits than in a vertex) and the screen-space barycentric coordinates, Q24; outside the
    /// triangle these can be negative or above 1.
    /// @param x, y The ray through the point, Q24; for an orthographic camera the point itself, Q32.
    /// @param kind ANY, SMOOTH_ONLY or SURFACE: s and t are already perspective-correct, and only highlights are returned; the diffuse
    /// light is then left in FRAGMENT_LIGHT, and the length of the ray in FRAGMENT_RAY_LENGTH.
    /// @return color Signed lanes of 85 bits, Q10, not clamped to 0..255; lanes of 56 bits for SURFACE.
    function colorAt(uint256 depth, uint256 s, uint256 t, uint256 x, uint256 y, uint256 kind) internal pure returns (uint256 color) {
        unchecked {
            uint256 mode = load(MODE);
            if (mode & IS_ORTHOGRAPHIC != 0) {
                assembly ("memory-safe") {
                    mstore(FRAGMENT_PLACE_X, sar(Q16, x))
                    mstore(FRAGMENT_PLACE_Y, sar(Q16, y))
                    x := 0
                    y := 0
                }
            } else if (kind != SURFACE) {
                assembly ("memory-safe") {
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
            // without `return`, so that the compiler can put the function where it is called
            if (kind == SURFACE) {
                setNormal(depth, s, t, x, y);
                // colours of lights are Q10 with effects
                color = (light(depth, x, y, kind) >> Q16) & LANES_24;
            } else {
                assembly ("memory-safe") {
                    // each lane has a bias of 2^24, so that it is positive
                    color := shr(Q24, add(add(mload(COLOR_0), mul(mload(COLOR_1), s)), mul(mload(COLOR_2), t)))
                }
                if (kind == ANY && mode & IS_DIFFUSE == 0) {
                    if (mode & IS_LIT != 0) color += (highlights(faceRayAt(depth), x, y) >> Q16_TO_Q10) & LANES_24;
                    assembly ("memory-safe") {
                        color := add( // to lanes of 85 bits
                            add(and(color, LANE_32), shl(MIDDLE_85_AT, and(shr(MIDDLE_AT, color), LANE_32))),
                            shl(UPPER_85_AT, and(shr(UPPER_AT, color), LANE_32))
                        )
                        color := sub(color, BIAS_85)
                    }
                } else {
                    if (kind == SMOOTH_ONLY) interpolateNormal(s, t, x, y);
                    else setNormal(depth, s, t, x, y);
                    color = modulated(color, light(depth, x, y, kind));
                }
            }
        }
    }

    /// @dev Returns N.r, the normal of the face times the ray to a point of this depth, Q48.
    function faceRayAt(uint256 depth) private pure returns (uint256 normalRay) {
        assembly ("memory-safe") {
            normalRay := add(mload(FACE_N_DOT_RAY), sar(Q142_TO_Q48, mul(mload(FACE_N_DOT_RAY_SLOPE), depth)))
        }
    }

    /// @dev Returns a colour (lanes of Q10 with a bias of 2^24) times FRAGMENT_LIGHT, plus highlights (lanes of Q16).
    function modulated(uint256 color, uint256 shine) private pure returns (uint256 sum) {
        assembly ("memory-safe") {
            shine := and(shr(Q16_TO_Q10, shine), LANES_24) // Q10 from here on
            let factor := mload(FRAGMENT_LIGHT)
            // colours of Q10 times light of Q40, taken as Q16
            let blue := sar(Q16, mul(sub(and(color, LANE_32), ONE_24), and(shr(BLUE_Q40_AT, factor), LANE_32)))
            let green := sar(Q16, mul(sub(and(shr(MIDDLE_AT, color), LANE_32), ONE_24), and(shr(GREEN_Q40_AT, factor), LANE_32)))
            let red := sar(Q16, mul(sub(and(shr(UPPER_AT, color), LANE_32), ONE_24), and(shr(RED_Q40_AT, factor), LANE_32)))
            green := shl(MIDDLE_85_AT, add(green, and(shr(MIDDLE_AT, shine), LANE_24)))
            sum := add(add(shl(UPPER_85_AT, add(red, shr(UPPER_AT, shine))), green), add(blue, and(shine, LANE_24)))
        }
    }

    /// @dev Returns the length of the ray (x, y, 1), Q24.
    function rayLength(uint256 x, uint256 y) private pure returns (uint256 length) {
        assembly ("memory-safe") {
            x := add(add(mul(x, x), mul(y, y)), ONE_48) // x from here on: x^2 + y^2 + 1, Q48
            length := add(mload(LENGTH_AT_0), shr(Q48, mul(x, mload(LENGTH_SLOPE))))
            length := shr(1, add(length, div(x, length))) // Newton: (l + x / l) / 2
            for { let steps := mload(LENGTH_STEPS) } steps { steps := sub(steps, 1) } {
                length := shr(1, add(length, div(x, length))) // and again
            }
        }
    }

    /// @dev Returns the highlight, Q16, from the square of its cosine, Q24.
    function specular(uint256 square) private pure returns (uint256 value) {
        unchecked {
            if (square > load(SPECULAR_BEGIN)) {
                assembly ("memory-safe") {
                    square := mul(sub(square, mload(SPECULAR_BEGIN)), mload(SPECULAR_SCALE)) // index into the table, Q40
                    if gt(square, SPECULAR_LAST) { square := SPECULAR_LAST } // min(square, SPECULAR_LAST)
                    value := mload(add(SPECULAR_TABLE, and(shr(SPECULAR_ENTRY_SHIFT, square), SPECULAR_ENTRY_MASK)))
                    square := and(shr(SPECULAR_REST_AT, square), SPECULAR_REST_MASK) // fraction of the index, Q16
                    value := add(shr(SPECULAR_VALUE_AT, value), shr(Q16, mul(and(value, LANE_32), square))) // value + increase * fraction
                }
            } else if (load(SPECULAR_ROOT) != 0) {
                if (square > ONE_24) square = ONE_24;
                value = (load(SPECULAR_ROOT) * sqrtNear(square << Q24, NORMAL_HINT)) >> Q24;
            }
        }
    }

    /// @dev Returns the highlights of directional lights; their diffuse light is in the colour.
    function highlights(uint256 normalRay, uint256 x, uint256 y) private pure returns (uint256 sum) {
        unchecked {
            uint256 length = rayLength(x, y);
            uint256 record = LIGHTS;
            while (true) {
                if (loadSigned(record + LIGHT_N_DOT_L) > 0) {
                    // (N.H)^2 = (N.L |r| - N.r)^2 / (2 |r| (|r| - L.r)), where |r| = length, Q24
                    uint256 nDotH = load(record + LIGHT_N_DOT_L) * length - normalRay;
                    if (int256(nDotH) > 0) {
                        assembly ("memory-safe") {
                            // L.r, Q48
                            let lightRay := add(mul(mload(add(record, LIGHT_X)), x), mul(mload(add(record, LIGHT_Y)), y))
                            lightRay := add(lightRay, shl(Q24, mload(add(record, LIGHT_Z))))
                            nDotH := div(mul(nDotH, nDotH), mul(shl(1, length), sub(shl(Q24, length), lightRay))) // its square, Q24
                        }
                        sum += load(record + LIGHT_COLOR) * specular(nDotH);
                    }
                }
                record += LIGHT_SIZE;
                if (record == load(LIGHTS_END)) break;
            }
        }
    }

    /// @dev Sets FRAGMENT_CONE, the attenuation of a spot light for a direction of length `distance` (Q16): the square of a linear function
    /// of the cosine to its axis, 1 at the inner angle and 0 at the outer one, as in the glTF extension KHR_lights_punctual; Q16.
    function setCone(uint256 record, uint256 lx, uint256 ly, uint256 lz, uint256 distance) private pure {
        assembly ("memory-safe") {
            let strength := ONE_16
            if mload(add(record, LIGHT_CONE)) {
                let cosine := add(mul(mload(add(record, LIGHT_AXIS_X)), lx), mul(mload(add(record, LIGHT_AXIS_Y)), ly))
                cosine := add(cosine, mul(mload(add(record, LIGHT_AXIS_Z)), lz)) // axis * L, Q40
                cosine := sub(sub(0, sdiv(cosine, distance)), mload(add(record, LIGHT_COS_OUTER))) // -axis * L / |L| - outer, Q24
                if slt(cosine, 0) { cosine := 0 } // max(cosine, 0)
                cosine := div(shl(Q16, cosine), mload(add(record, LIGHT_CONE))) // relative to inner - outer, Q16
                if lt(cosine, ONE_16) { strength := shr(Q16, mul(cosine, cosine)) }
            }
            mstore(FRAGMENT_CONE, strength)
        }
    }

    /// @dev Returns the highlights of all kinds of lights; leaves the diffuse light in FRAGMENT_LIGHT.
    function light(uint256 depth, uint256 x, uint256 y, uint256 kind) private pure returns (uint256 sum) {
        unchecked {
            uint256 length = rayLength(x, y);
            assembly ("memory-safe") {
                mstore(FRAGMENT_RAY_LENGTH, length)
                mstore(FRAGMENT_LIGHT, shl(Q40_TO_Q16, mload(AMBIENT)))
            }
            uint256 record = LIGHTS;
            while (true) {
                uint256 lx = load(record + LIGHT_X);
                uint256 ly = load(record + LIGHT_Y);
                uint256 lz = load(record + LIGHT_Z);
                uint256 distance = ONE_24;
                if (load(record + LIGHT_IS_POINT) != 0) {
                    assembly ("memory-safe") {
                        // from the fragment to the light, Q16
                        distance := div(shl(DEPTH_FRACTION, mload(DEPTH_SCALE)), depth) // from the eye, Q32
                        switch and(mload(MODE), IS_ORTHOGRAPHIC)
                        case 0 {
                            lx := sub(lx, sar(Q40, mul(x, distance))) // Q24 * Q32 to Q16
                            ly := sub(ly, sar(Q40, mul(y, distance)))
                            lz := sub(lz, shr(Q16, distance))
                        }
                        default {
                            lx := sub(lx, mload(FRAGMENT_PLACE_X)) // L - place of the fragment, Q16
                            ly := sub(ly, mload(FRAGMENT_PLACE_Y))
                            // depth = DEPTH_SCALE - distance / 256, with DEPTH_FRACTION more bits
                            lz := sub(lz, sar(Q16, sub(shl(DEPTH_FRACTION, mload(DEPTH_SCALE)), depth)))
                        }
                        distance := add(add(mul(lx, lx), mul(ly, ly)), mul(lz, lz)) // |L|^2, Q32
                    }
                    distance = sqrtNear(distance, record + LIGHT_HINT);
                }
                if (kind != SMOOTH_ONLY) setCone(record, lx, ly, lz, distance);
                // N.L: Q48 for a directional light, Q40 for a point light
                uint256 nDotL;
                assembly ("memory-safe") {
                    switch or(eq(kind, SMOOTH_ONLY), and(mload(MODE), IS_SMOOTH))
                    case 0 { nDotL := shl(Q24, mload(add(record, LIGHT_N_DOT_L))) }
                    default {
                        nDotL := add(mul(mload(FRAGMENT_NORMAL_X), lx), mul(mload(FRAGMENT_NORMAL_Y), ly)) // N.x L.x + N.y L.y + N.z L.z
                        nDotL := add(nDotL, mul(mload(FRAGMENT_NORMAL_Z), lz))
                    }
                }
                if (int256(nDotL) > 0) {
                    assembly ("memory-safe") {
                        // N.L of unit vectors, Q24; then multiplied by the cone, Q24
                        let lambert := div(shl(Q24, nDotL), mul(distance, mload(FRAGMENT_NORMAL_LENGTH)))
                        if iszero(eq(kind, SMOOTH_ONLY)) { lambert := shr(Q16, mul(lambert, mload(FRAGMENT_CONE))) } // * cone
                        mstore(FRAGMENT_LIGHT, add(mload(FRAGMENT_LIGHT), mul(mload(add(record, LIGHT_DIFFUSE)), lambert))) // Q40
                        // nDotL from here on: the numerator of N.H in the formula above, N.L |r| - N.r d
                        nDotL := sub(mul(nDotL, length), mul(distance, mload(FRAGMENT_NORMAL_RAY)))
                    }
                    if (int256(nDotL) > 0) {
                        assembly ("memory-safe") {
                            lx := add(add(mul(lx, x), mul(ly, y)), shl(Q24, lz)) // lx from here on: L.r
                            lx := mul(mul(distance, shl(1, length)), sub(mul(distance, length), lx)) // 2 d |r| (d |r| - L.r)
                            // its square, Q24
                            nDotL := div(shl(Q24, mul(nDotL, nDotL)), mul(mload(FRAGMENT_SQUARE), lx))
                        }
                        nDotL = specular(nDotL); // nDotL from here on: the highlight
                        assembly ("memory-safe") {
                            if iszero(eq(kind, SMOOTH_ONLY)) { nDotL := shr(Q16, mul(nDotL, mload(FRAGMENT_CONE))) }
                            sum := add(sum, mul(mload(add(record, LIGHT_COLOR)), nDotL))
                        }
                    }
                }
                record += LIGHT_SIZE;
                if (record == load(LIGHTS_END)) break;
            }
        }
    }

    /// @dev Sets FRAGMENT_NORMAL_RAY, and for a smooth surface the normal of the fragment, its length and square.
    function setNormal(uint256 depth, uint256 s, uint256 t, uint256 x, uint256 y) private pure {
        if (load(MODE) & IS_SMOOTH == 0) {
            x = faceRayAt(depth);
            assembly ("memory-safe") {
                mstore(FRAGMENT_NORMAL_RAY, x)
            }
        } else {
            interpolateNormal(s, t, x, y);
        }
    }

    /// @dev Interpolates the vertex normals at a fragment, Q24.
    function interpolateNormal(uint256 s, uint256 t, uint256 x, uint256 y) private pure {
        uint256 square;
        assembly ("memory-safe") {
            // t from here on: the normal, Q36 = Q20 * Q16, with a bias; s each of its coordinates, Q24
            t := add(mul(mload(NORMALS_1), shr(Q24_TO_Q16, s)), mul(mload(NORMALS_2), shr(Q24_TO_Q16, t)))
            t := add(add(mload(NORMALS_0), t), NORMAL_BIAS)
            s := sub(and(shr(NORMAL_X_AT, t), NORMAL_MASK), NORMAL_HALF)
            mstore(FRAGMENT_NORMAL_X, s)
            square := mul(s, s) // N.x^2, to which the others are added
            x := mul(s, x) // x from here on: N.r, Q48
            s := sub(and(shr(NORMAL_Y_AT, t), NORMAL_MASK), NORMAL_HALF)
            mstore(FRAGMENT_NORMAL_Y, s)
            square := add(square, mul(s, s))
            x := add(x, mul(s, y)) // N.x x + N.y y
            s := sub(shr(NORMAL_Z_AT, t), NORMAL_HALF)
            mstore(FRAGMENT_NORMAL_Z, s)
            square := add(square, mul(s, s)) // N.N, Q48
            mstore(FRAGMENT_NORMAL_RAY, add(x, shl(Q24, s))) // + N.z
            mstore(FRAGMENT_SQUARE, square)
        }
        square = sqrtNear(square, NORMAL_HINT);
        assembly ("memory-safe") {
            mstore(FRAGMENT_NORMAL_LENGTH, square)
        }
    }
}
