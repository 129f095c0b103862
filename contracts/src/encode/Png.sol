// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Strings} from "@openzeppelin/contracts/utils/Strings.sol";
import {Bmp} from "./Bmp.sol";
import {Crc32} from "./Crc32.sol";
import {DataUri} from "./DataUri.sol";
import {LITERALS, PngCode} from "./PngCode.sol";
import {PngErrors} from "../interfaces/PngErrors.sol";

/// @notice Encodes the renderer's bitmaps as PNG files. Each pixel becomes a square of up to 8 x 8 pixels, so that it remains sharp where
/// viewers smooth pictures.
/// @dev Sources: PNG (W3C), RFC 1950 (zlib), RFC 1951 (deflate).
///
/// The first row of each square contains the pixels themselves (filter None); the other rows equal the row above (filter Up): zeros. A
/// pixel is written as its three bytes and a match that repeats them until the next different pixel. All bytes have 9-bit codes, so that
/// eight pixels can be encoded in one word; the codes of matches are in a table: see `PngCode`. One Huffman code, fitted to pictures of
/// this renderer, is used for all.
library Png {
    uint256 internal constant MAX_SCALE = 8;
    string internal constant URI = "data:image/png;base64,";
    /// @dev The offset of the compressed data in the result, which begins with its length: after the signature (8 bytes), the IHDR chunk
    /// (25), the header of the IDAT chunk (8) and the zlib header (2).
    uint256 private constant DATA = 75;
    /// @dev The signature with the size and name of the IHDR chunk; the bytes after its width and height; its checksum, the size and name
    /// of the IDAT chunk and the zlib header, with checksum and size to be filled in later; the IEND chunk.
    uint256 private constant SIGNATURE_IHDR = 0x89504e470d0a1a0a0000000d49484452;
    uint256 private constant RGB_8 = 0x0802000000;
    uint256 internal constant RGBA_8 = 0x0806000000;
    uint256 private constant IDAT_ZLIB = 0x494441547801;
    uint256 private constant IEND = 0x49454e44;
    uint256 private constant IEND_SUM = 0xae426082;
    /// @dev The first two bytes of a bitmap; one plane of 24 bits per pixel.
    uint256 private constant BMP_KIND = 0x424d;
    uint256 private constant ONE_PLANE_24 = 0x01001800;
    /// @dev The filter of rows that equal the row above.
    uint256 internal constant UP = 2;
    /// @dev The largest prime below 2^16, for the checksum Adler-32.
    uint256 private constant ADLER = 65521;
    /// @dev The length in pixels of the parts of a row. Each part begins with a literal pixel.
    uint256 private constant PART = 256;
    /// @dev The code sizes of a byte and of a pixel, in bits.
    uint256 private constant LITERAL_SIZE = 9;
    uint256 private constant PIXEL_SIZE = 27;
    /// @dev If the match of the rest of a square has SHORT_MATCH bits, so that a pixel with it has 32, or if there is none, then eight
    /// pixels are all written as literals if at least MANY of them differ from their left neighbours.
    uint256 private constant SHORT_MATCH = 5;
    uint256 private constant MANY = 4;
    /// @dev The size of eight literal pixels in bits.
    uint256 private constant ALL_EIGHT = 216;
    /// @dev Mask of the uppermost bytes of eight pixels in the lower 24 bytes of a word.
    uint256 private constant BYTE_OF_PIXEL = 0x00000000000000000000ff0000ff0000ff0000ff0000ff0000ff0000ff0000ff;

    /// @dev The first byte of a word; and the green channel at the beginning of a word with nine bits per channel.
    uint256 private constant FIRST_BYTE = 0xff00000000000000000000000000000000000000000000000000000000000000;
    uint256 private constant GREEN_OF_9 = 0x003fc00000000000000000000000000000000000000000000000000000000000;
    /// @dev 1 in each of eight pixels of 24 bits.
    uint256 private constant EACH_PIXEL = 0x0000000000000000000001000001000001000001000001000001000001000001;
    /// @dev Masks of eight 24-bit pixels: the upper four; the upper two of each four; the upper one of each two.
    uint256 private constant UPPER_FOUR = 0x0000000000000000ffffffffffffffffffffffff000000000000000000000000;
    uint256 private constant UPPER_TWO = 0x00000000ffffffffffff00000000000000000000ffffffffffff000000000000;
    uint256 private constant UPPER_ONE = 0x0000ffffff0000000000ffffff0000000000ffffff0000000000ffffff000000;
    /// @dev Masks of eight 27-bit pixels in 32 bits each: the lower one of each two; after those have moved up, the lower of each two
    /// pairs; the lower of the two fours.
    uint256 private constant LOWER_ONE = 0x0000000007ffffff0000000007ffffff0000000007ffffff0000000007ffffff;
    uint256 private constant LOWER_TWO = 0x000000000000000007ffffffffffffe0000000000000000007ffffffffffffe0;
    uint256 private constant LOWER_FOUR = 0x0000000000000000000000000000000007ffffffffffffffffffffffffff8000;
    /// @dev 1 in each 32 bits; their lowest byte; and the next byte.
    uint256 private constant EACH_32 = 0x0000000100000001000000010000000100000001000000010000000100000001;
    uint256 private constant LOWEST_BYTES = 0x000000ff000000ff000000ff000000ff000000ff000000ff000000ff000000ff;
    uint256 private constant SECOND_BYTES = 0x0000ff000000ff000000ff000000ff000000ff000000ff000000ff000000ff00;

    // Checksums are computed from 30 bytes, ten pixels, at a time, in lanes of 16 bits; the lowest lane is not used.
    uint256 private constant WORD = 30;
    /// @dev The number of bytes of a row that can be summed in lanes of 16 bits: 14 words, and 510 * (1 + 2 + .. + 14) < 2^16.
    uint256 private constant SUMMED = 420;
    uint256 private constant LANES = 0x00ff00ff00ff00ff00ff00ff00ff00ff00ff00ff00ff00ff00ff00ff00ff0000;
    /// @dev The lower half of each byte; of each four bits; of each two bits.
    uint256 private constant LOW_4 = 0x0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f;
    uint256 private constant LOW_2 = 0x3333333333333333333333333333333333333333333333333333333333333333;
    uint256 private constant LOW_1 = 0x5555555555555555555555555555555555555555555555555555555555555555;
    uint256 private constant HALF_LANES = 0x0000ffff0000ffff0000ffff0000ffff0000ffff0000ffff0000ffff0000ffff;
    uint256 private constant ALL_LANES = 0xffffffff;

    /// @dev A bit stream.
    /// @param target The address of the next byte.
    /// @param count The number of bits already in that byte, 0..7; the others are zeros.
    struct Stream {
        uint256 target;
        uint256 count;
    }

    /// @dev The rows of a picture.
    /// @param source The calldata offset of the row that is read last.
    /// @param row The buffer of a row, with a word before it and four behind it.
    /// @param size The size of a row's pixels in bytes.
    /// @param height The number of rows.
    /// @param gaps The table of `gapsOf`.
    /// @param between The bits between two rows.
    /// @param betweenSize The number of these bits.
    /// @param lanes The sums of every 30th byte, see `sumRow`.
    struct Rows {
        uint256 source;
        uint256 row;
        uint256 size;
        uint256 height;
        uint256 gaps;
        uint256 between;
        uint256 betweenSize;
        uint256 lanes;
    }

    /// @notice Returns a PNG file of a bitmap.
    /// @param bmp A bitmap of 24 bits per pixel, as from the renderer.
    /// @param scale The enlargement, 1..8.
    function encode(bytes calldata bmp, uint256 scale) internal pure returns (bytes memory png) {
        png = compress(bmp, scale);
        writeSums(png);
    }

    /// @notice Returns the file without the fields that `writeSums` fills in.
    function compress(bytes calldata bmp, uint256 scale) internal pure returns (bytes memory png) {
        unchecked {
            (uint256 width, uint256 height) = sizeOf(bmp);
            if (scale == 0 || scale > MAX_SCALE) revert PngErrors.PixelScaleOutOfRange(scale, MAX_SCALE);
            Rows memory rows;
            (rows.size, rows.height) = (3 * width, height);
            Stream memory stream;
            {
                bytes memory tables = PngCode.tables();
                rows.gaps = gapsOf(tables, width < PART ? width : PART, scale);
                (rows.between, rows.betweenSize) = betweenRows(stream, tables, rows.size, scale);
            }
            bytes memory header = PngCode.header();
            rows.lanes = room(128);
            // with a word before it, and room for the padding behind it
            rows.row = room(rows.size + 192) + 32;
            assembly ("memory-safe") {
                // after the header, the lowest row
                mstore(rows, add(bmp.offset, 54))
            }
            png = open(stream, width * scale, height * scale, RGB_8, header);
            (uint256 rest, uint256 restSize) = PngCode.headerRest();
            put(stream, rest, restSize);
            (uint256 second, uint256 first) = writeRows(stream, rows, scale);
            (uint256 end, uint256 endSize) = PngCode.end();
            put(stream, end, endSize);
            finish(png, stream, second, first);
        }
    }

    /// @dev Writes the signature, the 13 bytes of the IHDR chunk, the name of the IDAT chunk, the zlib header, and the header of the block,
    /// behind all allocated memory; `finish` allocates the file.
    /// @param stream The stream, which then continues there.
    /// @param kind The IHDR bytes after width and height: RGB_8 or RGBA_8.
    function open(Stream memory stream, uint256 width, uint256 height, uint256 kind, bytes memory header)
        internal pure returns (bytes memory png)
    {
        assembly ("memory-safe") {
            png := mload(0x40)
            mstore(add(png, 32), or(or(shl(128, SIGNATURE_IHDR), shl(64, or(shl(32, width), height))), shl(24, kind)))
            mstore(add(png, 64), shl(168, IDAT_ZLIB))
            let target := add(png, DATA)
            mcopy(target, add(header, 32), mload(header))
            target := add(target, mload(header))
            mstore(target, 0)
            mstore(stream, target)
            mstore(add(stream, 0x20), 0)
        }
    }

    /// @notice Returns the PNG file of a bitmap as a `data:` URI.
    function dataURI(bytes calldata bmp, uint256 scale) internal pure returns (string memory) {
        // allocated before the file, since zeros are written behind the file
        string memory head = URI;
        return DataUri.wrap(head, encode(bmp, scale), "");
    }

    /// @notice Returns an SVG document of the same size that contains the PNG file.
    function svg(bytes calldata bmp, uint256 scale) internal pure returns (string memory) {
        unchecked {
            (uint256 width, uint256 height) = sizeOf(bmp);
            (string memory w, string memory h) = (Strings.toString(width * scale), Strings.toString(height * scale));
            string memory head = string.concat('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ', w, " ", h, '"><image width="', w);
            head = string.concat(head, '" height="', h, '" style="image-rendering:pixelated" href="', URI);
            string memory tail = '"/></svg>';
            return DataUri.wrap(head, encode(bmp, scale), tail);
        }
    }

    /// @dev Returns the width and height of a bitmap in pixels, each 1..65535.
    function sizeOf(bytes calldata bmp) internal pure returns (uint256 width, uint256 height) {
        unchecked {
            if (bmp.length < Bmp.HEADER) revert PngErrors.NotABitmap();
            uint256 kind;
            uint256 planesAndBits;
            assembly ("memory-safe") {
                kind := shr(240, calldataload(bmp.offset))
                // bytes 18 to 21 and 22 to 25 are width and height, little-endian
                let sides := calldataload(add(bmp.offset, 18))
                width := or(byte(0, sides), shl(8, byte(1, sides)))
                height := or(byte(4, sides), shl(8, byte(5, sides)))
                planesAndBits := and(shr(160, sides), 0xffffffff)
            }
            bool known = kind == BMP_KIND && planesAndBits == ONE_PLANE_24 && width != 0 && height != 0;
            if (!known || bmp.length != Bmp.HEADER + Bmp.stride(width) * height) revert PngErrors.NotABitmap();
        }
    }

    /// @dev Allocates zeroed memory, rounded up to whole words.
    function room(uint256 size) private pure returns (uint256 place) {
        assembly ("memory-safe") {
            place := mload(0x40)
            mstore(0x40, and(add(add(place, size), 31), not(31)))
            calldatacopy(place, calldatasize(), size)
        }
    }

    /// @dev Returns the codes of matches that repeat a pixel to the end of its square, and 0, 1, 2, ... pixels farther, 48 bytes apart. The
    /// lowest byte contains the number of bits; the first bit is uppermost. Before them, the value added to eight literal pixels if the
    /// first match has SHORT_MATCH bits.
    function gapsOf(bytes memory tables, uint256 width, uint256 scale) private pure returns (uint256 gaps) {
        unchecked {
            gaps = room(48 * width + 48);
            uint256 length = 3 * scale - 3;
            for (uint256 place = gaps; width != 0; --width) {
                (uint256 text, uint256 size) = matchCode(tables, length);
                length += 3 * scale;
                assembly ("memory-safe") {
                    place := add(place, 48)
                    mstore(place, or(shl(sub(256, size), text), size))
                }
            }
            assembly ("memory-safe") {
                mstore(gaps, mul(or(shr(224, mload(add(gaps, 48))), LITERALS), EACH_32))
            }
        }
    }

    /// @dev Returns the code of a match at the distance of a pixel, up to 32 times the maximum length, and its size in bits.
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

    /// @dev Writes the bits between the pixels of two rows: the rows that equal the row above, and the filter of the next row.
    /// @param stream The stream used for writing.
    /// @param rowSize The size of the pixels of a row in bytes, before enlargement.
    /// @return begin The address of the bits.
    /// @return size The number of bits.
    function betweenRows(Stream memory stream, bytes memory tables, uint256 rowSize, uint256 scale)
        private pure returns (uint256 begin, uint256 size)
    {
        unchecked {
            // after the filter and the first zero, matches at the distance of a byte; none without enlargement
            uint256 zeros = scale == 1 ? 3 : rowSize * scale - 1;
            uint256 longest = (zeros - 3) / 258;
            uint256 last = 3 + (zeros - 3) % 258;
            (uint256 text, uint256 textSize) = matchCode(tables, last);
            text ^= last > 258 ? PngCode.OTHER_DISTANCES : 1;
            // the bits of a row, and room for the last word written
            begin = room((scale * (2 * LITERAL_SIZE + longest * PngCode.LONGEST_SIZE + textSize)) / 8 + 64);
            stream.target = begin;
            for (uint256 copies = scale - 1; copies != 0; --copies) {
                put(stream, ((PngCode.LITERAL + UP) << LITERAL_SIZE) | PngCode.LITERAL, 2 * LITERAL_SIZE);
                for (uint256 k = longest; k != 0; --k) put(stream, PngCode.LONGEST_ZEROS, PngCode.LONGEST_SIZE);
                put(stream, text, textSize);
            }
            put(stream, PngCode.LITERAL, LITERAL_SIZE);
            size = 8 * (stream.target - begin) + stream.count;
        }
    }

    /// @return second The contribution of the uncompressed bytes to the second sum of Adler-32, in which each byte is weighted by the
    /// number of bytes from it to the end.
    /// @return first The first sum of Adler-32.
    function writeRows(Stream memory stream, Rows memory rows, uint256 scale) private pure returns (uint256 second, uint256 first) {
        unchecked {
            // the sum of all bytes; the sum weighted by the number of rows from each byte's row on; the sum weighted by position, as in
            // `sumRow`
            (uint256 sum, uint256 sumBelow, uint256 places) = sumRows(stream, rows);
            // pairs of copies of a row
            uint256 pairs = scale * (scale - 1) / 2;
            uint256 rowSize = 1 + rows.size * scale;
            uint256 written = rowSize * scale;
            first = 1 + scale * sum + UP * (scale - 1) * rows.height;
            // the pixels, each written `scale` times, after the filter of the row
            second = written * rows.height + scale * (written * sumBelow - sum - 3 * scale * places) - 3 * pairs * sum;
            second -= scale * withinWords(rows.lanes, scale);
            // the filters of the other rows
            second += UP * rowSize * pairs * rows.height * rows.height;
        }
    }

    /// @dev Writes all rows, and returns the sums described in `writeRows`.
    function sumRows(Stream memory stream, Rows memory rows) private pure returns (uint256 sum, uint256 sumBelow, uint256 places) {
        unchecked {
            (uint256 size, uint256 row) = (rows.size, rows.row);
            uint256 stride = Bmp.stride(size / 3);
            uint256 source = rows.source + stride * rows.height;
            put(stream, PngCode.LITERAL, LITERAL_SIZE);
            while (source != rows.source) {
                source -= stride;
                assembly ("memory-safe") {
                    calldatacopy(row, source, size)
                    // zeros for the sums
                    calldatacopy(add(row, size), calldatasize(), 96)
                }
                {
                    (uint256 sumOfRow, uint256 placesOfRow) = sumRow(row, size, rows.lanes);
                    sum += sumOfRow;
                    sumBelow += sum;
                    places += placesOfRow;
                }
                assembly ("memory-safe") {
                    // repeat the last pixel 32 times
                    let end := add(row, size)
                    let pixels := shl(64, mul(shr(232, mload(sub(end, 3))), EACH_PIXEL))
                    mstore(end, pixels)
                    mstore(add(end, 24), pixels)
                    mstore(add(end, 48), pixels)
                    mstore(add(end, 72), pixels)
                }
                for (uint256 begin; begin < size; begin += 3 * PART) {
                    writePart(stream, rows.gaps, row + begin, row + (size - begin < 3 * PART ? size : begin + 3 * PART));
                }
                putBits(stream, rows.between, source == rows.source ? rows.betweenSize - LITERAL_SIZE : rows.betweenSize);
            }
        }
    }

    /// @dev Sums a row. It must be followed by 90 zero bytes.
    /// @param lanes The address of four words to which sums of every 30th byte are added, counted from the upper end: the bytes with odd
    /// numbers, then those with even numbers, in lanes of 32 bits; for each, first every second one from the second on, then every second
    /// one from the first on.
    /// @return sum The sum of the bytes.
    /// @return places The sum of the bytes, each weighted by the index of the first of the ten pixels in its word.
    function sumRow(uint256 row, uint256 size, uint256 lanes) private pure returns (uint256 sum, uint256 places) {
        assembly ("memory-safe") {
            let last := add(row, size)
            for { let pixel := 0 } lt(row, last) { pixel := add(pixel, 140) } {
                let odd := 0
                let even := 0
                // prefix sums: the first of n words counts n times
                let sums := 0
                let first := row
                let end := add(row, SUMMED)
                if gt(end, last) { end := last }
                for {} lt(row, end) { row := add(row, 60) } {
                    odd := add(odd, and(mload(row), LANES))
                    even := add(even, and(shr(8, mload(row)), LANES))
                    sums := add(sums, add(odd, even))
                    odd := add(odd, and(mload(add(row, WORD)), LANES))
                    even := add(even, and(shr(8, mload(add(row, WORD))), LANES))
                    sums := add(sums, add(odd, even))
                }
                let count := div(sub(row, first), 3)
                mstore(lanes, add(mload(lanes), and(odd, HALF_LANES)))
                let place := add(lanes, 0x20)
                mstore(place, add(mload(place), and(shr(16, odd), HALF_LANES)))
                place := add(lanes, 0x40)
                mstore(place, add(mload(place), and(even, HALF_LANES)))
                place := add(lanes, 0x60)
                mstore(place, add(mload(place), and(shr(16, even), HALF_LANES)))
                even := add(odd, even)
                even := mod(add(and(even, HALF_LANES), and(shr(16, even), HALF_LANES)), ALL_LANES)
                sums := mod(add(and(sums, HALF_LANES), and(shr(16, sums), HALF_LANES)), ALL_LANES)
                sum := add(sum, even)
                places := add(places, sub(mul(add(pixel, count), even), mul(10, sums)))
            }
        }
    }

    /// @dev Returns the sum of all bytes, each weighted by its first position in the enlarged row, relative to the ten pixels of its word.
    function withinWords(uint256 lanes, uint256 scale) private pure returns (uint256 sum) {
        unchecked {
            for (uint256 i; i != WORD; ++i) {
                uint256 word;
                assembly ("memory-safe") {
                    // selects odd or even bytes, and the first, third, ... or the second, fourth, ... of them
                    word := mload(add(lanes, sub(sub(0x60, mul(0x40, and(i, 1))), mul(0x20, and(shr(1, i), 1)))))
                }
                // bitmaps are in the order blue, green, red; PNG files in the order red, green, blue
                sum += (3 * scale * (i / 3) + 2 - i % 3) * ((word >> (224 - 32 * (i / 4))) & ALL_LANES);
            }
        }
    }

    /// @dev Writes the pixels of a part of a row, with the match of each.
    /// @param first The first pixel. The bytes before it may be overwritten.
    /// @param end The end of the last pixel. Up to seven pixels after it must equal the last one.
    function writePart(Stream memory stream, uint256 gaps, uint256 first, uint256 end) private pure {
        assembly ("memory-safe") {
            // writes the match with this code for the previous pixel, then a pixel
            function write(target, count, code, pixel) -> newTarget, newCount {
                // from blue, green, red with eight bits each to red, green, blue with nine
                let text := shr(232, mload(pixel))
                text := or(or(shl(247, and(text, 0xff)), and(shl(230, text), GREEN_OF_9)), shl(229, shr(16, text)))
                text := add(text, shl(229, LITERALS))
                let size := and(code, 0xff)
                mstore(target, or(and(mload(target), FIRST_BYTE), shr(count, or(code, shr(size, text)))))
                newCount := add(add(count, size), PIXEL_SIZE)
                newTarget := add(target, shr(3, newCount))
                newCount := and(newCount, 7)
            }

            function writeMatch(target, count, code) -> newTarget, newCount {
                let size := and(code, 0xff)
                mstore(target, or(and(mload(target), FIRST_BYTE), shr(count, xor(code, size))))
                newCount := add(count, size)
                newTarget := add(target, shr(3, newCount))
                newCount := and(newCount, 7)
            }

            let target := mload(stream)
            let count := mload(add(stream, 0x20))
            // the last literal pixel: its match is written when its length is known
            let last := first
            target, count := write(target, count, 0, first)
            mcopy(sub(first, 3), first, 3)
            // all eight pixels may be literals if they begin before this one
            let square := byte(31, mload(add(gaps, 48)))
            let full := mul(sub(end, 23), or(eq(square, SHORT_MATCH), iszero(square)))
            for {} lt(first, end) {} {
                // most pixels equal their left neighbours, often 32 in a row
                let left := sub(first, 3)
                if iszero(
                    or(
                        or(xor(mload(first), mload(left)), xor(mload(add(first, 32)), mload(add(left, 32)))),
                        xor(mload(add(first, 64)), mload(add(left, 64)))
                    )
                ) {
                    first := add(first, 96)
                    continue
                }
                for { let behind := add(first, 96) } lt(first, behind) { first := add(first, 24) } {
                    let change := shr(64, xor(mload(first), mload(sub(first, 3))))
                    if iszero(change) { continue }
                    // the number of pixels that differ
                    let changed := or(change, or(shr(8, change), shr(16, change)))
                    changed := add(and(changed, BYTE_OF_PIXEL), BYTE_OF_PIXEL)
                    changed := mod(and(shr(8, changed), EACH_PIXEL), 0xffffff)
                    if gt(mul(changed, lt(first, full)), sub(MANY, 1)) {
                        // spread pixels from 24 to 32 bits: the upper half of each part moves up
                        let pixels := shr(64, mload(first))
                        pixels := add(pixels, mul(and(pixels, UPPER_FOUR), 0xffffffff))
                        pixels := add(pixels, mul(and(pixels, UPPER_TWO), 0xffff))
                        pixels := add(pixels, mul(and(pixels, UPPER_ONE), 0xff))
                        // from blue, green, red with eight bits each to red, green, blue with nine, preceded by the match of the previous
                        // pixel
                        pixels := add(
                            add(shl(18, and(pixels, LOWEST_BYTES)), shl(1, and(pixels, SECOND_BYTES))),
                            and(shr(16, pixels), LOWEST_BYTES)
                        )
                        pixels := add(pixels, mload(gaps))
                        if iszero(square) {
                            // compact to 27 bits each: the lower one of each two moves up
                            pixels := add(pixels, mul(and(pixels, LOWER_ONE), 31))
                            pixels := add(pixels, mul(and(pixels, LOWER_TWO), 1023))
                            pixels := shl(5, add(pixels, mul(and(pixels, LOWER_FOUR), 1048575)))
                            let size := ALL_EIGHT
                            switch xor(first, last)
                            case 0 {
                                // the first one is already written
                                pixels := shl(PIXEL_SIZE, pixels)
                                size := sub(ALL_EIGHT, PIXEL_SIZE)
                            }
                            default { target, count := writeMatch(target, count, mload(add(gaps, shl(4, sub(first, last))))) }
                            mstore(target, or(and(mload(target), FIRST_BYTE), shr(count, pixels)))
                            count := add(count, size)
                            target := add(target, shr(3, count))
                            count := and(count, 7)
                            last := add(first, 21)
                            continue
                        }
                        switch sub(first, last)
                        case 3 {
                            // write all of them: a word, and the bits shifted out of it
                            mstore(target, or(and(mload(target), FIRST_BYTE), shr(count, pixels)))
                            target := add(target, 32)
                            mstore(target, shl(sub(256, count), pixels))
                        }
                        default {
                            if xor(first, last) { target, count := write(target, count, mload(add(gaps, shl(4, sub(first, last)))), first) }
                            mstore(target, or(and(mload(target), FIRST_BYTE), shr(count, shl(32, pixels))))
                            target := add(target, 28)
                        }
                        last := add(first, 21)
                        continue
                    }
                    let place := first
                    switch shr(96, change)
                    case 0 {
                        change := shl(160, change)
                        place := add(place, 12)
                    }
                    default { change := shl(64, change) }
                    for {} change {
                        change := shl(24, change)
                        place := add(place, 3)
                    } {
                        if shr(232, change) {
                            target, count := write(target, count, mload(add(gaps, shl(4, sub(place, last)))), place)
                            last := place
                        }
                    }
                }
            }
            // the last match
            target, count := writeMatch(target, count, mload(add(gaps, shl(4, sub(end, last)))))
            mstore(stream, target)
            mstore(add(stream, 0x20), count)
        }
    }

    /// @dev Writes `size` bits from an address, the uppermost bit first.
    function putBits(Stream memory stream, uint256 source, uint256 size) private pure {
        unchecked {
            uint256 word;
            for (; size > 248; size -= 248) {
                assembly ("memory-safe") {
                    word := shr(8, mload(source))
                    source := add(source, 31)
                }
                put(stream, word, 248);
            }
            assembly ("memory-safe") {
                word := shr(sub(256, size), mload(source))
            }
            put(stream, word, size);
        }
    }

    /// @dev Writes up to 248 bits, the uppermost bit first.
    function put(Stream memory stream, uint256 text, uint256 size) internal pure {
        assembly ("memory-safe") {
            let target := mload(stream)
            let count := add(mload(add(stream, 0x20)), size)
            mstore(target, or(and(mload(target), FIRST_BYTE), shl(sub(256, count), text)))
            mstore(stream, add(target, shr(3, count)))
            mstore(add(stream, 0x20), and(count, 7))
        }
    }

    /// @dev Reverses the bits of each byte for deflate, and appends the Adler-32 checksum. Then the length of the file is correct, and its
    /// last twelve bytes are free.
    function finish(bytes memory png, Stream memory stream, uint256 second, uint256 first) internal pure {
        unchecked {
            second %= ADLER;
            first %= ADLER;
            assembly ("memory-safe") {
                let target := add(mload(stream), iszero(iszero(mload(add(stream, 0x20)))))
                for { let place := add(png, DATA) } lt(place, target) { place := add(place, 32) } {
                    let word := mload(place)
                    // `add` rather than `or`: the optimizer would rewrite `or` and `and` to more instructions
                    word := add(and(shr(4, word), LOW_4), mul(and(word, LOW_4), 16))
                    word := add(and(shr(2, word), LOW_2), mul(and(word, LOW_2), 4))
                    word := add(and(shr(1, word), LOW_1), mul(and(word, LOW_1), 2))
                    mstore(place, word)
                }
                mstore(target, shl(224, or(shl(16, second), first)))
                // the checksum of this chunk (4 bytes), and the IEND chunk (12 bytes)
                target := add(target, 20)
                mstore(png, sub(target, add(png, 32)))
                mstore(0x40, and(add(target, 31), not(31)))
            }
        }
    }

    /// @dev Fills in the data size and the checksums of the chunks, and appends the IEND chunk.
    function writeSums(bytes memory png) internal pure {
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
            write32(end - 8, IEND);
            write32(end - 4, IEND_SUM);
        }
    }

    function write32(uint256 target, uint256 value) private pure {
        assembly ("memory-safe") {
            mstore(target, or(shr(32, shl(32, mload(target))), shl(224, value)))
        }
    }
}
