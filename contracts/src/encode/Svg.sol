// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Base64} from "./Base64.sol";
import {Text} from "./Text.sol";

/// @notice Writes bitmaps as text: a `data:` URI, or an SVG document that shows each pixel as a square at any size.
library Svg {
    /// @notice Writes the `data:` URI of a bitmap.
    function writeUri(uint256 target, uint256 file, uint256 size) internal pure returns (uint256) {
        return Base64.encode(file, size, Text.write(target, "data:image/bmp;base64,"));
    }

    /// @notice Writes an SVG document that contains a bitmap of `width` by `height` pixels.
    function write(uint256 target, uint256 file, uint256 size, uint256 width, uint256 height) internal pure returns (uint256) {
        target = Text.write(target, '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ');
        target = Text.writeNumber(target, width);
        target = Text.write(target, " ");
        target = Text.writeNumber(target, height);
        target = Text.write(target, '"><image width="');
        target = Text.writeNumber(target, width);
        target = Text.write(target, '" height="');
        target = Text.writeNumber(target, height);
        target = Text.write(target, '" style="image-rendering:pixelated" href="');
        target = writeUri(target, file, size);
        return Text.write(target, '"/></svg>');
    }
}
