// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {LibZip} from "solady/src/utils/LibZip.sol";
import {forward} from "../encode/Redirect.sol";
import {GlbEncoder} from "../encode/GlbEncoder.sol";
import {PngEncoder} from "../encode/PngEncoder.sol";
import {ONE} from "../math/Fixed.sol";
import {COMPACT, LAST_FORMAT, SCENE, kindOf} from "../mesh/Kinds.sol";
import {Meshes} from "./Meshes.sol";
import {NORMALS} from "../scene/Mesh.sol";
import {FLAT, SMOOTH, Background, Object, Rectangle, Scene} from "../scene/Scene.sol";
import {Renderer} from "../Renderer.sol";
import {WithRenderer} from "../WithRenderer.sol";
import {Changes} from "../interfaces/Changes.sol";
import {Storage} from "./Storage.sol";
import {SceneChanges} from "./SceneChanges.sol";
import {Turn} from "../interfaces/Turn.sol";
import {StudioErrors} from "../interfaces/StudioErrors.sol";
import {Turntable} from "./Turntable.sol";
import {Units} from "./Units.sol";

/// @title Studio: stores meshes and scenes on chain, and draws them for any contract.
/// @notice Anyone can store a mesh or a scene for the cost of gas; its pointer is permanent. There is no owner, and nothing can be changed
/// or removed. The pointer is derived from the stored bytes: the same mesh or scene has the same pointer, whoever stores it, and is stored
/// once. Invalid scenes revert when drawn, and affect no other.
contract Studio is WithRenderer, StudioErrors {
    /// @notice The encoder of PNG files.
    PngEncoder public immutable encoder;
    /// @notice The contract that makes animated PNG files of rotating scenes.
    Turntable public immutable turntable;
    /// @notice The encoder of binary glTF files.
    GlbEncoder public immutable modeller;

    /// @notice Emitted when `storeMesh` stores new bytes. Not emitted for bytes that are already stored, nor by `storePart` and `join`. A
    /// missing event does not mean that the data is not stored; check for code at the pointer.
    event MeshStored(address indexed pointer, address indexed by);
    /// @notice Emitted when `storeScene` stores new bytes, as `MeshStored`.
    event SceneStored(address indexed pointer, address indexed by);

    /// @notice The address has no code.
    error NoEncoder(address encoder);
    /// @notice The address has no code.
    error NoTurntable(address turntable);
    /// @notice The address has no code.
    error NoModeller(address modeller);

    constructor(Renderer renderer_, PngEncoder encoder_, Turntable turntable_, GlbEncoder modeller_) WithRenderer(renderer_) {
        if (address(encoder_).code.length == 0) revert NoEncoder(address(encoder_));
        if (address(turntable_).code.length == 0) revert NoTurntable(address(turntable_));
        if (address(modeller_).code.length == 0) revert NoModeller(address(modeller_));
        (encoder, turntable, modeller) = (encoder_, turntable_, modeller_);
    }

    /// @notice Stores a mesh, packed (`Mesh.sol`) or compact (`CompactMesh.sol`). Pointers are not accepted.
    /// @return pointer The address of the stored mesh.
    function storeMesh(bytes memory data) external returns (address pointer) {
        uint256 kind = kindOf(data);
        if (kind > LAST_FORMAT && kind != COMPACT) revert NotAMesh(kind);
        bool created;
        (pointer, created) = Storage.keep(data);
        if (created) emit MeshStored(pointer, msg.sender);
    }

    /// @notice Stores a scene. Its meshes can be pointers: see `meshAt`. Reverts if a scale, a camera or a material looks as if its numbers
    /// were not multiplied by 2^32.
    /// @return pointer The address of the stored mesh.
    function storeScene(Scene memory scene_) external returns (address pointer) {
        Units.check(scene_);
        bool created;
        (pointer, created) = Storage.keep(abi.encodePacked(uint8(SCENE), LibZip.cdCompress(abi.encode(scene_))));
        if (created) emit SceneStored(pointer, msg.sender);
    }

    /// @notice Stores a part (at most 24,575 bytes) of data too large for one transaction.
    function storePart(bytes memory data) external returns (address pointer) {
        if (data.length > Storage.MAX_PART) revert NotToBeKept();
        (pointer,) = Storage.keepPart(data);
    }

    /// @notice Stores the concatenation of parts as a mesh or scene. If each part but the last has 24,575 bytes, the pointer is the same as
    /// if the whole were stored at once.
    function join(address[] memory parts) external returns (address pointer) {
        (pointer,) = Storage.join(parts);
    }

    /// @notice Returns the reference to a stored mesh, for `Object.mesh`.
    function meshAt(address pointer) external pure returns (bytes memory) {
        return Meshes.pointed(pointer);
    }

    /// @notice Returns a stored mesh in the format of `Mesh.sol`.
    function mesh(address pointer) external view returns (bytes memory) {
        return Meshes.open(Meshes.pointed(pointer));
    }

    /// @notice Returns a stored scene with its meshes in the format of `Mesh.sol`, as the renderer takes it.
    function scene(address pointer) public view returns (Scene memory scene_) {
        bytes memory data = Storage.read(pointer);
        if (kindOf(data) != SCENE) revert NotAScene(pointer);
        return decoded(data);
    }

    /// @notice Returns a stored scene with changes applied.
    function scene(address pointer, Changes memory changes) public view returns (Scene memory scene_) {
        scene_ = scene(pointer);
        SceneChanges.make(scene_, changes);
    }

    /// @notice Reverts with the renderer's error if the stored scene cannot be drawn: a part or a mesh is missing, or a number is out of
    /// range. Checks everything and draws one pixel. Stored data never changes, so a scene that passes remains drawable.
    function check(address pointer) external view {
        renderer.renderTile(scene(pointer), Rectangle(0, 0, 1, 1));
    }

    /// @notice Draws a stored scene.
    /// @return A Windows bitmap of 24 bits per pixel.
    function render(address pointer) external view returns (bytes memory) {
        forward(address(renderer), abi.encodeCall(Renderer.render, (scene(pointer))));
    }

    /// @notice As above, with changes applied to the scene.
    function render(address pointer, Changes memory changes) external view returns (bytes memory) {
        forward(address(renderer), abi.encodeCall(Renderer.render, (scene(pointer, changes))));
    }

    /// @notice Returns the picture as a PNG file, each pixel enlarged to a square of `scale` x `scale` pixels, 1..8.
    function renderPNG(address pointer, uint256 scale) external view returns (bytes memory) {
        forward(address(encoder), abi.encodeCall(PngEncoder.encode, (renderer.render(scene(pointer)), scale)));
    }

    /// @notice As above, with changes applied to the scene.
    function renderPNG(address pointer, uint256 scale, Changes memory changes) external view returns (bytes memory) {
        forward(address(encoder), abi.encodeCall(PngEncoder.encode, (renderer.render(scene(pointer, changes)), scale)));
    }

    /// @notice Returns the PNG file as a `data:` URI.
    function renderDataURI(address pointer, uint256 scale) external view returns (string memory) {
        forward(address(encoder), abi.encodeCall(PngEncoder.dataURI, (renderer.render(scene(pointer)), scale)));
    }

    /// @notice As above, with changes applied to the scene.
    function renderDataURI(address pointer, uint256 scale, Changes memory changes) external view returns (string memory) {
        forward(address(encoder), abi.encodeCall(PngEncoder.dataURI, (renderer.render(scene(pointer, changes)), scale)));
    }

    /// @notice Returns an SVG document that contains the PNG file and shows each pixel as a square without smoothing.
    function renderSVG(address pointer, uint256 scale) external view returns (string memory) {
        forward(address(encoder), abi.encodeCall(PngEncoder.svg, (renderer.render(scene(pointer)), scale)));
    }

    /// @notice As above, with changes applied to the scene.
    function renderSVG(address pointer, uint256 scale, Changes memory changes) external view returns (string memory) {
        forward(address(encoder), abi.encodeCall(PngEncoder.svg, (renderer.render(scene(pointer, changes)), scale)));
    }

    /// @notice Returns the picture as a PNG file with an alpha channel instead of the background. Draws the scene twice: over black and
    /// over white.
    function renderTransparentPNG(address pointer, uint256 scale) external view returns (bytes memory) {
        encodeTransparent(PngEncoder.encodeTransparent.selector, scene(pointer), scale);
    }

    /// @notice As above, with changes applied to the scene.
    function renderTransparentPNG(address pointer, uint256 scale, Changes memory changes) external view returns (bytes memory) {
        encodeTransparent(PngEncoder.encodeTransparent.selector, scene(pointer, changes), scale);
    }

    /// @notice Returns the PNG file as a `data:` URI.
    function renderTransparentDataURI(address pointer, uint256 scale) external view returns (string memory) {
        encodeTransparent(PngEncoder.transparentDataURI.selector, scene(pointer), scale);
    }

    /// @notice As above, with changes applied to the scene.
    function renderTransparentDataURI(address pointer, uint256 scale, Changes memory changes) external view returns (string memory) {
        encodeTransparent(PngEncoder.transparentDataURI.selector, scene(pointer, changes), scale);
    }

    /// @notice Returns an animated PNG file of the rotating scene. `Turntable` does the same for scenes that are not stored.
    function animate(address pointer, Turn memory spin) external view returns (bytes memory) {
        forward(address(turntable), abi.encodeCall(Turntable.animate, (scene(pointer), spin)));
    }

    /// @notice As above, with changes applied to the scene. `Changes.turn` sets the orientation of the first frame.
    function animate(address pointer, Turn memory spin, Changes memory changes) external view returns (bytes memory) {
        forward(address(turntable), abi.encodeCall(Turntable.animate, (scene(pointer, changes), spin)));
    }

    /// @notice Returns the animated PNG file as a `data:` URI.
    function animateDataURI(address pointer, Turn memory spin) external view returns (string memory) {
        forward(address(turntable), abi.encodeCall(Turntable.animateDataURI, (scene(pointer), spin)));
    }

    /// @notice As above, with changes applied to the scene.
    function animateDataURI(address pointer, Turn memory spin, Changes memory changes) external view returns (string memory) {
        forward(address(turntable), abi.encodeCall(Turntable.animateDataURI, (scene(pointer, changes), spin)));
    }

    /// @notice Returns the picture of a scene that is not stored as a PNG file. Meshes can be packed, compact or pointers. The `draw`
    /// functions revert if a scale, a camera or a material looks as if its numbers were not multiplied by 2^32.
    function drawPNG(Scene memory scene_, uint256 scale) external view returns (bytes memory) {
        forward(address(encoder), abi.encodeCall(PngEncoder.encode, (renderer.render(given(scene_)), scale)));
    }

    /// @notice Returns the PNG file as a `data:` URI.
    function drawDataURI(Scene memory scene_, uint256 scale) external view returns (string memory) {
        forward(address(encoder), abi.encodeCall(PngEncoder.dataURI, (renderer.render(given(scene_)), scale)));
    }

    /// @notice Returns the picture as a PNG file with an alpha channel instead of the background. Draws the scene twice: over black and
    /// over white.
    function drawTransparentPNG(Scene memory scene_, uint256 scale) external view returns (bytes memory) {
        encodeTransparent(PngEncoder.encodeTransparent.selector, given(scene_), scale);
    }

    /// @notice Returns the PNG file as a `data:` URI.
    function drawTransparentDataURI(Scene memory scene_, uint256 scale) external view returns (string memory) {
        encodeTransparent(PngEncoder.transparentDataURI.selector, given(scene_), scale);
    }

    /// @notice Returns a stored scene or mesh as a binary glTF file, for 3D viewers. `GlbEncoder` does the same for scenes that are not
    /// stored.
    function glb(address pointer) external view returns (bytes memory) {
        forward(address(modeller), abi.encodeCall(GlbEncoder.encode, (shown(pointer))));
    }

    /// @notice Returns the file as a `data:` URI.
    function glbDataURI(address pointer) external view returns (string memory) {
        forward(address(modeller), abi.encodeCall(GlbEncoder.dataURI, (shown(pointer))));
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
