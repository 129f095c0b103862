// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Storage} from "./Storage.sol";
import {CompactMesh} from "../mesh/CompactMesh.sol";
import {COMPACT, LAST_FORMAT, POINTED, kindOf} from "../mesh/Kinds.sol";
import {MeshErrors} from "../interfaces/MeshErrors.sol";

/// @notice Opens meshes of any kind.
library Meshes {
    /// @notice Returns the mesh in the format of `Mesh.sol`, which the renderer takes.
    function open(bytes memory data) internal view returns (bytes memory) {
        uint256 kind = kindOf(data);
        if (kind == POINTED) {
            data = Storage.read(pointerIn(data));
            kind = kindOf(data);
        }
        if (kind <= LAST_FORMAT) return data;
        if (kind == COMPACT) return CompactMesh.expand(data);
        revert MeshErrors.UnknownMesh(kind);
    }

    /// @notice Returns the reference to a stored mesh.
    function pointed(address pointer) internal pure returns (bytes memory) {
        return abi.encodePacked(uint8(POINTED), pointer);
    }

    function pointerIn(bytes memory data) private pure returns (address pointer) {
        if (data.length != 21) revert MeshErrors.UnknownMesh(POINTED);
        assembly ("memory-safe") {
            pointer := shr(96, mload(add(data, 33)))
        }
    }

    /// @dev Returns the bytes without the first one.
    function rest(bytes memory data) internal pure returns (bytes memory tail) {
        assembly ("memory-safe") {
            tail := mload(0x40)
            let size := sub(mload(data), 1)
            mstore(tail, size)
            mcopy(add(tail, 32), add(data, 33), size)
            mstore(add(add(tail, 32), size), 0)
            mstore(0x40, and(add(add(tail, size), 95), not(31)))
        }
    }
}
