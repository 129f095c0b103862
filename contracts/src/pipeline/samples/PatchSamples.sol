// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Patches} from "../shading/Patches.sol";
import {depthOf, max, min} from "../geometry/Screen.sol";
import {SampleRasterizer} from "./SampleRasterizer.sol";
import "../../words/SampleRegisters.sol";

// Computes `fill` of picture.py where `shade` is replaced by quadratic functions.
// Draws triangles with quadratic colours, over the whole triangle or over square cells: see Patches.
abstract contract PatchSamples is SampleRasterizer {
    /// @dev Sets further registers that quadratic functions need.
    function setQuadratic(uint256 a, uint256 b, uint256 c) internal pure {
        unchecked {
            if (load(MODE) & IS_PATCHED == 0) return;
            store(FARTHEST, min(depthOf(a), min(depthOf(b), depthOf(c))) << DEPTH_FRACTION);
            setQuadraticRow(a);
        }
    }

    /// @notice Draws the rows from `row` (inclusive) to `last` (exclusive).
    function drawPatches(uint256 row, uint256 last) internal pure {
        unchecked {
            uint256 size = load(PATCH_SIZE);
            if (size == 1) return drawSpans(row, last);
            if (size == 0) return drawRows(row, last);
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
                    drawRows(row, next);
                }
                store(SPAN_BEGIN, begin);
                store(SPAN_END, end);
                row = next;
            }
        }
    }

    /// @dev The same as drawSpans: the sides are in registers, since the loop over quadratic colours needs the stack.
    function drawRows(uint256 row, uint256 last) private pure {
        unchecked {
            while (row != last) {
                uint256 next = load(KINK_ROW);
                // the rows above the kink, the row of the kink, the rows below
                next = row < next ? min(next, last) : row == next ? row + 1 : last;
                (uint256 left, uint256 right) = sidesAt(row);
                store(ROW_LEFT, left);
                store(ROW_RIGHT, right);
                for (; row != next; ++row) {
                    (uint256 first, uint256 end) = columnsBetween(row);
                    if (first < end) drawRow(first, end, row);
                    store(ROW_LEFT, load(ROW_LEFT) + load(ROW_LEFT_STEP));
                    store(ROW_RIGHT, load(ROW_RIGHT) + load(ROW_RIGHT_STEP));
                    store(ROW_BOUNDS, load(ROW_BOUNDS) + load(ROW_BOUND_STEPS));
                }
            }
        }
    }

    /// @dev Draws the fragments of a row, whose sides are in ROW_LEFT and ROW_RIGHT, with colours that are a quadratic function of the
    /// position: see drawSpan.
    function drawRow(uint256 column, uint256 end, uint256 row) private pure {
        assembly ("memory-safe") {
            // the bytes of a colour that is beyond them in some lane, Q58
            function clamped(f) -> color {
                let beyond := and(add(and(f, ABOVE_Q58), ABOVE_Q58), CARRIES_85) // 1 above each lane below 0 or above 255
                color := or(and(f, BYTES_Q58), mul(shr(CARRY_85, beyond), BYTE_Q58)) // 255 there
                color := and(color, not(mul(shr(SIGN_85, and(f, SIGNS_85)), BYTE_Q58))) // 0 where negative
            }

            // a colour, Q58, from a colour times its depth, Q72
            function unweighted(f, attribute) -> color {
                // outside the triangle the depth can be anything
                attribute := sar(ACCUMULATOR_DEPTH_AT, attribute) // attribute: the depth
                if slt(attribute, mload(FARTHEST)) { attribute := mload(FARTHEST) }
                f := sub(and(shr(Q72_TO_Q24, f), LANES_37), BIAS_36) // colour times depth, Q24
                color := add(mul(f, div(shl(Q24_TO_Q58, mload(PATCH_WEIGHT)), attribute)), HALF_85) // * nearest / depth: Q58
            }

            {
                // in the row of the kink, no pixel counts as fully covered
                let inner := mload(INSETS)
                if iszero(lt(row, mload(KINK_ROW))) { inner := mload(KINK_INSETS) } // row >= kink
                if eq(row, mload(KINK_ROW)) { inner := NO_INSIDE }
                inner := add(mload(ROW_BOUNDS), shl(1, inner)) // bounds + 2 * insets
                mstore(INNER_BEGIN, and(sar(ADDRESS_FRACTION, signextend(LANE_128_LAST_BYTE, inner)), WHOLE_SAMPLES))
                mstore(INNER_END, and(sar(UPPER_ADDRESS_AT, inner), WHOLE_SAMPLES)) // floor of the upper one
            }
            let p := sub(mload(SAMPLE_ORIGIN), mul(row, mload(SAMPLE_STRIDE))) // of column 0
            mstore(ROW_IMAGE, sub(mload(ROW_IMAGE_0), mul(row, mload(ROW_IMAGE_STEP))))
            let attribute := add(add(mload(START), mul(sub(row, mload(START_ROW)), mload(DY))), mul(column, mload(DX))) // at the column
            end := add(p, shl(SAMPLE_SIZE_BITS, end)) // p + 32 * end
            p := add(p, shl(SAMPLE_SIZE_BITS, column))
            row := sub(row, mload(QUADRATIC_ROW)) // row: relative to QUADRATIC_ROW
            // the value at the column, Q58, and its change to the next column
            let g := add(mload(QUADRATIC_DX), mul(row, mload(QUADRATIC_DXY))) // dx + y dxy
            let f := add(mload(QUADRATIC_START), mul(row, mload(QUADRATIC_DY))) // f + y dy
            f := add(f, mul(shr(1, mul(row, sub(row, 1))), mload(QUADRATIC_DYY))) // + y (y - 1) / 2 dyy
            f := add(f, add(mul(column, g), mul(shr(1, mul(column, sub(column, 1))), mload(QUADRATIC_DXX)))) // + x g + x (x - 1) / 2 dxx
            g := add(g, mul(column, mload(QUADRATIC_DXX))) // + x dxx
            mstore(ROW_END, end)
            // first the pixels before the fully covered ones; end is the end of these, and of those that follow
            if lt(mload(INNER_BEGIN), end) { end := mload(INNER_BEGIN) } // min
            for {} 1 {} {
                for {} slt(p, end) {
                    p := add(p, SAMPLE_SIZE)
                    attribute := add(attribute, mload(DX))
                    f := add(f, g) // the next column
                    g := add(g, mload(QUADRATIC_DXX))
                } {
                    let z := mul(shr(ACCUMULATOR_DEPTH_AT, attribute), mload(SAMPLE_SCALE)) // of the pixel centre
                    z := and(add(z, mload(DEPTH_OFFSETS)), SAMPLE_DEPTHS) // the depths of four samples
                    let old := mload(p) // what is there
                    let seen := mul(p, ADDRESS_64) // the address in each lane, Q37
                    seen := and(and(add(mload(ROW_LEFT), seen), sub(mload(ROW_RIGHT), seen)), and(sub(add(z, BELOW_TOPS_64), old), TOPS_64))
                    if iszero(seen) { continue }
                    let color := f
                    if mload(PATCH_WEIGHT) { color := unweighted(f, attribute) }
                    switch and(color, ABOVE_Q58)
                    case 0 { color := and(color, BYTES_Q58) } // the integer parts
                    default { color := clamped(color) }
                    color := mul(color, Q58_TO_TOP) // blue, green, red at the top
                    // as Samples.paint and write, without their calls for each fragment
                    z := or(z, mul(shr(PIXEL_AT, color), ONES_64)) // the colour in each sample
                    if xor(seen, TOPS_64) {
                        mstore(p, or(xor(old, and(xor(old, z), sub(shl(1, seen), shr(TOP_64_AT, seen)))), IS_LISTED)) // where seen
                        if and(old, IS_LISTED) { continue }
                        z := add(mload(ROW_IMAGE), mul(3, shr(SAMPLE_SIZE_BITS, p)))
                        mstore(mload(MIXED_END), or(shl(MIXED_AT, p), shl(MIXED_PIXEL_AT, z))) // append (p, pixel)
                        mstore(MIXED_END, add(mload(MIXED_END), MIXED_SIZE))
                        continue
                    }
                    mstore(p, z)
                    mstore(0, color)
                    mcopy(add(mload(ROW_IMAGE), mul(3, shr(SAMPLE_SIZE_BITS, p))), 0, 3)
                }
                if iszero(lt(p, mload(ROW_END))) { break }
                // then the fully covered ones, while the buffer is empty
                end := mload(ROW_END)
                if lt(mload(INNER_END), end) { end := mload(INNER_END) } // min
                for {} slt(p, end) {
                    p := add(p, SAMPLE_SIZE)
                    attribute := add(attribute, mload(DX))
                    f := add(f, g) // the next column
                    g := add(g, mload(QUADRATIC_DXX))
                } {
                    if and(mload(p), SAMPLE_DEPTHS) { break }
                    let color := f
                    if mload(PATCH_WEIGHT) { color := unweighted(f, attribute) }
                    switch and(color, ABOVE_Q58)
                    case 0 { color := and(color, BYTES_Q58) } // the integer parts
                    default { color := clamped(color) }
                    color := mul(color, Q58_TO_TOP) // blue, green, red at the top
                    mstore(0, color)
                    mcopy(add(mload(ROW_IMAGE), mul(3, shr(SAMPLE_SIZE_BITS, p))), 0, 3)
                    let z := mul(shr(ACCUMULATOR_DEPTH_AT, attribute), mload(SAMPLE_SCALE)) // of the pixel centre
                    mstore(p, or(and(add(z, mload(DEPTH_OFFSETS)), SAMPLE_DEPTHS), mul(shr(PIXEL_AT, color), ONES_64)))
                }
                end := mload(ROW_END)
            }
        }
    }
}
