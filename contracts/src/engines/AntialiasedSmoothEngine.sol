// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {ExactSamples} from "../pipeline/samples/ExactSamples.sol";
import {EXACT} from "../pipeline/samples/SampleRasterizer.sol";
import {SampleBuffer} from "../pipeline/samples/SampleBuffer.sol";
import {SmoothSamples} from "../pipeline/samples/SmoothSamples.sol";
import {SmoothShading} from "../pipeline/shading/SmoothShading.sol";
import "../words/SampleRegisters.sol";

/// @title AntialiasedSmoothEngine: draws smooth surfaces with four samples per pixel.
/// @notice Called by the Renderer: see Engine. Draws the opaque surfaces with IS_QUADRATIC: most smooth ones.
contract AntialiasedSmoothEngine is SampleBuffer, ExactSamples, SmoothShading {
    function prepare(uint256 a, uint256 b, uint256 c) internal pure override {
        setGradients(a, b, c, 0);
        setQuadraticRow(a);
    }

    function drawFragments(uint256 row, uint256 last) internal pure override {
        drawSpans(row, last);
    }

    function drawSpan(uint256 left, uint256 right, uint256 column, uint256 end, uint256 row) internal pure override {
        if (load(MODE) & IS_QUADRATIC != 0) SmoothSamples.draw(left, right, column, end, row);
        else drawEach(left, right, column, end, row, EXACT);
    }

    /// @dev The AntialiasedFragmentEngine draws wires and translucent objects, the EffectsEngine shadows.
    function drawEdges(uint256, uint256, uint256, uint256) internal pure override {}

    function drawBlended(uint256, uint256, uint256, uint256, uint256) internal pure override {}

    function drawPartlyDark(uint256, uint256, uint256, uint256, uint256) internal pure override {}
}
