// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

/// @title MeshErrors: what can be wrong with a mesh before it is in the form that the renderer takes.
interface MeshErrors {
    /// @notice The first byte of a mesh is none that is known.
    error UnknownMesh(uint256 kind);
    /// @notice The numbers of a mesh do not go together: it should have `expected` bytes.
    error CompactMeshLength(uint256 expected, uint256 length);
    /// @notice What the head of a mesh says is beyond what the format knows.
    error CompactMeshHeader();
    /// @notice The faces have more new vertices than there are, or do not take all bytes of vertices that are told.
    error CompactMeshFaces();
}
