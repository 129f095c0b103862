// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Ambient, EffectUniforms} from "./EffectUniforms.sol";
import {View, lookAt} from "../uniforms/View.sol";
import {EffectRecords} from "./EffectRecords.sol";
import {Scene} from "../scene/Scene.sol";
import {SceneErrors} from "../scene/SceneErrors.sol";
import {Shadows} from "../shadows/Shadows.sol";
import "../words/EffectRegisters.sol";

// Computes the effects of `read` of picture.py, and `Shadow`.

/// @title Effects: computes the data that the EffectsEngine needs.
/// @notice Called by the Renderer for scenes with effects. Checks their records, and computes uniforms and shadows. Stateless.
contract Effects is SceneErrors {
    /// @notice Returns the uniforms of effects for the frame and each object. Checks the effect records; the rest of the scene must have
    /// been checked.
    /// @return The registers EFFECT_FRAME; for each object the registers EFFECT_OBJECT; then the shadows, if a light casts any: see
    /// Shadows. Without the ABI's offset and length.
    function prepare(Scene calldata scene) external pure returns (bytes memory) {
        unchecked {
            EffectRecords.check(scene);
            reserveRegisters(REGISTERS, EFFECT_REGISTERS_END);
            View memory view_ = lookAt(scene.camera, scene.canvas.width, scene.canvas.height);
            Ambient memory ambient = EffectUniforms.setFrame(view_, scene);
            store(EFFECTS_AT, freeMemory());
            setFreeMemory(freeMemory() + EFFECT_FRAME_SIZE);
            writeObjects(scene, view_, ambient);
            if (load(SHADOW_LIGHT) != 0) writeShadows(scene, view_);
            uint256 begin = load(EFFECTS_AT);
            uint256 end = freeMemory();
            assembly ("memory-safe") {
                mcopy(begin, EFFECT_FRAME_BEGIN, EFFECT_FRAME_SIZE)
                return(begin, sub(end, begin))
            }
        }
    }

    /// @dev Writes the registers of all objects.
    function writeObjects(Scene calldata scene, View memory view_, Ambient memory ambient) private pure {
        unchecked {
            uint256 target = freeMemory();
            uint256 end = target + scene.objects.length * EFFECT_OBJECT_SIZE;
            // the scene, the only argument, follows the frame's registers in the engine's calldata
            uint256 moved;
            assembly ("memory-safe") {
                moved := sub(add(4, FRAME_SIZE), scene)
            }
            setFreeMemory(end);
            for (uint256 i; i != scene.objects.length; ++i) {
                EffectUniforms.setObject(view_, scene, ambient, i, moved);
                assembly ("memory-safe") {
                    mcopy(target, EFFECT_OBJECT_BEGIN, EFFECT_OBJECT_SIZE)
                }
                target += EFFECT_OBJECT_SIZE;
            }
            // free the allocations
            setFreeMemory(end);
        }
    }

    /// @dev Writes the shadows.
    function writeShadows(Scene calldata scene, View memory view_) private pure {
        unchecked {
            store(SHADOWS_OFFSET, freeMemory() - load(EFFECTS_AT));
            (uint256 begin, uint256 size) = Shadows.cast(scene, view_);
            uint256 target = load(EFFECTS_AT) + load(SHADOWS_OFFSET);
            assembly ("memory-safe") {
                mcopy(target, begin, size)
            }
            setFreeMemory(target + size);
        }
    }
}
