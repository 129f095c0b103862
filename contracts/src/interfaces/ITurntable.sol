// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {PngErrors} from "./PngErrors.sol";
import {Scene} from "../scene/Scene.sol";
import {SceneErrors} from "../scene/SceneErrors.sol";
import {Turn} from "./Turn.sol";
import {TurntableErrors} from "./TurntableErrors.sol";
import {IPngEncoder} from "./IPngEncoder.sol";
import {IRenderer} from "./IRenderer.sol";

/// @title ITurntable: makes animated PNG files of rotating scenes.
interface ITurntable is SceneErrors, PngErrors, TurntableErrors {
    /// @notice The address has no code.
    error NoRenderer(address renderer);
    /// @notice The address has no code.
    error NoEncoder(address encoder);
    /// @notice The angle must be at most 2^26 degrees in either direction.
    error AngleOutOfRange(int256 degrees_);

    /// @notice Returns the renderer.
    function renderer() external view returns (IRenderer);

    /// @notice Returns the encoder of the frames.
    function encoder() external view returns (IPngEncoder);

    /// @notice Returns an animated PNG file that loops endlessly. The first frame is the scene as given.
    /// @param scene A scene with meshes in the format of `Mesh.sol`.
    function animate(Scene calldata scene, Turn calldata spin) external view returns (bytes memory);

    /// @notice Returns the file as a `data:` URI, for the `animation_url` of a token.
    function animateDataURI(Scene calldata scene, Turn calldata spin) external view returns (string memory);
}
