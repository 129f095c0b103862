// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {BlendedSamples} from "./pipeline/BlendedSamples.sol";
import {ExactSamples} from "./pipeline/ExactSamples.sol";
import {Pipeline} from "./pipeline/Pipeline.sol";
import {SampleBuffer} from "./pipeline/SampleBuffer.sol";
import {SampleWires} from "./pipeline/SampleWires.sol";
import {SmoothSamples} from "./pipeline/SmoothSamples.sol";
import "./pipeline/Registers.sol";

/// @title AntialiasedFragmentEngine: what the FragmentEngine does, with four samples for each pixel.
/// @notice The work of the Renderer: see FragmentEngine.
contract AntialiasedFragmentEngine is SampleBuffer, SampleWires {
    function drawFragments(uint256 row, uint256 last) internal pure override {
        drawSpans(row, last);
    }

    function drawSpan(uint256 left, uint256 right, uint256 column, uint256 end, uint256 row) internal pure override {
        uint256 mode = load(MODE);
        if (mode & IS_QUADRATIC != 0) SmoothSamples.draw(left, right, column, end, row);
        else if (mode & (IS_BLENDED | IS_DEPTH_PASS) != 0) BlendedSamples.draw(left, right, column, end, row);
        else ExactSamples.draw(left, right, column, end, row);
    }

    function drawWires(uint256 list, uint256 end) internal pure override(Pipeline, SampleWires) {
        SampleWires.drawWires(list, end);
    }
}
