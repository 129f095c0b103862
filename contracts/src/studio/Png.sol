// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Base64} from "../encode/Base64.sol";
import {Text} from "../encode/Text.sol";
import {Crc32} from "./Crc32.sol";
import {PngCode} from "./PngCode.sol";

/// @notice PNG files of the renderer's bitmaps, each pixel a square of up to 8 x 8, so that it stays crisp wherever pictures are smoothed.
/// @dev Source: PNG (W3C), RFC 1950 (zlib), RFC 1951 (deflate).
///
/// The rows are stored as differences: the first row of each square from the pixel at the left (filter Sub), the others from the row above
/// (filter Up), which leaves zeros. So there are two things to write, the differences of pixels and runs of zeros, and one Huffman code
/// for all pictures, fitted to those of this renderer, does for both: see `PngCode`. The checksums are computed from what is not zero.
library Png {
    uint256 internal constant MAX_SCALE = 8;
    uint256 private constant BMP_HEADER = 54;
    /// @dev Where in the bytes of the result, counted with the word of their length, the compressed data begin: behind the signature
    /// (8 bytes), the chunk IHDR (25), the head of the chunk IDAT (8) and that of zlib (2).
    uint256 private constant DATA = 75;
    uint256 private constant SUB = 1;
    uint256 private constant UP = 2;
    /// @dev The largest prime below 2^16, for the checksum Adler-32.
    uint256 private constant ADLER = 65521;
    /// @dev Behind the tables of `PngCode` there is room to remember codes of a difference and the zeros before it, each a word: how many
    /// zeros (16 bits) and the difference (24 bits), at bit 64 the size of the code, and the code.
    uint256 private constant KNOWN = 1312;
    uint256 private constant KNOWN_COUNT = 509;
    uint256 private constant KNOWN_SIZE = 16288;
    /// @dev Zeros that one code can stand for.
    uint256 private constant LONGEST_RUN = 259;

    /// @notice The bytes are not a bitmap as the renderer makes them.
    error NotABitmap();
    /// @notice Each pixel can become a square of 1 x 1 to 8 x 8.
    error ScaleOutOfRange(uint256 scale);

    /// @dev What has been written so far.
    /// @param target Where the next bytes belong.
    /// @param bits The bits that are not there yet, the last one lowest. Above them there may be others, which are there already.
    /// @param count How many, up to 255.
    /// @param sums What the bytes before compression add to Adler-32: twice 128 bits, the second sum, the first sum. All values are
    /// below 2^8, and there are fewer than 2^28 of them.
    /// @param code The tables of `PngCode`.
    struct Stream {
        uint256 target;
        uint256 bits;
        uint256 count;
        uint256 sums;
        uint256 code;
    }

    /// @notice A PNG file of a bitmap.
    /// @param bmp 24 bits a pixel, as the renderer makes it.
    /// @param scale How many pixels each becomes in both directions, 1..8.
    function encode(bytes memory bmp, uint256 scale) internal pure returns (bytes memory png) {
        unchecked {
            (uint256 width, uint256 height) = sizeOf(bmp);
            if (scale == 0 || scale > MAX_SCALE) revert ScaleOutOfRange(scale);
            Stream memory stream;
            bytes memory tables = PngCode.tables();
            bytes memory header = PngCode.header();
            uint256 row;
            assembly ("memory-safe") {
                // the tables, and room to remember codes
                let code := mload(0x40)
                mstore(add(stream, 0x80), code)
                mcopy(code, add(tables, 32), mload(tables))
                calldatacopy(add(code, KNOWN), calldatasize(), KNOWN_SIZE)
                // room for a row, with a word of zeros before it and two more words behind it
                row := add(add(code, add(KNOWN, KNOWN_SIZE)), 32)
                mstore(sub(row, 32), 0)
                png := add(row, and(add(mul(3, width), 95), not(31)))
                // signature; 13 bytes in the chunk IHDR: the sides, 8 bits for each of three channels; the chunk IDAT, and the head of zlib
                let sides := or(shl(32, mul(width, scale)), mul(height, scale))
                mstore(add(png, 32), or(or(shl(128, 0x89504e470d0a1a0a0000000d49484452), shl(64, sides)), shl(24, 0x0802000000)))
                mstore(add(png, 64), shl(168, 0x0000000000494441547801))
                let target := add(png, DATA)
                mcopy(target, add(header, 32), mload(header))
                mstore(stream, add(target, mload(header)))
            }
            (stream.bits, stream.count) = PngCode.headerRest();
            writeRows(stream, bmp, row, width, height, scale);
            finish(png, stream, (1 + 3 * width * scale) * height * scale);
            writeSums(png);
        }
    }

    /// @notice A PNG file of a bitmap as a `data:` URI.
    function dataURI(bytes memory bmp, uint256 scale) internal pure returns (string memory uri) {
        unchecked {
            bytes memory png = encode(bmp, scale);
            uint256 file;
            uint256 begin;
            string memory prefix = "data:image/png;base64,";
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
            if (bmp.length < BMP_HEADER) revert NotABitmap();
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
            if (!known || bmp.length != BMP_HEADER + strideOf(width) * height) revert NotABitmap();
        }
    }

    /// @dev Bytes of a row of a bitmap.
    function strideOf(uint256 width) private pure returns (uint256) {
        unchecked {
            return (3 * width + 3) & ~uint256(3);
        }
    }

    function writeRows(Stream memory stream, bytes memory bmp, uint256 row, uint256 width, uint256 height, uint256 scale)
        private
        pure
    {
        unchecked {
            uint256 stride = strideOf(width);
            uint256 rowSize = 1 + 3 * width * scale;
            // bytes that are not written yet
            uint256 rest = rowSize * height * scale;
            uint256 source;
            assembly ("memory-safe") {
                // bitmaps begin with the lowest row
                source := add(add(add(bmp, 32), BMP_HEADER), mul(stride, height))
            }
            (uint256 sub, uint256 subSize) = literal(stream, SUB);
            // a row like the one above
            (uint256 up, uint256 upSize) = literal(stream, UP);
            (uint256 run, uint256 runSize, bool short) = runCode(stream, rowSize - 1);
            (uint256 copied, uint256 copiedSize) = ((up << runSize) | run, upSize + runSize);
            for (uint256 y = height; y != 0; --y) {
                source -= stride;
                assembly ("memory-safe") {
                    let end := add(row, mul(3, width))
                    mcopy(row, source, mul(3, width))
                    // ten more pixels like the last one, and something else
                    let pixel := shr(232, mload(sub(end, 3)))
                    mstore(end, or(shl(16, mul(pixel, 0x000001000001000001000001000001000001000001000001000001000001)), and(not(shr(8, pixel)), 0xffff)))
                }
                put(stream, sub, subSize);
                putRun(stream, writeRow(stream, row, width, rest - 1, scale));
                for (uint256 copy = 1; copy != scale; ++copy) {
                    if (short) {
                        put(stream, copied, copiedSize);
                    } else {
                        put(stream, up, upSize);
                        putRun(stream, rowSize - 1);
                    }
                }
                stream.sums += (((SUB + UP * (scale - 1)) * rest - UP * rowSize * (scale * (scale - 1) / 2)) << 128) + SUB + UP * (scale - 1);
                rest -= rowSize * scale;
            }
        }
    }

    /// @dev Writes the differences of a row, each from the pixel at its left, but for the zeros at its end.
    /// @param row The pixels, after one of zeros. There must be ten more like the last one behind them, and then another one.
    /// @param rest How many bytes are not written yet, with those of this row.
    /// @return zeros How many there are at the end.
    function writeRow(Stream memory stream, uint256 row, uint256 width, uint256 rest, uint256 scale)
        private
        pure
        returns (uint256 zeros)
    {
        assembly ("memory-safe") {
            let end := add(row, mul(3, width))
            let bits := mload(add(stream, 0x20))
            let count := mload(add(stream, 0x40))
            let code := mload(add(stream, 0x80))
            // how many bytes are left at a pixel: this less its address times the scale
            let places := add(rest, mul(row, scale))
            let done := rest
            let step := mul(3, scale)
            for {} 1 { row := add(row, 30) } {
                // ten pixels at a time that are like those at their left
                for {} iszero(shr(16, xor(mload(row), mload(sub(row, 3))))) { row := add(row, 30) } {}
                if iszero(lt(row, end)) { break }
                // the differences: each byte by itself, its uppermost bit apart
                let here := mload(row)
                let word := mload(sub(row, 3))
                let signs := and(not(xor(here, word)), 0x8080808080808080808080808080808080808080808080808080808080808080)
                word := sub(or(here, 0x8080808080808080808080808080808080808080808080808080808080808080), and(word, 0x7f7f7f7f7f7f7f7f7f7f7f7f7f7f7f7f7f7f7f7f7f7f7f7f7f7f7f7f7f7f7f7f))
                word := and(xor(word, signs), not(0xffff))
                here := sub(places, mul(row, scale))
                {
                    // red, green and blue of ten pixels at once. What counts as often as there are bytes left, less green, less twice blue
                    let blue := and(shr(32, word), 0x0000ff0000ff0000ff0000ff0000ff0000ff0000ff0000ff0000ff0000ff)
                    let green := and(shr(24, word), 0x0000ff0000ff0000ff0000ff0000ff0000ff0000ff0000ff0000ff0000ff)
                    let all := add(add(blue, green), and(shr(16, word), 0x0000ff0000ff0000ff0000ff0000ff0000ff0000ff0000ff0000ff0000ff))
                    let less := mod(add(add(blue, blue), green), 0xffffff)
                    // each times its place from the left, 0 to 9
                    let steps := and(shr(216, mul(all, 0x000009000008000007000006000005000004000003000002000001000000)), 0xffffff)
                    less := add(less, mul(steps, step))
                    let sums := add(stream, 0x60)
                    mstore(sums, sub(add(mload(sums), mul(mod(all, 0xffffff), or(shl(128, here), 1))), shl(128, less)))
                }
                for {} word { word := shl(24, word) } {
                    let pixel := shr(232, word)
                    if pixel {
                        // the code of this after as many zeros, if it is remembered
                        let size := sub(done, here)
                        pixel := or(pixel, shl(24, size))
                        let slot := add(add(code, KNOWN), shl(5, mod(pixel, KNOWN_COUNT)))
                        let known := mload(slot)
                        if xor(shr(216, known), pixel) {
                            for {} gt(size, 258) { size := sub(size, 259) } {
                                known := shr(232, mload(add(code, 1289)))
                                bits := or(shl(and(known, 31), bits), shr(5, known))
                                count := add(count, and(known, 31))
                                if gt(count, 191) {
                                    count := sub(count, 192)
                                    mstore(mload(stream), shl(64, shr(count, bits)))
                                    mstore(stream, add(mload(stream), 24))
                                }
                            }
                            // the zeros that are left, red, green, blue
                            pixel := or(and(pixel, 0xffffff), shl(24, size))
                            let entry := shr(232, mload(add(add(code, 512), mul(3, size))))
                            known := shr(5, entry)
                            size := and(entry, 31)
                            entry := shr(240, mload(add(code, shl(1, byte(2, word)))))
                            known := or(shl(and(entry, 15), known), shr(4, entry))
                            size := add(size, and(entry, 15))
                            entry := shr(240, mload(add(code, shl(1, byte(1, word)))))
                            known := or(shl(and(entry, 15), known), shr(4, entry))
                            size := add(size, and(entry, 15))
                            entry := shr(240, mload(add(code, shl(1, byte(0, word)))))
                            known := or(shl(and(entry, 15), known), shr(4, entry))
                            size := add(size, and(entry, 15))
                            known := or(or(shl(216, pixel), shl(64, size)), known)
                            mstore(add(add(code, KNOWN), shl(5, mod(pixel, KNOWN_COUNT))), known)
                        }
                        size := byte(23, known)
                        bits := or(shl(size, bits), and(known, 0xffffffffffffffff))
                        count := add(count, size)
                        if gt(count, 191) {
                            count := sub(count, 192)
                            mstore(mload(stream), shl(64, shr(count, bits)))
                            mstore(stream, add(mload(stream), 24))
                        }
                        done := sub(here, 3)
                    }
                    here := sub(here, step)
                }
            }
            mstore(add(stream, 0x20), bits)
            mstore(add(stream, 0x40), count)
            zeros := sub(done, sub(places, mul(end, scale)))
        }
    }

    /// @dev The code of a byte, and its bits.
    function literal(Stream memory stream, uint256 value) private pure returns (uint256 text, uint256 size) {
        unchecked {
            uint256 code = stream.code;
            assembly ("memory-safe") {
                text := shr(240, mload(add(code, shl(1, value))))
            }
            return (text >> 4, text & 15);
        }
    }

    /// @dev Writes zeros, which add nothing to sums.
    function putRun(Stream memory stream, uint256 zeros) private pure {
        unchecked {
            for (; zeros >= 9 * LONGEST_RUN; zeros -= 9 * LONGEST_RUN) put(stream, PngCode.NINE_LONGEST_RUNS, 9 * PngCode.LONGEST_RUN_SIZE);
            (uint256 text, uint256 size,) = runCode(stream, zeros);
            put(stream, text, size);
        }
    }

    /// @dev The code of zeros, and its bits, if there are fewer than 9 times LONGEST_RUN.
    function runCode(Stream memory stream, uint256 zeros) private pure returns (uint256 text, uint256 size, bool short) {
        unchecked {
            uint256 code = stream.code;
            uint256 whole = 9 * LONGEST_RUN > zeros ? zeros / LONGEST_RUN : 0;
            assembly ("memory-safe") {
                text := shr(232, mload(add(code, add(512, mul(3, mod(zeros, LONGEST_RUN))))))
            }
            (text, size) = (text >> 5, text & 31);
            whole *= PngCode.LONGEST_RUN_SIZE;
            text |= (PngCode.NINE_LONGEST_RUNS >> (9 * PngCode.LONGEST_RUN_SIZE - whole)) << size;
            return (text, size + whole, zeros < 9 * LONGEST_RUN);
        }
    }

    /// @dev Writes up to 64 bits.
    function put(Stream memory stream, uint256 text, uint256 size) private pure {
        assembly ("memory-safe") {
            let bits := or(shl(size, mload(add(stream, 0x20))), text)
            let count := add(mload(add(stream, 0x40)), size)
            if gt(count, 191) {
                count := sub(count, 192)
                mstore(mload(stream), shl(64, shr(count, bits)))
                mstore(stream, add(mload(stream), 24))
            }
            mstore(add(stream, 0x20), bits)
            mstore(add(stream, 0x40), count)
        }
    }

    /// @dev Ends the block, turns the bits of each byte to the order of deflate, and adds the checksum of `size` bytes. After that the
    /// length of the file is right, and its last twelve bytes are free.
    function finish(bytes memory png, Stream memory stream, uint256 size) private pure {
        unchecked {
            (uint256 end, uint256 endSize) = PngCode.end();
            put(stream, end, endSize);
            uint256 second = (size + (stream.sums >> 128)) % ADLER;
            uint256 first = (1 + uint128(stream.sums)) % ADLER;
            assembly ("memory-safe") {
                let count := mload(add(stream, 0x40))
                let target := mload(stream)
                mstore(target, shl(sub(256, count), mload(add(stream, 0x20))))
                target := add(target, shr(3, add(count, 7)))
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
