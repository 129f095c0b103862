// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

// A Windows bitmap of 24 bits per pixel: a header, then the rows from the bottom, each padded to a multiple of 4 bytes. Source: Microsoft,
// BITMAPFILEHEADER and BITMAPINFOHEADER.

library Bmp {
    uint256 internal constant HEADER = 54;

    /// @notice Returns the size of a row in the file, in bytes.
    function stride(uint256 width) internal pure returns (uint256) {
        unchecked {
            return (3 * width + 3) & ~uint256(3);
        }
    }

    /// @notice Converts rows of pixels without padding to a file.
    /// @param image The address of the rows. There must be room for HEADER bytes before it, and for the padding after it.
    /// @return size The size of the file in bytes. It begins HEADER bytes before the image.
    function finish(uint256 image, uint256 width, uint256 height) internal pure returns (uint256 size) {
        unchecked {
            uint256 rowBytes = 3 * width;
            uint256 fileRowBytes = stride(width);
            if (rowBytes != fileRowBytes) {
                for (uint256 row = height; row-- != 0;) spreadRow(image, row, rowBytes, fileRowBytes);
            }
            size = fileRowBytes * height;
            // 24 bits per pixel, 2835 pixels per metre (72 dots per inch)
            uint256 first = (0x424d << 240) | (littleEndian(size + HEADER) << 208) | (littleEndian(HEADER) << 144)
                | (littleEndian(40) << 112) | (littleEndian(width) << 80) | (littleEndian(height) << 48) | 0x010018000000;
            uint256 second = (littleEndian(size) << 128) | (littleEndian(2835) << 96) | (littleEndian(2835) << 64);
            size += HEADER;
            assembly ("memory-safe") {
                // bytes 22 to 53; the first ten of them are also in the first word
                mstore(sub(image, 32), second)
                mstore(sub(image, 54), first)
            }
        }
    }

    /// @dev Moves a row to its place in the file and clears the padding after it.
    function spreadRow(uint256 image, uint256 row, uint256 rowBytes, uint256 fileRowBytes) private pure {
        assembly ("memory-safe") {
            let target := add(image, mul(row, fileRowBytes))
            mcopy(target, add(image, mul(row, rowBytes)), rowBytes)
            for { let gap := add(target, rowBytes) } lt(gap, add(target, fileRowBytes)) { gap := add(gap, 1) } { mstore8(gap, 0) }
        }
    }

    /// @dev Returns four bytes in reverse order.
    function littleEndian(uint256 value) internal pure returns (uint256) {
        return (value & 0xff) << 24 | (value & 0xff00) << 8 | (value & 0xff0000) >> 8 | value >> 24;
    }
}
