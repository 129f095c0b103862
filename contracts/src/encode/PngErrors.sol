// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

/// @title PngErrors: why there is no PNG file of something.
interface PngErrors {
    /// @notice The bytes are not a bitmap as the renderer makes them.
    error NotABitmap();
    /// @notice Each pixel of a picture can become a square of 1 x 1 to 8 x 8 of a PNG file.
    error PixelScaleOutOfRange(uint256 scale, uint256 largest);
    /// @notice The pictures of a scene over black and over white are not of one size.
    error SizesDiffer(uint256 width, uint256 height, uint256 otherWidth, uint256 otherHeight);
}
