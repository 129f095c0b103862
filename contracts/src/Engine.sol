// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Scene, Rectangle} from "./scene/Scene.sol";
import {Picture, draw} from "./pipeline/Pipeline.sol";

/// @title Engine: from a scene to pixels.
/// @notice The work of the Renderer, which checks the scene before and makes a file of the pixels after. Call the Renderer: a scene that
/// did not pass its checks is drawn wrong here.
contract Engine {
    /// @notice Draws a part of the canvas.
    /// @param countPixels Whether to count what was drawn.
    /// @return Two words without the ABI's offsets and lengths: how many triangles were left after culling and clipping, how many pixels
    /// they cover (0 if not counted); then the pixels, blue, green, red, rows from the bottom.
    function drawTile(Scene calldata scene, Rectangle calldata tile, bool countPixels) external pure returns (bytes memory) {
        Picture memory picture = draw(scene, tile, countPixels);
        assembly ("memory-safe") {
            let data := sub(mload(picture), 0x40)
            mstore(data, mload(add(picture, 0x40)))
            mstore(add(data, 0x20), mload(add(picture, 0x60)))
            return(data, add(0x40, mload(add(picture, 0x20))))
        }
    }
}
