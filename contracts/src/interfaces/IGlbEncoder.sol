// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {GlbErrors} from "../encode/GlbErrors.sol";
import {Scene} from "../scene/Scene.sol";
import {SceneErrors} from "../scene/SceneErrors.sol";

/// @title IGlbEncoder: scenes as models that viewers turn.
interface IGlbEncoder is SceneErrors, GlbErrors {
    /// @notice A binary glTF file of the objects of a scene: a node, a mesh and a material for each that has faces.
    /// @param scene Its meshes in the format of `Mesh.sol`.
    function encode(Scene calldata scene) external pure returns (bytes memory);

    /// @notice The same as a `data:` URI, for the `animation_url` of a token.
    function dataURI(Scene calldata scene) external pure returns (string memory);
}
