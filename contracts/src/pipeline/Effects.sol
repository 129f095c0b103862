// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Gamma} from "../math/Gamma.sol";
import {Extensions, RECORD_HEADER} from "../scene/Extensions.sol";
import {SceneErrors} from "../scene/SceneErrors.sol";
import {Ground} from "./Ground.sol";
import {ALL_SAMPLES, ShadowRows} from "./ShadowRows.sol";
import {TEXTURE_OF, Texture} from "./Texture.sol";
import "./Registers.sol";

// The records of effects: see Extensions. Those up to TONE are of the scene, with index 0; colours are three bytes, red, green, blue:
//
//   HEMISPHERE   the colours of the light from above, y up, and of that from below
//   RIM          the colour of the light at silhouettes, and the power by which it falls off, 1 byte, 1..16
//   FOG          its colour, and the distances along the line of sight at which it begins and at which it hides everything, 8 bytes each,
//                Q32, 0 to 2^58, the second above the first
//   TONE         what light is multiplied by in the end, 4 bytes, Q16, above 0, up to 64; and 1 byte of flags: see TONE_FILMIC
//   SHADOW       of the light that casts shadows; there is one at most: a word, which faces of culled objects do: see SHADOWS_ALL
//   GROUND       of an object that casts none, and fades into what is behind it: a word, of which the upper half has the distances from its
//                position at which it begins to fade and at which nothing is left of it, 8 bytes each, Q32, 0 to 2^58, the second above the
//                first
//
// What they do is told in SurfaceLight. An object may have a TEXTURE: see Texture. SHADOW and GROUND are checked by Shadows: see there, and
// Ground.

uint256 constant HEMISPHERE = 4;
uint256 constant RIM = 5;
uint256 constant FOG = 6;
uint256 constant TONE = 7;
uint256 constant SHADOW = 10;
uint256 constant GROUND = 11;

uint256 constant HEMISPHERE_SIZE = 6;
uint256 constant RIM_SIZE = 4;
uint256 constant FOG_SIZE = 19;
uint256 constant TONE_SIZE = 5;

uint256 constant MAX_RIM_POWER = 16;
/// @dev 2^26 units, Q32.
int256 constant MAX_FOG_DISTANCE = 1 << 58;
/// @dev Q16.
uint256 constant MAX_EXPOSURE = 64 << 16;
/// @dev Flags of a TONE: the filmic curve; light is added up in linear values, of which colours are decoded and encoded as sRGB.
uint256 constant TONE_FILMIC = 1;
uint256 constant TONE_GAMMA = 2;
/// @dev The greatest radius of a GROUND, 2^26 units, Q32.
uint256 constant MAX_FADE = 1 << 58;

/// @dev Which faces of culled objects cast shadows: all; those turned away from the light, enough where all such objects together are
/// closed; those turned to it.
uint256 constant SHADOWS_ALL = 1;
uint256 constant SHADOWS_AVERSE = 2;
uint256 constant SHADOWS_TURNED = 3;

