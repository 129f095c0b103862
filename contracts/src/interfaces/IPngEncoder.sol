// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {PngErrors} from "./PngErrors.sol";

/// @title IPngEncoder: encodes the renderer's bitmaps as PNG files.
interface IPngEncoder is PngErrors {
    /// @notice Returns a PNG file of a bitmap, each pixel enlarged to a square of `scale` x `scale` pixels, 1..8.
    function encode(bytes calldata bmp, uint256 scale) external pure returns (bytes memory);

    /// @notice Returns the PNG file without the length of its data, the checksums of its chunks and the IEND chunk, for containers that
    /// write their own: `Apng`.
    function compress(bytes calldata bmp, uint256 scale) external pure returns (bytes memory);

    /// @notice Returns the PNG file as a `data:` URI.
    function dataURI(bytes calldata bmp, uint256 scale) external pure returns (string memory);

    /// @notice Returns a PNG file with an alpha channel instead of a background, from two drawings of a scene; each pixel enlarged to a
    /// square of `scale` x `scale` pixels, 1..8. `Studio.drawTransparentPNG` makes both drawings.
    /// @param black The bitmap over a black background.
    /// @param white The bitmap over a white background.
    function encodeTransparent(bytes calldata black, bytes calldata white, uint256 scale) external pure returns (bytes memory);

    /// @notice Returns the PNG file with an alpha channel as a `data:` URI.
    function transparentDataURI(bytes calldata black, bytes calldata white, uint256 scale) external pure returns (string memory);

    /// @notice Returns an SVG document that contains the PNG file and shows each pixel of the bitmap as a square without smoothing.
    function svg(bytes calldata bmp, uint256 scale) external pure returns (string memory);
}
