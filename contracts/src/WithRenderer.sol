// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {IPngEncoder} from "./interfaces/IPngEncoder.sol";
import {IRenderer} from "./interfaces/IRenderer.sol";
import {IWithEncoder, IWithRenderer} from "./interfaces/IWithRenderer.sol";
import {SceneErrors} from "./scene/SceneErrors.sol";

/// @title WithRenderer: a contract that uses a renderer.
abstract contract WithRenderer is SceneErrors, IWithRenderer {
    IRenderer public immutable renderer;

    constructor(IRenderer renderer_) {
        if (address(renderer_).code.length == 0) revert NoRenderer(address(renderer_));
        renderer = renderer_;
    }
}

/// @title WithEncoder: a contract that uses a renderer, and an encoder of its pictures.
abstract contract WithEncoder is WithRenderer, IWithEncoder {
    IPngEncoder public immutable encoder;

    constructor(IRenderer renderer_, IPngEncoder encoder_) WithRenderer(renderer_) {
        if (address(encoder_).code.length == 0) revert NoEncoder(address(encoder_));
        encoder = encoder_;
    }
}
