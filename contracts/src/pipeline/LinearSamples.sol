// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {ABOVE_BYTES, BYTES_OF_LANES, LANES_TO_BYTES, NEXT_LANES, NEXT_LANE_TO_BYTE} from "./LinearSpans.sol";
import "./Registers.sol";

// Triangles of which the accumulator holds the colour, with four samples for each pixel: see Samples.
//
// Columns are told by the addresses that their samples have, so that one number tells the pixel and where it is.

/// @dev The highest bit of each colour in an accumulator, which is its sign where the centre of a pixel lies outside the triangle; and from
/// there to the lowest bit of the byte.
uint256 constant BELOW_NEXT_LANES = 0x800000000000008000000000000080000000000000;
uint256 constant SIGN_TO_BYTE = 13;

library LinearSamples {
    /// @notice Draws the rows from `row`, for which the sides are told, to before `last`. Changes the steps of the sides.
    function draw(uint256 row, uint256 last) internal pure {
        assembly ("memory-safe") {
            // rows by the addresses that their samples have at column 0, which go down
            let base := sub(mload(SAMPLE_ORIGIN), mul(row, mload(SAMPLE_STRIDE)))
            let start := add(mload(START), mul(sub(row, mload(START_ROW)), mload(DY)))
            mstore(ROW_IMAGE, sub(mload(SAMPLE_IMAGE), mul(3, add(mul(row, mload(TILE_WIDTH)), sar(SAMPLE_SIZE_BITS, base)))))
            last := sub(mload(SAMPLE_ORIGIN), mul(last, mload(SAMPLE_STRIDE)))
            let left := sub(mload(SIDE_LEFT), mul(base, ADDRESS_64))
            let right := add(mload(SIDE_RIGHT), mul(base, ADDRESS_64))
            row := mul(mload(SAMPLE_STRIDE), ADDRESS_64)
            mstore(SIDE_LEFT_STEP, add(mload(SIDE_LEFT_STEP), row))
            mstore(SIDE_RIGHT_STEP, sub(mload(SIDE_RIGHT_STEP), row))
            // first the rows above the kink
            let until := sub(mload(SAMPLE_ORIGIN), mul(mload(KINK_ROW), mload(SAMPLE_STRIDE)))
            // 0 there, 1 in the row of the kink, then 2
            row := 0
            if slt(until, last) { until := last }
            for {} 1 {} {
                for {} sgt(base, until) {} {
                    let p := shr(UPPER_LANE_64_AT, left)
                    let end := and(left, LANE_64)
                    if gt(end, p) { p := end }
                    p := and(sar(ADDRESS_FRACTION, sub(TO_FIRST_COLUMN, p)), WHOLE_SAMPLES)
                    end := shr(UPPER_LANE_64_AT, right)
                    {
                        let other := and(right, LANE_64)
                        if gt(other, end) { end := other }
                        end := and(sar(ADDRESS_FRACTION, sub(end, TO_LAST_COLUMN)), WHOLE_SAMPLES)
                        if eq(row, 1) {
                            // the outer samples do not tell how far a side with a kink reaches
                            other := add(base, shl(SAMPLE_SIZE_BITS, mload(KINK_BEGIN)))
                            if slt(other, p) { p := other }
                            other := add(base, shl(SAMPLE_SIZE_BITS, mload(KINK_END)))
                            if sgt(other, end) { end := other }
                        }
                        other := add(base, mload(SPAN_BEGIN_BYTES))
                        if slt(p, other) { p := other }
                        other := add(base, mload(SPAN_END_BYTES))
                        if sgt(end, other) { end := other }
                    }
                    if slt(p, end) {
                        let attribute := add(start, mul(shr(SAMPLE_SIZE_BITS, sub(p, base)), mload(DX)))
                        for {} 1 {} {
                            let seen := mul(p, ADDRESS_64)
                            seen := and(and(add(left, seen), sub(right, seen)), TOPS_64)
                            if seen {
                                let z := mul(sub(shr(ACCUMULATOR_DEPTH_AT, attribute), mload(SAMPLE_BASE)), mload(SAMPLE_SCALE))
                                z := and(add(z, mload(DEPTH_OFFSETS)), SAMPLE_DEPTHS)
                                let old := mload(p)
                                // nearer by one at least, whatever the colour below the old depth is
                                seen := and(seen, sub(add(z, BELOW_TOPS_64), old))
                                if seen {
                                    let color := attribute
                                    if and(color, ABOVE_BYTES) {
                                        // all bits of the byte where it is above 255, none where it is below 0
                                        color := and(add(and(attribute, ABOVE_BYTES), ABOVE_BYTES), NEXT_LANES)
                                        color := or(attribute, shr(NEXT_LANE_TO_BYTE, mul(color, 0xff)))
                                        color := and(color, not(shr(SIGN_TO_BYTE, mul(and(attribute, BELOW_NEXT_LANES), 0xff))))
                                    }
                                    color := shr(PIXEL_AT, mul(and(color, BYTES_OF_LANES), LANES_TO_BYTES))
                                    z := or(z, mul(color, ONES_64))
                                    switch eq(seen, TOPS_64)
                                    case 1 {
                                        mstore(0, shl(PIXEL_AT, color))
                                        mcopy(add(mload(ROW_IMAGE), mul(3, shr(SAMPLE_SIZE_BITS, p))), 0, 3)
                                    }
                                    default {
                                        z := xor(old, and(xor(old, z), sub(shl(1, seen), shr(63, seen))))
                                        z := or(z, IS_LISTED)
                                        if iszero(and(old, IS_LISTED)) {
                                            seen := add(mload(ROW_IMAGE), mul(3, shr(SAMPLE_SIZE_BITS, p)))
                                            mstore(mload(MIXED_END), or(shl(MIXED_AT, p), shl(MIXED_PIXEL_AT, seen)))
                                            mstore(MIXED_END, add(mload(MIXED_END), MIXED_SIZE))
                                        }
                                    }
                                    mstore(p, z)
                                }
                            }
                            p := add(p, 32)
                            if eq(p, end) { break }
                            attribute := add(attribute, mload(DX))
                        }
                    }
                    left := add(left, mload(SIDE_LEFT_STEP))
                    right := add(right, mload(SIDE_RIGHT_STEP))
                    start := add(start, mload(DY))
                    base := sub(base, mload(SAMPLE_STRIDE))
                    mstore(ROW_IMAGE, sub(mload(ROW_IMAGE), mload(ROW_IMAGE_STEP)))
                }
                if iszero(sgt(base, last)) { break }
                switch row
                case 0 {
                    // the row of the kink by itself, with samples on both edges; its step leads to the edge that continues
                    until := sub(base, mload(SAMPLE_STRIDE))
                    row := mload(KINK_MASK)
                    let step := mul(mload(SAMPLE_STRIDE), ADDRESS_64)
                    switch eq(mload(KINK_SIDE), SIDE_LEFT)
                    case 1 {
                        let edge := sub(mload(KINK_EDGE), mul(base, ADDRESS_64))
                        left := or(and(left, not(row)), and(edge, row))
                        mstore(KINK_STEP, add(mload(KINK_STEP), step))
                        mstore(SIDE_LEFT_STEP, sub(add(edge, mload(KINK_STEP)), left))
                    }
                    default {
                        let edge := add(mload(KINK_EDGE), mul(base, ADDRESS_64))
                        right := or(and(right, not(row)), and(edge, row))
                        mstore(KINK_STEP, sub(mload(KINK_STEP), step))
                        mstore(SIDE_RIGHT_STEP, sub(add(edge, mload(KINK_STEP)), right))
                    }
                    row := 1
                }
                default {
                    // the rows below
                    row := 2
                    until := last
                    mstore(sub(add(mload(KINK_SIDE), SIDE_LEFT_STEP), SIDE_LEFT), mload(KINK_STEP))
                }
            }
        }
    }
}
