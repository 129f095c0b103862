// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Bmp} from "./Bmp.sol";
import {DataUri} from "./DataUri.sol";
import {Png} from "./Png.sol";
import {AlphaCode} from "./PngCode.sol";
import {PngErrors} from "../interfaces/PngErrors.sol";

/// @notice Encodes PNG files with an alpha channel from two bitmaps of a scene: over black and over white.
/// @dev A fragment that covers a fraction a of a pixel in the colour c appears as a c over black and as a c + 255 (1 - a) over white. The
/// difference yields a, and the bitmap over black then yields c. This holds for antialiased edges and for translucent objects.
///
/// A pixel is written as four bytes; if equal pixels follow, as matches at the distance of a pixel. If pixels are enlarged to squares, the
/// other rows of a square equal the row above (filter Up): zeros. The Huffman code is `AlphaCode`.
library TransparentPng {
    /// @dev The maximum number of pixels in a match, since a match has at most 258 bytes.
    uint256 private constant MOST = 64;
    /// @dev The code sizes of a byte and of a pixel, in bits.
    uint256 private constant LITERAL_SIZE = 9;
    uint256 private constant PIXEL_SIZE = 36;
    /// @dev The first byte of a word.
    uint256 private constant FIRST_BYTE = 0xff00000000000000000000000000000000000000000000000000000000000000;

    /// @param stream The bits written so far.
    /// @param matches The table of `codes`.
    /// @param first, second The sums of Adler-32, not reduced.
    struct File {
        Png.Stream stream;
        uint256 matches;
        uint256 first;
        uint256 second;
    }

    /// @notice Returns a PNG file of 8 bits for each of red, green, blue and alpha.
    /// @param black, white Bitmaps of the scene over a black and over a white background, of the same size.
    /// @param scale The enlargement, 1..8.
    function encode(bytes calldata black, bytes calldata white, uint256 scale) internal pure returns (bytes memory png) {
        unchecked {
            (uint256 width, uint256 height) = Png.sizeOf(black);
            {
                (uint256 otherWidth, uint256 otherHeight) = Png.sizeOf(white);
                if (width != otherWidth || height != otherHeight) revert PngErrors.SizesDiffer(width, height, otherWidth, otherHeight);
            }
            if (scale == 0 || scale > Png.MAX_SCALE) revert PngErrors.PixelScaleOutOfRange(scale, Png.MAX_SCALE);
            File memory file;
            (file.matches, file.first) = (codes(), 1);
            bytes memory header = AlphaCode.header();
            png = Png.open(file.stream, width * scale, height * scale, Png.RGBA_8, header);
            (uint256 text, uint256 size) = AlphaCode.headerRest();
            Png.put(file.stream, text, size);
            uint256 place = Bmp.HEADER + Bmp.stride(width) * height;
            while (place != Bmp.HEADER) {
                place -= Bmp.stride(width);
                writeRow(file, black, white, place, place + 3 * width, scale);
                for (uint256 copies = scale - 1; copies != 0; --copies) {
                    writeFilter(file, Png.UP);
                    writeRun(file, 0, width * scale);
                }
            }
            (text, size) = AlphaCode.end();
            Png.put(file.stream, text, size);
            Png.finish(png, file.stream, file.second, file.first);
            Png.writeSums(png);
        }
    }

    /// @notice Returns the file as a `data:` URI.
    function dataURI(bytes calldata black, bytes calldata white, uint256 scale) internal pure returns (string memory) {
        // allocated before the file, since zeros are written behind the file
        string memory head = Png.URI;
        return DataUri.wrap(head, encode(black, white, scale), "");
    }

    /// @dev Writes a row.
    /// @param place The offset of its first pixel in the bitmaps, in bytes.
    /// @param end The offset of the end of its last pixel.
    function writeRow(File memory file, bytes calldata black, bytes calldata white, uint256 place, uint256 end, uint256 scale)
        private pure
    {
        unchecked {
            writeFilter(file, 0);
            uint256 toWhite;
            assembly ("memory-safe") {
                end := add(black.offset, end)
                place := add(black.offset, place)
                toWhite := sub(white.offset, black.offset)
            }
            while (place != end) {
                uint256 begin = place;
                uint256 onBlack;
                uint256 onWhite;
                assembly ("memory-safe") {
                    onBlack := shr(232, calldataload(place))
                    onWhite := shr(232, calldataload(add(place, toWhite)))
                    // the length of the run, in steps of ten pixels while all ten are equal: the shift discards the other two bytes
                    for { place := add(place, 3) } lt(place, end) { place := add(place, 3) } {
                        let before := sub(place, 3)
                        let change := or(
                            xor(calldataload(place), calldataload(before)),
                            xor(calldataload(add(place, toWhite)), calldataload(add(before, toWhite)))
                        )
                        if shr(232, change) { break }
                        if lt(shr(16, change), lt(add(place, 29), end)) { place := add(place, 27) }
                    }
                }
                writeRun(file, pixelOf(onBlack, onWhite), scale * (place - begin) / 3);
            }
        }
    }

    /// @notice Returns red, green, blue and alpha, 8 bits each, of a pixel with these colours over black and over white.
    /// @param onBlack, onWhite Blue, green and red, 8 bits each.
    function pixelOf(uint256 onBlack, uint256 onWhite) internal pure returns (uint256) {
        unchecked {
            if (onBlack == onWhite) return swapped(onBlack) | 255;
            uint256 most = difference(onBlack, onWhite, 16);
            uint256 other = difference(onBlack, onWhite, 8);
            if (other > most) most = other;
            other = difference(onBlack, onWhite, 0);
            if (other > most) most = other;
            if (most == 255) return 0;
            uint256 alpha = 255 - most;
            onBlack = channel(onBlack >> 16, alpha) << 16 | channel(onBlack >> 8, alpha) << 8 | channel(onBlack, alpha);
            return swapped(onBlack) | alpha;
        }
    }

    /// @dev Returns blue, green, red as red, green, blue, zero.
    function swapped(uint256 color) private pure returns (uint256) {
        return (color & 0xff) << 24 | (color & 0xff00) << 8 | (color >> 16) << 8;
    }

    /// @dev Returns by how much a channel is brighter over white; 0 if it is not, which two different scenes can cause.
    function difference(uint256 onBlack, uint256 onWhite, uint256 shift) private pure returns (uint256) {
        unchecked {
            (uint256 dark, uint256 bright) = (onBlack >> shift & 0xff, onWhite >> shift & 0xff);
            return bright > dark ? bright - dark : 0;
        }
    }

    /// @dev Returns the colour of a channel from its value over black, rounded to nearest.
    function channel(uint256 onBlack, uint256 alpha) private pure returns (uint256 value) {
        unchecked {
            value = ((onBlack & 0xff) * 255 + alpha / 2) / alpha;
            if (value > 255) value = 255;
        }
    }

    /// @dev Writes the filter of a row.
    function writeFilter(File memory file, uint256 filter) private pure {
        unchecked {
            Png.put(file.stream, (AlphaCode.PIXEL & 0x1ff) + filter, LITERAL_SIZE);
            file.first += filter;
            file.second += file.first;
        }
    }

    /// @dev Writes a pixel `count` times, at least once.
    function writeRun(File memory file, uint256 pixel, uint256 count) private pure {
        uint256 zeros = AlphaCode.PIXEL;
        assembly ("memory-safe") {
            let text
            {
                let red := shr(24, pixel)
                let green := byte(29, pixel)
                let blue := byte(30, pixel)
                let alpha := byte(31, pixel)
                text := shl(220, add(or(or(shl(27, red), shl(18, green)), or(shl(9, blue), alpha)), zeros))
                // the sums, as if computed byte by byte
                let weighted := add(add(shl(2, red), mul(3, green)), add(shl(1, blue), alpha))
                let sum := add(add(red, green), add(blue, alpha))
                let first := mload(add(file, 0x40))
                weighted := add(weighted, add(shl(2, first), mul(shl(1, sum), sub(count, 1))))
                mstore(add(file, 0x60), add(mload(add(file, 0x60)), mul(count, weighted)))
                mstore(add(file, 0x40), add(first, mul(count, sum)))
            }
            // the bytes with the first match, then as many matches as needed
            let stream := mload(file)
            let target := mload(stream)
            let bits := mload(add(stream, 0x20))
            let size := PIXEL_SIZE
            for { count := sub(count, 1) } gt(count, MOST) { count := sub(count, MOST) } {
                let code := mload(add(mload(add(file, 0x20)), mul(32, MOST)))
                mstore(target, or(and(mload(target), FIRST_BYTE), shr(bits, or(text, shr(size, code)))))
                bits := add(bits, add(size, and(code, 0xff)))
                target := add(target, shr(3, bits))
                bits := and(bits, 7)
                text := 0
                size := 0
            }
            let code := mload(add(mload(add(file, 0x20)), shl(5, count)))
            // the lowest byte of the code is shifted out, or lies behind the used bits
            mstore(target, or(and(mload(target), FIRST_BYTE), shr(bits, or(text, shr(size, code)))))
            bits := add(bits, add(size, and(code, 0xff)))
            mstore(stream, add(target, shr(3, bits)))
            mstore(add(stream, 0x20), and(bits, 7))
        }
    }

    /// @dev Returns the codes of matches that repeat 0 to MOST pixels, one word each: the code in the uppermost bits, its size in the
    /// lowest.
    function codes() private pure returns (uint256 table) {
        unchecked {
            bytes memory tables = AlphaCode.tables();
            assembly ("memory-safe") {
                table := mload(0x40)
                mstore(0x40, add(table, mul(32, add(MOST, 1))))
                mstore(table, 0)
                for { let i := 1 } lt(i, add(MOST, 1)) { i := add(i, 1) } {
                    let code := shr(232, mload(add(add(tables, 29), mul(3, i))))
                    let size := and(code, 31)
                    mstore(add(table, shl(5, i)), or(shl(sub(256, size), shr(5, code)), size))
                }
            }
        }
    }
}
