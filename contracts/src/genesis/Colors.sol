// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {IGenesis} from "../interfaces/IGenesis.sol";
import {Elements} from "./Elements.sol";
import {Seed, Tag, Random} from "./Random.sol";
import {Hsv} from "./Hsv.sol";
import {Prisms} from "./Prisms.sol";
import {Paint, Scheme, LEFT, UP, DOWN, RANDOM, LARGEST, RADIUS, CENTER_X} from "./Schemes.sol";

/// @title Colors: the colours of all vertices, from a gradient and random offsets of hue, saturation and value.
library Colors {
    using Random for Seed;
    using Elements for int256[];

    Tag private constant NONE = Tag.wrap(0);
    Tag private constant JIGGLE_HUE = Tag.wrap(bytes32("0") | bytes32(uint256(1)));
    Tag private constant JIGGLE_SATURATION = Tag.wrap(bytes32("1") | bytes32(uint256(1)));
    Tag private constant JIGGLE_VALUE = Tag.wrap(bytes32("2") | bytes32(uint256(1)));

    /// @dev Hue, saturation and value.
    struct Hue {
        int256 hue;
        int256 saturation;
        int256 value;
    }

    /// @return colors 0xRRGGBB for each vertex, in the order of the vertices.
    function paint(Seed seed, Scheme memory scheme, Prisms memory prisms) internal pure returns (uint256[] memory colors) {
        unchecked {
            uint256 count = prisms.flatX.length;
            colors = new uint256[](6 * count);
            uint256 chosen = highlights(seed, scheme, prisms);
            // these random numbers do not depend on the prism: all prisms of a kind have the same offsets
            Hue[6] memory plain = offsets(seed, scheme.primary);
            Hue[6] memory special;
            if (chosen != 0) special = offsets(seed, scheme.highlight);
            for (uint256 k; k != count; ++k) {
                bool isChosen = (chosen >> k) & 1 == 1;
                paintPrism(isChosen ? scheme.highlight : scheme.primary, isChosen ? special : plain, prisms, k, colors);
            }
        }
    }

    /// @dev Returns the set of highlighted prisms: bit k for prism k.
    function highlights(Seed seed, Scheme memory scheme, Prisms memory prisms) private pure returns (uint256 chosen) {
        unchecked {
            uint256 total = prisms.flatX.length;
            uint256 count = scheme.count < total ? scheme.count : total;
            if (count == 0) return 0;
            if (scheme.select == RANDOM) {
                if (total == 1) revert IGenesis.NoPrismToChoose();
                for (uint256 i; i != count; ++i) chosen |= 1 << (seed.hash(NONE, i, 0, 1) % (total - 1));
                return chosen;
            }
            int256[] memory keys =
                scheme.key == RADIUS ? prisms.flatRadius : scheme.key == CENTER_X ? prisms.flatX : prisms.flatY;
            // ties are resolved by the index: no two keys are equal from here on
            for (uint256 k = 1; k != total; ++k) {
                keys.put(k, (scheme.select == LARGEST ? -keys.get(k) : keys.get(k)) * 16 + int256(k));
            }
            // the first prism always comes first
            chosen = 1;
            for (uint256 k = 1; k != total; ++k) {
                int256 key = keys.get(k);
                uint256 before = 1;
                for (uint256 i = 1; i != total; ++i) if (keys.get(i) < key) ++before;
                if (before < count) chosen |= 1 << k;
            }
        }
    }

    /// @dev Returns the offsets at each vertex of a prism.
    function offsets(Seed seed, Paint memory how) private pure returns (Hue[6] memory found) {
        unchecked {
            uint256 jiggle = how.jiggle;
            if (jiggle == 0) return found;
            uint256 word;
            for (uint256 i; i != 6; ++i) {
                if (i != 0 && !how.byVertex) {
                    found[i] = found[0];
                    continue;
                }
                Hue memory offset = found[i];
                offset.hue = seed.draw(JIGGLE_HUE, word, 0, int256(2 * (jiggle >> 16)));
                offset.saturation = seed.draw(JIGGLE_SATURATION, word, 0, int256(2 * ((jiggle >> 8) & 0xff)));
                offset.value = seed.draw(JIGGLE_VALUE, word, 0, int256(2 * (jiggle & 0xff)));
                word = uint256(offset.hue);
            }
        }
    }

    function paintPrism(Paint memory how, Hue[6] memory added, Prisms memory prisms, uint256 k, uint256[] memory colors) private pure {
        unchecked {
            // the coordinates along the gradient
            int256[] memory values = how.direction < UP ? prisms.x : prisms.y;
            (int256 low, int256 high) = how.across ? (-prisms.half[how.direction >> 1], prisms.half[how.direction >> 1]) : range(values, k);
            if (!how.across && (how.direction == LEFT || how.direction == DOWN)) (low, high) = (high, low);
            for (uint256 i; i != 3; ++i) {
                int256 part = high == low ? int256(1) : (values.get(6 * k + 3 + i) - low) * 1000 / (high - low);
                (int256 hue, int256 saturation, int256 value) =
                    Hsv.fromRgb(mix(how, 16, part), mix(how, 8, part), mix(how, 0, part));
                colors[6 * k + i] = colorOf(hue, saturation, value, added[i], how.shift);
                colors[6 * k + 3 + i] = colorOf(hue, saturation, value, added[3 + i], 0);
            }
        }
    }

    /// @dev Returns the minimum and maximum coordinate at the near end of a prism.
    function range(int256[] memory values, uint256 k) private pure returns (int256 low, int256 high) {
        unchecked {
            (int256 a, int256 b, int256 c) = (values.get(6 * k + 3), values.get(6 * k + 4), values.get(6 * k + 5));
            (low, high) = a < b ? (a, b) : (b, a);
            if (c < low) low = c;
            if (c > high) high = c;
        }
    }

    /// @dev Returns a channel of the gradient, extrapolated beyond its ends, but not below 0.
    function mix(Paint memory how, uint256 shift, int256 part) private pure returns (int256 channel) {
        unchecked {
            int256 start = int256((how.start >> shift) & 0xff);
            int256 end = int256((how.end >> shift) & 0xff);
            channel = start + (end - start) * part / 1000;
            if (channel < 0) channel = 0;
        }
    }

    function colorOf(int256 hue, int256 saturation, int256 value, Hue memory added, int256 shift) private pure returns (uint256) {
        unchecked {
            (int256 red, int256 green, int256 blue) =
                Hsv.toRgb(clamp(hue + added.hue), clamp(saturation + added.saturation), clamp(value + added.value));
            return uint256((clamp(red - shift) << 16) | (clamp(green - shift) << 8) | clamp(blue - shift));
        }
    }

    function clamp(int256 value) private pure returns (int256) {
        return value < 0 ? int256(0) : value > 255 ? int256(255) : value;
    }
}
