// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Seed, Tag, Random} from "./Random.sol";
import {Hsv} from "./Hsv.sol";

uint256 constant ACCENTUATED = 0;
uint256 constant EMERGENT = 1;
uint256 constant SUNSET = 2;
uint256 constant STONE_AND_GOLD = 3;
uint256 constant DENATURED = 4;
uint256 constant CHAMELEONIC = 5;
uint256 constant GRADIATED = 6;
uint256 constant VIVID_ALABASTER = 7;
uint256 constant VIVID_INK = 8;
uint256 constant PIGMENTED = 9;

// The directions of a gradient.
uint256 constant RIGHT = 0;
uint256 constant LEFT = 1;
uint256 constant UP = 2;
uint256 constant DOWN = 3;

// The selection of highlights: at random, or the prisms with the largest or the smallest keys.
uint256 constant RANDOM = 0;
uint256 constant LARGEST = 1;
uint256 constant SMALLEST = 2;

// The keys.
uint256 constant RADIUS = 0;
uint256 constant CENTER_X = 1;
uint256 constant CENTER_Y = 2;

/// @notice The colouring of prisms. Colours are 0xRRGGBB.
/// @param start The first colour of the gradient.
/// @param end The last colour of the gradient.
/// @param across Whether the gradient spans the whole piece, rather than each triangle.
/// @param direction The direction of the gradient.
/// @param jiggle The means of the offsets of hue, saturation and value, one byte each.
/// @param byVertex Whether each vertex of a prism has its own offsets.
/// @param shift The decrease of brightness at the far end.
struct Paint {
    uint256 start;
    uint256 end;
    bool across;
    uint256 direction;
    uint256 jiggle;
    bool byVertex;
    int256 shift;
}

/// @notice The colours of a piece.
/// @param index The number of the scheme.
/// @param primary The colouring of most prisms.
/// @param highlight The colouring of the highlighted prisms.
/// @param count The number of highlighted prisms.
/// @param select The selection of highlights.
/// @param key The key of the selection.
/// @param top The background at the top.
/// @param bottom The background at the bottom.
struct Scheme {
    uint256 index;
    Paint primary;
    Paint highlight;
    uint256 count;
    uint256 select;
    uint256 key;
    uint256 top;
    uint256 bottom;
}

