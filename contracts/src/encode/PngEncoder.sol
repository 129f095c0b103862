// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Png} from "./Png.sol";
import {PngErrors} from "./PngErrors.sol";

/// @title PngEncoder: PNG files of the renderer's bitmaps, for the Studio and all contracts that would rather call than carry the code.
contract PngEncoder is PngErrors {
    /// @notice A PNG file of a bitmap, each pixel a square of `scale` pixels, 1..8.
    function encode(bytes memory bmp, uint256 scale) external pure returns (bytes memory) {
        return Png.encode(bmp, scale);
    }

    /// @notice The same as a `data:` URI.
    function dataURI(bytes memory bmp, uint256 scale) external pure returns (string memory) {
        return Png.dataURI(bmp, scale);
    }
}
