// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

/// @title GlbErrors: why there is no GLB file of a scene.
interface GlbErrors {
    /// @notice No object has a face: glTF knows no empty mesh.
    error NothingToShow();
}
