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
            uint256 p = Samples.place(row, column);
            for (; column != end; ++column) {
                uint256 covered = Samples.coverage(left, right, p);
                if (covered != 0) {
                    uint256 z = Samples.depthsOf(attribute);
                    uint256 seen;
                    assembly ("memory-safe") {
                        let old := mload(p)
                        switch and(mload(MODE), IS_BLENDED)
                        case 0 { seen := sub(or(z, TOPS_64), or(old, BELOW_SAMPLE_DEPTHS)) }
                        // what the first pass has found
                        default { seen := sub(TOPS_64, and(xor(old, or(z, FOUND_SAMPLES)), PASSES_OF_SAMPLES)) }
                        seen := and(seen, covered)
                    }
                    if (seen != 0) Samples.write(row, column, z | colorsOf(p, attribute, covered, column, row), seen);
                }
                p += 32;
                attribute += load(DX);
            }
        }
    }

    /// @dev What stands beside the depths of the samples of a fragment.
    function colorsOf(uint256 p, uint256 attribute, uint256 covered, uint256 column, uint256 row) private pure returns (uint256) {
        unchecked {
            uint256 mode = load(MODE);
            if (mode & IS_DEPTH_PASS != 0) return FOUND_SAMPLES | (load(p) & SAMPLE_COLORS);
            uint256 color = colorAt(attribute, covered, column, row);
            if (mode & IS_BLENDED == 0 && load(OPACITY) == OPAQUE) return color * ONES_64;
            // where a ground fades, or vertices have opacities, that of the fragment
            color = BlendedSamples.over(color, load(p));
            store(OPACITY, load(OBJECT_OPACITY));
            return mode & IS_BLENDED == 0 ? color : DRAWN_SAMPLES | color;
        }
    }

    /// @dev The colour in the middle of the samples that are covered.
    function colorAt(uint256 attribute, uint256 covered, uint256 column, uint256 row) private pure returns (uint256 color) {
        if (load(SHADOWS) != 0) ShadowRows.setShare(covered, column);
        bool isKnown;
        assembly ("memory-safe") {
            isKnown := and(mload(IS_UNIFORM), eq(mload(UNIFORM_SHARE), add(mload(SHADOW_SHARE), 1)))
        }
        if (isKnown && load(FADE_RANGE) == 0) return load(UNIFORM_COLOR);
        (uint256 x, uint256 y) = Samples.centroid(covered);
        attribute = Samples.moved(attribute, x, y);
        assembly ("memory-safe") {
            let step := mload(RAY_STEP)
            x := add(add(mload(RAY_LEFT), mul(column, step)), sar(3, mul(x, step)))
            y := add(add(mload(RAY_TOP), mul(row, step)), sar(3, mul(y, step)))
        }
        // until the fragment is drawn
        if (load(FADE_RANGE) != 0) store(OPACITY, Ground.opacityAt(attribute, x, y));
        if (isKnown) return load(UNIFORM_COLOR);
        color = Samples.bytesOf(SurfaceLight.colorAt(attribute, x, y));
        store(UNIFORM_COLOR, color);
        assembly ("memory-safe") {
            mstore(UNIFORM_SHARE, add(mload(SHADOW_SHARE), 1))
        }
    }
}
