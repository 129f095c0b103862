// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {answer} from "./Forward.sol";
import {Png} from "./Png.sol";
import {PngErrors} from "./PngErrors.sol";
import {TransparentPng} from "./TransparentPng.sol";

/// @title PngEncoder: PNG files of the renderer's bitmaps, for the Studio and all contracts that would rather call than carry the code.
contract PngEncoder is PngErrors {
    /// @notice A PNG file of a bitmap, each pixel a square of `scale` pixels, 1..8.
    function encode(bytes calldata bmp, uint256 scale) external pure returns (bytes memory) {
        answer(Png.encode(bmp, scale));
    }

    /// @notice The PNG file without the size of its data, the checksums of its chunks and the chunk IEND, for other files that have those:
    /// `Apng`.
    function compress(bytes calldata bmp, uint256 scale) external pure returns (bytes memory) {
        answer(Png.compress(bmp, scale));
    }

    /// @notice The PNG file as a `data:` URI.
    function dataURI(bytes calldata bmp, uint256 scale) external pure returns (string memory) {
        answer(bytes(Png.dataURI(bmp, scale)));
    }

    /// @notice A PNG file with an alpha channel in place of a background, of a scene that is drawn twice; each pixel a square of `scale`
    /// pixels, 1..8. `Studio.drawTransparentPNG` has it drawn.
    /// @param black Its bitmap over a black background.
    /// @param white Its bitmap over a white background.
    function encodeTransparent(bytes calldata black, bytes calldata white, uint256 scale) external pure returns (bytes memory) {
        answer(TransparentPng.encode(black, white, scale));
    }

    /// @notice The same as a `data:` URI.
    function transparentDataURI(bytes calldata black, bytes calldata white, uint256 scale) external pure returns (string memory) {
        answer(bytes(TransparentPng.dataURI(black, white, scale)));
    }

    /// @notice An SVG document that holds the PNG file, and shows each pixel of the bitmap as a square without smoothing.
    function svg(bytes calldata bmp, uint256 scale) external pure returns (string memory) {
        answer(bytes(Png.svg(bmp, scale)));
    }
}
