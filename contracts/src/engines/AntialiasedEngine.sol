// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {ExactSamples} from "../pipeline/samples/ExactSamples.sol";
import {FlatShading} from "../pipeline/shading/FlatShading.sol";
import {LinearSamples} from "../pipeline/samples/LinearSamples.sol";
import {PatchSamples} from "../pipeline/samples/PatchSamples.sol";
import {EXACT} from "../pipeline/samples/SampleRasterizer.sol";
import {SampleBuffer} from "../pipeline/samples/SampleBuffer.sol";
import "../words/Registers.sol";

/// @title AntialiasedEngine: does the work of the Engine with four samples per pixel.
/// @notice Called by the Renderer: see Engine.
contract AntialiasedEngine is SampleBuffer, PatchSamples, ExactSamples, FlatShading {
    function prepare(uint256 a, uint256 b, uint256 c) internal pure override {
        setGradients(a, b, c, 0);
        setQuadratic(a, b, c);
    }

    function drawFragments(uint256 row, uint256 last) internal pure override {
        if (load(MODE) & IS_PATCHED == 0) LinearSamples.draw(row, last);
        else drawPatches(row, last);
    }

    function drawSpan(uint256 left, uint256 right, uint256 column, uint256 end, uint256 row) internal pure override {
        drawEach(left, right, column, end, row, EXACT);
    }

    function dropShared(uint256, uint256 end, uint256, uint256) internal pure override returns (uint256) {
        return end;
    }

    /// @dev The AntialiasedFragmentEngine draws wires and translucent objects, the EffectsEngine shadows.
    function drawEdges(uint256, uint256, uint256, uint256) internal pure override {}

    function drawBlended(uint256, uint256, uint256, uint256, uint256) internal pure override {}

    function drawPartlyDark(uint256, uint256, uint256, uint256, uint256) internal pure override {}
}
