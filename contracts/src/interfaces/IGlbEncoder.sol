// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {GlbErrors} from "./GlbErrors.sol";
import {Scene} from "../scene/Scene.sol";
import {SceneErrors} from "../scene/SceneErrors.sol";

/// @title IGlbEncoder: encodes scenes as binary glTF files (GLB) for 3D viewers.
interface IGlbEncoder is SceneErrors, GlbErrors {
    /// @notice Returns a binary glTF file of the objects of a scene: one node, mesh and material for each object that has faces.
    /// @param scene A scene with meshes in the format of `Mesh.sol`.
    function encode(Scene calldata scene) external pure returns (bytes memory);

    /// @notice Returns the file as a `data:` URI, for the `animation_url` of a token.
    function dataURI(Scene calldata scene) external pure returns (string memory);
}
