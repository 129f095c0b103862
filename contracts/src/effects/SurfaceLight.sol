// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Gamma, LANES_END, Q8} from "./Gamma.sol";
import {TONE_FILMIC, TONE_GAMMA} from "../words/Records.sol";
import {FragmentLight, SURFACE} from "../pipeline/shading/FragmentLight.sol";
import {OPACITY_AT, Texture} from "./Texture.sol";
import "../words/EffectRegisters.sol";

// Computes `radiance` and `colored` of picture.py for scenes with effects.
// The fragment shader of scenes with effects. With albedo, light and highlights as in FragmentLight:
//
//   radiance = albedo * (light + hemisphere) + highlights + emission + rim * (1 - max(N.V, 0))^power
//   hemisphere = ambient coefficient * (ground + (sky - ground) * (1 + N.up) / 2)
//   colour = tone(radiance * exposure), blended with the fog by the distance along the line of sight
//
// In linear light (gamma), the albedo is decoded from sRGB and the final colour is encoded; the colours of lights are decoded beforehand.
// The filmic tone is x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14), the approximation of the ACES curve by Krzysztof Narkowicz.
//
// A new term is a function below, and its call in colorAt, which has:
//
//   colours               lanes of Q10, where 255 is white: never negative, below 2^24 levels; sums are bounded at the end
//   of each fragment      `attribute`, its depth; x and y, its ray; s and t, its barycentric coordinates
//   of lit ones           if MODE has IS_LIT, after FragmentLight.colorAt: FRAGMENT_LIGHT, which multiplies the albedo, lanes of Q40;
//                         FRAGMENT_NORMAL_RAY, which is N.r, FRAGMENT_NORMAL_LENGTH and FRAGMENT_RAY_LENGTH; of smooth faces (IS_SMOOTH)
//                         FRAGMENT_NORMAL_X, _Y, _Z, of flat ones FACE_UP, and FACE_NORMAL in the space of the mesh
//   of frame and object   the registers of EffectUniforms, rows of layout.toml
//
// EffectUniforms sets three registers without which the term may not be computed:
//
//   IS_CHANGED    if the scene or the object has a term that follows the light, such as rim, tone, fog and emission
//   HAS_DETAILS   if the object has a term that changes the albedo, such as a texture
//   VARIES        if the object has a term that is not the same all over a flat face; otherwise such a face may get the colour of one of
//                 its fragments

/// @dev 255 levels, Q10.
uint256 constant WHITE_10 = 0x3fc00;
/// @dev Addend that makes a larger lane carry into bit 55; that bit in each lane, and its position; a lane.
uint256 constant BELOW_BEYOND = 0x7ffffffffc03ff7ffffffffc03ff7ffffffffc03ff;
uint256 constant BEYOND_LEVELS = 0x800000000000008000000000000080000000000000;
uint256 constant BEYOND_AT = 55;
uint256 constant LANE_56 = 0xffffffffffffff;
/// @dev The lower 40 bits of each lane.
uint256 constant LANES_40 = 0xffffffffff0000ffffffffff0000ffffffffff;
/// @dev Values of the filmic curve above 64 (Q16) are treated as white.
uint256 constant BRIGHTEST_FILMIC = 1 << 22;
/// @dev 0.59 and 0.03, Q16, and 0.14, Q32, times 100.
uint256 constant FILMIC_59 = 59 << 16;
uint256 constant FILMIC_3 = 3 << 16;
uint256 constant FILMIC_14 = 14 << 32;
/// @dev The bias of a lane of COLOR_0, 2^24; the addend that makes lanes above 255, Q10, set bit 18; the bits that are zero for 0 to 255.
uint256 constant ALBEDO_BIAS = 0x10000000000000100000000000001000000;
uint256 constant ALBEDO_SLACK = 0x3ff000000000003ff000000000003ff;
uint256 constant BEYOND_ALBEDO = 0xfffc0000000000fffc0000000000fffc0000;

