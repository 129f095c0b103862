// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Base64} from "../encode/Base64.sol";
import {Text} from "../encode/Text.sol";
import {Crc32} from "./Crc32.sol";
import {PngCode} from "./PngCode.sol";
import {StudioErrors} from "./StudioErrors.sol";

/// @notice PNG files of the renderer's bitmaps, each pixel a square of up to 8 x 8, so that it stays crisp wherever pictures are smoothed.
/// @dev Source: PNG (W3C), RFC 1950 (zlib), RFC 1951 (deflate).
///
/// The first row of each square holds the pixels themselves (filter None), the others are like the row above (filter Up): zeros. A pixel
/// is written as its three bytes and a match that repeats them until another one comes. All bytes have codes of nine bits, so that eight
/// pixels can be made of a word at once; matches are looked up: see `PngCode`. One code, fitted to pictures of this renderer, does for all.
library Png {
    uint256 internal constant MAX_SCALE = 8;
    uint256 private constant BMP_HEADER = 54;
    /// @dev Where in the bytes of the result, counted with the word of their length, the compressed data begin: behind the signature
    /// (8 bytes), the chunk IHDR (25), the head of the chunk IDAT (8) and that of zlib (2).
    uint256 private constant DATA = 75;
    /// @dev The filter of rows that are as the row above.
    uint256 private constant UP = 2;
    /// @dev The largest prime below 2^16, for the checksum Adler-32.
    uint256 private constant ADLER = 65521;
    /// @dev Rows are divided into parts of so many pixels, each of which begins with a pixel that is written.
    uint256 private constant PART = 256;
    /// @dev Where a pixel and the match of the rest of its square have so many bits, eight pixels of which so many are not like those at
    /// their left are all written.
    uint256 private constant GROUP_SIZE = 32;
    uint256 private constant MANY = 4;
    /// @dev As many longest matches are written at once.
    uint256 private constant LONGEST_MANY = 32;

    /// @dev What has been written so far.
    /// @param target Where the next byte belongs.
    /// @param count How many of its bits are there already, 0..7. The others are zeros.
    /// @param gaps Codes, 48 bytes apart: of a pixel of zeros and the match of it up to 0, 1, 2, ... pixels farther. In the lowest byte
    /// the number of bits, of which the first is uppermost.
    struct Stream {
        uint256 target;
        uint256 count;
        uint256 gaps;
    }

    /// @notice A PNG file of a bitmap.
    /// @param bmp 24 bits a pixel, as the renderer makes it.
    /// @param scale How many pixels each becomes in both directions, 1..8.
    function encode(bytes memory bmp, uint256 scale) internal pure returns (bytes memory png) {
        unchecked {
            (uint256 width, uint256 height) = sizeOf(bmp);
            if (scale == 0 || scale > MAX_SCALE) revert StudioErrors.PixelScaleOutOfRange(scale, MAX_SCALE);
            Stream memory stream;
            bytes memory tables = PngCode.tables();
            bytes memory header = PngCode.header();
            Rows memory rows = Rows(bmp, tables, 0, width, height, scale);
            Above memory above = aboveOf(rows);
            writeGaps(stream, tables, width < PART ? width : PART, scale);
            uint256 row;
            assembly ("memory-safe") {
                // room for a row, with a word before it and two words behind it
                row := add(mload(0x40), 32)
                png := add(row, and(add(mul(3, width), 95), not(31)))
                // signature; 13 bytes in the chunk IHDR: the sides, 8 bits for each of three channels; the chunk IDAT, and the head of zlib
                let sides := or(shl(32, mul(width, scale)), mul(height, scale))
                mstore(add(png, 32), or(or(shl(128, 0x89504e470d0a1a0a0000000d49484452), shl(64, sides)), shl(24, 0x0802000000)))
                mstore(add(png, 64), shl(168, 0x0000000000494441547801))
                let target := add(png, DATA)
                mcopy(target, add(header, 32), mload(header))
                target := add(target, mload(header))
                mstore(target, 0)
                mstore(stream, target)
            }
            (uint256 rest, uint256 restSize) = PngCode.headerRest();
            put(stream, rest << (256 - restSize), restSize);
            rows.row = row;
            (uint256 second, uint256 first) = writeRows(stream, rows, above);
            finish(png, stream, second, first);
            writeSums(png);
        }
    }

    /// @notice A PNG file of a bitmap as a `data:` URI.
    function dataURI(bytes memory bmp, uint256 scale) internal pure returns (string memory uri) {
        unchecked {
            // this stands before the file, since zeros are written behind that
            string memory prefix = "data:image/png;base64,";
            bytes memory png = encode(bmp, scale);
            uint256 file;
            uint256 begin;
            assembly ("memory-safe") {
                file := add(png, 32)
                // the encoder needs zeros behind the file
                mstore(add(file, mload(png)), 0)
                uri := add(mload(0x40), 32)
                begin := add(uri, 32)
            }
            uint256 end = Base64.encode(file, png.length, Text.write(begin, prefix));
            assembly ("memory-safe") {
                mstore(uri, sub(end, begin))
                mstore(end, 0)
                mstore(0x40, and(add(end, 63), not(31)))
            }
        }
    }

    /// @dev The sides of a bitmap in pixels, each 1..65535.
    function sizeOf(bytes memory bmp) private pure returns (uint256 width, uint256 height) {
        unchecked {
            if (bmp.length < BMP_HEADER) revert StudioErrors.NotABitmap();
            uint256 kind;
            uint256 planesAndBits;
            assembly ("memory-safe") {
                kind := shr(240, mload(add(bmp, 32)))
                // bytes 18 to 21 and 22 to 25 are the sides, the lowest byte first
                let sides := mload(add(bmp, 50))
                width := or(byte(0, sides), shl(8, byte(1, sides)))
                height := or(byte(4, sides), shl(8, byte(5, sides)))
                planesAndBits := and(shr(160, sides), 0xffffffff)
            }
            bool known = kind == 0x424d && planesAndBits == 0x01001800 && width != 0 && height != 0;
            if (!known || bmp.length != BMP_HEADER + strideOf(width) * height) revert StudioErrors.NotABitmap();
        }
    }

    /// @dev Bytes of a row of a bitmap.
    function strideOf(uint256 width) private pure returns (uint256) {
        unchecked {
            return (3 * width + 3) & ~uint256(3);
        }
    }

    struct Rows {
        bytes bmp;
        bytes tables;
        uint256 row;
        uint256 width;
        uint256 height;
        uint256 scale;
    }

    /// @dev Finds the codes of pixels and of matches of them up to `width` pixels farther.
    function writeGaps(Stream memory stream, bytes memory tables, uint256 width, uint256 scale) private pure {
        unchecked {
            uint256 gaps;
            assembly ("memory-safe") {
                gaps := mload(0x40)
                mstore(0x40, add(gaps, mul(48, add(width, 1))))
            }
            stream.gaps = gaps;
            for (uint256 gap = 1; gap <= width; ++gap) {
                (uint256 text, uint256 size) = matchCode(tables, 3 * scale * gap - 3);
                assembly ("memory-safe") {
                    gaps := add(gaps, 48)
                }
                uint256 entry = (PngCode.LITERALS << 229) | (text << (229 - size)) | (27 + size);
                assembly ("memory-safe") {
                    mstore(gaps, entry)
                }
            }
        }
    }

    /// @dev The code of a match of up to 32 times the longest length at the distance of a pixel, and its bits.
    function matchCode(bytes memory tables, uint256 length) private pure returns (uint256 text, uint256 size) {
        unchecked {
            if (length == 0) return (0, 0);
            uint256 longest = PngCode.LONGEST_SIZE * ((length - 3) / 258);
            assembly ("memory-safe") {
                text := shr(232, mload(add(add(tables, 32), mul(3, mod(sub(length, 3), 258)))))
            }
            size = text & 31;
            text = (text >> 5) | ((PngCode.LONGEST & ((1 << longest) - 1)) << size);
            size += longest;
        }
    }

    /// @return second What the bytes before compression add to Adler-32: its second sum.
    /// @return first Its first sum.
    function writeRows(Stream memory stream, Rows memory rows, Above memory above) private pure returns (uint256 second, uint256 first) {
        unchecked {
            uint256 scale = rows.scale;
            uint256 rowSize = 1 + 3 * rows.width * scale;
            // bytes that are not written yet
            uint256 rest = rowSize * rows.height * scale;
            uint256 stride = strideOf(rows.width);
            uint256 source;
            {
                bytes memory bmp = rows.bmp;
                uint256 height = rows.height;
                assembly ("memory-safe") {
                    // bitmaps begin with the lowest row
                    source := add(add(add(bmp, 32), BMP_HEADER), mul(stride, height))
                }
            }
            second = rest;
            first = 1;
            for (uint256 y = rows.height; y != 0; --y) {
                source -= stride;
                put(stream, PngCode.LITERAL << 247, 9);
                {
                    uint256 row = rows.row;
                    uint256 size = 3 * rows.width;
                    assembly ("memory-safe") {
                        mcopy(row, source, size)
                        // eight more pixels like the last one
                        let end := add(row, size)
                        mstore(end, shl(64, mul(shr(232, mload(sub(end, 3))), 0x000001000001000001000001000001000001000001000001)))
                    }
                }
                (uint256 sum, uint256 less) = writeParts(stream, rows);
                second += scale * ((rest - 1) * sum - less) - 3 * (scale * (scale - 1) / 2) * sum;
                first += scale * sum;
                for (uint256 copies = scale - 1; copies != 0;) copies -= putAbove(stream, above, copies);
                second += UP * ((scale - 1) * rest - rowSize * (scale * (scale - 1) / 2));
                first += UP * (scale - 1);
                rest -= rowSize * scale;
            }
        }
    }

    /// @dev Writes the pixels of a row.
    /// @return sum Of their bytes.
    /// @return less Of their bytes, each times the first of its places in the row as it is written.
    function writeParts(Stream memory stream, Rows memory rows) private pure returns (uint256 sum, uint256 less) {
        unchecked {
            uint256 scale = rows.scale;
            uint256 width = rows.width;
            uint256 many = GROUP_SIZE;
            {
                uint256 gaps = stream.gaps;
                assembly ("memory-safe") {
                    if eq(and(mload(add(gaps, 48)), 0xff), GROUP_SIZE) { many := sub(MANY, 1) }
                }
            }
            uint256 rowAt = rows.row;
            for (uint256 x; x < width; x += PART) {
                uint256 size = width - x < PART ? width - x : PART;
                (uint256 lanes, uint256 totals, uint256 channels) = writePart(stream, rowAt + 3 * x, rowAt + 3 * (x + size), many);
                uint256 blocks = (size + 7) / 8;
                uint256 all = lanes % 0xffffff;
                uint256 steps;
                assembly ("memory-safe") {
                    // each times its place, 0 to 7
                    steps := and(shr(168, mul(lanes, 0x000007000006000005000004000003000002000001000000)), 0xffffff)
                }
                steps += 8 * (blocks * all - totals % 0xffffff);
                channels %= 0xffffff;
                // pixels behind the end of the row
                uint256 more = 8 * blocks - size;
                if (more != 0) {
                    uint256 pixel;
                    assembly ("memory-safe") {
                        pixel := shr(232, mload(add(rowAt, mul(3, sub(width, 1)))))
                    }
                    uint256 bytesOf = (pixel >> 16) + ((pixel >> 8) & 0xff) + (pixel & 0xff);
                    all -= more * bytesOf;
                    steps -= bytesOf * (more * (size + 8 * blocks - 1) / 2);
                    channels -= more * (((pixel >> 8) & 0xff) + 2 * (pixel >> 16));
                }
                sum += all;
                less += 3 * scale * (x * all + steps) + channels;
            }
        }
    }

    /// @dev Writes the pixels of a part of a row.
    /// @param first Its first pixel. What is before it may change.
    /// @param end Behind its last one; up to seven pixels more must be like that.
    /// @param many Where more of eight pixels than this are not like those at their left, all are written.
    /// @return lanes Sums of red, green and blue of each eighth pixel.
    /// @return totals Sums of these sums after each eight pixels.
    /// @return channels Of each eighth pixel, sums of green and twice blue.
    function writePart(Stream memory stream, uint256 first, uint256 end, uint256 many)
        private
        pure
        returns (uint256 lanes, uint256 totals, uint256 channels)
    {
        assembly ("memory-safe") {
            function write(target, count, pixel, code) -> newTarget, newCount {
                // blue, green and red, of eight bits each, to red, green and blue of nine
                let text := shr(232, mload(pixel))
                text := or(or(shl(247, and(text, 0xff)), and(shl(230, text), 0x003fc00000000000000000000000000000000000000000000000000000000000)), shl(229, shr(16, text)))
                mstore(target, or(and(mload(target), shl(248, 0xff)), shr(count, add(text, code))))
                newCount := add(count, and(code, 0xff))
                newTarget := add(target, shr(3, newCount))
                newCount := and(newCount, 7)
            }

            let target := mload(stream)
            let count := mload(add(stream, 0x20))
            let gaps := mload(add(stream, 0x40))
            // the pixel that is to be written next, when it is known how far it goes
            let last := first
            mcopy(sub(first, 3), first, 3)
            for {} lt(first, end) { first := add(first, 24) } {
                let pixels := mload(first)
                let change := xor(pixels, mload(sub(first, 3)))
                {
                    let blue := and(shr(80, pixels), 0x00000000000000000000ff0000ff0000ff0000ff0000ff0000ff0000ff0000ff)
                    let green := and(shr(72, pixels), 0x00000000000000000000ff0000ff0000ff0000ff0000ff0000ff0000ff0000ff)
                    channels := add(channels, add(green, add(blue, blue)))
                    lanes := add(lanes, add(add(blue, green), and(shr(64, pixels), 0x00000000000000000000ff0000ff0000ff0000ff0000ff0000ff0000ff0000ff)))
                    totals := add(totals, lanes)
                }
                if iszero(shr(64, change)) { continue }
                // how many pixels change
                let changed := shr(64, or(change, or(shr(8, change), shr(16, change))))
                changed := add(and(changed, 0x00000000000000000000ff0000ff0000ff0000ff0000ff0000ff0000ff0000ff), 0x00000000000000000000ff0000ff0000ff0000ff0000ff0000ff0000ff0000ff)
                changed := mod(and(shr(8, changed), 0x0000000000000000000001000001000001000001000001000001000001000001), 0xffffff)
                if gt(mul(changed, lt(first, sub(end, 23))), many) {
                    if xor(first, last) { target, count := write(target, count, last, mload(add(gaps, shl(4, sub(first, last))))) }
                    // red, green and blue, from 24 bits to 32 bits
                    pixels := shr(64, pixels)
                    pixels := or(or(shl(16, and(pixels, 0x00000000000000000000ff0000ff0000ff0000ff0000ff0000ff0000ff0000ff)), and(pixels, 0x000000000000000000ff0000ff0000ff0000ff0000ff0000ff0000ff0000ff00)), and(shr(16, pixels), 0x00000000000000000000ff0000ff0000ff0000ff0000ff0000ff0000ff0000ff))
                    pixels := or(and(pixels, 0x0000000000000000000000000000000000000000ffffffffffffffffffffffff), shl(32, and(pixels, 0x0000000000000000ffffffffffffffffffffffff000000000000000000000000)))
                    pixels := or(and(pixels, 0x00000000000000000000ffffffffffff00000000000000000000ffffffffffff), shl(16, and(pixels, 0x00000000ffffffffffff00000000000000000000ffffffffffff000000000000)))
                    pixels := or(and(pixels, 0x0000000000ffffff0000000000ffffff0000000000ffffff0000000000ffffff), shl(8, and(pixels, 0x0000ffffff0000000000ffffff0000000000ffffff0000000000ffffff000000)))
                    pixels := shl(5, pixels)
                    pixels := add(pixels, and(pixels, 0x1fffe0001fffe0001fffe0001fffe0001fffe0001fffe0001fffe0001fffe000))
                    pixels := add(pixels, and(pixels, 0x3fc000003fc000003fc000003fc000003fc000003fc000003fc000003fc00000))
                    pixels := add(pixels, mul(shr(224, mload(add(gaps, 48))), 0x0000000100000001000000010000000100000001000000010000000100000001))
                    // all but the last one, of which it is not known yet how far it goes
                    mstore(target, or(and(mload(target), shl(248, 0xff)), shr(count, and(pixels, not(0xffffffff)))))
                    target := add(target, 28)
                    last := add(first, 21)
                    continue
                }
                change := and(change, not(0xffffffffffffffff))
                for { let place := first } change {
                    change := shl(24, change)
                    place := add(place, 3)
                } {
                    if shr(232, change) {
                        target, count := write(target, count, last, mload(add(gaps, shl(4, sub(place, last)))))
                        last := place
                    }
                }
            }
            target, count := write(target, count, last, mload(add(gaps, shl(4, sub(end, last)))))
            mstore(stream, target)
            mstore(add(stream, 0x20), count)
        }
    }

    /// @dev As many rows like the row above as fit a word, or what one begins with.
    struct Above {
        uint256 text;
        uint256 size;
        uint256 copies;
        uint256 longest;
    }

    function aboveOf(Rows memory rows) private pure returns (Above memory above) {
        unchecked {
            uint256 zeros = 3 * rows.width * rows.scale - 1;
            // after the filter and the first zero, matches at the distance of a byte
            uint256 longest = (zeros - 3) / 258;
            uint256 last = 3 + (zeros - 3) % 258;
            (uint256 text, uint256 size) = matchCode(rows.tables, last);
            text ^= last > 258 ? PngCode.OTHER_DISTANCES : 1;
            above.longest = longest / LONGEST_MANY;
            longest = PngCode.LONGEST_SIZE * (longest % LONGEST_MANY);
            text |= (PngCode.LONGEST_ZEROS & ((1 << longest) - 1)) << size;
            size += longest;
            text |= (((PngCode.LITERAL + UP) << 9) | PngCode.LITERAL) << size;
            size += 18;
            above.size = size;
            uint256 copies = above.longest == 0 ? rows.scale - 1 : 1;
            for (; size * (above.copies + 1) <= 248 && above.copies < copies; ++above.copies) {
                above.text |= text << (256 - size * (above.copies + 1));
            }
        }
    }

    /// @dev Writes some rows like the row above.
    /// @return How many, at most as many as are wanted.
    function putAbove(Stream memory stream, Above memory above, uint256 wanted) private pure returns (uint256) {
        unchecked {
            uint256 size = above.size;
            if (above.longest != 0) {
                put(stream, (above.text >> 238) << 238, 18);
                for (uint256 k = above.longest; k != 0; --k) {
                    put(stream, PngCode.LONGEST_ZEROS << (256 - PngCode.LONGEST_SIZE * LONGEST_MANY), PngCode.LONGEST_SIZE * LONGEST_MANY);
                }
                put(stream, above.text << 18, size - 18);
                return 1;
            }
            uint256 copies = wanted < above.copies ? wanted : above.copies;
            put(stream, above.text & ~(type(uint256).max >> (size * copies)), size * copies);
            return copies;
        }
    }

    /// @dev Writes up to 248 bits, the first of which is uppermost.
    function put(Stream memory stream, uint256 text, uint256 size) private pure {
        assembly ("memory-safe") {
            let target := mload(stream)
            let count := mload(add(stream, 0x20))
            mstore(target, or(and(mload(target), shl(248, 0xff)), shr(count, text)))
            count := add(count, size)
            mstore(stream, add(target, shr(3, count)))
            mstore(add(stream, 0x20), and(count, 7))
        }
    }

    /// @dev Ends the block, turns the bits of each byte to the order of deflate, and adds the checksum Adler-32. After that the
    /// length of the file is right, and its last twelve bytes are free.
    function finish(bytes memory png, Stream memory stream, uint256 second, uint256 first) private pure {
        unchecked {
            (uint256 end, uint256 endSize) = PngCode.end();
            put(stream, end << (256 - endSize), endSize);
            second %= ADLER;
            first %= ADLER;
            assembly ("memory-safe") {
                let target := add(mload(stream), iszero(iszero(mload(add(stream, 0x20)))))
                for { let place := add(png, DATA) } lt(place, target) { place := add(place, 32) } {
                    let word := mload(place)
                    word := or(and(shr(4, word), 0x0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f), shl(4, and(word, 0x0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f)))
                    word := or(and(shr(2, word), 0x3333333333333333333333333333333333333333333333333333333333333333), shl(2, and(word, 0x3333333333333333333333333333333333333333333333333333333333333333)))
                    word := or(and(shr(1, word), 0x5555555555555555555555555555555555555555555555555555555555555555), shl(1, and(word, 0x5555555555555555555555555555555555555555555555555555555555555555)))
                    mstore(place, word)
                }
                mstore(target, shl(224, or(shl(16, second), first)))
                // the sum of this chunk (4 bytes), and the chunk IEND (12 bytes)
                target := add(target, 20)
                mstore(png, sub(target, add(png, 32)))
                mstore(0x40, and(add(target, 31), not(31)))
            }
        }
    }

    /// @dev Fills in the size of the data and the sums of the chunks, and adds the chunk IEND.
    function writeSums(bytes memory png) private pure {
        unchecked {
            uint256 file;
            uint256 end;
            assembly ("memory-safe") {
                file := add(png, 32)
                end := add(file, mload(png))
            }
            write32(file + 29, Crc32.sum(file + 12, 17));
            write32(file + 33, end - file - 57);
            write32(end - 16, Crc32.sum(file + 37, end - file - 53));
            write32(end - 12, 0);
            write32(end - 8, 0x49454e44);
            write32(end - 4, 0xae426082);
        }
    }

    function write32(uint256 target, uint256 value) private pure {
        assembly ("memory-safe") {
            mstore(target, or(shr(32, shl(32, mload(target))), shl(224, value)))
        }
    }
}
