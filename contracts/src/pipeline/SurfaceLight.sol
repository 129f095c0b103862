// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Gamma} from "../math/Gamma.sol";
import {sqrt} from "../math/Roots.sol";
import {TONE_FILMIC, TONE_GAMMA} from "./Effects.sol";
import {FragmentLight} from "./FragmentLight.sol";
import "./Registers.sol";

// The fragment shader of scenes with effects. With albedo, light and highlights of FragmentLight:
//
//   radiance = albedo * (light + hemisphere) + highlights + rim * (1 - max(N.V, 0))^power
//   hemisphere = ambient coefficient * (ground + (sky - ground) * (1 + N.up) / 2)
//   colour = tone(radiance * exposure), mixed with that of the fog by the distance along the line of sight
//
// In linear light (gamma) the albedo is decoded from sRGB, and the colour is encoded; the colours of lights are decoded before.
// The filmic tone is x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14), the fit of the ACES curve by Krzysztof Narkowicz.

/// @dev 255 levels, Q10.
uint256 constant WHITE_10 = 0x3fc00;
/// @dev Radiance above 2^30 levels, and values of the filmic curve above 64 (Q16), are as good as white.
uint256 constant BRIGHTEST = 1 << 40;
uint256 constant BRIGHTEST_FILMIC = 1 << 22;
/// @dev Where the lanes of a colour begin, and what is in one.
uint256 constant LANE_56 = 0xffffffffffffff;

