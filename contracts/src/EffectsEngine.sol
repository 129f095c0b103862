// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {EffectSamples} from "./pipeline/EffectSamples.sol";
import {Lighting} from "./pipeline/Lighting.sol";
import {Pipeline} from "./pipeline/Pipeline.sol";
import {SampleBuffer} from "./pipeline/SampleBuffer.sol";
import {SampleWires} from "./pipeline/SampleWires.sol";
import {Rasterizer} from "./pipeline/Rasterizer.sol";
import {ShadowRows} from "./pipeline/ShadowRows.sol";
import {Texture} from "./pipeline/Texture.sol";
import {Shading} from "./pipeline/Shading.sol";
import {SmoothShading} from "./pipeline/SmoothShading.sol";
import {Rectangle} from "./scene/Scene.sol";
import "./pipeline/Registers.sol";

/// @title EffectsEngine: transforms vertices to pixels, for scenes with effects.
/// @notice Called by the Renderer: see Engine. Draws all objects of a scene that has a hemisphere light, a rim, fog, a tone, a texture, a
/// shadow or a ground, with four samples per pixel, and shades every fragment individually.
contract EffectsEngine is SampleBuffer, SampleWires {
    function openPicture(Rectangle memory tile, uint256 image, uint256 bandRows, uint256[3][] memory lists)
        internal
        pure
        override
        returns (uint256)
    {
        assembly ("memory-safe") {
            mstore(LISTS, lists)
        }
        // a single object is not read again
        if (lists.length == 1) setObject();
        return super.openPicture(tile, image, bandRows, lists);
    }

    function readObject(uint256 position) internal pure override returns (uint256 next) {
        unchecked {
            if (load(EXPOSURE) == 0) setFrame();
            next = super.readObject(position);
            if (load(LISTS) != 0) setObject();
        }
    }

    /// @dev Reads the effects of the frame into their registers.
    function setFrame() private pure {
        unchecked {
            copyCalldata(EFFECT_FRAME_BEGIN, load(EFFECTS), EFFECT_FRAME_SIZE);
            if (load(SHADOWS) == 0) return;
            store(SHADOWS, load(EFFECTS) + load(SHADOWS));
            // allocated before the vertex records
            store(SHADOW_ROW, freeMemory());
            setFreeMemory(freeMemory() + 32 * load(TILE_WIDTH));
        }
    }

    /// @dev Reads the effects of the current object into their registers.
    function setObject() private pure {
        unchecked {
            uint256 number = load(OBJECT_NUMBER);
            copyCalldata(
                EFFECT_OBJECT_BEGIN, load(EFFECTS) + EFFECT_FRAME_SIZE + number * EFFECT_OBJECT_SIZE, EFFECT_OBJECT_SIZE
            );
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
            // the calldata includes every textured object
            if (load(TEXTURE) | load(OPACITIES) != 0) {
                // an array of pointers to the objects' lists, each of which begins with the address of the records
                store(RECORDS, load(load(load(LISTS) + 32 + 32 * (number - load(OBJECT_FIRST)))));
            }
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
                Lighting.setFace();
                Lighting.setFacing();
                setFaceUp();
                mode |= IS_LIT | IS_DIFFUSE;
            }
            if (mode & IS_LIT != 0 && load(SHADOWS) != 0) mode |= ShadowRows.setFace();
            (uint256 attributesA, uint256 attributesB, uint256 attributesC) = Shading.attributesOf(a, b, c);
            Shading.setExact(a, b, c, attributesA, attributesB, attributesC, mode | crossing);
            store(IS_UNIFORM, isUniform(mode) ? 1 : 0);
            store(UNIFORM_LIT, 0);
            store(UNIFORM_DARK, 0);
            if (mode & IS_DEPTH_PASS != 0) return;
            if (load(TEXTURE) != 0) Texture.setTriangle(a, b, c, recordShift(mode));
            if (load(OPACITIES) != 0) Texture.setOpacities(a, b, c, recordShift(mode));
        }
    }

    /// @dev Returns whether only shadows change the colour across the face.
    function isUniform(uint256 mode) private pure returns (bool) {
        unchecked {
            if (mode & (IS_SMOOTH | HAS_SPECULAR) != 0) return false;
            if (load(COLOR_1) | load(COLOR_2) | load(TEXTURE) | load(OPACITIES) | load(FOG_RANGE) | load(RIM_COLOR) != 0) return false;
            for (uint256 light = LIGHTS; light != load(LIGHTS_END); light += LIGHT_SIZE) {
                if (load(light + LIGHT_IS_POINT) != 0) return false;
            }
            return true;
        }
    }

    function setFaceUp() private pure {
        assembly ("memory-safe") {
            // as the direction of a light: see Lighting
            let up := sar(UPPER_86_AT, mul(mload(FACE_NORMAL), mload(UP_IN_MESH)))
            mstore(FACE_UP, sdiv(shl(Q16, up), mload(FACE_LENGTH)))
        }
    }

    function setGradients(uint256 a, uint256 b, uint256 c) internal pure override {
        EffectSamples.setGradients(a, b, c);
    }

    function drawFragments(uint256 row, uint256 last) internal pure override {
        drawSpans(row, last);
    }

    function drawSpan(uint256 left, uint256 right, uint256 column, uint256 end, uint256 row) internal pure override {
        EffectSamples.draw(left, right, column, end, row);
    }

    function drawWires(uint256 list, uint256 end) internal pure override(Pipeline, SampleWires) {
        SampleWires.drawWires(list, end);
    }
}
