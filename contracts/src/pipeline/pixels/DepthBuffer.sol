// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Rectangle} from "../../scene/Scene.sol";
import {Compositor, OVERHANG} from "../Compositor.sol";
import {Pipeline} from "../Pipeline.sol";
import {PixelRasterizer} from "./PixelRasterizer.sol";
import "../../words/Registers.sol";

// Stores the depths of `fill` of picture.py.
// The depth buffer of a band: 8 bytes for each pixel, rows as in the picture.
abstract contract DepthBuffer is Pipeline, PixelRasterizer {
    function openPicture(Rectangle memory tile, uint256 image, uint256 bandRows, uint256[3][] memory)
        internal pure override returns (uint256 size)
    {
        unchecked {
            // at the end of memory, where untouched memory costs nothing; depths are read as whole words, of which 8 bytes count; their
            // addresses are multiples of 8
            uint256 depth = (image + 3 * tile.width * (tile.height + 1) + OVERHANG + 31) & ~uint256(31);
            store(DEPTHS, depth);
            setFreeMemory(depth + 8 * bandRows * tile.width + 32);
            uint256 all = depth + 8 * tile.width * tile.height - image;
            if (load(DRAWN_BEFORE) == 0) {
                Compositor.background(image, tile);
            } else {
                copyCalldata(image, load(DRAWN_BEFORE), all);
            }
            return load(RETURNS_DEPTHS) == 0 ? 3 * tile.width * tile.height : all;
        }
    }

    function openBand(Rectangle memory tile, uint256 image, uint256 top, uint256 bottom) internal pure override {
        unchecked {
            uint256 depth = load(DEPTHS);
            store(DEPTH_ORIGIN, depth + 8 * ((load(BAND_BOTTOM) - 1) * tile.width - tile.x - PIXEL_BIAS));
            store(IMAGE_ORIGIN, image + 3 * (tile.height - bottom) * tile.width - 3 * (depth >> 3));
            // the memory of the first band is still untouched
            if (bottom != tile.height) {
                // including the word behind, since depths are read as whole words
                uint256 size = 8 * (bottom - top) * tile.width + 32;
                assembly ("memory-safe") {
                    // calldata reads as zero beyond its end
                    calldatacopy(depth, calldatasize(), size)
                }
            }
        }
    }

    /// @dev Pixels are written directly.
    function closeBand() internal pure override {}

    function litPixels(uint256 bandRows) internal pure override returns (uint256) {
        unchecked {
            uint256 depth = load(DEPTHS);
            return Compositor.litPixels(depth, depth + 8 * bandRows * load(TILE_WIDTH));
        }
    }
}
