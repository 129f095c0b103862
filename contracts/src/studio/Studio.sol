// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {LibZip} from "solady/src/utils/LibZip.sol";
import {forward} from "../encode/Redirect.sol";
import {Changes} from "../interfaces/Changes.sol";
import {IGlbEncoder} from "../interfaces/IGlbEncoder.sol";
import {IPngEncoder} from "../interfaces/IPngEncoder.sol";
import {IRenderer} from "../interfaces/IRenderer.sol";
import {IStudio} from "../interfaces/IStudio.sol";
import {ITurntable} from "../interfaces/ITurntable.sol";
import {Turn} from "../interfaces/Turn.sol";
import {COMPACT, LAST_FORMAT, SCENE, kindOf} from "../mesh/Kinds.sol";
import {Meshes} from "./Meshes.sol";
import {NORMALS} from "../scene/Mesh.sol";
import {FLAT, SMOOTH, Background, Object, Rectangle, Scene, ONE} from "../scene/Scene.sol";
import {WithEncoder} from "../WithRenderer.sol";
import {Storage} from "./Storage.sol";
import {SceneChanges} from "./SceneChanges.sol";
import {Units} from "./Units.sol";

/// @title Studio: stores meshes and scenes on chain, and draws them for any contract.
/// @notice Anyone can store a mesh or a scene for the cost of gas; its pointer is permanent. There is no owner, and nothing can be changed
/// or removed. The pointer is derived from the stored bytes: the same mesh or scene has the same pointer, whoever stores it, and is stored
/// once. Invalid scenes revert when drawn, and affect no other.
contract Studio is WithEncoder, IStudio {
    ITurntable public immutable turntable;
    IGlbEncoder public immutable modeller;

    constructor(IRenderer renderer_, IPngEncoder encoder_, ITurntable turntable_, IGlbEncoder modeller_)
        WithEncoder(renderer_, encoder_)
    {
        if (address(turntable_).code.length == 0) revert NoTurntable(address(turntable_));
        if (address(modeller_).code.length == 0) revert NoModeller(address(modeller_));
        (turntable, modeller) = (turntable_, modeller_);
    }

    function storeMesh(bytes memory data) external returns (address pointer) {
        uint256 kind = kindOf(data);
        if (kind > LAST_FORMAT && kind != COMPACT) revert NotAMesh(kind);
        bool created;
        (pointer, created) = Storage.keep(data);
        if (created) emit MeshStored(pointer, msg.sender);
    }

    function storeScene(Scene memory scene_) external returns (address pointer) {
        Units.check(scene_);
        bool created;
        (pointer, created) = Storage.keep(abi.encodePacked(uint8(SCENE), LibZip.cdCompress(abi.encode(scene_))));
        if (created) emit SceneStored(pointer, msg.sender);
    }

    function storePart(bytes memory data) external returns (address pointer) {
        if (data.length > Storage.MAX_PART) revert NotToBeKept();
        (pointer,) = Storage.keepPart(data);
    }

    function join(address[] memory parts) external returns (address pointer) {
        (pointer,) = Storage.join(parts);
    }

    function meshAt(address pointer) external pure returns (bytes memory) {
        return Meshes.pointed(pointer);
    }

    function mesh(address pointer) external view returns (bytes memory) {
        return Meshes.open(Meshes.pointed(pointer));
    }

    function scene(address pointer) public view returns (Scene memory scene_) {
        bytes memory data = Storage.read(pointer);
        if (kindOf(data) != SCENE) revert NotAScene(pointer);
        return decoded(data);
    }

    function scene(address pointer, Changes memory changes) public view returns (Scene memory scene_) {
        scene_ = scene(pointer);
        SceneChanges.make(scene_, changes);
    }

    function check(address pointer) external view {
        renderer.renderTile(scene(pointer), Rectangle(0, 0, 1, 1));
    }

    function render(address pointer) external view returns (bytes memory) {
        forward(address(renderer), abi.encodeCall(IRenderer.render, (scene(pointer))));
    }

    function render(address pointer, Changes memory changes) external view returns (bytes memory) {
        forward(address(renderer), abi.encodeCall(IRenderer.render, (scene(pointer, changes))));
    }

    function renderPNG(address pointer, uint256 scale) external view returns (bytes memory) {
        forward(address(encoder), abi.encodeCall(IPngEncoder.encode, (renderer.render(scene(pointer)), scale)));
    }

    function renderPNG(address pointer, uint256 scale, Changes memory changes) external view returns (bytes memory) {
        forward(address(encoder), abi.encodeCall(IPngEncoder.encode, (renderer.render(scene(pointer, changes)), scale)));
    }

    function renderDataURI(address pointer, uint256 scale) external view returns (string memory) {
        forward(address(encoder), abi.encodeCall(IPngEncoder.dataURI, (renderer.render(scene(pointer)), scale)));
    }

    function renderDataURI(address pointer, uint256 scale, Changes memory changes) external view returns (string memory) {
        forward(address(encoder), abi.encodeCall(IPngEncoder.dataURI, (renderer.render(scene(pointer, changes)), scale)));
    }

    function renderSVG(address pointer, uint256 scale) external view returns (string memory) {
        forward(address(encoder), abi.encodeCall(IPngEncoder.svg, (renderer.render(scene(pointer)), scale)));
    }

    function renderSVG(address pointer, uint256 scale, Changes memory changes) external view returns (string memory) {
        forward(address(encoder), abi.encodeCall(IPngEncoder.svg, (renderer.render(scene(pointer, changes)), scale)));
    }

    function renderTransparentPNG(address pointer, uint256 scale) external view returns (bytes memory) {
        encodeTransparent(IPngEncoder.encodeTransparent.selector, scene(pointer), scale);
    }

    function renderTransparentPNG(address pointer, uint256 scale, Changes memory changes) external view returns (bytes memory) {
        encodeTransparent(IPngEncoder.encodeTransparent.selector, scene(pointer, changes), scale);
    }

    function renderTransparentDataURI(address pointer, uint256 scale) external view returns (string memory) {
        encodeTransparent(IPngEncoder.transparentDataURI.selector, scene(pointer), scale);
    }

    function renderTransparentDataURI(address pointer, uint256 scale, Changes memory changes) external view returns (string memory) {
        encodeTransparent(IPngEncoder.transparentDataURI.selector, scene(pointer, changes), scale);
    }

    function animate(address pointer, Turn memory spin) external view returns (bytes memory) {
        forward(address(turntable), abi.encodeCall(ITurntable.animate, (scene(pointer), spin)));
    }

    function animate(address pointer, Turn memory spin, Changes memory changes) external view returns (bytes memory) {
        forward(address(turntable), abi.encodeCall(ITurntable.animate, (scene(pointer, changes), spin)));
    }

    function animateDataURI(address pointer, Turn memory spin) external view returns (string memory) {
        forward(address(turntable), abi.encodeCall(ITurntable.animateDataURI, (scene(pointer), spin)));
    }

    function animateDataURI(address pointer, Turn memory spin, Changes memory changes) external view returns (string memory) {
        forward(address(turntable), abi.encodeCall(ITurntable.animateDataURI, (scene(pointer, changes), spin)));
    }

    function drawPNG(Scene memory scene_, uint256 scale) external view returns (bytes memory) {
        forward(address(encoder), abi.encodeCall(IPngEncoder.encode, (renderer.render(given(scene_)), scale)));
    }

    function drawDataURI(Scene memory scene_, uint256 scale) external view returns (string memory) {
        forward(address(encoder), abi.encodeCall(IPngEncoder.dataURI, (renderer.render(given(scene_)), scale)));
    }

    function drawTransparentPNG(Scene memory scene_, uint256 scale) external view returns (bytes memory) {
        encodeTransparent(IPngEncoder.encodeTransparent.selector, given(scene_), scale);
    }

    function drawTransparentDataURI(Scene memory scene_, uint256 scale) external view returns (string memory) {
        encodeTransparent(IPngEncoder.transparentDataURI.selector, given(scene_), scale);
    }

    function glb(address pointer) external view returns (bytes memory) {
        forward(address(modeller), abi.encodeCall(IGlbEncoder.encode, (shown(pointer))));
    }

    function glbDataURI(address pointer) external view returns (string memory) {
        forward(address(modeller), abi.encodeCall(IGlbEncoder.dataURI, (shown(pointer))));
    }

    /// @dev Ends the call with the result of a function of the encoder for the pictures over black and over white.
    function encodeTransparent(bytes4 function_, Scene memory scene_, uint256 scale) private view {
        bytes memory black = over(scene_, scene_.invert != 0 ? 0xffffff : 0);
        bytes memory white = over(scene_, scene_.invert != 0 ? 0 : 0xffffff);
        forward(address(encoder), abi.encodeWithSelector(function_, black, white, scale));
    }

    /// @dev Returns the picture over a background of one colour. `invert` inverts the background too, so callers pass the inverse.
    function over(Scene memory scene_, uint256 color) private view returns (bytes memory) {
        scene_.background = Background(color, color);
        return renderer.render(scene_);
    }

    /// @dev Returns a stored scene, or a scene that shows a stored mesh from both sides.
    function shown(address pointer) private view returns (Scene memory scene_) {
        bytes memory data = Storage.read(pointer);
        if (kindOf(data) == SCENE) return decoded(data);
        scene_.objects = new Object[](1);
        Object memory object = scene_.objects[0];
        object.mesh = Meshes.open(data);
        (object.rotation.w, object.scale) = (ONE, ONE);
        object.material.shading = kindOf(object.mesh) & NORMALS == 0 ? FLAT : SMOOTH;
        object.material.shininess = 1;
    }

    function decoded(bytes memory data) private view returns (Scene memory) {
        return opened(abi.decode(LibZip.cdDecompress(Meshes.rest(data)), (Scene)));
    }

    /// @dev Returns a scene passed by a caller with its meshes unpacked. Reverts if numbers look as if they were not multiplied by 2^32.
    function given(Scene memory scene_) private view returns (Scene memory) {
        opened(scene_);
        Units.check(scene_);
        return scene_;
    }

    function opened(Scene memory scene_) private view returns (Scene memory) {
        for (uint256 k; k < scene_.objects.length; ++k) {
            scene_.objects[k].mesh = Meshes.open(scene_.objects[k].mesh);
        }
        return scene_;
    }
}
