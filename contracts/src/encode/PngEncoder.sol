// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {answer} from "./Redirect.sol";
import {Png} from "./Png.sol";
import {PngErrors} from "../interfaces/PngErrors.sol";
import {TransparentPng} from "./TransparentPng.sol";

/// @title PngEncoder: encodes the renderer's bitmaps as PNG files, for the Studio and for contracts that do not include the code.
contract PngEncoder is PngErrors {
    /// @notice Returns a PNG file of a bitmap, each pixel enlarged to a square of `scale` x `scale` pixels, 1..8.
    function encode(bytes calldata bmp, uint256 scale) external pure returns (bytes memory) {
        answer(Png.encode(bmp, scale));
    }

    /// @notice Returns the PNG file without the length of its data, the checksums of its chunks and the IEND chunk, for containers that
    /// write their own: `Apng`.
    function compress(bytes calldata bmp, uint256 scale) external pure returns (bytes memory) {
        answer(Png.compress(bmp, scale));
    }

    /// @notice Returns the PNG file as a `data:` URI.
    function dataURI(bytes calldata bmp, uint256 scale) external pure returns (string memory) {
        answer(bytes(Png.dataURI(bmp, scale)));
    }

    /// @notice Returns a PNG file with an alpha channel instead of a background, from two drawings of a scene; each pixel enlarged to a
    /// square of `scale` x `scale` pixels, 1..8. `Studio.drawTransparentPNG` makes both drawings.
    /// @param black The bitmap over a black background.
    /// @param white The bitmap over a white background.
    function encodeTransparent(bytes calldata black, bytes calldata white, uint256 scale) external pure returns (bytes memory) {
        answer(TransparentPng.encode(black, white, scale));
    }

    /// @notice Returns the PNG file with an alpha channel as a `data:` URI.
    function transparentDataURI(bytes calldata black, bytes calldata white, uint256 scale) external pure returns (string memory) {
        answer(bytes(TransparentPng.dataURI(black, white, scale)));
    }

    /// @notice Returns an SVG document that contains the PNG file and shows each pixel of the bitmap as a square without smoothing.
    function svg(bytes calldata bmp, uint256 scale) external pure returns (string memory) {
        answer(bytes(Png.svg(bmp, scale)));
    }
}
