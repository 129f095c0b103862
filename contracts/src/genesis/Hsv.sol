// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

/// @title Hsv: hue, saturation and value, 0..255 each, with truncating divisions.
library Hsv {
    /// @notice Converts a colour with channels of at least 0; if one exceeds 255, the value may, too.
    function fromRgb(int256 red, int256 green, int256 blue) internal pure returns (int256 hue, int256 saturation, int256 value) {
        unchecked {
            red = red * 1000 / 255;
            green = green * 1000 / 255;
            blue = blue * 1000 / 255;
            int256 most = red > green ? red : green;
            if (blue > most) most = blue;
            int256 least = red < green ? red : green;
            if (blue < least) least = blue;
            int256 spread = most - least;
            if (spread != 0) {
                int256 sextant;
                if (most == red) sextant = (green - blue) * 1000 / spread;
                else if (most == green) sextant = (blue - red) * 1000 / spread + 2000;
                else sextant = (red - green) * 1000 / spread + 4000;
                if (sextant < 0) sextant += 6000;
                hue = 60 * sextant / 360 * 255 / 1000;
                saturation = spread * 1000 / most * 255 / 1000;
            }
            value = most * 255 / 1000;
        }
    }

    /// @notice Converts numbers from 0 to 255; hue 255 equals hue 0.
    function toRgb(int256 hue, int256 saturation, int256 value) internal pure returns (int256 red, int256 green, int256 blue) {
        unchecked {
            int256 sixth = 6 * (hue % 255 * 1000 / 255);
            saturation = saturation * 1000 / 255;
            value = value * 1000 / 255;
            int256 chroma = value * saturation / 1000;
            int256 slope = sixth % 2000 - 1000;
            int256 middle = chroma * (1000 - (slope < 0 ? -slope : slope)) / 1000;
            // the common part of all three channels
            int256 base = value - chroma;
            middle = (middle + base) * 255 / 1000;
            chroma = (chroma + base) * 255 / 1000;
            base = base * 255 / 1000;
            if (sixth < 3000) {
                if (sixth < 1000) return (chroma, middle, base);
                return sixth < 2000 ? (middle, chroma, base) : (base, chroma, middle);
            }
            if (sixth < 4000) return (base, middle, chroma);
            return sixth < 5000 ? (middle, base, chroma) : (chroma, base, middle);
        }
    }
}
