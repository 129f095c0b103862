// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

// A mesh in bytes, all numbers big-endian:
//
//   format   1 byte    sum of NORMALS and WIDE
//   vertices 2 bytes   n
//   faces    2 bytes   m
//   n times:           position, 3 numbers of 2 bytes (3 if WIDE), signed
//                      colour, 3 bytes: red, green, blue
//                      normal, 4 bytes if NORMALS: 3 signed numbers of 10 bits, -511..511, then 2 bits that are 0
//   m times:           3 vertex numbers of 2 bytes, counter-clockwise as seen from the front
//
// The normal is the 2_10_10_10 format of graphics interfaces: a unit vector times 511.

uint256 constant NORMALS = 1;
uint256 constant WIDE = 2;

/// @notice A mesh whose bytes were found to be complete.
/// @dev All positions are calldata offsets.
struct Mesh {
    uint256 vertices;
    uint256 vertexCount;
    uint256 faces;
    uint256 faceCount;
    /// bits of a coordinate: 16 or 24
    uint256 bits;
    /// bytes of a vertex
    uint256 stride;
    bool hasNormals;
}

/// @notice The header is not that of a mesh: `format` has bits that mean nothing, or the bytes end before it is complete.
error MeshHeader(uint256 object, uint256 format, uint256 length);
/// @notice The counts of the header ask for `expected` bytes in all, `actual` were given.
error MeshLength(uint256 object, uint256 expected, uint256 actual);

function openMesh(bytes calldata data, uint256 object) pure returns (Mesh memory mesh) {
    unchecked {
        uint256 header;
        assembly ("memory-safe") {
            header := shr(216, calldataload(data.offset))
        }
        uint256 format = header >> 32;
        if (data.length < 5 || format > 3) revert MeshHeader(object, format, data.length);
        mesh.vertexCount = (header >> 16) & 0xffff;
        mesh.faceCount = header & 0xffff;
        mesh.bits = format & WIDE == 0 ? 16 : 24;
        mesh.hasNormals = format & NORMALS != 0;
        mesh.stride = 3 * mesh.bits / 8 + (mesh.hasNormals ? 7 : 3);
        uint256 expected = 5 + mesh.vertexCount * mesh.stride + mesh.faceCount * 6;
        if (data.length != expected) revert MeshLength(object, expected, data.length);
        assembly ("memory-safe") {
            mstore(mesh, add(data.offset, 5))
        }
        mesh.faces = mesh.vertices + mesh.vertexCount * mesh.stride;
    }
}
