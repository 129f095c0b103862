// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {Piece, Traits} from "./Piece.sol";
import {Scene} from "../scene/Scene.sol";
import {SceneErrors} from "../scene/SceneErrors.sol";
import {IWithRenderer} from "./IWithRenderer.sol";

/// @title IGenesis: pictures generated from 32-byte seeds.
interface IGenesis is SceneErrors, IWithRenderer {
    /// @notice The seed has no piece: no triangle fits.
    error NoTriangle();
    /// @notice The seed has no piece: the scheme needs to choose highlights among the other prisms, but there is only one prism.
    error NoPrismToChoose();

    /// @notice Returns the piece generated from a seed.
    function generate(bytes32 seed) external pure returns (Piece memory piece);

    /// @notice Returns the traits of a piece.
    function traits(bytes32 seed) external pure returns (Traits memory);

    /// @notice Returns the scene of a piece.
    function scene(bytes32 seed) external pure returns (Scene memory);

    /// @notice Returns the picture of a piece.
    /// @return A Windows bitmap of 24 bits per pixel.
    function render(bytes32 seed) external view returns (bytes memory);

    /// @notice Returns the picture of a piece.
    /// @return A `data:` URI of the bitmap.
    function renderDataURI(bytes32 seed) external view returns (string memory);

    /// @notice Returns the picture of a piece.
    /// @return An SVG document that shows the bitmap at any size without smoothing.
    function renderSVG(bytes32 seed) external view returns (string memory);
}
