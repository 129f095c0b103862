// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {SmoothShading} from "./SmoothShading.sol";
import {depthOf} from "../geometry/Screen.sol";
import "../../words/Registers.sol";

// Computes `wires` of picture.py: which edges are drawn.
// Draws the edges of the triangles of objects that are wireframes: Wireframe as pixels, SampleWires as samples. An edge of several faces is
// drawn once, with the first of those that are drawn.

/// @dev The set of edges: words of eight keys, of 32 bits each. One in each lane, and its highest bit.
uint256 constant ONES_32 = 0x100000001000000010000000100000001000000010000000100000001;
uint256 constant TOPS_32 = 0x8000000080000000800000008000000080000000800000008000000080000000;
/// @dev Multiplied by a key (Fibonacci hashing: 2^64 over the golden ratio) and shifted, it spreads the keys.
uint256 constant HASH_FACTOR = 0x9e3779b97f4a7c15;
uint256 constant HASH_SHIFT = 48;
/// @dev The positions of a key's first index, and of the last of the keys of a word.
uint256 constant KEY_FIRST_AT = 16;
uint256 constant KEY_SIZE = 32;
uint256 constant LAST_KEY_AT = 224;

abstract contract Wires is SmoothShading {
    /// @notice Draws a line, with the mode of the triangle.
    /// @param p, q The screen words of the ends.
    /// @param attribute The accumulator at p.
    /// @param change The change of the attribute word from p to q.
    function line(uint256 p, uint256 q, uint256 attribute, uint256 change) internal pure virtual;

    /// @dev The vertices of an edge, as numbers, are its key. A set of keys in free memory, which is zero before and afterwards, has room
    /// for four a triangle: it is filled by 3/8 in a closed mesh, and by 3/4 at most.
    function dropShared(uint256 list, uint256 end, uint256 records, uint256 shift) internal pure override returns (uint256 kept) {
        assembly ("memory-safe") {
            // adds the edge of two vertices, 16 bits each; returns 1 if it is new
            function add_(p, q, set, mask) -> isNew {
                let key := or(shl(KEY_FIRST_AT, p), q)
                if lt(q, p) { key := or(shl(KEY_FIRST_AT, q), p) }
                let at := shr(HASH_SHIFT, mul(key, HASH_FACTOR))
                for {} 1 { at := add(at, 32) } {
                    let word := add(set, and(at, mask))
                    let keys := mload(word)
                    let others := xor(keys, mul(key, ONES_32)) // a lane is zero where the key is
                    if and(and(sub(others, ONES_32), not(others)), TOPS_32) { break } // if any lane is zero
                    if iszero(shr(LAST_KEY_AT, keys)) {
                        mstore(word, or(shl(KEY_SIZE, keys), key))
                        isNew := 1
                        break
                    }
                }
            }

            let size := 64
            for {} lt(size, shr(1, sub(end, list))) {} { size := shl(1, size) } // 16 bytes a triangle
            let mask := sub(size, 32)
            kept := list
            for {} lt(list, end) { list := add(list, 32) } {
                let triangle := mload(list)
                let a := shr(shift, sub(and(shr(TRIANGLE_A_AT, triangle), TRIANGLE_A_MASK), records))
                let b := shr(shift, sub(and(shr(TRIANGLE_B_AT, triangle), TRIANGLE_B_MASK), records))
                let c := shr(shift, sub(and(triangle, TRIANGLE_C_MASK), records))
                let edges := add_(a, b, end, mask)
                edges := or(edges, shl(1, add_(b, c, end, mask)))
                edges := or(edges, shl(2, add_(c, a, end, mask)))
                if edges {
                    // ALL_EDGES before
                    mstore(kept, xor(triangle, shl(TRIANGLE_EDGES_AT, xor(edges, TRIANGLE_EDGES_MASK))))
                    kept := add(kept, 32)
                }
            }
            calldatacopy(kept, calldatasize(), add(sub(end, kept), size)) // zero, as depths have to be
        }
    }

    function drawEdges(uint256 a, uint256 b, uint256 c, uint256 triangle) internal pure override {
        unchecked {
            shadeExact(a, b, c, (triangle >> TRIANGLE_CROSSING_SHIFT) & CROSSES_COLUMNS);
            (uint256 start, uint256 toB, uint256 toC) = (load(ATTRIBUTE_0), load(DELTA_1), load(DELTA_2));
            uint256 mode = load(MODE);
            if (mode & IS_DEEP != 0) {
                // lines have their depths in the accumulator
                uint256 depth = depthOf(a);
                start += depth << ACCUMULATOR_VERTEX_DEPTH_AT;
                toB += (depthOf(b) - depth) << ATTRIBUTE_DEPTH_AT;
                toC += (depthOf(c) - depth) << ATTRIBUTE_DEPTH_AT;
                store(MODE, mode ^ IS_DEEP);
            }
            if (triangle & EDGE_AB != 0) line(a, b, start, toB);
            if (triangle & EDGE_BC != 0) line(b, c, start + (toB << ACCUMULATOR_FRACTION), toC - toB);
            if (triangle & EDGE_CA != 0) line(c, a, start + (toC << ACCUMULATOR_FRACTION), 0 - toC);
        }
    }
}
