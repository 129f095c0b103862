// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {LibZip} from "solady/src/utils/LibZip.sol";
import {forward} from "../encode/Forward.sol";
import {GlbEncoder} from "../encode/GlbEncoder.sol";
import {PngEncoder} from "../encode/PngEncoder.sol";
import {ONE} from "../math/Fixed.sol";
import {COMPACT, LAST_FORMAT, SCENE, kindOf} from "../mesh/Kinds.sol";
import {Meshes} from "../mesh/Meshes.sol";
import {NORMALS} from "../scene/Mesh.sol";
import {FLAT, SMOOTH, Background, Object, Rectangle, Scene} from "../scene/Scene.sol";
import {Renderer} from "../Renderer.sol";
import {WithRenderer} from "../WithRenderer.sol";
import {Changes} from "./Changes.sol";
import {Kept} from "./Kept.sol";
import {SceneChanges} from "./SceneChanges.sol";
import {Spin} from "./Spin.sol";
import {StudioErrors} from "./StudioErrors.sol";
import {Turntable} from "./Turntable.sol";
import {Units} from "./Units.sol";

/// @title Studio: meshes and scenes kept on chain, and their pictures for every contract.
/// @notice Anyone stores a mesh or a scene once, for the gas alone, and has a pointer to it for ever. There is no owner, nothing can be
/// changed or removed, and the address is made of what is stored: the same mesh or scene has the same pointer, whoever stores it, and is
/// stored once. What is wrong with a scene is told when it is drawn, and concerns no other.
contract Studio is WithRenderer, StudioErrors {
    /// @notice What makes PNG files of the pictures.
    PngEncoder public immutable encoder;
    /// @notice What makes animated PNG files of scenes that turn.
    Turntable public immutable turntable;
    /// @notice What makes models of scenes.
    GlbEncoder public immutable modeller;

    /// @notice Bytes were stored by `storeMesh` or `storeScene`. There is no event where they were kept already, nor for what `storePart`
    /// and `join` store: that nothing was told does not mean that nothing is kept. Ask the pointer.
    event MeshStored(address indexed pointer, address indexed by);
    /// @notice As for a mesh.
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

    /// @notice Stores a mesh in any of its forms but a pointer: packed (`Mesh.sol`) or compact (`CompactMesh.sol`).
    /// @return pointer Where it is kept.
    function storeMesh(bytes memory data) external returns (address pointer) {
        uint256 kind = kindOf(data);
        if (kind > LAST_FORMAT && kind != COMPACT) revert NotAMesh(kind);
        bool created;
        (pointer, created) = Kept.keep(data);
        if (created) emit MeshStored(pointer, msg.sender);
    }

    /// @notice Stores a scene. Its meshes may be pointers: `meshAt`. A scale, a camera or a material whose numbers were not multiplied by
    /// 2^32 is refused.
    /// @return pointer Where it is kept.
    function storeScene(Scene memory scene_) external returns (address pointer) {
        Units.check(scene_);
        bool created;
        (pointer, created) = Kept.keep(abi.encodePacked(uint8(SCENE), LibZip.cdCompress(abi.encode(scene_))));
        if (created) emit SceneStored(pointer, msg.sender);
    }

    /// @notice Stores up to 24,575 bytes of something larger, for what does not fit one transaction.
    function storePart(bytes memory data) external returns (address pointer) {
        if (data.length > Kept.MAX_PART) revert NotToBeKept();
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
        if (kindOf(data) != SCENE) revert NotAScene(pointer);
        return decoded(data);
    }

    /// @notice The same with changes.
    function scene(address pointer, Changes memory changes) public view returns (Scene memory scene_) {
        scene_ = scene(pointer);
        SceneChanges.make(scene_, changes);
    }

    /// @notice Reverts if the scene that is kept there cannot be drawn, with the error that drawing it would have: a part or a mesh is
    /// missing, or a number is out of range. All is checked, one pixel is drawn. As nothing that is kept changes, it can be drawn ever
    /// after.
    function check(address pointer) external view {
        renderer.renderTile(scene(pointer), Rectangle(0, 0, 1, 1));
    }

    /// @notice The picture of a scene that is kept.
    /// @return A Windows bitmap of 24 bits a pixel.
    function render(address pointer) external view returns (bytes memory) {
        forward(address(renderer), abi.encodeCall(Renderer.render, (scene(pointer))));
    }

    /// @notice The same with changes.
    function render(address pointer, Changes memory changes) external view returns (bytes memory) {
        forward(address(renderer), abi.encodeCall(Renderer.render, (scene(pointer, changes))));
    }

    /// @notice The picture as a PNG file, each pixel a square of `scale` pixels, 1..8.
    function renderPNG(address pointer, uint256 scale) external view returns (bytes memory) {
        forward(address(encoder), abi.encodeCall(PngEncoder.encode, (renderer.render(scene(pointer)), scale)));
    }

    /// @notice The same with changes.
    function renderPNG(address pointer, uint256 scale, Changes memory changes) external view returns (bytes memory) {
        forward(address(encoder), abi.encodeCall(PngEncoder.encode, (renderer.render(scene(pointer, changes)), scale)));
    }

    /// @notice The PNG file as a `data:` URI.
    function renderDataURI(address pointer, uint256 scale) external view returns (string memory) {
        forward(address(encoder), abi.encodeCall(PngEncoder.dataURI, (renderer.render(scene(pointer)), scale)));
    }

    /// @notice The same with changes.
    function renderDataURI(address pointer, uint256 scale, Changes memory changes) external view returns (string memory) {
        forward(address(encoder), abi.encodeCall(PngEncoder.dataURI, (renderer.render(scene(pointer, changes)), scale)));
    }

    /// @notice An SVG document that holds the PNG file, and shows each pixel as a square without smoothing.
    function renderSVG(address pointer, uint256 scale) external view returns (string memory) {
        forward(address(encoder), abi.encodeCall(PngEncoder.svg, (renderer.render(scene(pointer)), scale)));
    }

    /// @notice The same with changes.
    function renderSVG(address pointer, uint256 scale, Changes memory changes) external view returns (string memory) {
        forward(address(encoder), abi.encodeCall(PngEncoder.svg, (renderer.render(scene(pointer, changes)), scale)));
    }

    /// @notice The picture without its background, as a PNG file with an alpha channel. The scene is drawn twice: over black and over
    /// white.
    function renderTransparentPNG(address pointer, uint256 scale) external view returns (bytes memory) {
        encodeTransparent(PngEncoder.encodeTransparent.selector, scene(pointer), scale);
    }

    /// @notice The same with changes.
    function renderTransparentPNG(address pointer, uint256 scale, Changes memory changes) external view returns (bytes memory) {
        encodeTransparent(PngEncoder.encodeTransparent.selector, scene(pointer, changes), scale);
    }

    /// @notice The PNG file as a `data:` URI.
    function renderTransparentDataURI(address pointer, uint256 scale) external view returns (string memory) {
        encodeTransparent(PngEncoder.transparentDataURI.selector, scene(pointer), scale);
    }

    /// @notice The same with changes.
    function renderTransparentDataURI(address pointer, uint256 scale, Changes memory changes) external view returns (string memory) {
        encodeTransparent(PngEncoder.transparentDataURI.selector, scene(pointer, changes), scale);
    }

    /// @notice The scene turning, as an animated PNG file: see `Turntable`, which draws scenes that are not kept.
    function animate(address pointer, Spin memory spin) external view returns (bytes memory) {
        forward(address(turntable), abi.encodeCall(Turntable.animate, (scene(pointer), spin)));
    }

    /// @notice The same with changes, of which the first frame has the turn.
    function animate(address pointer, Spin memory spin, Changes memory changes) external view returns (bytes memory) {
        forward(address(turntable), abi.encodeCall(Turntable.animate, (scene(pointer, changes), spin)));
    }

    /// @notice The animated PNG file as a `data:` URI.
    function animateDataURI(address pointer, Spin memory spin) external view returns (string memory) {
        forward(address(turntable), abi.encodeCall(Turntable.animateDataURI, (scene(pointer), spin)));
    }

    /// @notice The same with changes.
    function animateDataURI(address pointer, Spin memory spin, Changes memory changes) external view returns (string memory) {
        forward(address(turntable), abi.encodeCall(Turntable.animateDataURI, (scene(pointer, changes), spin)));
    }

    /// @notice The picture of a scene that is not kept, as a PNG file; its meshes may be pointers and compact. As with the following, a
    /// scale, a camera or a material whose numbers were not multiplied by 2^32 is refused.
    function drawPNG(Scene memory scene_, uint256 scale) external view returns (bytes memory) {
        forward(address(encoder), abi.encodeCall(PngEncoder.encode, (renderer.render(given(scene_)), scale)));
    }

    /// @notice The same as a `data:` URI.
    function drawDataURI(Scene memory scene_, uint256 scale) external view returns (string memory) {
        forward(address(encoder), abi.encodeCall(PngEncoder.dataURI, (renderer.render(given(scene_)), scale)));
    }

    /// @notice The picture without its background, as a PNG file with an alpha channel. The scene is drawn twice: over black and over
    /// white.
    function drawTransparentPNG(Scene memory scene_, uint256 scale) external view returns (bytes memory) {
        encodeTransparent(PngEncoder.encodeTransparent.selector, given(scene_), scale);
    }

    /// @notice The same as a `data:` URI.
    function drawTransparentDataURI(Scene memory scene_, uint256 scale) external view returns (string memory) {
        encodeTransparent(PngEncoder.transparentDataURI.selector, given(scene_), scale);
    }

    /// @notice A scene or a mesh that is kept, as a binary glTF file, which viewers turn: see `GlbEncoder`, which takes scenes that are not
    /// kept.
    function glb(address pointer) external view returns (bytes memory) {
        forward(address(modeller), abi.encodeCall(GlbEncoder.encode, (shown(pointer))));
    }

    /// @notice The same as a `data:` URI.
    function glbDataURI(address pointer) external view returns (string memory) {
        forward(address(modeller), abi.encodeCall(GlbEncoder.dataURI, (shown(pointer))));
    }

    /// @dev Ends the call with what a function of the encoder makes of the pictures over black and over white.
    function encodeTransparent(bytes4 function_, Scene memory scene_, uint256 scale) private view {
        bytes memory black = over(scene_, scene_.invert != 0 ? 0xffffff : 0);
        bytes memory white = over(scene_, scene_.invert != 0 ? 0 : 0xffffff);
        forward(address(encoder), abi.encodeWithSelector(function_, black, white, scale));
    }

    /// @dev The picture over a background of one colour, which `invert` inverts, too.
    function over(Scene memory scene_, uint256 color) private view returns (bytes memory) {
        scene_.background = Background(color, color);
        return renderer.render(scene_);
    }

    /// @dev A scene that is kept, or one with a mesh that is kept, seen from both sides.
    function shown(address pointer) private view returns (Scene memory scene_) {
        bytes memory data = Kept.read(pointer);
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

    /// @dev A scene that a caller passes, for whom numbers without their unit are refused.
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