library Effects {
    /// @notice Checks the records, and sets the registers of the frame by them.
    function setFrame() internal pure {
        unchecked {
            store(EXPOSURE, ONE_16);
            uint256 end = load(EFFECTS_END);
            for (uint256 record = load(EFFECTS); record != end; record += RECORD_HEADER + Extensions.sizeOf(record)) {
                uint256 key = Extensions.keyOf(record);
                (uint256 kind, uint256 index) = (key >> 16, key & 0xffff);
                if (kind == SHADOW) store(SHADOW_LIGHT, LIGHTS + index * LIGHT_SIZE);
                if (kind == SHADOW || kind == GROUND) continue;
                if (kind == TEXTURE_OF) {
                    Texture.check(record, index);
                    continue;
                }
                if (kind > TONE) revert SceneErrors.UnknownExtension(kind, index);
                uint256 expected = sizeOf(kind);
                uint256 size = Extensions.sizeOf(record);
                if (size != expected) revert SceneErrors.ExtensionSize(kind, index, expected, size);
                if (index != 0) revert SceneErrors.ExtensionIndex(kind, index, 1);
                uint256 content = Extensions.word(record + RECORD_HEADER);
                if (kind == HEMISPHERE) setHemisphere(content);
                else if (kind == RIM) setRim(content);
                else if (kind == FOG) setFog(content);
                else setTone(content);
            }
            store(IS_TONED, load(TONE_FLAGS) != 0 || load(EXPOSURE) != ONE_16 ? 1 : 0);
            if (load(TONE_FLAGS) & TONE_GAMMA != 0) decodeLights();
            if (load(SHADOW_LIGHT) != 0) store(SHADOW_COLOR, load(load(SHADOW_LIGHT) + LIGHT_COLOR));
        }
    }

    function sizeOf(uint256 kind) private pure returns (uint256) {
        if (kind == HEMISPHERE) return HEMISPHERE_SIZE;
        if (kind == RIM) return RIM_SIZE;
        return kind == FOG ? FOG_SIZE : TONE_SIZE;
    }

    function setHemisphere(uint256 content) private pure {
        store(SKY_COLOR, lanes(content));
        store(GROUND_COLOR, lanes(content << 24));
    }

    function setRim(uint256 content) private pure {
        uint256 power = (content >> 224) & 0xff;
        if (power == 0 || power > MAX_RIM_POWER) revert SceneErrors.RimPowerOutOfRange(power);
        store(RIM_COLOR, lanes(content));
        store(RIM_POWER, power);
    }

    function setFog(uint256 content) private pure {
        unchecked {
            (int256 near, int256 far) = (int256(content << 24) >> 192, int256(content << 88) >> 192);
            if (near < 0 || near >= far || far > MAX_FOG_DISTANCE) revert SceneErrors.FogOutOfRange(near, far);
            store(FOG_COLOR, lanes(content));
            storeSigned(FOG_NEAR, near);
            storeSigned(FOG_RANGE, far - near);
        }
    }

    function setTone(uint256 content) private pure {
        (uint256 exposure, uint256 flags) = (content >> 224, (content >> 216) & 0xff);
        if (exposure == 0 || exposure > MAX_EXPOSURE) revert SceneErrors.ExposureOutOfRange(exposure);
        if (flags > TONE_FILMIC | TONE_GAMMA) revert SceneErrors.UnknownToneFlags(flags);
        store(EXPOSURE, exposure);
        store(TONE_FLAGS, flags);
    }

    /// @dev The colours of lights as linear ones, to the nearest level.
    function decodeLights() private pure {
        unchecked {
            Gamma.setTables();
            for (uint256 record = LIGHTS; record != load(LIGHTS_END); record += LIGHT_SIZE) decode(record + LIGHT_COLOR);
            decode(AMBIENT_LIGHT);
            decode(SKY_COLOR);
            decode(GROUND_COLOR);
            decode(RIM_COLOR);
        }
    }

    function decode(uint256 register) private pure {
        unchecked {
            uint256 color = load(register);
            uint256 linear;
            for (uint256 i; i != 3 * MIDDLE_AT; i += MIDDLE_AT) {
                linear |= ((Gamma.decode(((color >> i) & 0xff) << Q10) + (ONE_10 >> 1)) >> Q10) << i;
            }
            store(register, linear);
        }
    }

    /// @notice What the light of the frame is to the object whose uniforms were read.
    function setObject() internal pure {
        unchecked {
            uint256 shadow = load(SHADOW_LIGHT);
            // as it is without shadows
            if (shadow != 0) store(shadow + LIGHT_COLOR, load(SHADOW_COLOR));
            uint256 index = load(OBJECT_INDEX);
            Ground.setObject(load(OBJECT_FIRST) + index);
            ShadowRows.setObject(load(OBJECT_FIRST) + index);
            if (load(LISTS) != 0) {
                // an array of pointers to the lists of objects, which begin with the place of the records
                store(RECORDS, load(load(load(LISTS) + 32 + 32 * index)));
                Texture.setObject(load(OBJECT_FIRST) + index);
            }
            uint256 k = load(AMBIENT_COEFFICIENT);
            store(HEMISPHERE_SKY, scaled(load(SKY_COLOR), k));
            store(HEMISPHERE_GROUND, scaled(load(GROUND_COLOR), k));
            if (load(TONE_FLAGS) & TONE_GAMMA != 0) {
                store(AMBIENT, scaled(load(AMBIENT_LIGHT), k));
                k = load(DIFFUSE_COEFFICIENT);
                for (uint256 record = LIGHTS; record != load(LIGHTS_END); record += LIGHT_SIZE) {
                    store(record + LIGHT_DIFFUSE, scaled(load(record + LIGHT_COLOR), k));
                }
            }
            if (shadow != 0) {
                store(SHADOW_DIFFUSE, load(shadow + LIGHT_DIFFUSE));
                store(SHADOW_SHARE, ALL_SAMPLES);
            }
        }
    }

    /// @dev Lanes of bytes times a coefficient (Q16), lanes of Q16 where 255 is one.
    function scaled(uint256 color, uint256 k) private pure returns (uint256 light) {
        unchecked {
            for (uint256 i; i != 3 * MIDDLE_AT; i += MIDDLE_AT) light |= (((color >> i) & 0xff) * k / 255) << i;
        }
    }

    /// @dev The colour at the top of a word as lanes of bytes.
    function lanes(uint256 content) private pure returns (uint256) {
        unchecked {
            return (content >> 248) << UPPER_AT | ((content >> 240) & 0xff) << MIDDLE_AT | ((content >> 232) & 0xff);
        }
    }
}
