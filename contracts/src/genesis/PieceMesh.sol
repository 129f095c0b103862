// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Elements} from "./Elements.sol";
import {HEADER_SIZE, VERTEX_SIZE, FACE_SIZE} from "../mesh/PackedMesh.sol";
import {Prisms} from "./Prisms.sol";

/// @title PieceMesh: packs prisms in the format of `Mesh.sol`.
library PieceMesh {
    using Elements for int256[];

    /// @dev The seven faces of a prism, three vertex indices of 2 bytes each, and the increment of each index from prism to prism. There is
    /// no far cap.
    uint256 private constant FACES_A = 0x0003_0004_0005_0004_0003_0000_0000_0001_0004_0005_0004_0001;
    uint256 private constant FACES_B = 0x0001_0002_0005_0002_0000_0003_0003_0005_0002;
    uint256 private constant SIX = 0x0006_0006_0006_0006_0006_0006_0006_0006_0006_0006_0006_0006;

    /// @param colors 0xRRGGBB for each point.
    function pack(Prisms memory prisms, uint256[] memory colors) internal pure returns (bytes memory mesh) {
        unchecked {
            uint256 vertices = colors.length;
            uint256 count = vertices / 6;
            // room for the whole words written at the end
            mesh = new bytes(HEADER_SIZE + VERTEX_SIZE * vertices + 7 * FACE_SIZE * count + 32);
            uint256 target;
            assembly ("memory-safe") {
                // exclude the last word
                mstore(mesh, sub(mload(mesh), 32))
                target := add(mesh, 32)
            }
            target = write(target, (vertices << 16) | (7 * count), HEADER_SIZE);
            (int256 cx, int256 cy) = (prisms.center[0], prisms.center[1]);
            for (uint256 i; i != vertices; ++i) {
                uint256 position = (short(prisms.x.get(i) - cx) << 32) | (short(prisms.y.get(i) - cy) << 16) | short(-prisms.z.get(i));
                target = write(target, (position << 24) | colors[i], VERTEX_SIZE);
            }
            (uint256 a, uint256 b) = (FACES_A, FACES_B);
            for (uint256 k; k != count; ++k) {
                target = write(target, a, 4 * FACE_SIZE);
                target = write(target, b, 3 * FACE_SIZE);
                a += SIX;
                b += SIX >> 48;
            }
        }
    }

    function short(int256 value) private pure returns (uint256) {
        return uint16(uint256(value));
    }

    /// @dev Writes a number of `size` bytes, followed by zeros, and returns the end of the number.
    function write(uint256 target, uint256 value, uint256 size) private pure returns (uint256) {
        unchecked {
            assembly ("memory-safe") {
                mstore(target, shl(sub(256, shl(3, size)), value))
            }
            return target + size;
        }
    }
}