/// @title Schemes: the colour schemes of pieces.
library Schemes {
    using Random for Seed;

    /// @dev The largest number of 0..10,000 that yields each scheme but the last, 16 bits each, the first in the lowest.
    uint256 private constant BOUNDS = (9500 << 128) | (8000 << 112) | (6500 << 96) | (6000 << 80) | (5500 << 64) | (3100 << 48)
        | (3000 << 32) | (2500 << 16) | 1500;

    Tag private constant KIND = Tag.wrap(bytes32("schemedId") | bytes32(uint256(9)));
    Tag private constant HUE = Tag.wrap(bytes32("hsv") | bytes32(uint256(3)));
    Tag private constant PRIMARY = Tag.wrap(bytes32("pri") | bytes32(uint256(3)));
    Tag private constant PRIMARY_EMERGENT = Tag.wrap(bytes32("priDir") | bytes32(uint256(6)));
    // sic
    Tag private constant PRIMARY_STONE = Tag.wrap(bytes32("pirDir") | bytes32(uint256(6)));
    Tag private constant HIGHLIGHT = Tag.wrap(bytes32("hlt") | bytes32(uint256(3)));
    Tag private constant HIGHLIGHT_DIRECTION = Tag.wrap(bytes32("hltDir") | bytes32(uint256(6)));
    Tag private constant COUNT = Tag.wrap(bytes32("hltNum") | bytes32(uint256(6)));
    Tag private constant SELECT = Tag.wrap(bytes32("hltSel") | bytes32(uint256(6)));
    Tag private constant KEY = Tag.wrap(bytes32("hltVar") | bytes32(uint256(6)));

    /// @param prisms The number of prisms of the piece.
    function choose(Seed seed, uint256 prisms) internal pure returns (Scheme memory scheme) {
        unchecked {
            int256 value = seed.draw(KIND, 0, 10000);
            while (scheme.index != PIGMENTED && value > int256((BOUNDS >> 16 * scheme.index) & 0xffff)) ++scheme.index;
            if (scheme.index == ACCENTUATED) accentuated(scheme, seed);
            else if (scheme.index == EMERGENT) emergent(scheme, seed);
            else if (scheme.index == SUNSET) sunset(scheme, seed, prisms);
            else if (scheme.index == STONE_AND_GOLD) stoneAndGold(scheme, seed);
            else if (scheme.index <= GRADIATED) drawn(scheme, seed, prisms);
            else if (scheme.index <= VIVID_INK) vivid(scheme, seed, prisms);
            else pigmented(scheme, seed, prisms);
        }
    }

    function name(uint256 index) internal pure returns (string memory) {
        if (index == ACCENTUATED) return "Accentuated";
        if (index == EMERGENT) return "Emergent";
        if (index == SUNSET) return "Sunset";
        if (index == STONE_AND_GOLD) return "Stone & Gold";
        if (index == DENATURED) return "Denatured";
        if (index == CHAMELEONIC) return "Chameleonic";
        if (index == GRADIATED) return "Gradiated";
        if (index == VIVID_ALABASTER) return "Vivid Alabaster";
        if (index == VIVID_INK) return "Vivid Ink";
        return "Pigmented";
    }

    function accentuated(Scheme memory scheme, Seed seed) private pure {
        scheme.primary = Paint(0x3c1e19, 0xcdcdcd, true, RIGHT, 0x0d0d0d, false, 205);
        scheme.highlight = Paint(0xff0000, 0xff3200, false, direction(seed, HIGHLIGHT_DIRECTION, 0, 3), 0x323232, false, 205);
        (scheme.count, scheme.select) = (uint256(seed.draw(COUNT, 3, 5)), LARGEST);
        (scheme.top, scheme.bottom) = (0x000000, 0x010101);
    }

    function emergent(Scheme memory scheme, Seed seed) private pure {
        scheme.primary = Paint(0x004dff, 0x00ff19, false, direction(seed, PRIMARY_EMERGENT, 2, 3), 0x3c3c3c, false, -255);
        scheme.highlight = Paint(0x004dff, 0x00ff19, false, DOWN, 0x3c3c3c, false, -255);
        (scheme.count, scheme.select) = (uint256(seed.draw(COUNT, 4, 6)), SMALLEST);
        (scheme.top, scheme.bottom) = (0xffffff, 0xffffff);
    }

    function sunset(Scheme memory scheme, Seed seed, uint256 prisms) private pure {
        unchecked {
            scheme.primary = Paint(0xb300b3, 0x0000ff, true, UP, 0x191919, true, 127);
            scheme.highlight = Paint(0x000000, 0x000000, false, RIGHT, 0x0f000f, true, 0);
            int256 most = prisms > 8 ? int256(prisms) - 8 : int256(0);
            (scheme.count, scheme.select) = (uint256(seed.draw(COUNT, most > 2 ? most - 2 : int256(0), most)), SMALLEST);
            (scheme.top, scheme.bottom) = (0xfa67f7, 0x9d68fa);
        }
    }

    function stoneAndGold(Scheme memory scheme, Seed seed) private pure {
        uint256 way = direction(seed, PRIMARY_STONE, 0, 1);
        scheme.primary = Paint(0x323232, 0x646464, false, way, 0x0a0a0a, true, 128);
        scheme.highlight = Paint(0xffc500, 0xff7e00, false, way, 0, false, 64);
        (scheme.count, scheme.select) = (1, LARGEST);
    }

    /// @dev Denatured, Chameleonic and Gradiated: random colours.
    function drawn(Scheme memory scheme, Seed seed, uint256 prisms) private pure {
        unchecked {
            uint256 way = direction(seed, PRIMARY, 0, scheme.index == CHAMELEONIC ? int256(3) : int256(1));
            Paint memory primary = scheme.primary;
            Paint memory highlight = scheme.highlight;
            (primary.start, primary.end) = (color(seed, "PA"), color(seed, "PB"));
            (highlight.start, highlight.end) = (color(seed, "HA"), color(seed, "HB"));
            (primary.direction, highlight.direction) = (way, way ^ 1);
            (scheme.count, scheme.select) = (12, SMALLEST);
            (scheme.top, scheme.bottom) = (0x030303, 0x000000);
            if (scheme.index == DENATURED) {
                highlight.direction = direction(seed, HIGHLIGHT, 0, 1);
                (primary.across, highlight.across) = (true, true);
                (primary.shift, highlight.shift) = (127, 127);
                scheme.count = prisms / 2;
            } else if (scheme.index == CHAMELEONIC) {
                (primary.jiggle, highlight.jiggle) = (0x191919, 0xffffff);
                (primary.byVertex, highlight.byVertex) = (true, true);
                highlight.shift = 205;
            } else {
                (primary.across, highlight.across) = (true, true);
                (primary.jiggle, highlight.jiggle) = (0x7f7f7f, 0x7f7f7f);
                (primary.shift, highlight.shift) = (205, 205);
            }
        }
    }

    /// @dev Vivid Alabaster and Vivid Ink: white or black prisms, highlights and a background of one hue.
    function vivid(Scheme memory scheme, Seed seed, uint256 prisms) private pure {
        unchecked {
            int256 hue = seed.draw(HUE, 0, 255);
            if (scheme.index == VIVID_ALABASTER) {
                uint256 light = hsv(hue, 230, 255);
                scheme.primary = Paint(0xffffff, 0xffffff, false, RIGHT, 0x191919, true, 127);
                scheme.highlight = Paint(light, light, false, RIGHT, 0x193232, true, 180);
            } else {
                uint256 dark = hsv(hue, 245, 190);
                scheme.primary = Paint(0x000000, 0x000000, false, RIGHT, 0x191919, false, -60);
                scheme.highlight = Paint(dark, dark, false, RIGHT, 0, false, -60);
                scheme.key = uint256(seed.draw(KEY, 0, 2));
            }
            (scheme.count, scheme.select) = ((prisms + 1) / 2, uint256(seed.draw(SELECT, 0, 2)));
            // nine units to either side, on a circle of 255
            (scheme.top, scheme.bottom) = (hsv((hue + 246) % 255, 105, 255), hsv((hue + 9) % 255, 105, 255));
        }
    }

    function pigmented(Scheme memory scheme, Seed seed, uint256 prisms) private pure {
        unchecked {
            scheme.primary = Paint(0x321e19, 0xcdcdcd, true, RIGHT, 0x0d0d0d, false, 205);
            scheme.highlight = Paint(0xff0000, 0xff3200, false, direction(seed, HIGHLIGHT_DIRECTION, 0, 3), 0xff3232, false, 205);
            (scheme.count, scheme.select) = (prisms / 3, LARGEST);
            (scheme.top, scheme.bottom) = (0x000000, 0x070707);
        }
    }

    function direction(Seed seed, Tag tag, int256 low, int256 high) private pure returns (uint256) {
        return uint256(seed.draw(tag, low, high));
    }

    /// @dev Returns a random colour. The tags of its channels are the two letters followed by R, G or B.
    function color(Seed seed, bytes2 letters) private pure returns (uint256) {
        unchecked {
            return (channel(seed, letters, "R") << 16) | (channel(seed, letters, "G") << 8) | channel(seed, letters, "B");
        }
    }

    function channel(Seed seed, bytes2 letters, bytes1 letter) private pure returns (uint256) {
        return uint256(seed.draw(Tag.wrap(letters | (bytes32(letter) >> 16) | bytes32(uint256(3))), 25, 255));
    }

    function hsv(int256 hue, int256 saturation, int256 value) private pure returns (uint256) {
        unchecked {
            (int256 red, int256 green, int256 blue) = Hsv.toRgb(hue, saturation, value);
            return uint256((red << 16) | (green << 8) | blue);
        }
    }
}
