// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {DepthBuffer} from "../pipeline/pixels/DepthBuffer.sol";
import {FlatShading} from "../pipeline/shading/FlatShading.sol";
import {LinearSpans} from "../pipeline/pixels/LinearSpans.sol";
import {PatchSpans} from "../pipeline/pixels/PatchSpans.sol";
import {Spans} from "../pipeline/pixels/Spans.sol";
import "../words/Registers.sol";

/// @title Engine: transforms vertices to pixels, for flat and unlit surfaces.
/// @notice Called by the Renderer, which checks the scene and computes the uniforms before, and makes a file of the pixels afterwards. Do
/// not call the engine directly: it does not validate its input.
contract Engine is DepthBuffer, FlatShading {
    function drawParts(uint256 edges, uint256 rows, uint256 row) internal pure override {
        uint256 mode = load(MODE);
        if (mode == 0) LinearSpans.draw(edges, rows, row, false);
        else if (mode == IS_LINEAR) LinearSpans.draw(edges, rows, row, true);
        else drawBothParts(edges, rows, row);
    }

    function drawRows(uint256 edges, uint256 slopes, uint256 start, uint256 row, uint256 end) internal pure override {
        if (load(MODE) & IS_PATCHED == 0) Spans.rows(edges, slopes, start, row, end, true, false);
        else PatchSpans.fill(edges, slopes, start, row, end);
    }

    function dropShared(uint256, uint256 end, uint256, uint256) internal pure override returns (uint256) {
        return end;
    }

    /// @dev The FragmentEngine draws wires.
    function drawEdges(uint256, uint256, uint256, uint256) internal pure override {}
}
