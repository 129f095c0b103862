// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Patches} from "./Patches.sol";
import {SampleRasterizer} from "./SampleRasterizer.sol";
import "./Registers.sol";

// Triangles of which the colours are quadratic over square cells: see Patches.
abstract contract PatchSamples is SampleRasterizer {
    /// @notice Draws the rows from `row` to before `last`, cell by cell.
    function drawCells(uint256 row, uint256 last) internal pure {
        unchecked {
            uint256 size = load(PATCH_SIZE);
            (uint256 begin, uint256 end) = (load(SPAN_BEGIN), load(SPAN_END));
            while (row != last) {
                uint256 next = min(row / size * size + size, last);
                store(QUADRATIC_ROW, row);
                uint256 start = load(START) + (row - load(START_ROW)) * load(DY);
                (uint256 first, uint256 reach) = columnsOf(row, next);
                for (uint256 column = first / size * size; column < reach; column += size) {
                    Patches.fit(column, row, start, size);
                    store(SPAN_BEGIN, max(begin, column));
                    store(SPAN_END, min(end, column + size));
                    drawSpans(row, next);
                }
                store(SPAN_BEGIN, begin);
                store(SPAN_END, end);
                row = next;
            }
        }
    }
}
