// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Scene} from "../scene/Scene.sol";
import {DataUri} from "./DataUri.sol";
import {answer} from "./Redirect.sol";
import {Glb} from "./Glb.sol";
import {IGlbEncoder} from "../interfaces/IGlbEncoder.sol";

/// @title GlbEncoder: encodes scenes as binary glTF files for 3D viewers, for the Studio and any contract.
contract GlbEncoder is IGlbEncoder {
    function encode(Scene calldata scene) external pure returns (bytes memory) {
        answer(Glb.encode(scene));
    }

    function dataURI(Scene calldata scene) external pure returns (string memory) {
        string memory head = "data:model/gltf-binary;base64,";
        answer(bytes(DataUri.wrap(head, Glb.encode(scene), "")));
    }
}