library SurfaceLight {
    /// @notice Returns the colour for this accumulator and ray.
    /// @param attribute The accumulator of fine barycentric coordinates.
    /// @param x, y As for FragmentLight.
    /// @return color Three bytes, blue uppermost.
    function colorAt(uint256 attribute, uint256 x, uint256 y) internal pure returns (uint256 color) {
        uint256 s;
        uint256 t;
        assembly ("memory-safe") {
            s := sar(FINE_S_AT, signextend(FINE_S_LAST_BYTE, attribute)) // Q44, of the screen
            t := signextend(FINE_T_LAST_BYTE, attribute) // Q44
            attribute := shr(ACCUMULATOR_DEPTH_AT, attribute) // from here on, the depth
            let mode := mload(MODE)
            switch and(mode, IS_ORTHOGRAPHIC) // as in FragmentLight
            case 0 {
                let divisor := shl(FINE_TO_24, attribute) // to Q24
                s := sdiv(mul(s, mload(DEPTH_1)), divisor) // s * depth of the vertex / depth, Q24: perspective-correct
                t := sdiv(mul(t, mload(DEPTH_2)), divisor)
                if and(mode, IS_STEEP) {
                    if sgt(s, ONE_24) { s := ONE_24 } // as in FragmentLight
                    if sgt(t, ONE_24) { t := ONE_24 } // rounding errors of near vertices
                }
            }
            default {
                s := sar(FINE_TO_24, s) // to Q24: already perspective-correct
                t := sar(FINE_TO_24, t)
            }
        }
        uint256 albedo = albedoAt(s, t);
        if (load(MODE) & IS_LIT != 0) {
            // the highlights only; the light that modulates the albedo stays in FRAGMENT_LIGHT
            color = FragmentLight.colorAt(attribute, s, t, x, y, SURFACE);
            addHemisphere();
            color = lit(albedo, color);
        } else {
            color = albedo;
        }
        if (load(IS_CHANGED) != 0) {
            unchecked {
                color += load(EMISSION);
            }
            if (load(RIM_COLOR) != 0 && load(MODE) & IS_LIT != 0) color = withRim(color, rimAt());
            if (load(IS_TONED) != 0) color = toned(color);
            if (load(FOG_RANGE) != 0) color = fogged(color, fogAt(attribute));
        }
        color = bounded(color);
        assembly ("memory-safe") {
            color := shr(PIXEL_AT, mul(and(add(color, HALF_LEVEL), BYTES_Q10), Q10_TO_PIXEL)) // rounded to levels, 0xBBGGRR
        }
    }

    /// @dev Returns the colour of the surface, lanes of Q10, 0..255.
    /// @param s, t Perspective-correct barycentric coordinates, Q24.
    function albedoAt(uint256 s, uint256 t) private pure returns (uint256 albedo) {
        assembly ("memory-safe") {
            albedo := shr(Q24, add(add(mload(COLOR_0), mul(mload(COLOR_1), s)), mul(mload(COLOR_2), t))) // c0 + c1 s + c2 t
            albedo := and(albedo, LANES_32) // Q10, plus 2^24
            albedo := xor(albedo, ALBEDO_BIAS) // - 2^24 in each lane
            if and(add(albedo, ALBEDO_SLACK), BEYOND_ALBEDO) { // some lane is below 0 or above 255
                let inside := 0
                for { let i := 0 } lt(i, LANES_END) { i := add(i, MIDDLE_AT) } { // blue, green, red
                    let channel := and(shr(i, albedo), LANE_32)
                    if gt(channel, WHITE_10) { channel := mul(WHITE_10, lt(channel, ONE_24)) } // 0 if negative: the bias bit is still set
                    inside := or(inside, shl(i, channel)) // 0..255
                }
                albedo := inside
            }
        }
        if (load(HAS_DETAILS) != 0) {
            if (load(OPACITIES) != 0) setOpacity(s, t);
            if (load(TEXTURE) != 0) albedo = textured(albedo, Texture.colorAt(s, t));
            if (load(TONE_FLAGS) & TONE_GAMMA != 0) albedo = Gamma.decodeLanes(albedo);
        }
    }

    /// @dev Sets OPACITY to that of the fragment if vertices have opacities, which are in the uppermost lane of colours.
    function setOpacity(uint256 s, uint256 t) private pure {
        unchecked {
            uint256 sum = load(COLOR_0) + load(COLOR_1) * s + load(COLOR_2) * t;
            // as for the channels
            int256 opacity = int256(sum >> (OPACITY_AT + Q24)) - int256(ONE_24);
            if (opacity < 0) opacity = 0;
            if (opacity > int256(WHITE_10)) opacity = int256(WHITE_10);
            store(OPACITY, uint256(opacity) * load(OBJECT_OPACITY) / WHITE_10);
        }
    }

    /// @dev Multiplies lanes of Q10 by those of a texture, Q16.
    function textured(uint256 color, uint256 texture) private pure returns (uint256 product) {
        assembly ("memory-safe") {
            product := shr(Q16, mul(and(color, LANE_32), and(texture, LANE_24))) // blue
            let channel := shr(Q16, mul(and(shr(MIDDLE_AT, color), LANE_32), and(shr(MIDDLE_AT, texture), LANE_24))) // green
            product := or(product, shl(MIDDLE_AT, channel))
            product := or(product, shl(UPPER_AT, shr(Q16, mul(shr(UPPER_AT, color), shr(UPPER_AT, texture))))) // red
        }
    }

    /// @dev Returns albedo times FRAGMENT_LIGHT (Q40), plus highlights; lanes of Q10.
    function lit(uint256 albedo, uint256 highlights) private pure returns (uint256 color) {
        assembly ("memory-safe") {
            let light := mload(FRAGMENT_LIGHT) // lanes of Q40
            color := shr(Q16, mul(and(albedo, LANE_32), and(shr(BLUE_Q40_AT, light), LANE_32))) // Q10 times Q16
            color := add(color, shl(MIDDLE_AT, shr(Q16, mul(and(shr(MIDDLE_AT, albedo), LANE_32), and(shr(GREEN_Q40_AT, light), LANE_32)))))
            color := add(color, shl(UPPER_AT, shr(Q16, mul(shr(UPPER_AT, albedo), and(shr(RED_Q40_AT, light), LANE_32))))) // red
            color := add(color, highlights) // may exceed 255
        }
    }

    /// @dev Returns a colour plus the rim at this strength, Q24.
    function withRim(uint256 color, uint256 strength) private pure returns (uint256) {
        unchecked {
            return color + (((load(RIM_COLOR) * strength) >> Q24) & LANES_24);
        }
    }

    /// @dev Returns a colour blended with the fog at this strength, Q16.
    function fogged(uint256 color, uint256 strength) private pure returns (uint256) {
        unchecked {
            if (strength == 0) return color;
            color = bounded(color) * (ONE_16 - strength) + load(FOG_COLOR) * strength;
            return (color >> Q16) & LANES_24;
        }
    }

    /// @dev Returns a colour with channels clamped to 255, lanes of Q10.
    function bounded(uint256 color) private pure returns (uint256 levels) {
        assembly ("memory-safe") {
            levels := color
            let beyond := and(add(color, BELOW_BEYOND), BEYOND_LEVELS) // a bit for each lane above 255
            if beyond { // rarely
                beyond := shr(BEYOND_AT, beyond) // 1 in each
                levels := or(and(color, not(mul(beyond, LANE_56))), mul(beyond, WHITE_10)) // 255 there
            }
        }
    }

    /// @dev Adds the light from above and below to FRAGMENT_LIGHT, lanes of Q40.
    function addHemisphere() private pure {
        assembly ("memory-safe") {
            if or(mload(HEMISPHERE_SKY), mload(HEMISPHERE_GROUND)) { // there is a hemisphere
                let up := mload(FACE_UP) // N.up, Q24
                if and(mload(MODE), IS_SMOOTH) { // else that of the face
                    up := add(mul(mload(FRAGMENT_NORMAL_X), mload(UP_X)), mul(mload(FRAGMENT_NORMAL_Y), mload(UP_Y)))
                    up := sdiv(add(up, mul(mload(FRAGMENT_NORMAL_Z), mload(UP_Z))), mload(FRAGMENT_NORMAL_LENGTH)) // N . UP / |N|
                }
                if sgt(up, ONE_24) { up := ONE_24 }
                if slt(up, sub(0, ONE_24)) { up := sub(0, ONE_24) } // -1..1
                up := shr(1, add(ONE_24, up)) // from here on, the share of the sky: (1 + N.up) / 2
                up := add(mul(mload(HEMISPHERE_SKY), up), mul(mload(HEMISPHERE_GROUND), sub(ONE_24, up))) // from here on, the light, Q40
                mstore(FRAGMENT_LIGHT, add(mload(FRAGMENT_LIGHT), up)) // for `lit`
            }
        }
    }

    /// @dev Returns the strength of the rim at a fragment, Q24.
    function rimAt() private pure returns (uint256 strength) {
        unchecked {
            uint256 normalRay = load(FRAGMENT_NORMAL_RAY);
            uint256 length = load(FRAGMENT_NORMAL_LENGTH) * load(FRAGMENT_RAY_LENGTH);
            uint256 part;
            assembly ("memory-safe") {
                part := add(ONE_24, sdiv(shl(Q24, normalRay), length)) // 1 - N.V, where V = -ray
                if sgt(part, ONE_24) { part := ONE_24 } // N.V < 0
                part := mul(part, sgt(part, 0)) // at least 0
            }
            strength = ONE_24;
            for (uint256 i = load(RIM_POWER); i != 0; --i) strength = (strength * part) >> Q24;
        }
    }

    /// @dev Returns the opacity of the fog at a depth, Q16.
    function fogAt(uint256 depth) private pure returns (uint256 strength) {
        assembly ("memory-safe") {
            let distance := shl(DEPTH_FRACTION, mload(DEPTH_SCALE)) // along the line of sight, Q32
            switch and(mload(MODE), IS_ORTHOGRAPHIC)
            case 0 { distance := div(distance, depth) } // scale / depth
            default { distance := sub(distance, depth) } // scale - depth
            distance := sub(distance, mload(FOG_NEAR)) // how far into the fog
            distance := mul(distance, sgt(distance, 0)) // at least 0
            strength := div(shl(Q16, distance), mload(FOG_RANGE)) // (distance - near) / (far - near)
            if gt(strength, ONE_16) { strength := ONE_16 } // opaque
        }
    }

    /// @dev Returns the displayed colour, lanes of Q10, 0..255.
    function toned(uint256 color) private pure returns (uint256 shown) {
        unchecked {
            uint256 flags = load(TONE_FLAGS);
            // Four lights, ambient light and a hemisphere, with coefficients up to 4, are less than 2^24; exposures are at most 2^22
            color = ((color * load(EXPOSURE)) >> Q16) & LANES_40;
            if (flags == 0) return bounded(color);
            for (uint256 i; i != LANES_END; i += MIDDLE_AT) {
                uint256 channel;
                assembly ("memory-safe") {
                    channel := div(shl(Q16_TO_Q10, and(shr(i, color), LANE_56)), 255) // Q16, where 1 is white
                    if and(flags, TONE_FILMIC) {
                        if gt(channel, BRIGHTEST_FILMIC) { channel := BRIGHTEST_FILMIC } // white above 64
                        let divisor := add(mul(channel, add(mul(243, channel), FILMIC_59)), FILMIC_14) // x (2.43 x + 0.59) + 0.14
                        channel := div(shl(Q16, mul(channel, add(mul(251, channel), FILMIC_3))), divisor) // x (2.51 x + 0.03) / ..
                    }
                    if gt(channel, ONE_16) { channel := ONE_16 } // at most 1
                }
                if (flags & TONE_GAMMA != 0) channel = Gamma.encode(channel) << (Q10 - Q8);
                else channel = (channel * 255) >> Q16_TO_Q10;
                shown |= channel << i;
            }
        }
    }
}
