// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {PngErrors} from "../encode/PngErrors.sol";

/// @title IPngEncoder: PNG files of the renderer's bitmaps.
interface IPngEncoder is PngErrors {
    /// @notice A PNG file of a bitmap, each pixel a square of `scale` pixels, 1..8.
    function encode(bytes calldata bmp, uint256 scale) external pure returns (bytes memory);

    /// @notice The PNG file without the size of its data, the checksums of its chunks and the chunk IEND, for other files that have those:
    /// `Apng`.
    function compress(bytes calldata bmp, uint256 scale) external pure returns (bytes memory);

    /// @notice The PNG file as a `data:` URI.
    function dataURI(bytes calldata bmp, uint256 scale) external pure returns (string memory);

    /// @notice A PNG file with an alpha channel in place of a background, of a scene that is drawn twice; each pixel a square of `scale`
    /// pixels, 1..8. `Studio.drawTransparentPNG` has it drawn.
    /// @param black Its bitmap over a black background.
    /// @param white Its bitmap over a white background.
    function encodeTransparent(bytes calldata black, bytes calldata white, uint256 scale) external pure returns (bytes memory);

    /// @notice The same as a `data:` URI.
    function transparentDataURI(bytes calldata black, bytes calldata white, uint256 scale) external pure returns (string memory);

    /// @notice An SVG document that holds the PNG file, and shows each pixel of the bitmap as a square without smoothing.
    function svg(bytes calldata bmp, uint256 scale) external pure returns (string memory);
}
