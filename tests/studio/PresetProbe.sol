// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Material, Scene} from "../../contracts/src/scene/Scene.sol";
import {Preset, Presets, Stage, StageMaker} from "../../contracts/src/building/SceneBuilder.sol";

/// @notice Gives a mesh, seen from a side, each of the presets, in the order of their table.
contract PresetProbe {
    function all(bytes memory mesh, bool smooth, int256[3] memory toward) external pure returns (Scene[] memory scenes) {
        Preset[10] memory looks = [
            Presets.studio(), Presets.clay(), Presets.gold(), Presets.neon(), Presets.noir(), Presets.sunset(), Presets.facets(),
            Presets.blueprint(), Presets.xray(), Presets.flat()
        ];
        scenes = new Scene[](looks.length);
        for (uint256 k; k != looks.length; ++k) {
            Stage memory stage = StageMaker.stage(60, 40);
            stage.add(mesh, smooth ? StageMaker.smooth(1, 2, 3, 4) : StageMaker.flat(1, 2, 3, 4));
            stage.fit(StageMaker.units(toward[0], toward[1], toward[2]));
            stage.preset(looks[k]);
            if (stage.scene.lights.length != 0) stage.shadow(0);
            scenes[k] = stage.scene;
        }
    }
}
