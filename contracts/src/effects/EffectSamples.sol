// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {BlendedSamples} from "../pipeline/samples/BlendedSamples.sol";
import {OPAQUE} from "../scene/Extensions.sol";
import {Ground} from "./Ground.sol";
import {Samples} from "../pipeline/samples/Samples.sol";
import {ShadowRows} from "../shadows/ShadowRows.sol";
import {SurfaceLight} from "./SurfaceLight.sol";
import "../words/EffectRegisters.sol";

// The fragments of scenes with effects, opaque or translucent, with four samples per pixel. Each is shaded individually, at the centroid of
// the samples that the triangle covers. Translucent ones are drawn in two passes: see BlendedSpans. A fragment of which some samples are in
// shadow and others are not is drawn twice: with the light that casts shadows switched off, and on.

library EffectSamples {
    /// @notice Draws the fragments of a row: see SampleRasterizer.drawSpan.
    function draw(uint256 left, uint256 right, uint256 column, uint256 end, uint256 row) internal pure {
        if (load(MODE) & IS_PARTLY_DARK == 0) return drawRow(left, right, column, end, row, false);
        ShadowRows.prepare(column, end, row);
        drawRow(left, right, column, end, row, true);
    }

    /// @dev The compiler makes one function for each value of `isPartlyDark`.
    function drawRow(uint256 left, uint256 right, uint256 column, uint256 end, uint256 row, bool isPartlyDark) private pure {
        unchecked {
            uint256 attribute = load(START) + (row - load(START_ROW)) * load(DY) + column * load(DX);
            uint256 p = Samples.place(row, column);
            for (; column != end; ++column) {
                uint256 covered = Samples.coverage(left, right, p);
                if (covered != 0) {
                    if (isPartlyDark) partlyDark(p, attribute, covered, column, row);
                    else if (load(MODE) & (IS_BLENDED | IS_DEPTH_PASS) == 0) opaque(p, attribute, covered, column, row);
                    else blended(p, attribute, covered, column, row);
                }
                p += 32;
                attribute += load(DX);
            }
        }
    }

    /// @dev Draws a fragment of which some samples may be in shadow.
    function partlyDark(uint256 p, uint256 attribute, uint256 covered, uint256 column, uint256 row) private pure {
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
        if (load(MODE) & IS_BLENDED == 0) opaque(p, attribute, covered, column, row);
        else blended(p, attribute, covered, column, row);
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
    function colorAt(uint256 attribute, uint256 covered, uint256 column, uint256 row) private pure returns (uint256) {
        if (load(IS_UNIFORM) | load(FADE_RANGE) != 0) return uniformAt(attribute, covered, column, row);
        uint256 x;
        uint256 y;
        (attribute, x, y) = centroid(attribute, covered, column, row);
        return SurfaceLight.colorAt(attribute, x, y);
    }

    /// @dev The same for triangles that are uniform or fade.
    function uniformAt(uint256 attribute, uint256 covered, uint256 column, uint256 row) private pure returns (uint256 color) {
        unchecked {
            color = load(UNIFORM_LIT + load(IS_DARK));
            if (color != 0 && load(FADE_RANGE) == 0) return color ^ ONE_24;
            uint256 x;
            uint256 y;
            (attribute, x, y) = centroid(attribute, covered, column, row);
            // valid until the fragment is drawn
            if (load(FADE_RANGE) != 0) store(OPACITY, Ground.opacityAt(attribute, x, y));
            if (color == 0) {
                color = SurfaceLight.colorAt(attribute, x, y) | ONE_24;
                if (load(IS_UNIFORM) != 0) store(UNIFORM_LIT + load(IS_DARK), color);
            }
            return color ^ ONE_24;
        }
    }

    /// @dev Returns the accumulator and the ray at the centroid of the covered samples.
    function centroid(uint256 attribute, uint256 covered, uint256 column, uint256 row)
        private
        pure
        returns (uint256, uint256 x, uint256 y)
    {
        unchecked {
            x = load(RAY_LEFT) + column * load(RAY_STEP);
            y = load(RAY_TOP) + row * load(RAY_STEP);
            if (covered != TOPS_64) {
                (uint256 dx, uint256 dy) = Samples.centroid(covered);
                attribute = Samples.moved(attribute, dx, dy);
                x += uint256(int256(dx * load(RAY_STEP)) >> 3);
                y += uint256(int256(dy * load(RAY_STEP)) >> 3);
            }
            return (attribute, x, y);
        }
    }
}
