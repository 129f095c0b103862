// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {EffectSamples} from "../effects/EffectSamples.sol";
import {Lighting} from "../pipeline/shading/Lighting.sol";
import {SampleBuffer} from "../pipeline/samples/SampleBuffer.sol";
import {SampleWires} from "../pipeline/samples/SampleWires.sol";
import {Rasterizer} from "../pipeline/geometry/Rasterizer.sol";
import {ShadowRows} from "../shadows/ShadowRows.sol";
import {Texture} from "../effects/Texture.sol";
import {Shading} from "../pipeline/shading/Shading.sol";
import {SmoothShading} from "../pipeline/shading/SmoothShading.sol";
import "../words/EffectRegisters.sol";

/// @title EffectsEngine: transforms vertices to pixels, for scenes with effects.
/// @notice Called by the Renderer: see Engine. Draws all objects of a scene that has any record of EffectRecords, with four samples per
/// pixel, and shades every fragment individually.
contract EffectsEngine is SampleBuffer, SampleWires, EffectSamples {
    function registersEnd() internal pure override returns (uint256) {
        return EFFECT_REGISTERS_END;
    }

    /// @dev Reads the effects of the frame into their registers.
    function openFrame() internal pure override {
        unchecked {
            copyCalldata(EFFECT_FRAME_BEGIN, load(EFFECTS_OFFSET), EFFECT_FRAME_SIZE);
            uint256 shadows = load(SHADOWS_OFFSET);
            if (shadows == 0) return;
            store(SHADOWS, load(EFFECTS_OFFSET) + shadows);
            // allocated before the vertex records
            store(SHADOW_ROW, freeMemory());
            setFreeMemory(freeMemory() + 32 * load(TILE_WIDTH));
        }
    }

    /// @dev Reads the effects of the current object into their registers.
    function openObject(uint256 records) internal pure override {
        unchecked {
            uint256 number = load(OBJECT_NUMBER);
            uint256 effects = load(EFFECTS_OFFSET) + EFFECT_FRAME_SIZE + number * EFFECT_OBJECT_SIZE;
            copyCalldata(EFFECT_OBJECT_BEGIN, effects, EFFECT_OBJECT_SIZE);
            store(OBJECT_OPACITY, load(OPACITY));
            if (load(OBJECT_MODE) & IS_BLENDED != 0) store(FADE_RANGE, 0);
            store(AMBIENT, load(OBJECT_AMBIENT));
            uint256 register = LIGHT_COLORS;
            for (uint256 light = LIGHTS; light != load(LIGHTS_END); light += LIGHT_SIZE) {
                store(light + LIGHT_COLOR, load(register));
                store(light + LIGHT_DIFFUSE, load(register + LIGHT_DIFFUSES - LIGHT_COLORS));
                register += 32;
            }
            if (load(SHADOWS) != 0) ShadowRows.setObject(number);
            store(RECORDS, records);
            // that of the mode in both passes
            store(RECORD_SHIFT, recordShift(load(OBJECT_MODE)));
        }
    }

    function shade(uint256 a, uint256 b, uint256 c, uint256 crossing) internal pure override(Rasterizer, SmoothShading) {
        shadeExact(a, b, c, crossing);
    }

    function shadeExact(uint256 a, uint256 b, uint256 c, uint256 crossing) internal pure override {
        unchecked {
            uint256 mode = load(OBJECT_MODE) & ~IS_QUADRATIC;
            if (mode & IS_SMOOTH != 0) {
                Shading.setNormals(a, b, c);
            } else if (mode & IS_FLAT != 0) {
                Lighting.setFace(crossing);
                Lighting.setFacing();
                setFaceUp();
                mode |= IS_LIT | IS_DIFFUSE;
            }
            if (mode & IS_LIT != 0 && load(SHADOWS) != 0) mode |= ShadowRows.setFace();
            (uint256 attributesA, uint256 attributesB, uint256 attributesC) = Shading.attributesOf(a, b, c);
            Shading.setExact(a, b, c, attributesA, attributesB, attributesC, mode | crossing);
            // whether only shadows change the colour across the face
            bool varies = mode & (IS_SMOOTH | HAS_SPECULAR) | load(COLOR_1) | load(COLOR_2) | load(VARIES) != 0;
            store(IS_UNIFORM, varies ? 0 : 1);
            store(UNIFORM_LIT, 0);
            store(UNIFORM_DARK, 0);
            if (mode & IS_DEPTH_PASS != 0 && load(ALPHA) == 0) return;
            if (load(TEXTURE) != 0) Texture.setTriangle(a, b, c);
            if (load(OPACITIES) != 0) Texture.setOpacities(a, b, c);
        }
    }

    function setFaceUp() private pure {
        assembly ("memory-safe") {
            // as the direction of a light: see Lighting
            let up := sar(UPPER_86_AT, mul(mload(FACE_NORMAL), mload(UP_IN_MESH)))
            mstore(FACE_UP, sdiv(shl(Q16, up), mload(FACE_LENGTH)))
        }
    }

    function prepare(uint256 a, uint256 b, uint256 c) internal pure override {
        setGradients(a, b, c, FINE_BITS);
    }

    function drawFragments(uint256 row, uint256 last) internal pure override {
        drawSpans(row, last);
    }
}
