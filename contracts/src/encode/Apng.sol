// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Crc32} from "./Crc32.sol";

/// @notice Assembles animated PNG files from PNG files of one size. Viewers without support for animations show the first frame.
/// @dev Source: PNG, third edition (W3C), the chunks acTL, fcTL and fdAT. The PNG files are those of `Png.compress`: their pixels are in
/// one IDAT chunk after the IHDR chunk, and the checksums are missing.
library Apng {
    /// @dev The offset of the IHDR chunk in a PNG file, the size of its data, and the offset of the IDAT chunk's data.
    uint256 private constant IHDR = 8;
    uint256 private constant IHDR_SIZE = 13;
    uint256 private constant DATA = 41;
    /// @dev The size of the checksum and the IEND chunk behind the data.
    uint256 private constant IEND = 12;
    uint256 private constant TAIL = 16;
    /// @dev Sizes and names of chunks.
    uint256 private constant AC_TL = 0x000000086163544c;
    uint256 private constant FC_TL = 0x0000001a6663544c;
    uint256 private constant ID_AT = 0x49444154;
    uint256 private constant FD_AT = 0x66644154;
    /// @dev The denominator of delays.
    uint256 private constant MILLISECONDS = 1000;

    /// @notice Writes everything before the first frame. The animation loops endlessly.
    /// @param target The address to write to, at least 64 bytes before the PNG file.
    /// @param png The first frame.
    /// @return end The address after the written bytes.
    function begin(uint256 target, bytes memory png, uint256 frames) internal pure returns (uint256 end) {
        unchecked {
            assembly ("memory-safe") {
                mcopy(target, add(png, 32), DATA)
            }
            end = writeSum(target + IHDR, IHDR_SIZE);
            assembly ("memory-safe") {
                // the last word is the number of loops; 0 loops endlessly
                mstore(end, or(shl(192, AC_TL), shl(160, frames)))
            }
            return writeSum(end, 8);
        }
    }

    /// @notice Writes a frame.
    /// @param target The address to write to, at least 64 bytes before the PNG file.
    /// @param png The frame as a PNG file, which may be overwritten.
    /// @param number The number of the frame, from 0.
    /// @param delay The duration of the frame in milliseconds.
    /// @return end The address after the written bytes.
    function frame(uint256 target, bytes memory png, uint256 number, uint256 delay) internal pure returns (uint256 end) {
        unchecked {
            uint256 size = png.length - DATA - TAIL;
            // fcTL and fdAT chunks are numbered together; the first frame has no fdAT
            uint256 sequence = number == 0 ? 0 : 2 * number - 1;
            assembly ("memory-safe") {
                let sides := shr(192, mload(add(png, 48)))
                // replaces the whole canvas
                mstore(target, or(or(shl(192, FC_TL), shl(160, sequence)), or(shl(96, sides), or(shl(16, delay), MILLISECONDS))))
                mstore(add(target, 32), 0)
            }
            target = writeSum(target, 26);
            // the data, preceded by its sequence number except for the first frame
            uint256 more = number == 0 ? 0 : 4;
            uint256 head = ((size + more) << 64) | ((number == 0 ? ID_AT : FD_AT) << 32) | (sequence + 1);
            assembly ("memory-safe") {
                mcopy(add(add(target, 8), more), add(png, add(32, DATA)), size)
                // without a sequence number, the last four bytes belong to the data
                let kept := sub(256, shl(3, add(8, more)))
                mstore(target, or(shl(kept, shr(shl(3, sub(4, more)), head)), shr(sub(256, kept), shl(sub(256, kept), mload(target)))))
            }
            return writeSum(target, size + more);
        }
    }

    /// @notice Writes the end of the file: the IEND chunk.
    /// @return end The address after it.
    function finish(uint256 target) internal pure returns (uint256 end) {
        unchecked {
            assembly ("memory-safe") {
                mstore(target, 0x0000000049454e44ae4260820000000000000000000000000000000000000000)
            }
            return target + IEND;
        }
    }

    /// @dev Writes the checksum of a chunk with `size` bytes of data, and returns the address after it.
    function writeSum(uint256 chunk, uint256 size) private pure returns (uint256 end) {
        unchecked {
            uint256 sum = Crc32.sum(chunk + 4, size + 4);
            end = chunk + size + 12;
            assembly ("memory-safe") {
                let place := sub(end, 32)
                mstore(place, or(shl(32, shr(32, mload(place))), sum))
            }
        }
    }
}
