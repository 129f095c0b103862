// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Mesh} from "../../scene/Mesh.sol";
import {SceneErrors} from "../../scene/SceneErrors.sol";
import {Triangles} from "./Triangles.sol";
import "../../words/Registers.sol";

// Checks the faces of `object_of` of picture.py.

/// @dev Lanes of 32 bits: the lowest bit, and the lower half of each.
uint256 constant LOW_32 = 0x0000000100000001000000010000000100000001000000010000000100000001;
uint256 constant LOW_16 = 0x0000ffff0000ffff0000ffff0000ffff0000ffff0000ffff0000ffff0000ffff;

library Indices {
    /// @notice Reverts if a face has a vertex index out of range.
    function check(Mesh memory mesh, uint256 object) internal pure {
        unchecked {
            uint256 count = mesh.vertexCount;
            uint256 faces = mesh.faces;
            uint256 size = FACE_SIZE * mesh.faceCount;
            uint256 bad;
            assembly ("memory-safe") {
                // 16 indices at once: index + 2^16 - count, in lanes of 32 bits, is at least 2^16 if the index is out of range
                let bias := mul(sub(0x10000, count), LOW_32) // 2^16 - count in each lane
                let end := add(faces, size)
                // the first word begins before the faces if their size is not a multiple of 32: index 0 in place of what is there
                let before := and(sub(0, size), 31) // -size mod 32
                let mask := shr(shl(3, before), not(0)) // without the first 8 * before bits
                for { let place := sub(faces, before) } lt(place, end) { place := add(place, 32) } {
                    let numbers := and(calldataload(place), mask)
                    mask := not(0)
                    bad := or(bad, or(add(and(numbers, LOW_16), bias), add(and(shr(16, numbers), LOW_16), bias)))
                }
                bad := and(bad, shl(16, LOW_32))
            }
            if (bad == 0) return;
            for (uint256 face; face != mesh.faceCount; ++face) {
                uint256 indices = Triangles.readIndices(faces + FACE_SIZE * face);
                if (
                    indices >> FACE_FIRST_AT >= count || (indices >> FACE_SECOND_AT) & FACE_INDEX_MASK >= count
                        || indices & FACE_INDEX_MASK >= count
                ) {
                    revert SceneErrors.IndexOutOfRange(object, face, count);
                }
            }
        }
    }
}
