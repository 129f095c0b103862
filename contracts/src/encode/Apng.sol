// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Crc32} from "./Crc32.sol";

/// @notice Animated PNG files, made of PNG files of one size: the first shows where animations are unknown.
/// @dev Source: PNG, third edition (W3C), the chunks acTL, fcTL and fdAT. The PNG files are those of `Png.compress`: their pixels are in
/// one chunk IDAT, behind the chunk IHDR, and checksums are missing.
library Apng {
    /// @dev Where the chunk IHDR of a PNG file begins, the bytes of its data, and where the data of the chunk IDAT begin.
    uint256 private constant IHDR = 8;
    uint256 private constant IHDR_SIZE = 13;
    uint256 private constant DATA = 41;
    /// @dev What stands behind those: a checksum and the chunk IEND.
    uint256 private constant IEND = 12;
    uint256 private constant TAIL = 16;
    /// @dev Size and name of chunks.
    uint256 private constant AC_TL = 0x000000086163544c;
    uint256 private constant FC_TL = 0x0000001a6663544c;
    uint256 private constant ID_AT = 0x49444154;
    uint256 private constant FD_AT = 0x66644154;
    /// @dev The denominator of delays.
    uint256 private constant MILLISECONDS = 1000;

    /// @notice Writes what precedes the first frame. The animation is repeated for ever.
    /// @param target Where; the PNG file may not begin before 64 bytes behind it.
    /// @param png The first frame.
    /// @return end The address behind what was written.
    function begin(uint256 target, bytes memory png, uint256 frames) internal pure returns (uint256 end) {
        unchecked {
            assembly ("memory-safe") {
                mcopy(target, add(png, 32), DATA)
            }
            end = writeSum(target + IHDR, IHDR_SIZE);
            assembly ("memory-safe") {
                // the last word is how often it is repeated, 0 being for ever
                mstore(end, or(shl(192, AC_TL), shl(160, frames)))
            }
            return writeSum(end, 8);
        }
    }

    /// @notice Writes a frame.
    /// @param target Where; the PNG file may not begin before 64 bytes behind it.
    /// @param png The frame as a file, which may be overwritten.
    /// @param number Of the frame, from 0.
    /// @param delay How long it is shown, in milliseconds.
    /// @return end The address behind what was written.
    function frame(uint256 target, bytes memory png, uint256 number, uint256 delay) internal pure returns (uint256 end) {
        unchecked {
            uint256 size = png.length - DATA - TAIL;
            // fcTL and fdAT are numbered together; the first frame has no fdAT
            uint256 sequence = number == 0 ? 0 : 2 * number - 1;
            assembly ("memory-safe") {
                let sides := shr(192, mload(add(png, 48)))
                // at the top left corner, in place of what was there
                mstore(target, or(or(shl(192, FC_TL), shl(160, sequence)), or(shl(96, sides), or(shl(16, delay), MILLISECONDS))))
                mstore(add(target, 32), 0)
            }
            target = writeSum(target, 26);
            // the data, with their number in front of them if they are not of the first frame
            uint256 more = number == 0 ? 0 : 4;
            uint256 head = ((size + more) << 64) | ((number == 0 ? ID_AT : FD_AT) << 32) | (sequence + 1);
            assembly ("memory-safe") {
                mcopy(add(add(target, 8), more), add(png, add(32, DATA)), size)
                // the last four bytes are the data's if there is no number
                let kept := sub(256, shl(3, add(8, more)))
                mstore(target, or(shl(kept, shr(shl(3, sub(4, more)), head)), shr(sub(256, kept), shl(sub(256, kept), mload(target)))))
            }
            return writeSum(target, size + more);
        }
    }

    /// @notice Writes what follows the last frame: the chunk IEND.
    /// @return end The address behind it.
    function finish(uint256 target) internal pure returns (uint256 end) {
        unchecked {
            assembly ("memory-safe") {
                mstore(target, 0x0000000049454e44ae4260820000000000000000000000000000000000000000)
            }
            return target + IEND;
        }
    }

    /// @dev Writes the sum of a chunk that has so many bytes of data; the address behind it.
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
