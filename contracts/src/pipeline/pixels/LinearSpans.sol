// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import "../../words/Registers.sol";

// Computes `fill` of picture.py where `shade` is linear on the screen.
// Rows of fragments of triangles whose colours are linear on the screen, for triangles within the tile and the band: most of a picture.
// For others see Spans.

library LinearSpans {
    /// @notice Draws a triangle that lies entirely within the band.
    /// @param edges Addresses as in PixelRasterizer; SLOPES are their changes.
    /// @param rows The number of rows of the upper part.
    /// @param row The address of the first row.
    /// @param clamps Whether colours may exceed 255, and are clamped: a literal, of which the compiler is to make two functions.
    function draw(uint256 edges, uint256 rows, uint256 row, bool clamps) internal pure {
        assembly ("memory-safe") {
            // START is relative to column 0; make it relative to address 0
            let start := sub(mload(START), mul(mload(DX_8), row))
            row := shl(DEPTH_SIZE_BITS, mload(DX_8)) // row from here on: the change per pixel, 8 DX_8
            mstore(ROW_STEP, add(mload(DY), mul(mload(DX_8), mload(DEPTH_STRIDE)))) // a row down, from the same address
            for {} 1 {} {
                for {} rows {} {
                    let p := and(shr(EDGE_ADDRESS_FRACTION, edges), ADDRESS) // the first pixel
                    let last := and(shr(EDGE_RIGHT_ADDRESS_AT, edges), ADDRESS) // the one after the last
                    if lt(p, last) { // not an empty row
                        let attribute := add(start, mul(mload(DX_8), p)) // start + DX * column
                        let pixel := add(mload(IMAGE_ORIGIN), mul(3, shr(DEPTH_SIZE_BITS, p))) // IMAGE_ORIGIN + 3 * (p / 8)
                        for {} 1 {} {
                            if gt(attribute, or(mload(p), BEHIND_DEPTH)) { // depth > the one in the buffer
                                // copying a few bytes is cheaper than inserting them into a word
                                mstore(0, attribute)
                                mcopy(p, 0, 8)
                                let color := attribute
                                if clamps {
                                    // set the lowest bit of the next lane if a bit of ABOVE_BYTES is set; from it all bits of the byte
                                    color := and(add(and(attribute, ABOVE_BYTES), ABOVE_BYTES), NEXT_LANES)
                                    color := or(attribute, shr(NEXT_LANE_TO_BYTE, mul(color, 0xff)))
                                }
                                mstore(0, mul(and(color, BYTES_OF_LANES), LANES_TO_BYTES)) // blue, green, red at the top
                                mcopy(pixel, 0, 3)
                            }
                            p := add(p, 8) // the next pixel
                            if eq(p, last) { break } // do .. while (p != last)
                            pixel := add(pixel, 3)
                            attribute := add(attribute, row) // + DX
                        }
                    }
                    edges := add(edges, mload(SLOPES)) // the next row
                    start := add(start, mload(ROW_STEP)) // + DY, and the stride
                    rows := sub(rows, 1)
                }
                rows := mload(LOWER_ROWS) // the lower part, once
                if iszero(rows) { break } // there is none, or it has been drawn
                edges := or(and(edges, mload(LOWER_KEPT)), mload(LOWER_EDGE)) // one edge goes on, the other is replaced
                mstore(SLOPES, mload(LOWER_SLOPES))
                mstore(LOWER_ROWS, 0) // no third part
            }
        }
    }
}
