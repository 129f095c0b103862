// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import "../../words/Registers.sol";

// Rows of fragments of triangles whose colours are linear on the screen: a plain loop, and a general one for tile borders, bands, and
// colours above 255.

/// @dev The bytes of colours in an accumulator, and a multiplier that collects them at the top of a word; the bits below are undefined.
uint256 constant BYTES_OF_LANES = 0x0003fc000000000003fc000000000003fc0000000000;
uint256 constant LANES_TO_BYTES = 0x4000000000000000400000000000000040000000000000000000;
/// @dev The bits of colours in an accumulator above the bytes, and the lowest bits of the lanes above.
uint256 constant ABOVE_BYTES = 0xfc000000000000fc000000000000fc000000000000;
uint256 constant NEXT_LANES = 0x1000000000000010000000000000100000000000000;
/// @dev The distance from the lowest bit of the next lane to that of a byte.
uint256 constant NEXT_LANE_TO_BYTE = 14;
/// @dev Mask of the address of a depth, a multiple of 8.
uint256 constant ADDRESS = 0xfffffff8;

library LinearSpans {
    /// @notice Draws a triangle that lies entirely within the band and has no colour above 255.
    /// @param edges Addresses as in PixelRasterizer; SLOPES are their changes.
    /// @param rows The number of rows of the upper part.
    /// @param row The address of the first row.
    function plain(uint256 edges, uint256 rows, uint256 row) internal pure {
        assembly ("memory-safe") {
            // START is relative to column 0; make it relative to address 0
            let start := sub(mload(START), mul(mload(DX_8), row))
            row := shl(DEPTH_SIZE_BITS, mload(DX_8))
            mstore(ROW_STEP, add(mload(DY), mul(mload(DX_8), mload(DEPTH_STRIDE))))
            for {} 1 {} {
                for {} rows {} {
                    let p := and(shr(EDGE_ADDRESS_FRACTION, edges), ADDRESS)
                    let last := and(shr(EDGE_RIGHT_ADDRESS_AT, edges), ADDRESS)
                    if lt(p, last) {
                        let attribute := add(start, mul(mload(DX_8), p))
                        let pixel := add(mload(IMAGE_ORIGIN), mul(3, shr(DEPTH_SIZE_BITS, p)))
                        for {} 1 {} {
                            if gt(attribute, or(mload(p), BEHIND_DEPTH)) {
                                // copying a few bytes is cheaper than inserting them into a word
                                mstore(0, attribute)
                                mcopy(p, 0, 8)
                                mstore(0, mul(and(attribute, BYTES_OF_LANES), LANES_TO_BYTES))
                                mcopy(pixel, 0, 3)
                            }
                            p := add(p, 8)
                            if eq(p, last) { break }
                            pixel := add(pixel, 3)
                            attribute := add(attribute, row)
                        }
                    }
                    edges := add(edges, mload(SLOPES))
                    start := add(start, mload(ROW_STEP))
                    rows := sub(rows, 1)
                }
                rows := mload(LOWER_ROWS)
                if iszero(rows) { break }
                edges := or(and(edges, mload(LOWER_KEPT)), mload(LOWER_EDGE))
                mstore(SLOPES, mload(LOWER_SLOPES))
                mstore(LOWER_ROWS, 0)
            }
        }
    }

    /// @notice Draws a triangle as `plain` does, with colours clamped to 255.
    /// @param edges Addresses as in PixelRasterizer; SLOPES are their changes.
    /// @param rows The number of rows of the upper part.
    /// @param row The address of the first row.
    function saturating(uint256 edges, uint256 rows, uint256 row) internal pure {
        assembly ("memory-safe") {
            let start := sub(mload(START), mul(mload(DX_8), row))
            row := shl(DEPTH_SIZE_BITS, mload(DX_8))
            mstore(ROW_STEP, add(mload(DY), mul(mload(DX_8), mload(DEPTH_STRIDE))))
            for {} 1 {} {
                for {} rows {} {
                    let p := and(shr(EDGE_ADDRESS_FRACTION, edges), ADDRESS)
                    let last := and(shr(EDGE_RIGHT_ADDRESS_AT, edges), ADDRESS)
                    if lt(p, last) {
                        let attribute := add(start, mul(mload(DX_8), p))
                        let pixel := add(mload(IMAGE_ORIGIN), mul(3, shr(DEPTH_SIZE_BITS, p)))
                        for {} 1 {} {
                            if gt(attribute, or(mload(p), BEHIND_DEPTH)) {
                                mstore(0, attribute)
                                mcopy(p, 0, 8)
                                // set the lowest bit of the next lane if a bit of ABOVE_BYTES is set; from it all eight bits of the byte
                                let full := and(add(and(attribute, ABOVE_BYTES), ABOVE_BYTES), NEXT_LANES)
                                full := or(attribute, shr(NEXT_LANE_TO_BYTE, mul(full, 0xff)))
                                mstore(0, mul(and(full, BYTES_OF_LANES), LANES_TO_BYTES))
                                mcopy(pixel, 0, 3)
                            }
                            p := add(p, 8)
                            if eq(p, last) { break }
                            pixel := add(pixel, 3)
                            attribute := add(attribute, row)
                        }
                    }
                    edges := add(edges, mload(SLOPES))
                    start := add(start, mload(ROW_STEP))
                    rows := sub(rows, 1)
                }
                rows := mload(LOWER_ROWS)
                if iszero(rows) { break }
                edges := or(and(edges, mload(LOWER_KEPT)), mload(LOWER_EDGE))
                mstore(SLOPES, mload(LOWER_SLOPES))
                mstore(LOWER_ROWS, 0)
            }
        }
    }

    /// @notice Draws the rows from `row` (inclusive) to `last` (exclusive), given by addresses, between two edges.
    /// @param edges, slopes Columns, Q48.
    /// @param start Depth and colour at column 0; DX and DY are their changes.
    function general(uint256 edges, uint256 slopes, uint256 start, uint256 row, uint256 last) internal pure {
        assembly ("memory-safe") {
            // colours that change linearly
            function span(base, first, end, attribute, step) {
                if lt(first, mload(COLUMN_BEGIN)) {
                    attribute := add(attribute, mul(step, sub(mload(COLUMN_BEGIN), first)))
                    first := mload(COLUMN_BEGIN)
                }
                if gt(end, mload(COLUMN_END)) { end := mload(COLUMN_END) }
                if lt(first, end) {
                    first := add(base, shl(DEPTH_SIZE_BITS, first))
                    end := add(base, shl(DEPTH_SIZE_BITS, end))
                    base := add(mload(IMAGE_ORIGIN), mul(3, shr(DEPTH_SIZE_BITS, first)))
                    for {} 1 {} {
                        let old := mload(first)
                        if gt(attribute, or(old, BEHIND_DEPTH)) {
                            mstore(
                                first,
                                xor(old, and(xor(old, attribute), FIRST_DEPTH))
                            )
                            let color := and(shr(ACCUMULATOR_FRACTION, attribute), LANES_24)
                            color := or(color, mul(and(shr(30, add(color, OVERFLOW_TO_CARRY)), ONES), BYTE_Q10))
                            color := mul(
                                and(color, BYTES_Q10),
                                Q10_TO_PIXEL
                            )
                            old := mload(base)
                            mstore(base, xor(old, and(xor(old, color), FIRST_PIXEL)))
                        }
                        first := add(first, 8)
                        if eq(first, end) { break }
                        base := add(base, 3)
                        attribute := add(attribute, step)
                    }
                }
            }

            for {} sgt(row, last) {} {
                let from := and(shr(EDGES_LEFT_COLUMN_AT, edges), EDGES_LEFT_COLUMN_MASK)
                let to := shr(EDGES_RIGHT_COLUMN_AT, edges)
                if lt(from, to) { span(row, from, to, add(start, mul(from, mload(DX))), mload(DX)) }
                edges := add(edges, slopes)
                start := add(start, mload(DY))
                row := sub(row, mload(DEPTH_STRIDE))
            }
        }
    }
}
