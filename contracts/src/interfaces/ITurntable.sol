// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {AngleErrors} from "../math/Euler.sol";
import {PngErrors} from "./PngErrors.sol";
import {Scene} from "../scene/Scene.sol";
import {SceneErrors} from "../scene/SceneErrors.sol";
import {Turn} from "./Turn.sol";
import {TurntableErrors} from "./TurntableErrors.sol";
import {IWithEncoder} from "./IWithRenderer.sol";

/// @title ITurntable: makes animated PNG files of rotating scenes.
interface ITurntable is SceneErrors, PngErrors, TurntableErrors, AngleErrors, IWithEncoder {
    /// @notice Returns an animated PNG file that loops endlessly. The first frame is the scene as given.
    /// @param scene A scene with meshes in the format of `Mesh.sol`.
    function animate(Scene calldata scene, Turn calldata spin) external view returns (bytes memory);

    /// @notice Returns the file as a `data:` URI, for the `animation_url` of a token.
    function animateDataURI(Scene calldata scene, Turn calldata spin) external view returns (string memory);
}