library SurfaceLight {
    /// @notice The colour where the accumulator and the ray are these: lanes of 85 bits, Q10, 0..255.
    /// @param attribute The accumulator of barycentric coordinates.
    /// @param x, y As for FragmentLight.
    function colorAt(uint256 attribute, uint256 x, uint256 y) internal pure returns (uint256 color) {
        unchecked {
            uint256 s;
            uint256 t;
            assembly ("memory-safe") {
                s := sar(ACCUMULATOR_S_AT, signextend(ACCUMULATOR_S_LAST_BYTE, attribute))
                t := sar(ACCUMULATOR_T_AT, signextend(ACCUMULATOR_T_LAST_BYTE, attribute))
                attribute := shr(ACCUMULATOR_DEPTH_AT, attribute)
            }
            uint256 albedo = albedoAt(attribute, s, t);
            uint256 highlights;
            uint256 rim;
            bool isLit = load(MODE) & IS_LIT != 0;
            if (isLit) {
                highlights = FragmentLight.colorAt(attribute, s, t, x, y);
                addHemisphere();
                if (load(RIM_COLOR) != 0) rim = rimAt(x, y);
            }
            uint256 light = load(FRAGMENT_LIGHT);
            uint256 fog = load(FOG_RANGE) == 0 ? 0 : fogAt(attribute);
            for (uint256 i; i != 3; ++i) {
                uint256 channel = (albedo >> (MIDDLE_AT * i)) & LANE_32;
                if (isLit) {
                    channel = (channel * (((light >> (MIDDLE_AT * i)) & LANE_56) >> 24)) >> 16;
                    channel += (highlights >> (MIDDLE_85_AT * i)) & LANE_85;
                    channel += (((load(RIM_COLOR) >> (MIDDLE_AT * i)) & LANE_32) * rim) >> (Q24 - Q10);
                }
                channel = toned(channel);
                if (fog != 0) {
                    channel = (channel * (ONE_16 - fog) + (((load(FOG_COLOR) >> (MIDDLE_AT * i)) & LANE_32) << Q10) * fog) >> Q16;
                }
                color |= channel << (MIDDLE_85_AT * i);
            }
        }
    }

    /// @dev The colour of the surface itself, lanes of Q10, 0..255.
    function albedoAt(uint256 depth, uint256 s, uint256 t) private pure returns (uint256 albedo) {
        unchecked {
            uint256 color;
            assembly ("memory-safe") {
                // as in FragmentLight
                let mode := mload(MODE)
                if iszero(and(mode, IS_ORTHOGRAPHIC)) {
                    s := sdiv(mul(s, mload(DEPTH_1)), depth)
                    t := sdiv(mul(t, mload(DEPTH_2)), depth)
                    if and(mode, IS_STEEP) {
                        if sgt(s, ONE_24) { s := ONE_24 }
                        if sgt(t, ONE_24) { t := ONE_24 }
                    }
                }
                color := shr(24, add(add(mload(ALBEDO_0), mul(mload(ALBEDO_1), s)), mul(mload(ALBEDO_2), t)))
            }
            bool isLinear = load(TONE_FLAGS) & TONE_GAMMA != 0;
            for (uint256 i; i != 3; ++i) {
                uint256 channel = (color >> (MIDDLE_AT * i)) & LANE_32;
                // each lane has 2^24 too much, so that it is positive
                channel = channel < ONE_24 ? 0 : channel - ONE_24;
                if (channel > WHITE_10) channel = WHITE_10;
                if (isLinear) channel = Gamma.decode(channel);
                albedo |= channel << (MIDDLE_AT * i);
            }
        }
    }

    /// @dev Adds the light from above and below to FRAGMENT_LIGHT, lanes of Q40.
    function addHemisphere() private pure {
        assembly ("memory-safe") {
            if or(mload(HEMISPHERE_SKY), mload(HEMISPHERE_GROUND)) {
                // N.up, Q24
                let up := mload(FACE_UP)
                if and(mload(MODE), IS_SMOOTH) {
                    up := add(mul(mload(FRAGMENT_NORMAL_X), mload(UP_X)), mul(mload(FRAGMENT_NORMAL_Y), mload(UP_Y)))
                    up := sdiv(add(up, mul(mload(FRAGMENT_NORMAL_Z), mload(UP_Z))), mload(FRAGMENT_NORMAL_LENGTH))
                }
                if sgt(up, ONE_24) { up := ONE_24 }
                if slt(up, sub(0, ONE_24)) { up := sub(0, ONE_24) }
                up := shr(1, add(ONE_24, up))
                up := add(mul(mload(HEMISPHERE_SKY), up), mul(mload(HEMISPHERE_GROUND), sub(ONE_24, up)))
                mstore(FRAGMENT_LIGHT, add(mload(FRAGMENT_LIGHT), up))
            }
        }
    }

    /// @dev How strong the rim is at a fragment, Q24.
    function rimAt(uint256 x, uint256 y) private pure returns (uint256 strength) {
        unchecked {
            uint256 normalRay = load(FRAGMENT_NORMAL_RAY);
            uint256 length = load(FRAGMENT_NORMAL_LENGTH);
            if (load(MODE) & IS_ORTHOGRAPHIC == 0) length *= sqrt(x * x + y * y + ONE_48);
            else length <<= Q24;
            uint256 part;
            assembly ("memory-safe") {
                // 1 - N.V, where V = -ray
                part := add(ONE_24, sdiv(shl(24, normalRay), length))
                if sgt(part, ONE_24) { part := ONE_24 }
                part := mul(part, sgt(part, 0))
            }
            strength = ONE_24;
            for (uint256 i = load(RIM_POWER); i != 0; --i) strength = (strength * part) >> Q24;
        }
    }

    /// @dev How much the fog hides at a depth, Q16.
    function fogAt(uint256 depth) private pure returns (uint256 strength) {
        assembly ("memory-safe") {
            let distance := shl(8, mload(DEPTH_SCALE))
            switch and(mload(MODE), IS_ORTHOGRAPHIC)
            case 0 { distance := div(distance, depth) }
            default { distance := sub(distance, depth) }
            distance := sub(distance, mload(FOG_NEAR))
            distance := mul(distance, sgt(distance, 0))
            strength := div(shl(16, distance), mload(FOG_RANGE))
            if gt(strength, ONE_16) { strength := ONE_16 }
        }
    }

    /// @dev A channel, Q10, as it is shown: 0..255, Q10.
    function toned(uint256 channel) private pure returns (uint256) {
        unchecked {
            if (channel > BRIGHTEST) channel = BRIGHTEST;
            channel = (channel * load(EXPOSURE)) >> Q16;
            uint256 flags = load(TONE_FLAGS);
            if (flags == 0) return channel > WHITE_10 ? WHITE_10 : channel;
            // Q16, where 1 is white
            channel = (channel << 6) / 255;
            if (flags & TONE_FILMIC != 0) {
                if (channel > BRIGHTEST_FILMIC) channel = BRIGHTEST_FILMIC;
                uint256 divisor = channel * (243 * channel + 59 * ONE_16) + 14 * ONE_32;
                channel = ((channel * (251 * channel + 3 * ONE_16)) << Q16) / divisor;
            }
            if (channel > ONE_16) channel = ONE_16;
            return flags & TONE_GAMMA != 0 ? Gamma.encode(channel) << 2 : (channel * 255) >> 6;
        }
    }
}
