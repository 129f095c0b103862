// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

/// @title PngErrors: the errors of PNG encoding.
interface PngErrors {
    /// @notice The bytes are not a bitmap as the renderer returns it.
    error NotABitmap();
    /// @notice The enlargement must be 1 to `largest`.
    error PixelScaleOutOfRange(uint256 scale, uint256 largest);
    /// @notice The bitmaps over black and over white differ in size.
    error SizesDiffer(uint256 width, uint256 height, uint256 otherWidth, uint256 otherHeight);
}
