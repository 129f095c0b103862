// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {BlendedSamples} from "../pipeline/samples/BlendedSamples.sol";
import {ExactSamples} from "../pipeline/samples/ExactSamples.sol";
import {Pipeline} from "../pipeline/Pipeline.sol";
import {SampleBuffer} from "../pipeline/samples/SampleBuffer.sol";
import {SampleWires} from "../pipeline/samples/SampleWires.sol";
import {SmoothSamples} from "../pipeline/samples/SmoothSamples.sol";
import "../words/SampleRegisters.sol";

/// @title AntialiasedFragmentEngine: does the work of the FragmentEngine with four samples per pixel.
/// @notice Called by the Renderer: see FragmentEngine.
contract AntialiasedFragmentEngine is SampleBuffer, SampleWires {
    function prepare(uint256 a, uint256, uint256) internal pure override {
        unchecked {
            store(QUADRATIC_ROW, max((a + (SUBPIXEL_MASK << SCREEN_ROW_AT)) >> SCREEN_PIXEL_ROW_AT, load(BAND_TOP)));
        }
    }

    function drawFragments(uint256 row, uint256 last) internal pure override {
        drawSpans(row, last);
    }

    function drawSpan(uint256 left, uint256 right, uint256 column, uint256 end, uint256 row) internal pure override {
        if (load(MODE) & IS_QUADRATIC != 0) SmoothSamples.draw(left, right, column, end, row);
        else drawEach(left, right, column, end, row);
    }

    function drawFragment(uint256 attribute, uint256 covered, uint256 column, uint256 row) internal pure override {
        if (load(MODE) & (IS_BLENDED | IS_DEPTH_PASS) != 0) BlendedSamples.fragment(attribute, covered, column, row);
        else ExactSamples.fragment(attribute, covered, column, row);
    }

    function drawWires(uint256 list, uint256 end) internal pure override(Pipeline, SampleWires) {
        SampleWires.drawWires(list, end);
    }
}
