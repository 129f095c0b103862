// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {IPngEncoder} from "./IPngEncoder.sol";
import {IRenderer} from "./IRenderer.sol";

/// @title IWithRenderer: a contract that uses a renderer.
interface IWithRenderer {
    /// @notice The address has no code.
    error NoRenderer(address renderer);

    /// @notice Returns the renderer.
    function renderer() external view returns (IRenderer);
}

/// @title IWithEncoder: a contract that uses a renderer, and an encoder of its pictures.
interface IWithEncoder is IWithRenderer {
    /// @notice The address has no code.
    error NoEncoder(address encoder);

    /// @notice Returns the encoder of PNG files.
    function encoder() external view returns (IPngEncoder);
}
