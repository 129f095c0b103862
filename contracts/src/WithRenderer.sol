// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Renderer} from "./Renderer.sol";
import {SceneErrors} from "./scene/SceneErrors.sol";

/// @title WithRenderer: a contract that uses a renderer.
abstract contract WithRenderer is SceneErrors {
    /// @notice The renderer.
    Renderer public immutable renderer;

    /// @notice The address has no code.
    error NoRenderer(address renderer);

    constructor(Renderer renderer_) {
        if (address(renderer_).code.length == 0) revert NoRenderer(address(renderer_));
        renderer = renderer_;
    }
}
