// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {FragmentLight} from "../shading/FragmentLight.sol";
import {BELOW_NEXT_LANES, SIGN_TO_BYTE} from "./LinearSamples.sol";
import {Lighting} from "../shading/Lighting.sol";
import {WIREFRAME} from "../../scene/Scene.sol";
import {SampleWires} from "./SampleWires.sol";
import {Samples} from "./Samples.sol";
import {Shading} from "../shading/Shading.sol";
import {max, min} from "../geometry/Screen.sol";
import {sqrt} from "../../math/Roots.sol";
import "../../words/SampleRegisters.sol";

// Computes `shade` of picture.py along `wires`, in linear parts.
// Draws opaque lines of flat and unlit faces in parts with linear colours: light is computed on the line, at the ends of parts over which
// it is linear (see Materials). Other lines are drawn by SampleWires, which shades each fragment: those of smooth surfaces, those with spot
// lights, and those whose colours perspective changes.

/// @dev The area of a line of 1/16 of a pixel. Shorter ones have the colour of one end: colours are extrapolated by a pixel.
uint256 constant SHORT_AREA = 2048;
/// @dev The square of a pixel in sub-pixels.
uint256 constant SQUARE_PIXEL = 0x10000;
/// @dev Added to lanes of 85 bits to make them positive; the maximum of a colour, 512 levels, Q10.
uint256 constant POSITIVE_85 = 0x400000000000000000000200000000000000000000100000000000;
uint256 constant MOST_Q10 = 0x7ffff;

