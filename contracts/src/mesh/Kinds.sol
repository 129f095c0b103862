// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {NORMALS, WIDE} from "../scene/Mesh.sol";

// The first byte of whatever is kept, or stands for a mesh, says what it is.

/// @dev Up to this: a mesh as the renderer takes it; the byte is its format (`Mesh.sol`).
uint256 constant LAST_FORMAT = NORMALS + WIDE;
/// @dev A mesh in fewer bytes: `CompactMesh.sol`.
uint256 constant COMPACT = 0x10;
/// @dev What stands for a mesh that is kept: the address of it, 20 bytes.
uint256 constant POINTED = 0x12;
/// @dev A list of the addresses of parts, 20 bytes each, which together are what is kept.
uint256 constant PARTS = 0x13;
/// @dev A scene: its ABI encoding, in which zeros are compressed (solady's LibZip.cdCompress).
uint256 constant SCENE = 0x20;

/// @notice The first byte; 256 if there is none.
function kindOf(bytes memory data) pure returns (uint256) {
    return data.length == 0 ? 256 : uint8(data[0]);
}
