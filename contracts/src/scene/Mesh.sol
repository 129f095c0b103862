// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

// The binary format of a mesh, all numbers big-endian:
//
//   format   1 byte    sum of NORMALS and WIDE
//   vertices 2 bytes   n
//   faces    2 bytes   m
//   n times:           position, 3 numbers of 2 bytes (3 if WIDE), signed
//                      colour, 3 bytes: red, green, blue
//                      normal, 4 bytes if NORMALS: 3 signed numbers of 10 bits, -511..511, then 2 bits that are 0
//   m times:           3 vertex indices of 2 bytes, counter-clockwise as seen from the front
//
// The normal is in the 2_10_10_10 format of graphics APIs: a unit vector times 511.

uint256 constant NORMALS = 1;
uint256 constant WIDE = 2;

/// @dev Positions are calldata offsets.
struct Mesh {
    uint256 vertices;
    uint256 vertexCount;
    uint256 faces;
    uint256 faceCount;
    /// bits of a coordinate: 16 or 24
    uint256 bits;
    /// bytes of a vertex
    uint256 stride;
}

/// @notice Returns the positions of the parts of a mesh. Its data must be complete: see `checkMesh`.
function openMesh(bytes calldata data) pure returns (Mesh memory mesh) {
    unchecked {
        uint256 header;
        assembly ("memory-safe") {
            header := shr(216, calldataload(data.offset))
            mstore(mesh, add(data.offset, 5))
        }
        uint256 format = header >> 32;
        mesh.vertexCount = (header >> 16) & 0xffff;
        mesh.faceCount = header & 0xffff;
        mesh.bits = format & WIDE == 0 ? 16 : 24;
        mesh.stride = 3 * mesh.bits / 8 + (format & NORMALS == 0 ? 3 : 7);
        mesh.faces = mesh.vertices + mesh.vertexCount * mesh.stride;
    }
}
