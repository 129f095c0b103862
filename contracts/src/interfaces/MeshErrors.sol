// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

/// @title MeshErrors: the errors of meshes that cannot be converted to the renderer's format.
interface MeshErrors {
    /// @notice The first byte of the mesh is not a known kind.
    error UnknownMesh(uint256 kind);
    /// @notice The fields of the compact mesh are inconsistent with its length: it must have `expected` bytes.
    error CompactMeshLength(uint256 expected, uint256 length);
    /// @notice The header of the compact mesh has an invalid field.
    error CompactMeshHeader();
    /// @notice The faces use more new vertices than there are, or do not use all explicit vertex references.
    error CompactMeshFaces();
}
