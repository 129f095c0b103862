// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {sqrtNear} from "../../math/Roots.sol";
import {columnOf, rowOf} from "../geometry/Screen.sol";
import {Clipper} from "../geometry/Clipper.sol";
import {SampleRasterizer} from "./SampleRasterizer.sol";
import {Samples} from "./Samples.sol";
import {Wires} from "../shading/Wires.sol";
import "../../words/SampleRegisters.sol";

// Computes `wires` of picture.py for four samples per pixel.
// Rasterizes the edges of triangles to fragments of four samples: a line is a rectangle, one pixel wide, as in OpenGL with multisampling.
//
// With D from the upper end of the line, p, to the lower one and W from there to the right side of the rectangle, both in whole sub-pixels,
// two products tell where a sample s lies, and both are exact:
//
//   across = D x (s - p)    from -area on one side to area on the other
//   along  = W x (s - p)    from 0 at one end to area at the other             area = D x W
//
// Samples on a left side belong to the line, those on a right side do not; where a side is horizontal, those on the upper one do. The four
// samples of a pixel are lanes of 64 bits. Less the least product that belongs to the line, and with 2^63 added, a product has the highest
// bit in its lane if it is not below that; LINE_ACROSS_END or LINE_ALONG_END minus it, if it is below the end.

/// @dev Sub-pixels beyond the centre of a pixel in which the ends of parts, which are rounded, may have samples.
uint256 constant PART_REACH = 97;
/// @dev An eighth of a pixel in sub-pixels, as a power of two.
uint256 constant EIGHTH_TO_SUBPIXELS = 5;

