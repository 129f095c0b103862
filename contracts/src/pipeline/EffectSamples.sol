// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {BlendedSamples} from "./BlendedSamples.sol";
import {OPAQUE} from "../scene/Extensions.sol";
import {Ground} from "./Ground.sol";
import {Samples} from "./Samples.sol";
import {SHADOW_DARK, ShadowRows} from "./ShadowRows.sol";
import {SurfaceLight} from "./SurfaceLight.sol";
import "./Registers.sol";

// The fragments of scenes with effects, opaque or translucent, with four samples per pixel. Each is shaded individually, at the centroid of
// the samples that the triangle covers. Translucent ones are drawn in two passes: see BlendedSpans.

library EffectSamples {
    /// @notice Draws the fragments of a row: see SampleRasterizer.drawSpan.
    function draw(uint256 left, uint256 right, uint256 column, uint256 end, uint256 row) internal pure {
        unchecked {
            if (load(SHADOW_LIST) > SHADOW_DARK) ShadowRows.prepare(column, end, row);
            uint256 attribute = load(START) + (row - load(START_ROW)) * load(DY) + column * load(DX);
            uint256 p = Samples.place(row, column);
            for (; column != end; ++column) {
                uint256 covered = Samples.coverage(left, right, p);
                if (covered != 0) {
                    if (load(MODE) & (IS_BLENDED | IS_DEPTH_PASS) == 0) opaque(p, attribute, covered, column, row);
                    else blended(p, attribute, covered, column, row);
                }
                p += 32;
                attribute += load(DX);
            }
        }
    }

    function opaque(uint256 p, uint256 attribute, uint256 covered, uint256 column, uint256 row) private pure {
        unchecked {
            uint256 z = Samples.depthsOf(attribute);
            uint256 seen = covered & (z + BELOW_TOPS_64 - load(p));
            if (seen == 0) return;
            uint256 color = colorAt(attribute, covered, column, row);
            if (load(OPACITY) == OPAQUE) {
                if (seen == TOPS_64) return Samples.paint(p, row, column, z, color);
                z |= color * ONES_64;
            } else {
                // where a ground fades
                z |= BlendedSamples.over(color, load(p));
                store(OPACITY, OPAQUE);
            }
            Samples.write(p, row, column, z, seen);
        }
    }

    function blended(uint256 p, uint256 attribute, uint256 covered, uint256 column, uint256 row) private pure {
        unchecked {
            uint256 z = Samples.depthsOf(attribute);
            uint256 old = load(p);
            bool isFirst = load(MODE) & IS_BLENDED == 0;
            // nearer than the stored depth; or equal to the depth found by the first pass
            uint256 seen = isFirst ? z + BELOW_TOPS_64 - old : TOPS_64 - ((old ^ (z | FOUND_SAMPLES)) & PASSES_OF_SAMPLES);
            seen &= covered;
            if (seen == 0) return;
            if (isFirst) {
                z |= FOUND_SAMPLES | (old & SAMPLE_COLORS);
            } else {
                uint256 color = colorAt(attribute, covered, column, row);
                z |= DRAWN_SAMPLES | BlendedSamples.over(color, old);
                // the fragment's own opacity if vertices have opacities
                store(OPACITY, load(OBJECT_OPACITY));
            }
            Samples.write(p, row, column, z, seen);
        }
    }

    /// @dev Returns the colour at the centroid of the covered samples.
    function colorAt(uint256 attribute, uint256 covered, uint256 column, uint256 row) private pure returns (uint256 color) {
        unchecked {
            bool isPlain = load(SHADOWS) | load(IS_UNIFORM) | load(FADE_RANGE) == 0;
            bool isKnown;
            if (!isPlain) {
                if (load(SHADOWS) != 0) ShadowRows.setShare(covered, column);
                isKnown = load(UNIFORM_SHARE) == load(SHADOW_SHARE) + 1;
                if (isKnown && load(FADE_RANGE) == 0) return load(UNIFORM_COLOR);
            }
            uint256 x = load(RAY_LEFT) + column * load(RAY_STEP);
            uint256 y = load(RAY_TOP) + row * load(RAY_STEP);
            if (covered != TOPS_64) {
                (uint256 dx, uint256 dy) = Samples.centroid(covered);
                attribute = Samples.moved(attribute, dx, dy);
                x += uint256(int256(dx * load(RAY_STEP)) >> 3);
                y += uint256(int256(dy * load(RAY_STEP)) >> 3);
            }
            if (!isPlain) {
                // valid until the fragment is drawn
                if (load(FADE_RANGE) != 0) store(OPACITY, Ground.opacityAt(attribute, x, y));
                if (isKnown) return load(UNIFORM_COLOR);
            }
            color = SurfaceLight.colorAt(attribute, x, y);
            if (isPlain || load(IS_UNIFORM) == 0) return color;
            store(UNIFORM_COLOR, color);
            store(UNIFORM_SHARE, load(SHADOW_SHARE) + 1);
        }
    }
}
