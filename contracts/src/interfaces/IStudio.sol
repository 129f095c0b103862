// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {Scene} from "../scene/Scene.sol";
import {Changes} from "./Changes.sol";
import {Turn} from "./Turn.sol";
import {StudioErrors} from "./StudioErrors.sol";
import {IGlbEncoder} from "./IGlbEncoder.sol";
import {ITurntable} from "./ITurntable.sol";
import {IWithEncoder} from "./IWithRenderer.sol";

/// @title IStudio: stores meshes and scenes on chain, and draws them for any contract.
/// @notice Anyone can store a mesh or a scene; its pointer is permanent. There is no owner, and nothing can be changed or removed. The
/// pointer is derived from the stored bytes: the same mesh or scene has the same pointer on every chain.
interface IStudio is StudioErrors, IWithEncoder {
    /// @notice Emitted when `storeMesh` stores new bytes. Not emitted for bytes that are already stored, nor by `storePart` and `join`. A
    /// missing event does not mean that the data is not stored; check for code at the pointer.
    event MeshStored(address indexed pointer, address indexed by);
    /// @notice Emitted when `storeScene` stores new bytes, as `MeshStored`.
    event SceneStored(address indexed pointer, address indexed by);

    /// @notice The address has no code.
    error NoTurntable(address turntable);
    /// @notice The address has no code.
    error NoModeller(address modeller);

    /// @notice Returns the contract that makes animated PNG files of rotating scenes.
    function turntable() external view returns (ITurntable);

    /// @notice Returns the encoder of binary glTF files.
    function modeller() external view returns (IGlbEncoder);

    /// @notice Stores a mesh, packed (`Mesh.sol`) or compact (`CompactMesh.sol`). Pointers are not accepted.
    /// @return pointer The address of the stored mesh.
    function storeMesh(bytes calldata data) external returns (address pointer);

    /// @notice Stores a scene. Its meshes can be pointers: see `meshAt`. Reverts if a scale, a camera or a material looks as if its numbers
    /// were not multiplied by 2^32.
    /// @return pointer The address of the stored scene.
    function storeScene(Scene calldata scene_) external returns (address pointer);

    /// @notice Stores a part (at most 24,575 bytes) of data too large for one transaction.
    function storePart(bytes calldata data) external returns (address pointer);

    /// @notice Stores the concatenation of parts as a mesh or scene. If each part but the last has 24,575 bytes, the pointer is the same as
    /// if the whole were stored at once.
    function join(address[] calldata parts) external returns (address pointer);

    /// @notice Returns the reference to a stored mesh, for `Object.mesh`.
    function meshAt(address pointer) external pure returns (bytes memory);

    /// @notice Returns a stored mesh in the format of `Mesh.sol`.
    function mesh(address pointer) external view returns (bytes memory);

    /// @notice Returns a stored scene with its meshes in the format of `Mesh.sol`, as the renderer takes it.
    function scene(address pointer) external view returns (Scene memory);

    /// @notice Returns a stored scene with changes applied.
    function scene(address pointer, Changes calldata changes) external view returns (Scene memory);

    /// @notice Reverts with the renderer's error if the stored scene cannot be drawn: a part or a mesh is missing, or a number is out of
    /// range. Checks everything and draws one pixel. Stored data never changes, so a scene that passes remains drawable.
    function check(address pointer) external view;

    /// @notice Draws a stored scene.
    /// @return A Windows bitmap of 24 bits per pixel.
    function render(address pointer) external view returns (bytes memory);

    /// @notice As above, with changes applied to the scene.
    function render(address pointer, Changes calldata changes) external view returns (bytes memory);

    /// @notice Returns the picture as a PNG file, each pixel enlarged to a square of `scale` x `scale` pixels, 1..8.
    function renderPNG(address pointer, uint256 scale) external view returns (bytes memory);

    /// @notice As above, with changes applied to the scene.
    function renderPNG(address pointer, uint256 scale, Changes calldata changes) external view returns (bytes memory);

    /// @notice Returns the PNG file as a `data:` URI.
    function renderDataURI(address pointer, uint256 scale) external view returns (string memory);

    /// @notice As above, with changes applied to the scene.
    function renderDataURI(address pointer, uint256 scale, Changes calldata changes) external view returns (string memory);

    /// @notice Returns an SVG document that contains the PNG file and shows each pixel as a square without smoothing.
    function renderSVG(address pointer, uint256 scale) external view returns (string memory);

    /// @notice As above, with changes applied to the scene.
    function renderSVG(address pointer, uint256 scale, Changes calldata changes) external view returns (string memory);

    /// @notice Returns the picture as a PNG file with an alpha channel instead of the background. Draws the scene twice: over black and
    /// over white.
    function renderTransparentPNG(address pointer, uint256 scale) external view returns (bytes memory);

    /// @notice As above, with changes applied to the scene.
    function renderTransparentPNG(address pointer, uint256 scale, Changes calldata changes) external view returns (bytes memory);

    /// @notice Returns the PNG file as a `data:` URI.
    function renderTransparentDataURI(address pointer, uint256 scale) external view returns (string memory);

    /// @notice As above, with changes applied to the scene.
    function renderTransparentDataURI(address pointer, uint256 scale, Changes calldata changes) external view returns (string memory);

    /// @notice Returns an animated PNG file of the rotating scene. `Turntable` does the same for scenes that are not stored.
    function animate(address pointer, Turn calldata spin) external view returns (bytes memory);

    /// @notice As above, with changes applied to the scene. `Changes.turn` sets the orientation of the first frame.
    function animate(address pointer, Turn calldata spin, Changes calldata changes) external view returns (bytes memory);

    /// @notice Returns the animated PNG file as a `data:` URI.
    function animateDataURI(address pointer, Turn calldata spin) external view returns (string memory);

    /// @notice As above, with changes applied to the scene.
    function animateDataURI(address pointer, Turn calldata spin, Changes calldata changes) external view returns (string memory);

    /// @notice Returns the picture of a scene that is not stored as a PNG file. Meshes can be packed, compact or pointers. The `draw`
    /// functions revert if a scale, a camera or a material looks as if its numbers were not multiplied by 2^32.
    function drawPNG(Scene calldata scene_, uint256 scale) external view returns (bytes memory);

    /// @notice Returns the PNG file as a `data:` URI.
    function drawDataURI(Scene calldata scene_, uint256 scale) external view returns (string memory);

    /// @notice Returns the picture as a PNG file with an alpha channel instead of the background. Draws the scene twice: over black and
    /// over white.
    function drawTransparentPNG(Scene calldata scene_, uint256 scale) external view returns (bytes memory);

    /// @notice Returns the PNG file as a `data:` URI.
    function drawTransparentDataURI(Scene calldata scene_, uint256 scale) external view returns (string memory);

    /// @notice Returns a stored scene or mesh as a binary glTF file, for 3D viewers. `GlbEncoder` does the same for scenes that are not
    /// stored.
    function glb(address pointer) external view returns (bytes memory);

    /// @notice Returns the file as a `data:` URI.
    function glbDataURI(address pointer) external view returns (string memory);
}
