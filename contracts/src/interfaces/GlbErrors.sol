// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

/// @title GlbErrors: the errors of glTF encoding.
interface GlbErrors {
    /// @notice No object has a face, and glTF does not allow empty meshes.
    error NothingToShow();
}
