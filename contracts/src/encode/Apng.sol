// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Crc32} from "./Crc32.sol";

/// @notice Animated PNG files, made of PNG files of one size: the first shows where animations are unknown.
/// @dev Source: PNG, third edition (W3C), the chunks acTL, fcTL and fdAT. The PNG files are those of `Png`: their pixels are in one chunk
/// IDAT, behind the chunk IHDR.
library Apng {
    /// @dev Where the chunk IDAT of a PNG file begins: behind the signature and the chunk IHDR; and bytes of the chunk IEND.
    uint256 private constant IDAT = 33;
    uint256 private constant IEND = 12;
    /// @dev Size and name of chunks.
    uint256 private constant AC_TL = 0x000000086163544c;
    uint256 private constant FC_TL = 0x0000001a6663544c;
    uint256 private constant FD_AT = 0x66644154;
    /// @dev The denominator of delays.
    uint256 private constant MILLISECONDS = 1000;

    /// @notice Writes what precedes the first frame. The animation is repeated for ever.
    /// @param target Where; the PNG file may not begin before 53 bytes behind it.
    /// @param png The first frame.
    /// @return end The address behind what was written.
    function begin(uint256 target, bytes memory png, uint256 frames) internal pure returns (uint256 end) {
        unchecked {
            assembly ("memory-safe") {
                mcopy(target, add(png, 32), IDAT)
                target := add(target, IDAT)
                // the last word is how often it is repeated, 0 being for ever
                mstore(target, or(shl(192, AC_TL), shl(160, frames)))
            }
            return writeSum(target, 8);
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
            uint256 size = png.length - IDAT - IEND;
            // fcTL and fdAT are numbered together; the first frame has no fdAT
            uint256 sequence = number == 0 ? 0 : 2 * number - 1;
            uint256 source;
            assembly ("memory-safe") {
                source := add(png, 32)
                let sides := shr(192, mload(add(source, 16)))
                // at the top left corner, in place of what was there
                mstore(target, or(or(shl(192, FC_TL), shl(160, sequence)), or(shl(96, sides), or(shl(16, delay), MILLISECONDS))))
                mstore(add(target, 32), 0)
                source := add(source, IDAT)
            }
            target = writeSum(target, 26);
            if (number == 0) {
                assembly ("memory-safe") {
                    mcopy(target, source, size)
                }
                return target + size;
            }
            assembly ("memory-safe") {
                // the data with their number in front of them, in place of size, name and sum
                size := sub(size, 12)
                mcopy(add(target, 12), add(source, 8), size)
                size := add(size, 4)
                let head := or(shl(64, size), or(shl(32, FD_AT), add(sequence, 1)))
                mstore(target, or(shl(160, head), shr(96, shl(96, mload(target)))))
            }
            return writeSum(target, size);
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
