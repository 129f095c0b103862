// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {BlendedSamples} from "../pipeline/samples/BlendedSamples.sol";
import {LinearWires} from "../pipeline/samples/LinearWires.sol";
import {BLENDED, EXACT} from "../pipeline/samples/SampleRasterizer.sol";
import {SampleBuffer} from "../pipeline/samples/SampleBuffer.sol";
import {SmoothSamples} from "../pipeline/samples/SmoothSamples.sol";
import "../words/SampleRegisters.sol";

/// @title AntialiasedFragmentEngine: does the work of the FragmentEngine with four samples per pixel.
/// @notice Called by the Renderer: see FragmentEngine.
contract AntialiasedFragmentEngine is SampleBuffer, LinearWires, BlendedSamples {
    function prepare(uint256 a, uint256 b, uint256 c) internal pure override {
        setGradients(a, b, c, 0);
        setQuadraticRow(a);
    }

    function drawFragments(uint256 row, uint256 last) internal pure override {
        drawSpans(row, last);
    }

    function drawSpan(uint256 left, uint256 right, uint256 column, uint256 end, uint256 row) internal pure override {
        uint256 mode = load(MODE);
        if (mode & IS_QUADRATIC != 0) SmoothSamples.draw(left, right, column, end, row);
        // not a literal: one loop is smaller
        else drawEach(left, right, column, end, row, mode & (IS_BLENDED | IS_DEPTH_PASS) == 0 ? EXACT : BLENDED);
    }

    /// @dev The EffectsEngine draws shadows.
    function drawPartlyDark(uint256, uint256, uint256, uint256, uint256) internal pure override {}
}
