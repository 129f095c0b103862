// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {Fixed} from "../math/Fixed.sol";
import {Quaternion} from "../math/Quaternion.sol";
import {Rectangle, Scene} from "../scene/Scene.sol";
import {SceneErrors} from "../scene/SceneErrors.sol";

/// @title IRenderer: pictures of 3D scenes.
/// @notice Stateless. The errors are those of `SceneErrors.sol`.
interface IRenderer is SceneErrors {
    /// @notice The address has no code.
    error NoEngine(address engine);
    /// @notice The angle leaves the range of 2^26 degrees either way.
    error AngleOutOfRange(int256 degrees_);
    /// @notice A mistake of the renderer, which no scene causes.
    error RegistersOverlap();

    /// @notice What computes the pixels of flat and unlit surfaces.
    function engine() external view returns (address);

    /// @notice What computes the pixels of all else.
    function fragmentEngine() external view returns (address);

    /// @notice What `engine` does, with four samples for each pixel.
    function antialiasedEngine() external view returns (address);

    /// @notice What `fragmentEngine` does, with four samples for each pixel.
    function antialiasedFragmentEngine() external view returns (address);

    /// @notice What computes all pixels of scenes with effects.
    function effectsEngine() external view returns (address);

    /// @notice What finds out before what their effects are to the frame and to each object.
    function effects() external view returns (address);

    /// @notice Draws a scene.
    /// @return A Windows bitmap of 24 bits a pixel.
    function render(Scene calldata scene) external view returns (bytes memory);

    /// @notice Draws a part of the canvas as a bitmap of its own. The parts of a picture together equal the whole, byte for byte.
    function renderTile(Scene calldata scene, Rectangle calldata tile) external view returns (bytes memory);

    /// @notice Draws a scene and counts what was drawn.
    /// @return bmp As `render` returns it.
    /// @return triangles How many triangles were left after culling and clipping.
    /// @return litPixels How many pixels any of them covers.
    function renderCounted(Scene calldata scene) external view returns (bytes memory bmp, uint256 triangles, uint256 litPixels);

    /// @notice Draws a part of the canvas, as `renderTile` does, and counts what was drawn of it.
    /// @return bmp As `renderTile` returns it.
    /// @return triangles How many triangles were left after culling and clipping that do not lie beyond one border of the part.
    /// @return litPixels How many pixels of the part any of them covers.
    function renderTileCounted(Scene calldata scene, Rectangle calldata tile)
        external
        view
        returns (bytes memory bmp, uint256 triangles, uint256 litPixels);

    /// @notice Draws a scene.
    /// @return A `data:` URI of the bitmap.
    function renderDataURI(Scene calldata scene) external view returns (string memory);

    /// @notice Draws a scene.
    /// @return An SVG document that shows the bitmap at any size without smoothing.
    function renderSVG(Scene calldata scene) external view returns (string memory);

    /// @notice The rotation about the x axis, then y, then z, by angles in degrees (Q32), for an object of a scene.
    function eulerRotation(Fixed x, Fixed y, Fixed z) external pure returns (Quaternion memory);

    /// @notice The data with which the Renderer calls the engine to draw a part of the canvas, as `Uniforms.sol` says: for measurements.
    function engineCall(Scene calldata scene, Rectangle calldata tile) external view returns (bytes memory);
}