abstract contract LinearWires is SampleWires {
    /// @dev Sets LINE_REACH.
    function shadeExact(uint256 a, uint256 b, uint256 c, uint256 crossing) internal pure override {
        (uint256 attributesA, uint256 attributesB, uint256 attributesC, uint256 mode) = surface(a, b, c, crossing);
        store(LINE_REACH, 0);
        if (
            load(OBJECT_FLAGS) & WIREFRAME != 0 && mode & (IS_BLENDED | IS_DEPTH_PASS | IS_SMOOTH | IS_SPOT_LIT) == 0
                && Shading.isAffine(attributesA, attributesB, attributesC, a, b, c)
        ) {
            if (mode & IS_LIT == 0) return Shading.setLinear(attributesA, attributesB, attributesC, IS_LINEAR | crossing);
            if (mode & IS_DIFFUSE == 0) {
                store(LINE_REACH, max(load(REACH), SQUARE_PIXEL));
            } else if (((attributesA ^ attributesB) | (attributesA ^ attributesC)) & LANES_24 == 0) {
                // one colour: its product with light is as linear as light
                store(LINE_REACH, Lighting.pointReach(min(attributesA, min(attributesB, attributesC)) >> ATTRIBUTE_DEPTH_AT));
            }
        }
        Shading.setExact(a, b, c, attributesA, attributesB, attributesC, mode | crossing);
    }

    function drawLine(uint256 p, uint256 q, uint256 attribute, uint256 change) internal pure override {
        unchecked {
            uint256 parts = 1;
            bool isLit = load(MODE) & IS_PATCHED != 0;
            uint256 last;
            if (isLit) {
                uint256 square = load(LINE_DX) * load(LINE_DX) + load(LINE_DY) * load(LINE_DY);
                // shorter than a pixel, parts take more gas than fragments
                if (load(LINE_REACH) < SQUARE_PIXEL) return super.drawLine(p, q, attribute, change);
                parts = sqrt(square / load(LINE_REACH)) + 1;
                attribute -= WEIGHT_BIAS;
                store(LINE_UPPER, p);
                store(LINE_ATTRIBUTE, attribute);
                store(LINE_CHANGE, change);
                attribute = (attribute >> ACCUMULATOR_DEPTH_AT << ACCUMULATOR_DEPTH_AT) + COLOR_BIAS;
                change = (change + HALF_DEPTH) >> ATTRIBUTE_DEPTH_AT << ATTRIBUTE_DEPTH_AT; // both: the depth alone
            }
            // not a literal: see ZERO_SLOT
            for (uint256 part = load(ZERO_SLOT); part != parts; ++part) {
                if (!setPart(p, part, parts)) {
                    last = 0;
                    continue;
                }
                uint256 first = last;
                uint256 slope;
                if (isLit) {
                    if (first == 0) first = colorOn((part << Q32) / parts);
                    last = colorOn(((part + 1) << Q32) / parts);
                    slope = last - first;
                }
                // as if the whole line were like this part
                drawPart(p, part, parts, attribute + ((first - part * slope) << ACCUMULATOR_FRACTION), change + parts * slope);
            }
        }
    }

    /// @dev Returns the colour of a point of the line, as in attribute words.
    /// @param fraction The place of the point between the ends, Q32.
    function colorOn(uint256 fraction) private pure returns (uint256 lanes) {
        uint256 x;
        uint256 y;
        uint256 attribute;
        assembly ("memory-safe") {
            y := mload(LINE_UPPER) // for now
            x := add(shl(Q32, and(shr(SCREEN_COLUMN_AT, y), SCREEN_COLUMN_MASK)), mul(mload(LINE_DX), fraction)) // column, Q40
            y := add(shl(Q32, shr(SCREEN_ROW_AT, y)), mul(mload(LINE_DY), fraction)) // row, Q40
            x := add(mload(RAY_LEFT), sar(Q40, mul(x, mload(RAY_STEP)))) // left + column * step
            y := add(mload(RAY_TOP), sar(Q40, mul(y, mload(RAY_STEP))))
            attribute := add(mload(LINE_ATTRIBUTE), mul(mload(LINE_CHANGE), fraction))
        }
        lanes = FragmentLight.colorOf(attribute, x, y);
        assembly ("memory-safe") {
            // one lane of 85 bits, between 0 and MOST_Q10
            function lane(color, shift) -> value {
                value := sub(and(shr(shift, color), LANE_64), ONE_44)
                if sgt(value, MOST_Q10) { value := MOST_Q10 } // min
                value := mul(value, sgt(value, 0)) // max(value, 0)
            }

            let color := add(lanes, POSITIVE_85)
            lanes := or(lane(color, 0), or(shl(MIDDLE_AT, lane(color, MIDDLE_85_AT)), shl(UPPER_AT, lane(color, UPPER_85_AT))))
        }
    }

    /// @dev Draws a part of a line. The place along it, from 0 to 1, changes by -W.y / area in a row and by W.x / area in a column.
    /// @param p The screen word of the upper end, to which `attribute` belongs.
    function drawPart(uint256 p, uint256 part, uint256 parts, uint256 attribute, uint256 change) private pure {
        assembly ("memory-safe") {
            let x := and(shr(SCREEN_COLUMN_AT, p), SCREEN_COLUMN_MASK)
            let y := shr(SCREEN_ROW_AT, p)
            let area := mload(LINE_AREA)
            if lt(area, SHORT_AREA) {
                change := shl(ATTRIBUTE_DEPTH_AT, sar(ATTRIBUTE_DEPTH_AT, add(change, HALF_DEPTH))) // the depth alone
            }
            let along := sdiv(shl(GRADIENT_SHIFT, sub(0, mload(LINE_ASIDE_Y))), area) // Q29
            let down := sdiv(shl(GRADIENT_SHIFT, mload(LINE_ASIDE_X)), area)
            // back to the centre of the pixel of p
            area := sub(0, add(mul(along, and(x, SUBPIXEL_MASK)), mul(down, and(y, SUBPIXEL_MASK)))) // area: that distance
            attribute := add(attribute, mul(change, sar(GRADIENT_TO_ACCUMULATOR, area)))
            along := mul(change, along) // along, down: the changes of the accumulator over an eighth of a pixel
            down := mul(change, down)
            mstore(DX, shl(EIGHTH_BITS, along))
            mstore(DY, shl(EIGHTH_BITS, down))
            mstore(START_ROW, shr(SUBPIXEL_BITS, y))
            mstore(START, sub(attribute, mul(shr(SUBPIXEL_BITS, x), mload(DX)))) // attribute - column * DX
            along := mul(sar(ACCUMULATOR_DEPTH_AT, along), SAMPLE_X_8)
            down := mul(sar(ACCUMULATOR_DEPTH_AT, down), SAMPLE_Y_8)
            mstore(DEPTH_OFFSETS, sub(shl(mload(SAMPLE_SHIFT), add(along, down)), mload(DEPTH_BASE)))
        }
        setProducts(p, part, parts);
        drawRows(true);
    }

    function drawLinear(uint256 p, uint256 attribute, uint256 covered) internal pure override {
        unchecked {
            uint256 z = Samples.depthsOf(attribute);
            uint256 seen = covered & (z + BELOW_TOPS_64 - load(p));
            if (seen != 0) Samples.write(p, z | (bytesOf(attribute) * ONES_64), seen);
        }
    }

    /// @dev Returns the colour of an accumulator, as LinearSamples: three bytes, blue uppermost.
    function bytesOf(uint256 attribute) private pure returns (uint256 color) {
        assembly ("memory-safe") {
            color := attribute
            if and(color, ABOVE_BYTES) {
                color := and(add(and(attribute, ABOVE_BYTES), ABOVE_BYTES), NEXT_LANES) // 1 above each lane > 255
                color := or(attribute, shr(NEXT_LANE_TO_BYTE, mul(color, 0xff))) // 255 there
                color := and(color, not(shr(SIGN_TO_BYTE, mul(and(attribute, BELOW_NEXT_LANES), 0xff)))) // 0 below 0
            }
            color := shr(PIXEL_AT, mul(and(color, BYTES_OF_LANES), LANES_TO_BYTES))
        }
    }
}
