// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Rectangle} from "../scene/Scene.sol";
import "../words/Registers.sol";

// Computes the background, the blending and the last step of `draw` of picture.py.
// The background, blending, and the final operations on all pixels.

/// @dev The background may write this many bytes beyond its end: less than one more row, or 96 bytes.
uint256 constant OVERHANG = 96;
/// @dev Just below 256, Q10.
int256 constant BRIGHTEST = 0x3ffff;

library Compositor {
    /// @notice Fills the pixels of a tile with the background; rows from the bottom, without padding.
    function background(uint256 image, Rectangle memory tile) internal pure {
        unchecked {
            uint256 rowBytes = 3 * tile.width;
            fillRows(image, rowBytes, image + rowBytes * tile.height, load(BACKGROUND), load(BACKGROUND_STEP));
        }
    }

    /// @dev Fills the rows from `row` (inclusive) to `end` (exclusive).
    /// @param color The colour of the first row in lanes of Q24; `step` is its change per row.
    function fillRows(uint256 row, uint256 rowBytes, uint256 end, uint256 color, uint256 step) private pure {
        assembly ("memory-safe") {
            // not a valid colour
            let last := ONE_24
            for {} lt(row, end) { row := add(row, rowBytes) } {
                let rounded := and(shr(Q24, color), BYTES_56)
                color := add(color, step)
                if eq(rounded, last) {
                    mcopy(row, sub(row, rowBytes), rowBytes) // as the row before
                    continue
                }
                last := rounded
                // b g r b g r ...: 32 bytes hold ten and two thirds pixels
                rounded := shr(PIXEL_AT, mul(rounded, LANES_TO_PIXEL)) // 0xBBGGRR
                let word := or(mul(shl(16, rounded), TEN_PIXELS), shr(8, rounded)) // ten pixels, and two bytes of the next
                mstore(row, word)
                mstore(add(row, 32), or(shl(248, rounded), shr(8, word))) // the last byte of that, and ten pixels, ...
                mstore(add(row, 64), or(shl(240, rounded), shr(16, word))) // the last two bytes, ten pixels
                for { let done := 96 } lt(done, rowBytes) { done := shl(1, done) } { mcopy(add(row, done), row, done) } // doubles it
            }
        }
    }

    /// @notice Returns a fragment blended over its pixel: color * OPACITY + behind * (1 - OPACITY).
    /// @param color Signed lanes of 85 bits, Q10; clamped to 0..255 first.
    /// @param pixel The address of the pixel.
    function over(uint256 color, uint256 pixel) internal pure returns (uint256 mixed) {
        unchecked {
            // blue, green and red at the top of the word
            uint256 behind = load(pixel);
            for (uint256 lane; lane != 3; ++lane) {
                int256 value = int256(color << LOWER_85_TO_TOP) >> LOWER_85_TO_TOP;
                // remove what the lane below has borrowed
                color = uint256(int256(color - uint256(value)) >> MIDDLE_85_AT);
                if (value < 0) value = 0;
                if (value > BRIGHTEST) value = BRIGHTEST;
                uint256 byte_ = (behind >> (248 - 8 * lane)) & 0xff;
                mixed |= ((uint256(value) * load(OPACITY) + (byte_ << Q10) * (ONE_24 - load(OPACITY))) >> Q24) << (MIDDLE_85_AT * lane);
            }
        }
    }

    /// @notice Replaces every byte v of `size` bytes with 255 - v.
    function invert(uint256 image, uint256 size) internal pure {
        assembly ("memory-safe") {
            let end := add(image, size)
            for {} lt(image, end) { image := add(image, 64) } {
                mstore(image, not(mload(image))) // 255 - v
                mstore(add(image, 32), not(mload(add(image, 32))))
            }
        }
    }

    /// @notice Returns the number of covered pixels in a depth buffer. Fragments never have the depth 0 of an empty buffer. The 24 bytes
    /// behind the end must be empty.
    function litPixels(uint256 depth, uint256 end) internal pure returns (uint256 count) {
        assembly ("memory-safe") {
            // four depths in a word; 1 or 0 for each, in separate lanes that are summed at the end
            let counts := 0
            for {} lt(depth, end) { depth := add(depth, 32) } {
                let depths := mload(depth) // four
                // the highest bit of a lane is set if any of its bits is set
                let some := add(and(depths, BELOW_TOPS_64), BELOW_TOPS_64)
                counts := add(counts, shr(TOP_64_AT, and(or(some, depths), TOPS_64))) // + 1 in each lane that is not 0
            }
            count := mod(counts, 0xffffffffffffffff)
        }
    }
}
