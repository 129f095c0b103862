// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {WIREFRAME} from "../scene/Scene.sol";
import {BlendedSamples} from "../pipeline/samples/BlendedSamples.sol";
import {BLENDED, EXACT} from "../pipeline/samples/SampleRasterizer.sol";
import {SampleBuffer} from "../pipeline/samples/SampleBuffer.sol";
import {SampleWires} from "../pipeline/samples/SampleWires.sol";
import {OpenEdges} from "../pipeline/samples/OpenEdges.sol";
import {QuadraticSamples} from "../pipeline/samples/QuadraticSamples.sol";
import {SmoothSamples} from "../pipeline/samples/SmoothSamples.sol";
import {SmoothShading} from "../pipeline/shading/SmoothShading.sol";
import "../words/SampleRegisters.sol";

/// @title AntialiasedFragmentEngine: does the work of the FragmentEngine with four samples per pixel.
/// @notice Called by the Renderer: see FragmentEngine.
contract AntialiasedFragmentEngine is SampleBuffer, SampleWires, BlendedSamples, SmoothSamples {
    function prepare(uint256 a, uint256 b, uint256 c, uint256 row) internal pure override {
        setGradients(a, b, c, 0);
        setRows(a, b, c, row);
    }

    function openObject(uint256) internal pure override {
        openSmooth();
    }

    function isListed(uint256 mode) internal pure override returns (bool) {
        return mode & (IS_QUADRATIC | IS_BLENDED) == IS_QUADRATIC && load(OBJECT_FLAGS) & WIREFRAME == 0;
    }

    function closeList(uint256 list, uint256 end, uint256 records, uint256 made, uint256 free) internal pure override returns (uint256) {
        return OpenEdges.find(list, end, records, made, free);
    }

    function openList(uint256 kept) internal pure override {
        store(HAS_EDGES, kept);
        if (kept != 0) OpenEdges.mark(kept);
    }

    function setDifferences(uint256 a, uint256 b, uint256 c) internal pure override(SmoothShading, SmoothSamples) {
        SmoothSamples.setDifferences(a, b, c);
    }

    function drawFragments(uint256 row, uint256 last) internal pure override {
        if (load(MODE) & IS_QUADRATIC != 0) QuadraticSamples.draw(row, last);
        else drawSpans(row, last);
    }

    function drawSpan(uint256 left, uint256 right, uint256 column, uint256 end, uint256 row) internal pure override {
        // not a literal: one loop is smaller
        drawEach(left, right, column, end, row, load(MODE) & (IS_BLENDED | IS_DEPTH_PASS) == 0 ? EXACT : BLENDED);
    }

    /// @dev The EffectsEngine draws shadows.
    function drawPartlyDark(uint256, uint256, uint256, uint256, uint256) internal pure override {}
}
