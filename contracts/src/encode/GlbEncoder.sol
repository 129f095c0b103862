// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Scene} from "../scene/Scene.sol";
import {SceneErrors} from "../scene/SceneErrors.sol";
import {DataUri} from "./DataUri.sol";
import {answer} from "./Redirect.sol";
import {Glb} from "./Glb.sol";
import {GlbErrors} from "../interfaces/GlbErrors.sol";

/// @title GlbEncoder: encodes scenes as binary glTF files for 3D viewers, for the Studio and any contract.
contract GlbEncoder is SceneErrors, GlbErrors {
    /// @notice Returns a binary glTF file of the objects of a scene: one node, mesh and material for each object that has faces.
    /// @param scene A scene with meshes in the format of `Mesh.sol`.
    function encode(Scene calldata scene) external pure returns (bytes memory) {
        answer(Glb.encode(scene));
    }

    /// @notice Returns the file as a `data:` URI, for the `animation_url` of a token.
    function dataURI(Scene calldata scene) external pure returns (string memory) {
        string memory head = "data:model/gltf-binary;base64,";
        answer(bytes(DataUri.wrap(head, Glb.encode(scene), "")));
    }
}
