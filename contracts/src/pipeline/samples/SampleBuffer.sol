// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Rectangle} from "../../scene/Scene.sol";
import {Compositor, OVERHANG} from "../Compositor.sol";
import {BAND_PIXELS, Pipeline} from "../Pipeline.sol";
import {max, min} from "../geometry/Screen.sol";
import {SampleRasterizer} from "./SampleRasterizer.sol";
import "../../words/SampleRegisters.sol";

// Stores the samples of `draw` of picture.py, and computes their mean.
// A word of four samples for each pixel of a band, rows as in the picture. Only the columns and rows reached by objects are stored, since
// memory cost grows quadratically.
//
// The pixels passed to the next engine are followed by the bounds of these columns and rows, four words, and the samples.

/// @dev The number of pixels beyond the outermost vertices that lines and samples may touch.
uint256 constant MARGIN = 2;
uint256 constant BORDERS_SIZE = 0x80;
/// @dev Moves the column of a screen word to the top.
uint256 constant COLUMN_TO_TOP = 172;
/// @dev With fewer faces, two bands are cheaper than one with twice the samples: the price of memory is quadratic.
uint256 constant FEW_FACES = 160;

abstract contract SampleBuffer is Pipeline, SampleRasterizer {
    function registersEnd() internal pure virtual override returns (uint256) {
        return SAMPLE_REGISTERS_END;
    }

    function bandPixels() internal pure override returns (uint256) {
        unchecked {
            // engines hand on the samples of whole pictures; more objects have more faces
            if (load(DRAWN_BEFORE) | load(RETURNS_DEPTHS) != 0 || load(OBJECT_COUNT) != 1) return BAND_PIXELS;
            return loadCalldata(load(OBJECTS) + MESH_FACE_COUNT - OBJECT_BYTES) < FEW_FACES ? BAND_PIXELS / 2 : BAND_PIXELS;
        }
    }

    function openPicture(Rectangle memory tile, uint256 image, uint256, uint256[3][] memory lists)
        internal pure override returns (uint256 size)
    {
        unchecked {
            uint256 borders = (image + 3 * tile.width * tile.height + OVERHANG + 31) & ~uint256(31);
            uint256 before = load(DRAWN_BEFORE);
            setBorders(tile, lists);
            if (before == 0) {
                Compositor.background(image, tile);
            } else {
                copyCalldata(image, before, borders - image);
                uint256 old = borders - image + before;
                store(SAMPLE_BEGIN, min(load(SAMPLE_BEGIN), loadCalldata(old)));
                store(SAMPLE_END, max(load(SAMPLE_END), loadCalldata(old + 0x20)));
                store(SAMPLE_TOP, min(load(SAMPLE_TOP), loadCalldata(old + 0x40)));
                store(SAMPLE_BOTTOM, max(load(SAMPLE_BOTTOM), loadCalldata(old + 0x60)));
            }
            if (load(SAMPLE_BEGIN) > load(SAMPLE_END)) store(SAMPLE_BEGIN, load(SAMPLE_END));
            if (load(SAMPLE_TOP) > load(SAMPLE_BOTTOM)) store(SAMPLE_TOP, load(SAMPLE_BOTTOM));
            assembly ("memory-safe") {
                mcopy(borders, SAMPLE_BEGIN, BORDERS_SIZE)
            }
            store(DEPTHS, borders + BORDERS_SIZE);
            uint256 stride = (load(SAMPLE_END) - load(SAMPLE_BEGIN)) << SAMPLE_SIZE_BITS;
            store(SAMPLE_STRIDE, stride);
            store(STRIDE_37, stride << ADDRESS_FRACTION);
            store(DEPTH_BASE, load(SAMPLE_BASE) * load(SAMPLE_SCALE));
            store(ROW_IMAGE_STEP, 3 * tile.width - 3 * (stride >> SAMPLE_SIZE_BITS));
            if (load(RETURNS_DEPTHS) == 0) return 3 * tile.width * tile.height;
            return borders + BORDERS_SIZE + stride * (load(SAMPLE_BOTTOM) - load(SAMPLE_TOP)) - image;
        }
    }

    function openBand(Rectangle memory tile, uint256 image, uint256, uint256) internal pure override {
        unchecked {
            uint256 stride = load(SAMPLE_STRIDE);
            uint256 samples = load(DEPTHS);
            // the row after the last row that has samples
            uint256 row = min(load(BAND_BOTTOM), load(SAMPLE_BOTTOM));
            uint256 origin = samples + (row - 1) * stride;
            store(SAMPLE_ORIGIN, origin - (load(SAMPLE_BEGIN) << SAMPLE_SIZE_BITS));
            store(SAMPLE_IMAGE, image + 3 * ((tile.y + tile.height - 1 + PIXEL_BIAS) * tile.width - tile.x - PIXEL_BIAS));
            store(ROW_IMAGE_0, load(SAMPLE_IMAGE) - 3 * uint256(loadSigned(SAMPLE_ORIGIN) >> SAMPLE_SIZE_BITS));
            store(MIXED, samples);
            store(MIXED_END, samples);
            uint256 top = max(load(BAND_TOP), load(SAMPLE_TOP));
            if (row <= top || stride == 0) return;
            store(MIXED, samples + (row - top) * stride);
            store(MIXED_END, load(MIXED));
            clear(tile, samples, row, (row - top) * stride);
            uint256 before = load(DRAWN_BEFORE);
            if (before != 0) copySamples(before + samples - BORDERS_SIZE - image, origin);
        }
    }

    /// @dev Fills samples with the background.
    /// @param row The row after the one at `samples`; rows go upward.
    function clear(Rectangle memory tile, uint256 samples, uint256 row, uint256 size) private pure {
        unchecked {
            uint256 stride = load(SAMPLE_STRIDE);
            uint256 end = samples + size;
            uint256 color = load(BACKGROUND) + load(BACKGROUND_STEP) * (tile.y + tile.height + PIXEL_BIAS - row);
            uint256 step = load(BACKGROUND_STEP);
            assembly ("memory-safe") {
                // not a valid colour
                let last := ONE_24
                for {} lt(samples, end) { samples := add(samples, stride) } {
                    let rounded := and(shr(Q24, color), BYTES_56) // whole levels
                    color := add(color, step)
                    if eq(rounded, last) {
                        mcopy(samples, sub(samples, stride), stride) // as the row before
                        continue
                    }
                    last := rounded
                    mstore(samples, mul(shr(PIXEL_AT, mul(rounded, LANES_TO_PIXEL)), ONES_64)) // 0xBBGGRR in each sample
                    let done := SAMPLE_SIZE
                    for {} lt(shl(1, done), stride) { done := shl(1, done) } { mcopy(add(samples, done), samples, done) } // doubles
                    mcopy(add(samples, done), samples, sub(stride, done)) // the rest
                }
            }
        }
    }

    /// @dev Copies the samples drawn before. There is only one band in this case.
    /// @param position The calldata offset of their bounds.
    /// @param origin The address of the samples of row 0 in the first column that has samples.
    function copySamples(uint256 position, uint256 origin) private pure {
        unchecked {
            uint256 stride = load(SAMPLE_STRIDE);
            uint256 begin = loadCalldata(position);
            uint256 size = (loadCalldata(position + 0x20) - begin) << SAMPLE_SIZE_BITS;
            uint256 top = loadCalldata(position + 0x40);
            uint256 row = loadCalldata(position + 0x60);
            uint256 target = origin - row * stride + stride + ((begin - load(SAMPLE_BEGIN)) << SAMPLE_SIZE_BITS);
            position += BORDERS_SIZE;
            for (; row != top; --row) {
                copyCalldata(target, position, size);
                position += size;
                target += stride;
            }
        }
    }

    /// @dev Sets the columns and rows of the tile that the vertices reach; all of them if any vertex is clipped.
    function setBorders(Rectangle memory tile, uint256[3][] memory lists) private pure {
        unchecked {
            // of rows and of columns: the minimum, and the maximum minus it, for a single test of most vertices
            uint256 least = type(uint256).max;
            uint256 rows = 1;
            uint256 left = least;
            uint256 columns = 1;
            // of any vertex
            uint256 flags;
            uint256 uniforms = load(OBJECTS);
            for (uint256 i; i != lists.length; ++i) {
                uniforms = readObject(uniforms);
                uint256 size = 1 << recordShift(load(OBJECT_MODE));
                uint256 record = lists[i][0];
                uint256 end = record + size * load(MESH_VERTEX_COUNT);
                assembly ("memory-safe") {
                    for {} lt(record, end) { record := add(record, size) } {
                        let word := mload(record)
                        flags := or(flags, word)
                        if gt(sub(word, least), rows) { // words compare like rows
                            rows := add(least, rows) // rows: the maximum
                            if lt(word, least) { least := word }
                            if gt(word, rows) { rows := word }
                            rows := sub(rows, least)
                        }
                        word := shl(COLUMN_TO_TOP, word) // now like columns
                        if gt(sub(word, left), columns) {
                            columns := add(left, columns) // columns: the maximum
                            if lt(word, left) { left := word }
                            if gt(word, columns) { columns := word }
                            columns := sub(columns, left)
                        }
                    }
                }
            }
            uint256 begin = load(COLUMN_BEGIN);
            uint256 top = tile.y + PIXEL_BIAS;
            store(SAMPLE_BEGIN, begin);
            store(SAMPLE_END, load(COLUMN_END));
            store(SAMPLE_TOP, top);
            store(SAMPLE_BOTTOM, top + tile.height);
            if (flags & MUST_CLIP != 0) return;
            if (flags == 0) {
                // nothing to draw
                store(SAMPLE_END, begin);
                store(SAMPLE_BOTTOM, top);
                return;
            }
            uint256 right = (left + columns) >> (COLUMN_TO_TOP + SCREEN_COLUMN_AT + SUBPIXEL_BITS);
            left >>= COLUMN_TO_TOP + SCREEN_COLUMN_AT + SUBPIXEL_BITS;
            store(SAMPLE_BEGIN, max(begin, left < MARGIN ? 0 : left - MARGIN));
            store(SAMPLE_END, min(load(COLUMN_END), right + MARGIN + 1));
            uint256 bottom = (least + rows) >> SCREEN_PIXEL_ROW_AT;
            least >>= SCREEN_PIXEL_ROW_AT;
            store(SAMPLE_TOP, max(top, least < MARGIN ? 0 : least - MARGIN));
            store(SAMPLE_BOTTOM, min(top + tile.height, bottom + MARGIN + 1));
        }
    }

    /// @dev Writes the means of the pixels whose samples differ.
    function closeBand() internal pure override {
        assembly ("memory-safe") {
            let end := mload(MIXED_END)
            for { let entry := mload(MIXED) } lt(entry, end) { entry := add(entry, MIXED_SIZE) } {
                let p := mload(entry)
                let samples := mload(shr(MIXED_AT, p))
                // sums in the top lane: red lowest, blue at bit 16, green at bit 32
                samples := mul(or(and(samples, RED_BLUE_64), shl(GREEN_OF_SUM, and(samples, GREEN_64))), ONES_64)
                samples := and(add(samples, ROUND_SUM), MEAN_OF_SUM) // + 2; the bits above the last two are the mean
                mstore(0, mul(samples, SUM_TO_TOP)) // blue, green, red
                mcopy(and(shr(MIXED_PIXEL_AT, p), MIXED_PIXEL_MASK), 0, 3)
            }
            if mload(RETURNS_DEPTHS) {
                // the next engine has a list of its own
                for { let entry := mload(MIXED) } lt(entry, end) { entry := add(entry, MIXED_SIZE) } {
                    let p := shr(MIXED_AT, mload(entry))
                    mstore(p, and(mload(p), not(IS_LISTED)))
                }
            }
        }
    }

    function litPixels(uint256) internal pure override returns (uint256 count) {
        unchecked {
            uint256 p = load(DEPTHS);
            uint256 bottom = min(load(BAND_BOTTOM), load(SAMPLE_BOTTOM));
            uint256 top = max(load(BAND_TOP), load(SAMPLE_TOP));
            uint256 end = p + (bottom - top) * load(SAMPLE_STRIDE);
            assembly ("memory-safe") {
                // signed: none if there are no such rows
                for {} slt(p, end) { p := add(p, SAMPLE_SIZE) } { count := add(count, iszero(iszero(and(mload(p), SAMPLE_DEPTHS)))) }
            }
        }
    }
}
