// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {NORMALS, WIDE} from "../scene/Mesh.sol";

// The first byte of stored data, or of a reference to a mesh, is its kind.

/// @dev Kinds up to this one: a mesh as the renderer takes it; the kind is its format (`Mesh.sol`).
uint256 constant LAST_FORMAT = NORMALS + WIDE;
/// @dev A compact mesh: `CompactMesh.sol`.
uint256 constant COMPACT = 0x10;
/// @dev A reference to a stored mesh: its address, 20 bytes.
uint256 constant POINTED = 0x12;
/// @dev A list of the addresses of parts, 20 bytes each, which represents the concatenation of the parts.
uint256 constant PARTS = 0x13;
/// @dev A scene: its ABI encoding with zeros compressed (solady's LibZip.cdCompress).
uint256 constant SCENE = 0x20;

/// @notice Returns the kind, the first byte; 256 if the data is empty.
function kindOf(bytes memory data) pure returns (uint256) {
    return data.length == 0 ? 256 : uint8(data[0]);
}

/// @notice Returns a number of `size` bytes, from byte `place` on.
function number(bytes memory data, uint256 place, uint256 size) pure returns (uint256 value) {
    assembly ("memory-safe") {
        value := shr(sub(256, shl(3, size)), mload(add(add(data, 32), place)))
    }
}