abstract contract SampleWires is SampleRasterizer, Wires {
    /// @notice Draws a line whose products are set, with fragments that are shaded individually.
    /// @param p, q The screen words of the ends, in this order.
    /// @param attribute, change The accumulator at p, and the change of the attribute word from p to q.
    function drawLine(uint256 p, uint256 q, uint256 attribute, uint256 change) internal pure virtual {
        unchecked {
            // not a literal: see ZERO_SLOT
            uint256 zero = load(ZERO_SLOT);
            if (!setPart(p, zero, zero + 1)) return;
            store(ATTRIBUTE_0, attribute);
            store(DELTA_1, 0);
            store(DELTA_2, change);
            // beside p, with its attributes; clamped, since that is far from the picture
            uint256 x = Clipper.inGuardBand(columnOf(p) + loadSigned(LINE_ASIDE_X));
            uint256 y = Clipper.inGuardBand(rowOf(p) + loadSigned(LINE_ASIDE_Y));
            prepare(p, (y << SCREEN_ROW_AT) | (x << SCREEN_COLUMN_AT), q);
            setProducts(p, zero, zero + 1);
            drawRows(false);
        }
    }

    function line(uint256 p, uint256 q, uint256 attribute, uint256 change) internal pure override {
        unchecked {
            // the same rectangle for both faces that share the edge
            if (q < p) {
                (p, q) = (q, p);
                attribute += change << ACCUMULATOR_FRACTION;
                change = 0 - change;
            }
            int256 dx = columnOf(q) - columnOf(p);
            int256 dy = rowOf(q) - rowOf(p);
            int256 length = int256(sqrtNear(uint256(dx * dx + dy * dy), LINE_HINT));
            if (length == 0) return;
            int256 asideX = dy * int256(HALF_PIXEL) / length;
            int256 asideY = -(dx * int256(HALF_PIXEL) / length);
            storeSigned(LINE_DX, dx);
            storeSigned(LINE_DY, dy);
            storeSigned(LINE_ASIDE_X, asideX);
            storeSigned(LINE_ASIDE_Y, asideY);
            storeSigned(LINE_AREA, dy * asideX - dx * asideY);
            drawLine(p, q, attribute, change);
        }
    }

    /// @notice Sets the rows and columns of a part of the line.
    /// @param p The screen word of its upper end.
    /// @return isVisible Whether there are any in the tile and band.
    function setPart(uint256 p, uint256 part, uint256 parts) internal pure returns (bool isVisible) {
        assembly ("memory-safe") {
            // sets the pixels with samples from `least` to `most`, inside of given ones
            function setPixels(least, most, begin, end, register) -> some {
                least := sar(SUBPIXEL_BITS, add(sub(least, PART_REACH), SUBPIXEL_MASK)) // ceil(least - reach)
                most := add(sar(SUBPIXEL_BITS, add(most, PART_REACH)), 1) // floor(most + reach) + 1
                if slt(least, begin) { least := begin } // max
                if sgt(most, end) { most := end } // min
                mstore(register, least)
                mstore(add(register, 0x20), most)
                some := slt(least, most)
            }

            let begin := and(shr(SCREEN_COLUMN_AT, p), SCREEN_COLUMN_MASK)
            let end := add(begin, sdiv(mul(mload(LINE_DX), add(part, 1)), parts)) // p.x + D.x * (part + 1) / parts
            begin := add(begin, sdiv(mul(mload(LINE_DX), part), parts)) // p.x + D.x * part / parts
            if slt(end, begin) {
                let left := end
                end := begin
                begin := left
            }
            let aside := mload(LINE_ASIDE_X)
            isVisible := setPixels(sub(begin, aside), add(end, aside), mload(COLUMN_BEGIN), mload(COLUMN_END), LINE_LEFT)
            begin := shr(SCREEN_ROW_AT, p)
            end := add(begin, div(mul(mload(LINE_DY), add(part, 1)), parts))
            begin := add(begin, div(mul(mload(LINE_DY), part), parts))
            aside := mload(LINE_ASIDE_Y)
            aside := xor(aside, sar(SIGN_AT, aside)) // |W.y|, or one less
            begin := sub(begin, add(aside, 1))
            isVisible := and(isVisible, setPixels(begin, add(end, add(aside, 1)), mload(BAND_TOP), mload(BAND_BOTTOM), LINE_TOP))
        }
    }

    /// @notice Sets the products of that part.
    function setProducts(uint256 p, uint256 part, uint256 parts) internal pure {
        assembly ("memory-safe") {
            // the first pixel relative to p
            let x := sub(shl(SUBPIXEL_BITS, mload(LINE_LEFT)), and(shr(SCREEN_COLUMN_AT, p), SCREEN_COLUMN_MASK))
            let y := sub(shl(SUBPIXEL_BITS, mload(LINE_TOP)), shr(SCREEN_ROW_AT, p))
            let dx := mload(LINE_DX)
            let dy := mload(LINE_DY)
            let area := mload(LINE_AREA)
            // across + area, and one less if the upper side is the one at +area
            let product := add(sub(mul(dy, x), mul(dx, y)), sub(area, iszero(dy)))
            let lanes := shl(EIGHTH_TO_SUBPIXELS, sub(mul(dy, SAMPLE_X_8), mul(dx, SAMPLE_Y_8))) // of the samples, relative to the centre
            mstore(LINE_ACROSS, add(mul(add(product, TOP_64), ONES_64), lanes))
            mstore(LINE_ACROSS_RIGHT, mul(shl(SUBPIXEL_BITS, dy), ONES_64))
            mstore(LINE_ACROSS_DOWN, mul(shl(SUBPIXEL_BITS, sub(0, dx)), ONES_64))
            mstore(LINE_ACROSS_END, sub(mul(shl(1, area), ONES_64), 1)) // 2^64 - 1 + 2 * area in each lane
            // the outermost samples: 32 * max(|3 dx - dy|, |3 dy + dx|)
            lanes := sub(mul(3, dx), dy)
            lanes := xor(lanes, sar(SIGN_AT, lanes))
            let other := add(mul(3, dy), dx)
            other := xor(other, sar(SIGN_AT, other))
            if lt(lanes, other) { lanes := other }
            lanes := shl(EIGHTH_TO_SUBPIXELS, add(lanes, 1)) // lanes: of the outermost sample
            mstore(LINE_ENTER, sub(sub(0, lanes), product))
            mstore(LINE_STAY, shl(1, add(area, lanes)))
            // the same along the line; dx, dy from here on: W
            dx := mload(LINE_ASIDE_X)
            dy := mload(LINE_ASIDE_Y)
            product := div(mul(area, part), parts) // where the part begins
            area := sub(div(mul(area, add(part, 1)), parts), product) // area: of the part
            product := sub(sub(mul(dx, y), mul(dy, x)), add(product, sgt(dy, 0))) // one less if the right side is the one at +area
            lanes := shl(EIGHTH_TO_SUBPIXELS, sub(mul(dx, SAMPLE_Y_8), mul(dy, SAMPLE_X_8)))
            mstore(LINE_ALONG, add(mul(add(product, TOP_64), ONES_64), lanes))
            mstore(LINE_ALONG_RIGHT, mul(shl(SUBPIXEL_BITS, sub(0, dy)), ONES_64))
            mstore(LINE_ALONG_DOWN, mul(shl(SUBPIXEL_BITS, dx), ONES_64))
            mstore(LINE_ALONG_END, sub(mul(area, ONES_64), 1))
        }
    }

    /// @notice Draws a fragment whose colour is in the accumulator, if this engine has such lines.
    function drawLinear(uint256 p, uint256 attribute, uint256 covered) internal pure virtual {}

    /// @notice Draws the fragments of all rows of the part.
    /// @param isLinear Whether by drawLinear. If it is a literal, the compiler makes a loop for it alone.
    function drawRows(bool isLinear) internal pure {
        unchecked {
            bool isBlended = load(MODE) & (IS_BLENDED | IS_DEPTH_PASS) != 0;
            uint256 last = load(LINE_BOTTOM);
            for (uint256 row = load(LINE_TOP); row != last; ++row) {
                (uint256 begin, uint256 end) = nextRow();
                uint256 across = load(LINE_ACROSS) + begin * load(LINE_ACROSS_RIGHT);
                uint256 along = load(LINE_ALONG) + begin * load(LINE_ALONG_RIGHT);
                uint256 column = load(LINE_LEFT) + begin;
                uint256 attribute = load(START) + (row - load(START_ROW)) * load(DY) + column * load(DX);
                uint256 p = Samples.openRow(row) + (column << SAMPLE_SIZE_BITS);
                for (; begin < end; ++begin) {
                    uint256 covered = across & (load(LINE_ACROSS_END) - across) & along & (load(LINE_ALONG_END) - along) & TOPS_64;
                    if (covered != 0) {
                        if (isLinear) drawLinear(p, attribute, covered);
                        else if (isBlended) drawBlended(p, attribute, covered, column, row);
                        else drawExact(p, attribute, covered, column, row);
                    }
                    p += SAMPLE_SIZE;
                    ++column;
                    attribute += load(DX);
                    across += load(LINE_ACROSS_RIGHT);
                    along += load(LINE_ALONG_RIGHT);
                }
                store(LINE_ACROSS, load(LINE_ACROSS) + load(LINE_ACROSS_DOWN));
                store(LINE_ALONG, load(LINE_ALONG) + load(LINE_ALONG_DOWN));
            }
        }
    }

    /// @dev Returns the columns of the current row with fragments, relative to LINE_LEFT: the first, and the one after the last, if they
    /// are in this order. Brings LINE_ENTER to the next row.
    function nextRow() private pure returns (uint256 begin, uint256 end) {
        assembly ("memory-safe") {
            let step := shl(SUBPIXEL_BITS, mload(LINE_DY))
            let enter := mload(LINE_ENTER)
            mstore(LINE_ENTER, add(enter, shl(SUBPIXEL_BITS, mload(LINE_DX))))
            end := sub(mload(LINE_RIGHT), mload(LINE_LEFT))
            if step {
                enter := add(enter, sub(step, 1)) // enter: rounded up when it is divided
                let exit := add(enter, mload(LINE_STAY))
                exit := mul(div(exit, step), sgt(exit, 0)) // max(ceil(exit / step), 0)
                if lt(exit, end) { end := exit } // min
                begin := mul(div(enter, step), sgt(enter, 0)) // max(ceil(enter / step), 0)
            }
        }
    }
}
