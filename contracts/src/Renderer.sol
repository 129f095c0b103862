// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Scene, Rectangle} from "./scene/Scene.sol";
import {draw} from "./pipeline/Pipeline.sol";

contract Renderer {
    function render(Scene calldata scene) external pure returns (bytes memory) {
        (uint256 image, ) = draw(scene, Rectangle(0, 0, scene.canvas.width, scene.canvas.height));
        uint256 size = 3 * scene.canvas.width * scene.canvas.height + 54;
        assembly ("memory-safe") {
            mstore(sub(image, 118), 32)
            mstore(sub(image, 86), size)
            return(sub(image, 118), add(64, and(add(size, 31), not(31))))
        }
    }
}
