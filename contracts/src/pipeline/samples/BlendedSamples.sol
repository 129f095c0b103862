// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {ExactSamples} from "./ExactSamples.sol";
import {Samples} from "./Samples.sol";
import "../../words/Registers.sol";

// Computes the layers of `draw` of picture.py for translucent objects.
// Draws translucent objects with four samples per pixel: the two passes of Spans, for each sample.

/// @dev The lowest byte of each sample.
uint256 constant BYTE_OF_SAMPLES = 0xff * ONES_64;

abstract contract BlendedSamples is ExactSamples {
    function drawBlended(uint256 p, uint256 attribute, uint256 covered, uint256 column, uint256 row) internal pure override {
        unchecked {
            bool isFirst = load(MODE) & IS_BLENDED == 0;
            uint256 z = Samples.depthsOf(attribute);
            uint256 old = load(p);
            // nearer than the stored depth; or equal to the depth found by the first pass
            uint256 seen = isFirst ? z + BELOW_TOPS_64 - old : TOPS_64 - ((old ^ (z | FOUND_SAMPLES)) & PASSES_OF_SAMPLES);
            seen &= covered;
            if (seen == 0) return;
            z |= isFirst
                ? FOUND_SAMPLES | (old & SAMPLE_COLORS)
                : DRAWN_SAMPLES | over(colorAt(attribute, covered, column, row), old);
            Samples.write(p, z, seen);
        }
    }

    /// @dev Returns a colour blended over those of the four samples: color * OPACITY + behind * (1 - OPACITY), rounded to the nearest
    /// level.
    function over(uint256 color, uint256 behind) internal pure virtual returns (uint256 mixed) {
        unchecked {
            (uint256 opacity, uint256 rest) = (load(OPACITY), ONE_24 - load(OPACITY));
            for (uint256 channel; channel != 24; channel += 8) {
                // all samples at once
                uint256 value = ((color >> channel) & 0xff) * opacity + HALF_24;
                value = value * ONES_64 + ((behind >> channel) & BYTE_OF_SAMPLES) * rest;
                mixed |= ((value >> Q24) & BYTE_OF_SAMPLES) << channel;
            }
        }
    }
}
