// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Scene} from "../scene/Scene.sol";
import {SceneErrors} from "../scene/SceneErrors.sol";
import {DataUri} from "./DataUri.sol";
import {answer} from "./Forward.sol";
import {Glb} from "./Glb.sol";
import {GlbErrors} from "./GlbErrors.sol";

/// @title GlbEncoder: scenes as models that viewers turn, for the Studio and all contracts.
contract GlbEncoder is SceneErrors, GlbErrors {
    /// @notice A binary glTF file of the objects of a scene: a node, a mesh and a material for each that has faces.
    /// @param scene Its meshes in the format of `Mesh.sol`.
    function encode(Scene calldata scene) external pure returns (bytes memory) {
        answer(Glb.encode(scene));
    }

    /// @notice The same as a `data:` URI, for the `animation_url` of a token.
    function dataURI(Scene calldata scene) external pure returns (string memory) {
        string memory head = "data:model/gltf-binary;base64,";
        answer(bytes(DataUri.wrap(head, Glb.encode(scene), "")));
    }
}
