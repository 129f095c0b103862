// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {PngErrors} from "../encode/PngErrors.sol";
import {Scene} from "../scene/Scene.sol";
import {SceneErrors} from "../scene/SceneErrors.sol";
import {Spin} from "../studio/Spin.sol";
import {TurntableErrors} from "../studio/TurntableErrors.sol";
import {IPngEncoder} from "./IPngEncoder.sol";
import {IRenderer} from "./IRenderer.sol";

/// @title ITurntable: scenes that turn, as animated PNG files.
interface ITurntable is SceneErrors, PngErrors, TurntableErrors {
    /// @notice The address has no code.
    error NoRenderer(address renderer);
    /// @notice The address has no code.
    error NoEncoder(address encoder);
    /// @notice The angle leaves the range of 2^26 degrees either way.
    error AngleOutOfRange(int256 degrees_);

    /// @notice What draws.
    function renderer() external view returns (IRenderer);

    /// @notice What makes a PNG file of each frame.
    function encoder() external view returns (IPngEncoder);

    /// @notice An animated PNG file, repeated for ever. The first frame is the scene as it is.
    /// @param scene Its meshes in the format of `Mesh.sol`.
    function animate(Scene calldata scene, Spin calldata spin) external view returns (bytes memory);

    /// @notice The same as a `data:` URI, for the `animation_url` of a token.
    function animateDataURI(Scene calldata scene, Spin calldata spin) external view returns (string memory);
}
