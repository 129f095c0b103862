// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {Fixed} from "../math/Fixed.sol";
import {Vector} from "../math/Vector.sol";
import {NORMALS, WIDE} from "../scene/Mesh.sol";

// Sizes of the parts of a mesh in bytes; for a vertex without a normal, with 16-bit coordinates.
uint256 constant HEADER_SIZE = 5;
uint256 constant VERTEX_SIZE = 9;
uint256 constant FACE_SIZE = 6;

/// @notice Reads and changes meshes in the format of `Mesh.sol`, in memory.
library PackedMesh {
    /// @notice Sets the colour of all vertices. Leaves incomplete meshes unchanged; the renderer rejects them.
    function paint(bytes memory mesh, uint256 color) internal pure {
        (uint256 begin, uint256 end, uint256 size, uint256 stride) = vertices(mesh);
        assembly ("memory-safe") {
            color := shl(232, color)
            for { let place := add(begin, mul(3, size)) } lt(place, end) { place := add(place, stride) } {
                mstore(place, or(color, shr(24, shl(24, mload(place)))))
            }
        }
    }

    /// @notice Returns the minimum and maximum coordinates; zeros if there are no vertices or the data is incomplete.
    function box(bytes memory mesh) internal pure returns (int256[3] memory low, int256[3] memory high) {
        (uint256 begin, uint256 end, uint256 size, uint256 stride) = vertices(mesh);
        if (begin >= end) return (low, high);
        assembly ("memory-safe") {
            // a coordinate occupies the uppermost bits of the word at its position
            let cut := sub(256, shl(3, size))
            for { let axis := 0 } lt(axis, 3) { axis := add(axis, 1) } {
                let place := add(begin, mul(axis, size))
                let least := sar(cut, mload(place))
                let most := least
                for {} lt(place, end) { place := add(place, stride) } {
                    let value := sar(cut, mload(place))
                    if slt(value, least) { least := value }
                    if sgt(value, most) { most := value }
                }
                mstore(add(low, shl(5, axis)), least)
                mstore(add(high, shl(5, axis)), most)
            }
        }
    }

    /// @notice Returns the maximum dot product of the vertices with a direction, and whether there are vertices and all of them are
    /// complete.
    function reach(bytes memory mesh, Vector memory direction) internal pure returns (Fixed most, bool any) {
        (uint256 begin, uint256 end, uint256 size, uint256 stride) = vertices(mesh);
        if (begin >= end) return (most, false);
        (int256 x, int256 y, int256 z) = (direction.x.raw(), direction.y.raw(), direction.z.raw());
        int256 best = type(int256).min;
        assembly ("memory-safe") {
            // bits of a coordinate, which occupies the uppermost bits of the word at its position
            let bits := shl(3, size)
            let cut := sub(256, bits)
            for {} lt(begin, end) { begin := add(begin, stride) } {
                let word := mload(begin)
                let value := mul(x, sar(cut, word))
                word := shl(bits, word)
                value := add(value, mul(y, sar(cut, word)))
                value := add(value, mul(z, sar(cut, shl(bits, word))))
                if sgt(value, best) { best := value }
            }
        }
        return (Fixed.wrap(best), true);
    }

    /// @notice Returns the location of the vertices.
    /// @return begin The position of the first one.
    /// @return end The position after the last one; 0 if the data is incomplete.
    /// @return size The size of a coordinate in bytes.
    /// @return stride The size of a vertex in bytes.
    function vertices(bytes memory mesh) internal pure returns (uint256 begin, uint256 end, uint256 size, uint256 stride) {
        unchecked {
            uint256 header;
            assembly ("memory-safe") {
                header := shr(216, mload(add(mesh, 32)))
                begin := add(mesh, 37)
            }
            uint256 format = header >> 32;
            size = format & WIDE == 0 ? 2 : 3;
            stride = 3 * size + (format & NORMALS == 0 ? 3 : 7);
            uint256 used = HEADER_SIZE + stride * ((header >> 16) & 0xffff);
            if (used <= mesh.length) end = begin + used - HEADER_SIZE;
        }
    }
}
