// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {DepthBuffer} from "../pipeline/pixels/DepthBuffer.sol";
import {Shading} from "../pipeline/shading/Shading.sol";
import {SmoothSpans} from "../pipeline/pixels/SmoothSpans.sol";
import {Spans} from "../pipeline/pixels/Spans.sol";
import {Wireframe} from "../pipeline/pixels/Wireframe.sol";
import "../words/Registers.sol";

/// @title FragmentEngine: transforms vertices to pixels, for surfaces that are shaded per fragment.
/// @notice Draws smooth surfaces, wires, and all translucent or spot-lit objects; otherwise like `Engine`.
contract FragmentEngine is DepthBuffer, Wireframe {
    /// @dev Triangles whose only varying attribute is a linearly varying colour need no per-fragment light.
    function shadeExact(uint256 a, uint256 b, uint256 c, uint256 crossing) internal pure override {
        (uint256 attributesA, uint256 attributesB, uint256 attributesC, uint256 mode) = surface(a, b, c, crossing);
        if (mode & (IS_LIT | IS_BLENDED | IS_DEPTH_PASS) == 0 && Shading.isAffine(attributesA, attributesB, attributesC, a, b, c)) {
            return Shading.setLinear(attributesA, attributesB, attributesC, IS_LINEAR | crossing);
        }
        Shading.setExact(a, b, c, attributesA, attributesB, attributesC, mode | crossing);
    }

    function drawParts(uint256 edges, uint256 rows, uint256 row) internal pure override {
        if (load(MODE) & IS_QUADRATIC != 0) SmoothSpans.drawParts(edges, rows, row);
        else drawBothParts(edges, rows, row);
    }

    function drawRows(uint256 edges, uint256 slopes, uint256 start, uint256 row, uint256 end) internal pure override {
        uint256 mode = load(MODE);
        if (mode & (IS_BLENDED | IS_DEPTH_PASS) != 0) Spans.rows(edges, slopes, start, row, end, false, true);
        else if (mode & IS_PATCHED != 0) Spans.rows(edges, slopes, start, row, end, false, false);
        else Spans.rows(edges, slopes, start, row, end, true, false);
    }
}
