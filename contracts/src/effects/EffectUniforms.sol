// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Gamma} from "./Gamma.sol";
import {ALPHA_HEADER, EffectRecords} from "./EffectRecords.sol";
import {Extensions} from "../scene/Extensions.sol";
import "../words/Records.sol";
import {Light, Material, Object, Scene, POINT, UNLIT, Vector, Matrix} from "../scene/Scene.sol";
import {Lights} from "../uniforms/Lights.sol";
import {MeshSpace} from "../uniforms/MeshSpace.sol";
import {Transform} from "../uniforms/Transform.sol";
import {View} from "../uniforms/View.sol";
import "../words/EffectRegisters.sol";

// Computes the values of `read` and `object_of` of picture.py that effects need, as registers.

/// @notice Ambient light, light from above, and light from below: lanes of bytes.
struct Ambient {
    uint256 light;
    uint256 sky;
    uint256 ground;
}

/// @notice Sets the effect registers of the frame and of an object. The records must have been checked.
library EffectUniforms {
    /// @notice Sets the registers of the frame, except for SHADOWS_OFFSET.
    /// @return ambient The light to be multiplied by the objects' coefficients.
    function setFrame(View memory view_, Scene calldata scene) internal pure returns (Ambient memory ambient) {
        unchecked {
            // the products with (0, 1, 0)
            storeSigned(UP_X, view_.right.y.raw() >> (Q32 - Q24));
            storeSigned(UP_Y, view_.down.y.raw() >> (Q32 - Q24));
            storeSigned(UP_Z, view_.forward.y.raw() >> (Q32 - Q24));
            store(EXPOSURE, ONE_16);
            (uint256 record, uint256 end) = Extensions.behind(scene, ANTIALIAS);
            for (; record != end; record += RECORD_HEADER + Extensions.sizeOf(record)) {
                uint256 key = Extensions.keyOf(record);
                (uint256 kind, uint256 index) = (key >> 16, key & 0xffff);
                uint256 content = loadCalldata(record + RECORD_HEADER);
                if (kind == HEMISPHERE) {
                    ambient.sky = lanes(content);
                    ambient.ground = lanes(content << 24);
                } else if (kind == RIM) {
                    store(RIM_COLOR, lanes(content));
                    store(RIM_POWER, EffectRecords.rimPower(content));
                } else if (kind == FOG) {
                    (int256 near, int256 far) = EffectRecords.fogDistances(content);
                    store(FOG_COLOR, lanes(content) << Q10);
                    storeSigned(FOG_NEAR, near);
                    storeSigned(FOG_RANGE, far - near);
                } else if (kind == TONE) {
                    (uint256 exposure, uint256 flags) = EffectRecords.toneOf(content);
                    store(EXPOSURE, exposure);
                    store(TONE_FLAGS, flags);
                    store(IS_TONED, flags != 0 || exposure != ONE_16 ? 1 : 0);
                } else if (kind == SHADOW) {
                    store(SHADOW_LIGHT, LIGHTS + index * LIGHT_SIZE);
                }
            }
            if (load(TONE_FLAGS) & TONE_GAMMA != 0) Gamma.setTables();
            ambient.light = lightOf(Lights.colorLanes(scene.ambientLight));
            ambient.sky = lightOf(ambient.sky);
            ambient.ground = lightOf(ambient.ground);
            store(RIM_COLOR, lightOf(load(RIM_COLOR)));
            Light[] calldata lights = scene.lights;
            for (uint256 i; i != lights.length; ++i) store(LIGHT_COLORS + 32 * i, lightOf(Lights.colorLanes(lights[i].color)));
        }
    }

    /// @notice Sets the registers of an object.
    /// @param moved The difference between the scene's positions in the engine's calldata and in this call.
    function setObject(View memory view_, Scene calldata scene, Ambient memory ambient, uint256 number, uint256 moved) internal pure {
        unchecked {
            Object calldata object = scene.objects[number];
            Matrix memory rotation = object.rotation.toMatrix();
            if (object.material.shading != UNLIT) setLight(object.material, ambient, scene.lights.length);
            MeshSpace.storeLanes(UP_IN_MESH, Vector(rotation.x.y, rotation.y.y, rotation.z.y));
            uint256 content = Extensions.find(scene, TEXTURE_OF, number);
            store(TEXTURE, content == 0 ? 0 : content + moved);
            store(TEXTURE_UVS, content == 0 ? 0 : EffectRecords.uvsOf(content) + moved);
            content = Extensions.find(scene, ALPHA_OF, number);
            store(ALPHA, content == 0 ? 0 : content + ALPHA_HEADER + moved);
            if (content != 0) content = loadCalldata(content) >> 248;
            store(ALPHA_LEAST, content == 0 ? 1 : 257 * content);
            content = Extensions.find(scene, OPACITIES_OF, number);
            store(OPACITIES, content == 0 ? 0 : content + moved);
            content = Extensions.find(scene, EMISSION_OF, number);
            store(EMISSION, content == 0 ? 0 : lightOf(Lights.colorLanes(loadCalldata(content))));
            store(IS_CHANGED, load(EMISSION) | load(RIM_COLOR) | load(IS_TONED) | load(FOG_RANGE) != 0 ? 1 : 0);
            store(HAS_DETAILS, load(TEXTURE) | load(OPACITIES) | (load(TONE_FLAGS) & TONE_GAMMA) != 0 ? 1 : 0);
            uint256 varies = load(TEXTURE) | load(OPACITIES) | load(FOG_RANGE) | load(RIM_COLOR);
            for (uint256 i; i != scene.lights.length; ++i) {
                if (scene.lights[i].kind == POINT) varies |= 1;
            }
            store(VARIES, varies);
            content = Extensions.find(scene, GROUND, number);
            if (content == 0) {
                store(FADE_RANGE, 0);
            } else {
                (uint256 inner, uint256 outer) = EffectRecords.radiiOf(loadCalldata(content));
                store(FADE_SQUARE, outer * outer);
                store(FADE_RANGE, outer * outer - inner * inner);
                Transform.setMatrix(view_, object, rotation);
                setFadePlace();
            }
        }
    }

    function setLight(Material calldata material, Ambient memory ambient, uint256 lights) private pure {
        unchecked {
            uint256 k = uint256(material.ambient.raw()) >> (Q32 - Q16);
            store(OBJECT_AMBIENT, scaled(ambient.light, k));
            store(HEMISPHERE_SKY, scaled(ambient.sky, k));
            store(HEMISPHERE_GROUND, scaled(ambient.ground, k));
            k = uint256(material.diffuse.raw()) >> (Q32 - Q16);
            for (uint256 i; i != 32 * lights; i += 32) store(LIGHT_DIFFUSES + i, scaled(load(LIGHT_COLORS + i), k));
        }
    }

    /// @dev Sets the position of the object in camera space, from the column and row at which it appears.
    function setFadePlace() private pure {
        unchecked {
            uint256 clip = load(MATRIX_T) + CLIP_BIAS;
            int256 w = int256(clip) >> CLIP_W_AT;
            int256 x = int256(clip & CLIP_X_MASK) - int256(CLIP_HALF);
            int256 y = int256((clip >> CLIP_Y_AT) & CLIP_Y_MASK) - int256(CLIP_HALF);
            storeSigned(FADE_Z, w);
            storeSigned(FADE_X, placeOf(loadSigned(RAY_LEFT), x, w));
            storeSigned(FADE_Y, placeOf(loadSigned(RAY_TOP), y, w));
        }
    }

    function placeOf(int256 first, int256 column, int256 w) private pure returns (int256) {
        unchecked {
            int256 step = loadSigned(RAY_STEP);
            if (load(FRAME_IS_ORTHOGRAPHIC) != 0) return first + ((column * step) >> (Q32 + SUBPIXEL_BITS));
            return (first * w + ((column * step) >> SUBPIXEL_BITS)) >> Q24;
        }
    }

    /// @dev Converts the colour of a light from lanes of bytes to lanes of Q10, linear values if light is linear.
    function lightOf(uint256 color) private pure returns (uint256) {
        return load(TONE_FLAGS) & TONE_GAMMA == 0 ? color << Q10 : Gamma.decodeLanes(color << Q10);
    }

    /// @dev Returns lanes of Q10 times a coefficient (Q16): lanes of Q16 where 255 is one.
    function scaled(uint256 color, uint256 k) private pure returns (uint256 light) {
        unchecked {
            for (uint256 i; i != 3 * MIDDLE_AT; i += MIDDLE_AT) light |= (((color >> i) & LANE_24) * k / (255 << Q10)) << i;
        }
    }

    /// @dev Returns the colour at the top of a word as lanes of bytes.
    function lanes(uint256 content) private pure returns (uint256) {
        unchecked {
            return (content >> 248) << UPPER_AT | ((content >> 240) & 0xff) << MIDDLE_AT | ((content >> 232) & 0xff);
        }
    }
}
