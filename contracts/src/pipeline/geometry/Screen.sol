// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import "../../words/Registers.sol";

// Reads what `Camera.project` and `Camera.nearness` of picture.py return.
// Reads screen words: see SCREEN_ in Words.sol. Columns and rows are in sub-pixels.

function columnOf(uint256 screenWord) pure returns (int256) {
    return int256((screenWord >> SCREEN_COLUMN_AT) & SCREEN_COLUMN_MASK);
}

function rowOf(uint256 screenWord) pure returns (int256) {
    return int256(screenWord >> SCREEN_ROW_AT);
}

/// @dev Returns the first row of pixels whose centres are not above the vertex.
function firstRowOf(uint256 screenWord) pure returns (uint256) {
    unchecked {
        return (screenWord + (SUBPIXEL_MASK << SCREEN_ROW_AT)) >> SCREEN_PIXEL_ROW_AT;
    }
}

/// @dev Returns the depth of the vertex.
function depthOf(uint256 screenWord) pure returns (uint256) {
    unchecked {
        return load((screenWord & SCREEN_RECORD_MASK) + VERTEX_ATTRIBUTES) >> ATTRIBUTE_DEPTH_AT;
    }
}

/// @dev Returns twice the area of a triangle; negative if it is clockwise.
function doubleAreaOf(uint256 a, uint256 b, uint256 c) pure returns (int256) {
    unchecked {
        return (columnOf(c) - columnOf(a)) * (rowOf(b) - rowOf(a)) - (columnOf(b) - columnOf(a)) * (rowOf(c) - rowOf(a));
    }
}

function min(uint256 a, uint256 b) pure returns (uint256) {
    return a < b ? a : b;
}

function max(uint256 a, uint256 b) pure returns (uint256) {
    return a > b ? a : b;
}
