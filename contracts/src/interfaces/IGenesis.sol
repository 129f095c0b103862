// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {Piece, Traits} from "../genesis/Piece.sol";
import {Scene} from "../scene/Scene.sol";
import {SceneErrors} from "../scene/SceneErrors.sol";
import {IRenderer} from "./IRenderer.sol";

/// @title IGenesis: pictures that are made from a seed of 32 bytes.
interface IGenesis is SceneErrors {
    /// @notice No triangle fits: the seed has no piece.
    error NoTriangle();
    /// @notice The scheme would choose highlights among the other prisms, and there is one only: the seed has no piece.
    error NoPrismToChoose();
    /// @notice The address has no code.
    error NoRenderer(address renderer);

    /// @notice What draws.
    function renderer() external view returns (IRenderer);

    /// @notice The piece of a seed.
    function generate(bytes32 seed) external pure returns (Piece memory piece);

    /// @notice What a piece is called.
    function traits(bytes32 seed) external pure returns (Traits memory);

    /// @notice How a piece is drawn.
    function scene(bytes32 seed) external pure returns (Scene memory);

    /// @notice The picture of a piece.
    /// @return A Windows bitmap of 24 bits a pixel.
    function render(bytes32 seed) external view returns (bytes memory);

    /// @notice The picture of a piece.
    /// @return A `data:` URI of the bitmap.
    function renderDataURI(bytes32 seed) external view returns (string memory);

    /// @notice The picture of a piece.
    /// @return An SVG document that shows the bitmap at any size without smoothing.
    function renderSVG(bytes32 seed) external view returns (string memory);
}
