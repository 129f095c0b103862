// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {doubleAreaOf} from "./Screen.sol";
import "../../words/Registers.sol";

// Lists what `triangles` of picture.py yields.
// A triangle of a list, in one word: see TRIANGLE_ in Words.sol.
//
// The first vertex is the topmost, and the vertices are counter-clockwise on the screen.

uint256 constant ALL_EDGES = 7;

library Triangles {
    /// @notice Returns the three vertex indices of a face, 16 bits each.
    function readIndices(uint256 face) internal pure returns (uint256 indices) {
        assembly ("memory-safe") {
            indices := shr(FACE_AT, calldataload(face))
        }
    }

    /// @notice Lists one triangle of a clipped face, if it is to be drawn: see PrimitiveAssembly.
    /// @param a, b, c The screen words of the vertices.
    /// @param edges The edges that belong to the face, three bits as in the list.
    /// @return end The end of the list.
    /// @return drawn 1 if it is to be drawn, otherwise 0.
    function append(uint256 list, uint256 a, uint256 b, uint256 c, uint256 edges, bool cull)
        internal pure returns (uint256 end, uint256 drawn)
    {
        unchecked {
            int256 area = doubleAreaOf(a, b, c);
            if (area == 0 || (cull && area < 0) || a & b & c & IS_OUTSIDE != 0) return (list, 0);
            if (area < 0) {
                (b, c) = (c, b);
                edges = (edges >> 2) | (edges & 2) | ((edges & 1) << 2);
            }
            while (a > b || a > c) {
                (a, b, c) = (b, c, a);
                edges = (edges >> 1) | ((edges & 1) << 2);
            }
            return (pack(list, a, b, c, edges, area < 0 ? IS_TURNED_AWAY : 0), 1);
        }
    }

    /// @dev Lists a triangle of the face at FACE if it may cover a row.
    /// @param turned IS_TURNED_AWAY if it is turned away from the eye, otherwise 0.
    function pack(uint256 list, uint256 a, uint256 b, uint256 c, uint256 edges, uint256 turned) internal pure returns (uint256) {
        unchecked {
            uint256 top = (a + load(ROUND_TOP)) >> SCREEN_PIXEL_ROW_AT;
            uint256 bottom = ((b > c ? b : c) + load(ROUND_BOTTOM)) >> SCREEN_PIXEL_ROW_AT;
            if (top >= bottom) return list;
            uint256 face = (load(FACE) - load(MESH_FACES)) / FACE_SIZE;
            uint256 crossing = (a | b | c) & OUTSIDE_COLUMNS == 0 ? 0 : CROSSING_BIT;
            store(
                list,
                crossing | (turned << TRIANGLE_CROSSING_SHIFT) | (edges << TRIANGLE_EDGES_AT) | (face << TRIANGLE_FACE_AT)
                    | (bottom << TRIANGLE_BOTTOM_AT) | (top << TRIANGLE_TOP_AT) | ((a & SCREEN_RECORD_MASK) << TRIANGLE_A_AT)
                    | ((b & SCREEN_RECORD_MASK) << TRIANGLE_B_AT) | (c & SCREEN_RECORD_MASK)
            );
            return list + 32;
        }
    }
}
