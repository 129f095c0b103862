// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {LibZip} from "solady/src/utils/LibZip.sol";
import {NORMALS, WIDE} from "../scene/Mesh.sol";
import {Scene} from "../scene/Scene.sol";
import {Renderer} from "../Renderer.sol";
import {COMPACT} from "./CompactMesh.sol";
import {Kept} from "./Kept.sol";
import {Meshes, ZIPPED} from "./Meshes.sol";
import {Png} from "./Png.sol";
import {Changes, SceneChanges} from "./SceneChanges.sol";

/// @title Studio: meshes and scenes kept on chain, and their pictures for every contract.
/// @notice Anyone stores a mesh or a scene once, for the gas alone, and has a pointer to it for ever. There is no owner, nothing can be
/// changed or removed, and the address is made of what is stored: the same mesh or scene has the same pointer, whoever stores it, and is
/// stored once. What is wrong with a scene is told when it is drawn, and concerns no other.
contract Studio {
    Renderer public immutable renderer;

    /// @dev The first byte of a scene that is kept. After it the ABI encoding of the scene, in which zeros are compressed (solady's
    /// LibZip.cdCompress).
    uint256 private constant SCENE = 0x20;

    event MeshStored(address indexed pointer, address indexed by);
    event SceneStored(address indexed pointer, address indexed by);

    error NoRenderer(address renderer);
    /// @notice The first byte of what is to be stored, or of what is kept there, is not that of a mesh (256: there is none).
    error NotAMesh(uint256 kind);
    /// @notice What is kept there is no scene.
    error NotAScene(address pointer);

    constructor(Renderer renderer_) {
        if (address(renderer_).code.length == 0) revert NoRenderer(address(renderer_));
        renderer = renderer_;
    }

    /// @notice Stores a mesh in any of its forms but a pointer: packed (`Mesh.sol`), compact (`CompactMesh.sol`) or zipped (`Meshes.sol`).
    /// @return pointer Where it is kept.
    function storeMesh(bytes memory data) external returns (address pointer) {
        uint256 kind = Meshes.kindOf(data);
        if (kind > NORMALS + WIDE && kind != COMPACT && kind != ZIPPED) revert NotAMesh(kind);
        bool created;
        (pointer, created) = Kept.keep(data);
        if (created) emit MeshStored(pointer, msg.sender);
    }

    /// @notice Stores a scene. Its meshes may be pointers: `meshAt`.
    /// @return pointer Where it is kept.
    function storeScene(Scene memory scene_) external returns (address pointer) {
        bool created;
        (pointer, created) = Kept.keep(abi.encodePacked(uint8(SCENE), LibZip.cdCompress(abi.encode(scene_))));
        if (created) emit SceneStored(pointer, msg.sender);
    }

    /// @notice Stores up to 24,575 bytes of something larger, for what does not fit one transaction.
    function storePart(bytes memory data) external returns (address pointer) {
        if (data.length > Kept.MAX_PART) revert Kept.NotToBeKept();
        (pointer,) = Kept.keepPart(data);
    }

    /// @notice Stores what the parts are together: a mesh or a scene. The pointer is that of the whole stored at once, where each part but
    /// the last has 24,575 bytes.
    function join(address[] memory parts) external returns (address pointer) {
        (pointer,) = Kept.join(parts);
    }

    /// @notice What stands for a mesh that is kept, in the field `mesh` of an object.
    function meshAt(address pointer) external pure returns (bytes memory) {
        return Meshes.pointed(pointer);
    }

    /// @notice A mesh that is kept, in the format of `Mesh.sol`.
    function mesh(address pointer) external view returns (bytes memory) {
        return Meshes.open(Meshes.pointed(pointer));
    }

    /// @notice A scene that is kept, its meshes in the format of `Mesh.sol`: what the renderer takes.
    function scene(address pointer) public view returns (Scene memory scene_) {
        bytes memory data = Kept.read(pointer);
        if (Meshes.kindOf(data) != SCENE) revert NotAScene(pointer);
        scene_ = opened(abi.decode(LibZip.cdDecompress(Meshes.rest(data)), (Scene)));
    }

    /// @notice The same with changes.
    function scene(address pointer, Changes memory changes) public view returns (Scene memory scene_) {
        scene_ = scene(pointer);
        SceneChanges.make(scene_, changes);
    }

    /// @notice The picture of a scene that is kept.
    /// @return A Windows bitmap of 24 bits a pixel.
    function render(address pointer) external view returns (bytes memory) {
        return renderer.render(scene(pointer));
    }

    /// @notice The same with changes.
    function render(address pointer, Changes memory changes) external view returns (bytes memory) {
        return renderer.render(scene(pointer, changes));
    }

    /// @notice The picture as a PNG file, each pixel a square of `scale` pixels, 1..8.
    function renderPNG(address pointer, uint256 scale) external view returns (bytes memory) {
        return Png.encode(renderer.render(scene(pointer)), scale);
    }

    /// @notice The same with changes.
    function renderPNG(address pointer, uint256 scale, Changes memory changes) external view returns (bytes memory) {
        return Png.encode(renderer.render(scene(pointer, changes)), scale);
    }

    /// @notice The PNG file as a `data:` URI.
    function renderDataURI(address pointer, uint256 scale) external view returns (string memory) {
        return Png.dataURI(renderer.render(scene(pointer)), scale);
    }

    /// @notice The same with changes.
    function renderDataURI(address pointer, uint256 scale, Changes memory changes) external view returns (string memory) {
        return Png.dataURI(renderer.render(scene(pointer, changes)), scale);
    }

    /// @notice The picture of a scene that is not kept, as a PNG file; its meshes may be pointers and compact.
    function drawPNG(Scene memory scene_, uint256 scale) external view returns (bytes memory) {
        return Png.encode(renderer.render(opened(scene_)), scale);
    }

    /// @notice The same as a `data:` URI.
    function drawDataURI(Scene memory scene_, uint256 scale) external view returns (string memory) {
        return Png.dataURI(renderer.render(opened(scene_)), scale);
    }

    function opened(Scene memory scene_) private view returns (Scene memory) {
        for (uint256 k; k < scene_.objects.length; ++k) {
            scene_.objects[k].mesh = Meshes.open(scene_.objects[k].mesh);
        }
        return scene_;
    }
}
