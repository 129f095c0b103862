// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import "../../words/SampleRegisters.sol";

// Computes `fill` of picture.py where `shade` is linear on the screen.
// Draws triangles whose colour is in the accumulator, with four samples per pixel: see Samples. Most triangles of models are small and
// linear, so the cost of a row matters as much as that of its pixels.

/// @dev The highest bit of each colour in an accumulator, which is its sign if the pixel centre lies outside the triangle; and the shift
/// from there to the lowest bit of the byte.
uint256 constant BELOW_NEXT_LANES = 0x800000000000008000000000000080000000000000;
uint256 constant SIGN_TO_BYTE = 13;

library LinearSamples {
    /// @notice Draws the rows from `row`, for which the sides are given, to `last` (exclusive). Changes the steps of the sides.
    function draw(uint256 row, uint256 last) internal pure {
        assembly ("memory-safe") {
            let left := mload(SIDE_LEFT)
            let right := mload(SIDE_RIGHT) // four columns each: see SampleRasterizer
            let bounds := mload(BOUNDS) // two addresses, Q37
            // START is relative to column 0; make it relative to address 0
            let start := sar(SAMPLE_SIZE_BITS, sub(mload(SAMPLE_ORIGIN), mul(row, mload(SAMPLE_STRIDE)))) // column 0 / 32
            mstore(ROW_IMAGE, sub(mload(ROW_IMAGE_0), mul(row, mload(ROW_IMAGE_STEP))))
            start := sub(add(mload(START), mul(sub(row, mload(START_ROW)), mload(DY))), mul(start, mload(DX))) // start + y DY - start DX
            mstore(ROW_STEP_32, add(mload(DY), mul(shr(SAMPLE_SIZE_BITS, mload(SAMPLE_STRIDE)), mload(DX)))) // rows go up in memory
            if mload(IS_CLAMPED) {
                // as addresses
                let base := sub(mload(SAMPLE_ORIGIN), mul(row, mload(SAMPLE_STRIDE))) // of column 0
                mstore(SPAN_BEGIN, add(base, shl(SAMPLE_SIZE_BITS, mload(SPAN_BEGIN)))) // base + 32 * column
                mstore(SPAN_END, add(base, shl(SAMPLE_SIZE_BITS, mload(SPAN_END))))
            }
            // the number of rows above the kink; and of those from it on, negative once its own row is drawn
            let rows := sub(last, row)
            last := sub(last, mload(KINK_ROW)) // last: the rows from the kink on
            last := mul(last, sgt(last, 0)) // none if they are not in the band
            rows := sub(rows, last)
            for {} 1 {} {
                for {} rows { rows := sub(rows, 1) } {
                    let p := and(shr(ADDRESS_FRACTION, bounds), ADDRESS_32) // floor of the lower bound
                    let end := and(shr(UPPER_ADDRESS_AT, bounds), ADDRESS_32) // floor of the upper bound
                    if mload(IS_CLAMPED) {
                        p := and(sar(ADDRESS_FRACTION, signextend(LANE_128_LAST_BYTE, bounds)), WHOLE_SAMPLES)
                        end := and(sar(UPPER_ADDRESS_AT, bounds), WHOLE_SAMPLES)
                        if slt(p, mload(SPAN_BEGIN)) { p := mload(SPAN_BEGIN) } // max
                        if sgt(end, mload(SPAN_END)) { end := mload(SPAN_END) } // min
                        end := mul(end, sgt(end, 0)) // max(end, 0)
                        mstore(SPAN_BEGIN, sub(mload(SPAN_BEGIN), mload(SAMPLE_STRIDE)))
                        mstore(SPAN_END, sub(mload(SPAN_END), mload(SAMPLE_STRIDE)))
                    }
                    for { let attribute := add(start, mul(shr(SAMPLE_SIZE_BITS, p), mload(DX))) } lt(p, end) { // start + x DX
                        attribute := add(attribute, mload(DX)) // the next column
                        p := add(p, SAMPLE_SIZE)
                    } {
                        let z := mul(shr(ACCUMULATOR_DEPTH_AT, attribute), mload(SAMPLE_SCALE)) // of the pixel centre
                        z := and(add(z, mload(DEPTH_OFFSETS)), SAMPLE_DEPTHS) // the depths of four samples
                        let old := mload(p) // what is there
                        let seen := mul(p, ADDRESS_64) // the address in each lane, Q37
                        // nearer by at least one, whatever the colour bits below the old depth are
                        seen := and(and(add(left, seen), sub(right, seen)), and(sub(add(z, BELOW_TOPS_64), old), TOPS_64))
                        if iszero(seen) { continue }
                        let color := and(attribute, BYTES_OF_LANES)
                        if and(attribute, ABOVE_BYTES) {
                            // set all bits of the byte if above 255, none if below 0
                            let beyond := and(add(and(attribute, ABOVE_BYTES), ABOVE_BYTES), NEXT_LANES) // 1 above each lane > 255
                            color := or(color, shr(NEXT_LANE_TO_BYTE, mul(beyond, 0xff))) // 255 there
                            color := and(color, not(shr(SIGN_TO_BYTE, mul(and(attribute, BELOW_NEXT_LANES), 0xff)))) // 0 below 0
                        }
                        color := mul(color, LANES_TO_BYTES) // blue, green, red at the top
                        z := or(z, mul(shr(PIXEL_AT, color), ONES_64)) // the colour in each sample
                        // as Samples.paint and write, without their calls for each fragment
                        if xor(seen, TOPS_64) {
                            mstore(p, or(xor(old, and(xor(old, z), sub(shl(1, seen), shr(TOP_64_AT, seen)))), IS_LISTED))
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
                    left := add(left, mload(SIDE_LEFT_STEP)) // the next row
                    right := add(right, mload(SIDE_RIGHT_STEP))
                    bounds := add(bounds, mload(BOUND_STEPS)) // both
                    start := add(start, mload(ROW_STEP_32))
                    mstore(ROW_IMAGE, sub(mload(ROW_IMAGE), mload(ROW_IMAGE_STEP)))
                }
                if iszero(last) { break }
                if slt(last, 0) {
                    // the rows below the kink
                    mstore(sub(add(mload(KINK_SIDE), SIDE_LEFT_STEP), SIDE_LEFT), mload(KINK_STEP)) // the step of that side
                    rows := sub(0, last) // the rest
                    last := 0
                    continue
                }
                // the row of the kink is drawn separately, with samples on both edges; its step leads to the lower edge
                rows := 1 // it alone
                last := sub(1, last)
                bounds := or(and(bounds, mload(KINK_KEPT)), mload(KINK_BOUND)) // replace the bound of that side
                mstore(BOUND_STEPS, mload(KINK_BOUND_STEPS))
                let mask := mload(KINK_MASK) // the samples below the kink
                let edge := mload(KINK_EDGE) // the lower edge in this row
                if eq(mload(KINK_SIDE), SIDE_LEFT) {
                    left := or(and(left, not(mask)), and(edge, mask)) // the edge in the lanes below the kink
                    mstore(SIDE_LEFT_STEP, sub(add(edge, mload(KINK_STEP)), left)) // to the edge in the next row
                    continue
                }
                right := or(and(right, not(mask)), and(edge, mask))
                mstore(SIDE_RIGHT_STEP, sub(add(edge, mload(KINK_STEP)), right))
            }
        }
    }
}
