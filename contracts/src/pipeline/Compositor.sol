// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Rectangle} from "../scene/Scene.sol";
import {ONES} from "../pipeline/Registers.sol";

// The background under the objects, and what happens to all pixels when they are drawn.

library Compositor {
    /// @notice Fills the pixels of a tile with the background, rows from the bottom, without padding.
    function background(uint256 image, uint256 top, uint256 bottom, uint256 height, Rectangle memory tile) internal pure {
        unchecked {
            uint256 rowBytes = 3 * tile.width;
            // lanes of Q24: the change from row to row upwards, and the bottom row
            uint256 step = laneStep(top, bottom, height == 1 ? 1 : height - 1);
            uint256 color = (lanes(height == 1 ? top : bottom) << 24) + (ONES << 23) + step * (height - tile.y - tile.height);
            uint256 last = type(uint256).max;
            for (uint256 row = tile.height; row != 0; --row) {
                uint256 rounded = (color >> 24) & (ONES * 0xff);
                if (rounded == last) copyRow(image, rowBytes);
                else fillRow(image, rowBytes, rounded);
                last = rounded;
                image += rowBytes;
                color += step;
            }
        }
    }

    /// @notice Turns every byte v of `size` bytes into 255 - v.
    function invert(uint256 image, uint256 size) internal pure {
        assembly ("memory-safe") {
            let end := add(image, size)
            for {} lt(image, end) { image := add(image, 64) } {
                mstore(image, not(mload(image)))
                mstore(add(image, 32), not(mload(add(image, 32))))
            }
        }
    }

    /// @notice How many pixels of a depth buffer are covered. Nothing that is drawn has the depth 0 of the empty buffer; the 24 bytes
    /// behind its end must be empty.
    function litPixels(uint256 depth, uint256 end) internal pure returns (uint256 count) {
        assembly ("memory-safe") {
            // four depths in a word; 1 or 0 for each, side by side in lanes that are added up at the end
            let counts := 0
            for {} lt(depth, end) { depth := add(depth, 32) } {
                let depths := mload(depth)
                // the highest bit of a lane is set if any bit of it is
                let some := add(and(depths, 0x7fffffffffffffff7fffffffffffffff7fffffffffffffff7fffffffffffffff), 0x7fffffffffffffff7fffffffffffffff7fffffffffffffff7fffffffffffffff)
                counts := add(counts, shr(63, and(or(some, depths), 0x8000000000000000800000000000000080000000000000008000000000000000)))
            }
            count := mod(counts, 0xffffffffffffffff)
        }
    }

    function lanes(uint256 color) private pure returns (uint256) {
        return (color & 0xff) | ((color & 0xff00) << 48) | ((color & 0xff0000) << 96);
    }

    function laneStep(uint256 top, uint256 bottom, uint256 rows) private pure returns (uint256 step) {
        unchecked {
            for (uint256 i; i != 3; ++i) {
                int256 difference = int256((top >> (8 * i)) & 0xff) - int256((bottom >> (8 * i)) & 0xff);
                step += uint256((difference << 24) / int256(rows)) << (56 * i);
            }
        }
    }

    /// @dev Repeats the row before.
    function copyRow(uint256 row, uint256 rowBytes) private pure {
        assembly ("memory-safe") {
            mcopy(row, sub(row, rowBytes), rowBytes)
        }
    }

    /// @param color Lanes of bytes.
    function fillRow(uint256 row, uint256 rowBytes, uint256 color) private pure {
        assembly ("memory-safe") {
            // b g r b g r ...: 32 bytes hold ten pixels and two thirds
            color := shr(232, mul(color, 0x100000000000000010000000000000001000000000000000000000000000000))
            let word := or(mul(shl(16, color), 0x1000001000001000001000001000001000001000001000001000001), shr(8, color))
            mstore(row, word)
            mstore(add(row, 32), or(shl(248, color), shr(8, word)))
            mstore(add(row, 64), or(shl(240, color), shr(16, word)))
            let done := 96
            for {} lt(done, rowBytes) { done := shl(1, done) } { mcopy(add(row, done), row, done) }
        }
    }
}
