// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {Scene} from "../scene/Scene.sol";
import {Changes} from "../studio/Changes.sol";
import {Spin} from "../studio/Spin.sol";
import {StudioErrors} from "../studio/StudioErrors.sol";
import {IGlbEncoder} from "./IGlbEncoder.sol";
import {IPngEncoder} from "./IPngEncoder.sol";
import {IRenderer} from "./IRenderer.sol";
import {ITurntable} from "./ITurntable.sol";

/// @title IStudio: meshes and scenes stored on chain, and pictures for every contract.
/// @notice Anyone stores a mesh or a scene once. There is no owner, and nothing can be changed or removed. The address of what is stored
/// is made of its bytes: the same mesh or scene has the same pointer on every chain.
interface IStudio is StudioErrors {
    /// @notice Bytes were stored by `storeMesh` or `storeScene`. There is no event where they were kept already, nor for what `storePart`
    /// and `join` store: that nothing was told does not mean that nothing is kept. Ask the pointer.
    event MeshStored(address indexed pointer, address indexed by);
    /// @notice As for a mesh.
    event SceneStored(address indexed pointer, address indexed by);

    /// @notice The address has no code.
    error NoRenderer(address renderer);
    /// @notice The address has no code.
    error NoEncoder(address encoder);
    /// @notice The address has no code.
    error NoTurntable(address turntable);
    /// @notice The address has no code.
    error NoModeller(address modeller);

    /// @notice What draws.
    function renderer() external view returns (IRenderer);

    /// @notice What makes PNG files of the pictures.
    function encoder() external view returns (IPngEncoder);

    /// @notice What makes animated PNG files of scenes that turn.
    function turntable() external view returns (ITurntable);

    /// @notice What makes models of scenes.
    function modeller() external view returns (IGlbEncoder);

    /// @notice Stores a mesh in any of its forms but a pointer: packed (`Mesh.sol`) or compact (`CompactMesh.sol`).
    /// @return pointer Where it is kept.
    function storeMesh(bytes calldata data) external returns (address pointer);

    /// @notice Stores a scene. Its meshes may be pointers: `meshAt`. A scale, a camera or a material whose numbers were not multiplied by
    /// 2^32 is refused.
    /// @return pointer Where it is kept.
    function storeScene(Scene calldata scene_) external returns (address pointer);

    /// @notice Stores up to 24,575 bytes of something larger, for what does not fit one transaction.
    function storePart(bytes calldata data) external returns (address pointer);

    /// @notice Stores what the parts are together: a mesh or a scene. The pointer is that of the whole stored at once, where each part but
    /// the last has 24,575 bytes.
    function join(address[] calldata parts) external returns (address pointer);

    /// @notice What stands for a mesh that is kept, in the field `mesh` of an object.
    function meshAt(address pointer) external pure returns (bytes memory);

    /// @notice A mesh that is kept, in the format of `Mesh.sol`.
    function mesh(address pointer) external view returns (bytes memory);

    /// @notice A scene that is kept, its meshes in the format of `Mesh.sol`: what the renderer takes.
    function scene(address pointer) external view returns (Scene memory);

    /// @notice The same with changes.
    function scene(address pointer, Changes calldata changes) external view returns (Scene memory);

    /// @notice Reverts if the scene that is kept there cannot be drawn, with the error that drawing it would have: a part or a mesh is
    /// missing, or a number is out of range. All is checked, one pixel is drawn. As nothing that is kept changes, it can be drawn ever
    /// after.
    function check(address pointer) external view;

    /// @notice The picture of a scene that is kept.
    /// @return A Windows bitmap of 24 bits a pixel.
    function render(address pointer) external view returns (bytes memory);

    /// @notice The same with changes.
    function render(address pointer, Changes calldata changes) external view returns (bytes memory);

    /// @notice The picture as a PNG file, each pixel a square of `scale` pixels, 1..8.
    function renderPNG(address pointer, uint256 scale) external view returns (bytes memory);

    /// @notice The same with changes.
    function renderPNG(address pointer, uint256 scale, Changes calldata changes) external view returns (bytes memory);

    /// @notice The PNG file as a `data:` URI.
    function renderDataURI(address pointer, uint256 scale) external view returns (string memory);

    /// @notice The same with changes.
    function renderDataURI(address pointer, uint256 scale, Changes calldata changes) external view returns (string memory);

    /// @notice An SVG document that holds the PNG file, and shows each pixel as a square without smoothing.
    function renderSVG(address pointer, uint256 scale) external view returns (string memory);

    /// @notice The same with changes.
    function renderSVG(address pointer, uint256 scale, Changes calldata changes) external view returns (string memory);

    /// @notice The picture without its background, as a PNG file with an alpha channel. The scene is drawn twice: over black and over
    /// white.
    function renderTransparentPNG(address pointer, uint256 scale) external view returns (bytes memory);

    /// @notice The same with changes.
    function renderTransparentPNG(address pointer, uint256 scale, Changes calldata changes) external view returns (bytes memory);

    /// @notice The PNG file as a `data:` URI.
    function renderTransparentDataURI(address pointer, uint256 scale) external view returns (string memory);

    /// @notice The same with changes.
    function renderTransparentDataURI(address pointer, uint256 scale, Changes calldata changes) external view returns (string memory);

    /// @notice The scene turning, as an animated PNG file: see `Turntable`, which draws scenes that are not kept.
    function animate(address pointer, Spin calldata spin) external view returns (bytes memory);

    /// @notice The same with changes, of which the first frame has the turn.
    function animate(address pointer, Spin calldata spin, Changes calldata changes) external view returns (bytes memory);

    /// @notice The animated PNG file as a `data:` URI.
    function animateDataURI(address pointer, Spin calldata spin) external view returns (string memory);

    /// @notice The same with changes.
    function animateDataURI(address pointer, Spin calldata spin, Changes calldata changes) external view returns (string memory);

    /// @notice The picture of a scene that is not kept, as a PNG file; its meshes may be pointers and compact. As with the following, a
    /// scale, a camera or a material whose numbers were not multiplied by 2^32 is refused.
    function drawPNG(Scene calldata scene_, uint256 scale) external view returns (bytes memory);

    /// @notice The same as a `data:` URI.
    function drawDataURI(Scene calldata scene_, uint256 scale) external view returns (string memory);

    /// @notice The picture without its background, as a PNG file with an alpha channel. The scene is drawn twice: over black and over
    /// white.
    function drawTransparentPNG(Scene calldata scene_, uint256 scale) external view returns (bytes memory);

    /// @notice The same as a `data:` URI.
    function drawTransparentDataURI(Scene calldata scene_, uint256 scale) external view returns (string memory);

    /// @notice A scene or a mesh that is kept, as a binary glTF file, which viewers turn: see `GlbEncoder`, which takes scenes that are not
    /// kept.
    function glb(address pointer) external view returns (bytes memory);

    /// @notice The same as a `data:` URI.
    function glbDataURI(address pointer) external view returns (string memory);
}
