// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {BlendedSamples} from "./BlendedSamples.sol";
import {OPAQUE} from "../scene/Extensions.sol";
import {Ground} from "./Ground.sol";
import {Samples} from "./Samples.sol";
import {SHADOW_DARK, ShadowRows} from "./ShadowRows.sol";
import {SurfaceLight} from "./SurfaceLight.sol";
import "./Registers.sol";

// The fragments of scenes with effects, opaque or not, with four samples for each pixel: each is lit for itself, at the middle of the
// samples that the triangle covers. What is not opaque is drawn in two passes: see BlendedSpans.

library EffectSamples {
    /// @notice Draws the fragments of a row: see SampleRasterizer.drawSpan.
    function draw(uint256 left, uint256 right, uint256 column, uint256 end, uint256 row) internal pure {
        unchecked {
            if (load(SHADOW_LIST) > SHADOW_DARK) ShadowRows.prepare(column, end, row);
            uint256 attribute = load(START) + (row - load(START_ROW)) * load(DY) + column * load(DX);
            for (; column != end; ++column) {
                uint256 covered = Samples.coverage(left, right, column);
                if (covered != 0) fragment(attribute, covered, column, row);
                attribute += load(DX);
            }
        }
    }

    function fragment(uint256 attribute, uint256 covered, uint256 column, uint256 row) private pure {
        unchecked {
            uint256 old = load(Samples.place(row, column));
            uint256 depths = Samples.depthsOf(attribute);
            uint256 mode = load(MODE);
            uint256 seen = covered
                & (
                    mode & IS_BLENDED != 0
                        // what the first pass has found
                        ? TOPS_64 - ((old ^ (depths | FOUND_SAMPLES)) & PASSES_OF_SAMPLES)
                        : (depths | TOPS_64) - (old | BELOW_SAMPLE_DEPTHS)
                );
            if (seen == 0) return;
            if (mode & IS_DEPTH_PASS != 0) {
                depths |= FOUND_SAMPLES | (old & SAMPLE_COLORS);
            } else {
                uint256 color = colorAt(attribute, covered, column, row);
                if (mode & IS_BLENDED != 0) {
                    depths |= DRAWN_SAMPLES | BlendedSamples.over(color, old);
                } else if (load(OPACITY) == OPAQUE) {
                    depths |= color * ONES_64;
                } else {
                    // of a ground
                    bool isGone = load(OPACITY) == 0;
                    if (!isGone) depths |= BlendedSamples.over(color, old);
                    store(OPACITY, OPAQUE);
                    if (isGone) return;
                }
            }
            Samples.write(row, column, depths, seen);
        }
    }

    function colorAt(uint256 attribute, uint256 covered, uint256 column, uint256 row) private pure returns (uint256 color) {
        unchecked {
            uint256 uniform = load(IS_UNIFORM);
            if (load(SHADOWS) != 0) ShadowRows.setShare(covered, column);
            bool isKnown = uniform != 0 && load(UNIFORM_SHARE) == load(SHADOW_SHARE) + 1;
            if (isKnown && load(FADE_RANGE) == 0) return load(UNIFORM_COLOR);
            (uint256 x, uint256 y) = Samples.centroid(covered);
            attribute = Samples.moved(attribute, x, y);
            uint256 step = load(RAY_STEP);
            x = load(RAY_LEFT) + column * step + uint256(int256(x * step) >> 3);
            y = load(RAY_TOP) + row * step + uint256(int256(y * step) >> 3);
            if (load(FADE_RANGE) != 0) {
                // until the fragment is drawn
                store(OPACITY, Ground.opacityAt(attribute, x, y));
                if (load(OPACITY) == 0) return 0;
            }
            if (isKnown) return load(UNIFORM_COLOR);
            color = Samples.bytesOf(SurfaceLight.colorAt(attribute, x, y));
            store(UNIFORM_COLOR, color);
            store(UNIFORM_SHARE, load(SHADOW_SHARE) + 1);
        }
    }
}
