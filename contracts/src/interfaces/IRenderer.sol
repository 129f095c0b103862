// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {AngleErrors} from "../math/Euler.sol";
import {Rectangle, Scene, Fixed, Quaternion} from "../scene/Scene.sol";
import {SceneErrors} from "../scene/SceneErrors.sol";
import {RegisterErrors} from "../words/RegisterErrors.sol";

/// @title IRenderer: draws 3D scenes.
/// @notice Stateless. `SceneErrors.sol` declares the errors of invalid scenes.
interface IRenderer is SceneErrors, AngleErrors, RegisterErrors {
    /// @notice The address has no code.
    error NoEngine(address engine);

    /// @notice Returns the engine for flat and unlit surfaces.
    function engine() external view returns (address);

    /// @notice Returns the engine for smooth, wireframe, translucent and spot-lit objects.
    function fragmentEngine() external view returns (address);

    /// @notice Returns the engine that does the work of `engine` with four samples per pixel.
    function antialiasedEngine() external view returns (address);

    /// @notice Returns the engine that does the work of `fragmentEngine` with four samples per pixel, except most smooth surfaces.
    function antialiasedFragmentEngine() external view returns (address);

    /// @notice Returns the engine for opaque smooth surfaces lit by one or two lamps, with four samples per pixel.
    function antialiasedSmoothEngine() external view returns (address);

    /// @notice Returns the engine for scenes with effects.
    function effectsEngine() external view returns (address);

    /// @notice Returns the contract that checks effects and computes their uniforms.
    function effects() external view returns (address);

    /// @notice Draws a scene.
    /// @return A Windows bitmap of 24 bits per pixel.
    function render(Scene calldata scene) external view returns (bytes memory);

    /// @notice Draws a part of the canvas as a separate bitmap. The tiles of a picture together equal the whole picture, byte for byte.
    function renderTile(Scene calldata scene, Rectangle calldata tile) external view returns (bytes memory);

    /// @notice Draws a scene and counts its triangles and lit pixels.
    /// @return bmp The bitmap, as from `render`.
    /// @return triangles The number of triangles left after culling and clipping.
    /// @return litPixels The number of pixels covered by any of them.
    function renderCounted(Scene calldata scene) external view returns (bytes memory bmp, uint256 triangles, uint256 litPixels);

    /// @notice Draws a part of the canvas, as `renderTile` does, and counts its triangles and lit pixels.
    /// @return bmp The bitmap, as from `renderTile`.
    /// @return triangles The number of triangles left after culling and clipping that do not lie entirely beyond one edge of the tile.
    /// @return litPixels The number of pixels of the tile covered by any of them.
    function renderTileCounted(Scene calldata scene, Rectangle calldata tile)
        external view returns (bytes memory bmp, uint256 triangles, uint256 litPixels);

    /// @notice Draws a scene.
    /// @return A `data:` URI of the bitmap.
    function renderDataURI(Scene calldata scene) external view returns (string memory);

    /// @notice Draws a scene.
    /// @return An SVG document that shows the bitmap at any size without smoothing.
    function renderSVG(Scene calldata scene) external view returns (string memory);

    /// @notice Returns the rotation about the x axis, then y, then z, by angles in degrees (Q32), for `Object.rotation`.
    function eulerRotation(Fixed x, Fixed y, Fixed z) external pure returns (Quaternion memory);

    /// @notice Returns the calldata with which the Renderer calls the engine to draw a part of the canvas, in the format of `Uniforms.sol`.
    /// For measurements.
    function engineCall(Scene calldata scene, Rectangle calldata tile) external view returns (bytes memory);
}
