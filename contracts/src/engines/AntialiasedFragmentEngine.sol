// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {BlendedSamples} from "../pipeline/samples/BlendedSamples.sol";
import {LinearWires} from "../pipeline/samples/LinearWires.sol";
import {BLENDED, EXACT} from "../pipeline/samples/SampleRasterizer.sol";
import {SampleBuffer} from "../pipeline/samples/SampleBuffer.sol";
import {Rasterizer} from "../pipeline/geometry/Rasterizer.sol";
import {SmoothShading} from "../pipeline/shading/SmoothShading.sol";
import "../words/SampleRegisters.sol";

/// @title AntialiasedFragmentEngine: draws wires, translucent and spot-lit objects with four samples per pixel.
/// @notice Called by the Renderer: see Engine. Draws what no other engine draws with four samples per pixel, and shades every fragment
/// individually.
contract AntialiasedFragmentEngine is SampleBuffer, LinearWires, BlendedSamples {
    function prepare(uint256 a, uint256 b, uint256 c) internal pure override {
        setGradients(a, b, c, 0);
    }

    function shade(uint256 a, uint256 b, uint256 c, uint256 crossing) internal pure override(Rasterizer, SmoothShading) {
        shadeExact(a, b, c, crossing);
    }

    function drawFragments(uint256 row, uint256 last) internal pure override {
        drawSpans(row, last);
    }

    function drawSpan(uint256 left, uint256 right, uint256 column, uint256 end, uint256 row) internal pure override {
        // not a literal: one loop is smaller
        drawEach(left, right, column, end, row, load(MODE) & (IS_BLENDED | IS_DEPTH_PASS) == 0 ? EXACT : BLENDED);
    }

    /// @dev The EffectsEngine draws shadows.
    function drawPartlyDark(uint256, uint256, uint256, uint256, uint256) internal pure override {}
}
