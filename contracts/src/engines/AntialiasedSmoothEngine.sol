// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {ExactSamples} from "../pipeline/samples/ExactSamples.sol";
import {FragmentLight} from "../pipeline/shading/FragmentLight.sol";
import {OpenEdges} from "../pipeline/samples/OpenEdges.sol";
import {QuadraticSamples} from "../pipeline/samples/QuadraticSamples.sol";
import {EXACT, SampleRasterizer} from "../pipeline/samples/SampleRasterizer.sol";
import {SampleBuffer} from "../pipeline/samples/SampleBuffer.sol";
import {Samples} from "../pipeline/samples/Samples.sol";
import {SmoothSamples} from "../pipeline/samples/SmoothSamples.sol";
import "../words/SampleRegisters.sol";

/// @title AntialiasedSmoothEngine: draws smooth surfaces with four samples per pixel.
/// @notice Called by the Renderer: see Engine. Draws the opaque surfaces with IS_QUADRATIC: most smooth ones.
contract AntialiasedSmoothEngine is SampleBuffer, ExactSamples, SmoothSamples {
    function openObject(uint256) internal pure override {
        openSmooth();
    }

    /// @dev Open edges are found when all triangles are known.
    function isListed() internal pure override returns (bool) {
        return true;
    }

    function closeList(uint256 list, uint256 end, uint256 records, uint256 free) internal pure override returns (uint256) {
        return OpenEdges.find(list, end, records, recordShift(0), free);
    }

    /// @dev A vertex has directions to each lamp.
    function recordShift(uint256) internal pure override returns (uint256) {
        unchecked {
            return load(LIGHTS_END) == LIGHTS + LIGHT_SIZE ? SMOOTH_RECORD_BITS : SMOOTH_RECORD_BITS + 1;
        }
    }

    function registersEnd() internal pure override returns (uint256) {
        unchecked {
            return SHINE_TABLE + 2 * SPECULAR_SIZE;
        }
    }

    /// @dev Marks are the same for all objects, so that faces in the same place have the same depths.
    function openLists(uint256[3][] memory lists) internal pure override {
        unchecked {
            for (uint256 i; i != lists.length; ++i) OpenEdges.mark(lists[i][2]);
        }
    }

    function prepare(uint256 a, uint256 b, uint256 c) internal pure override {
        setRows(a, b, c);
        setGradients(a, b, c, 0);
    }

    function drawFragments(uint256 row, uint256 last) internal pure override {
        setWholeOffsets();
        if (load(MODE) & IS_QUADRATIC != 0) QuadraticSamples.draw(row, last);
        else drawSpans(row, last);
    }

    function drawSpan(uint256 left, uint256 right, uint256 column, uint256 end, uint256 row) internal pure override {
        drawEach(left, right, column, end, row, EXACT);
    }

    /// @dev As QuadraticSamples, with the same mark.
    function drawExact(uint256 p, uint256 attribute, uint256 covered, uint256 column, uint256 row)
        internal pure override(ExactSamples, SampleRasterizer)
    {
        unchecked {
            uint256 edge = load(p) & IS_EDGE;
            (uint256 z, uint256 seen) = (load(DEPTH_OFFSETS), covered);
            if (edge == 0) {
                if (covered & TOP_64 == 0) return;
                (z, seen) = (load(WHOLE_OFFSETS), TOPS_64);
            }
            z = (z + (attribute >> ACCUMULATOR_DEPTH_AT) * load(SAMPLE_SCALE)) & SAMPLE_DEPTHS;
            seen &= z + BELOW_TOPS_64 - load(p);
            if (seen == 0) return;
            // within the triangle, although all samples may get the colour
            z |= edge | colorAt(attribute, covered, column, row) * ONES_64;
            if (seen == TOPS_64) Samples.paint(p, z);
            else Samples.write(p, z, seen);
        }
    }

    function colorAt(uint256 attribute, uint256 covered, uint256 column, uint256 row) internal pure override returns (uint256) {
        (uint256 there, uint256 x, uint256 y) = Samples.centroid(attribute, covered, column, row);
        return Samples.bytesOf(FragmentLight.smoothColorOf(there, x, y));
    }

    /// @dev The AntialiasedFragmentEngine draws wires and translucent objects, the EffectsEngine shadows.
    function dropShared(uint256, uint256 end, uint256, uint256) internal pure override returns (uint256) {
        return end;
    }

    function drawEdges(uint256, uint256, uint256, uint256) internal pure override {}

    function drawBlended(uint256, uint256, uint256, uint256, uint256) internal pure override {}

    function drawPartlyDark(uint256, uint256, uint256, uint256, uint256) internal pure override {}
}
