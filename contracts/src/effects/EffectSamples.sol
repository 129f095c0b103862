// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {BlendedSamples} from "../pipeline/samples/BlendedSamples.sol";
import {OPAQUE} from "../scene/Extensions.sol";
import {Ground} from "./Ground.sol";
import {BLENDED, EXACT, PARTLY_DARK} from "../pipeline/samples/SampleRasterizer.sol";
import {Samples} from "../pipeline/samples/Samples.sol";
import {ShadowRows} from "../shadows/ShadowRows.sol";
import {SurfaceLight} from "./SurfaceLight.sol";
import "../words/EffectRegisters.sol";

// Computes `fill` of picture.py with light and shadow at each fragment.
// The fragments of scenes with effects, opaque or translucent, with four samples per pixel. Each is shaded individually, at the centroid of
// the samples that the triangle covers. A fragment of which some samples are in shadow and others are not is drawn twice: with the light
// that casts shadows switched off, and on.
abstract contract EffectSamples is BlendedSamples {
    function drawSpan(uint256 left, uint256 right, uint256 column, uint256 end, uint256 row) internal pure override {
        uint256 mode = load(MODE);
        if (mode & (IS_PARTLY_DARK | IS_BLENDED | IS_DEPTH_PASS) == 0 || (mode & IS_DEPTH_PASS != 0 && load(ALPHA) != 0)) {
            return drawEach(left, right, column, end, row, EXACT);
        }
        if (mode & IS_PARTLY_DARK == 0) return drawEach(left, right, column, end, row, BLENDED);
        ShadowRows.prepare(column, end, row);
        drawEach(left, right, column, end, row, PARTLY_DARK);
    }

    function drawPartlyDark(uint256 p, uint256 attribute, uint256 covered, uint256 column, uint256 row) internal pure override {
        unchecked {
            uint256 dark = ShadowRows.darkOf(covered, column);
            uint256 lit = covered ^ dark;
            if (dark != 0 && lit != 0) {
                // those in shadow first; meanwhile nothing is in front of what the others have
                uint256 old = load(p);
                lit = ((lit << 1) - (lit >> 63)) & SAMPLE_DEPTHS;
                store(p, old | lit);
                inLight(p, attribute, covered, column, row, dark);
                store(p, load(p) ^ ((load(p) ^ old) & lit));
                dark = 0;
            }
            inLight(p, attribute, covered, column, row, dark);
        }
    }

    /// @dev Draws the samples that are visible, with the light that casts shadows off if `dark` is not zero.
    function inLight(uint256 p, uint256 attribute, uint256 covered, uint256 column, uint256 row, uint256 dark) private pure {
        ShadowRows.setLight(dark);
        if (load(MODE) & IS_BLENDED == 0) drawExact(p, attribute, covered, column, row);
        else drawBlended(p, attribute, covered, column, row);
    }

    function drawExact(uint256 p, uint256 attribute, uint256 covered, uint256 column, uint256 row) internal pure override {
        unchecked {
            uint256 z = Samples.depthsOf(attribute);
            uint256 seen = covered & (z + BELOW_TOPS_64 - load(p));
            if (seen == 0) return;
            uint256 color = colorAt(attribute, covered, column, row);
            if (load(OPACITY) == OPAQUE) {
                z |= color * ONES_64;
                if (seen == TOPS_64) return Samples.paint(p, z);
            } else {
                // where a ground fades, or a texel is not opaque
                bool isHidden = load(OPACITY) | load(FADE_RANGE) == 0;
                color = over(color, load(p));
                if (isHidden) return;
                // as BlendedSamples if this is the first pass
                z |= load(MODE) & IS_DEPTH_PASS == 0 ? color : FOUND_SAMPLES | (load(p) & SAMPLE_COLORS);
            }
            Samples.write(p, z, seen);
        }
    }

    /// @dev The opacity of a fragment, which `colorAt` sets if vertices or texels have opacities or a ground fades, is valid until it is
    /// blended.
    function over(uint256 color, uint256 behind) internal pure override returns (uint256 mixed) {
        mixed = super.over(color, behind);
        store(OPACITY, load(OBJECT_OPACITY));
    }

    function colorAt(uint256 attribute, uint256 covered, uint256 column, uint256 row) internal pure override returns (uint256) {
        if (load(IS_UNIFORM) | load(FADE_RANGE) != 0) return uniformAt(attribute, covered, column, row);
        (uint256 there, uint256 x, uint256 y) = Samples.centroid(attribute, covered, column, row);
        return SurfaceLight.colorAt(there, x, y);
    }

    /// @dev The same for triangles that are uniform or fade.
    function uniformAt(uint256 attribute, uint256 covered, uint256 column, uint256 row) private pure returns (uint256 color) {
        unchecked {
            color = load(UNIFORM_LIT + load(IS_DARK));
            if (color != 0 && load(FADE_RANGE) == 0) return color ^ ONE_24;
            (uint256 there, uint256 x, uint256 y) = Samples.centroid(attribute, covered, column, row);
            if (load(FADE_RANGE) != 0) store(OPACITY, Ground.opacityAt(there, x, y));
            if (color == 0) {
                color = SurfaceLight.colorAt(there, x, y) | ONE_24;
                if (load(IS_UNIFORM) != 0) store(UNIFORM_LIT + load(IS_DARK), color);
            }
            return color ^ ONE_24;
        }
    }
}
