// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {max, min} from "../geometry/Screen.sol";
import {WEIGHTED_BIAS} from "./FragmentLight.sol";
import {Lighting} from "./Lighting.sol";
import "../../words/Registers.sol";

// Prepares `weights_at` of picture.py: the values of the corners, and their changes.
// The common parts of triangle shading: the test whether colours can be linear on the screen, and the registers of linear triangles and of
// those whose fragments are shaded individually.

/// @dev A bit above the numbers of each lane; and the limit for a pair: 4 times 3 levels, Q30.
uint256 constant GUARDS = 0x00400000000000004000000000000040000000000000;
uint256 constant LIMITS = 0x00000003000000000000030000000000000300000000;
/// @dev Twice the area of three pixels, in sub-pixels.
uint256 constant THREE_PIXELS = 0x60000;
/// @dev 1, Q84: divided by a depth, its inverse; and the shift from that times a depth to Q20.
uint256 constant ONE_84 = 0x1000000000000000000000;
uint256 constant Q84_TO_Q20 = 64;
/// @dev 2 to this power is the factor of depths from which on they are interpolated separately: see IS_DEEP.
uint256 constant DEEP_BITS = 12;
/// @dev From the normals of vertices to NORMALS_0.
uint256 constant Q20_TO_Q36 = 16;
/// @dev From a quotient of sub-pixel lengths and twice an area to Q32 per pixel.
uint256 constant SUBPIXEL_TO_Q32 = 40;
/// @dev Eight rows in the format of screen words.
uint256 constant EIGHT_ROWS = 0x80000000000000000000000000000000000;

library Shading {
    /// @notice Returns the attribute words of the vertices with these screen words.
    function attributesOf(uint256 a, uint256 b, uint256 c) internal pure returns (uint256, uint256, uint256) {
        assembly ("memory-safe") {
            a := mload(add(and(a, SCREEN_RECORD_MASK), VERTEX_ATTRIBUTES))
            b := mload(add(and(b, SCREEN_RECORD_MASK), VERTEX_ATTRIBUTES))
            c := mload(add(and(c, SCREEN_RECORD_MASK), VERTEX_ATTRIBUTES))
        }
        return (a, b, c);
    }

    /// @notice Sets the normal and the light of a flat face.
    /// @param crossing See Lighting.setFace.
    /// @return mode How its fragments are lit. If only by highlights, the colours of the attribute words include the other light.
    function setFace(uint256 attributesA, uint256 attributesB, uint256 attributesC, uint256 crossing)
        internal pure returns (uint256 mode, uint256, uint256, uint256)
    {
        unchecked {
            uint256 light;
            (mode, light) = Lighting.setFace(crossing);
            Lighting.setFacing();
            if (mode & IS_DIFFUSE == 0) return (mode, lit(attributesA, light), lit(attributesB, light), lit(attributesC, light));
            return (mode, attributesA, attributesB, attributesC);
        }
    }

    /// @dev Sets the registers of a triangle with linear colours.
    function setLinear(uint256 attributesA, uint256 attributesB, uint256 attributesC, uint256 mode) internal pure {
        assembly ("memory-safe") {
            mstore(MODE, mode)
            mstore(ATTRIBUTE_0, add(shl(ACCUMULATOR_FRACTION, attributesA), COLOR_BIAS))
            mstore(DELTA_1, sub(attributesB, attributesA))
            mstore(DELTA_2, sub(attributesC, attributesA))
        }
    }

    /// @dev Returns whether colours interpolated linearly on the screen are within four levels of the perspective-correct ones; within two
    /// in large triangles, which determine the mean error of a picture. With weights w, depths z and colours c, the difference is the sum
    /// of w_i w_j (z_i - z_j) (c_i - c_j) / z over the three pairs of vertices, where w_i w_j is at most 1/4, and their sum at most 1/3:
    /// each pair alone may contribute three levels, or one and a half.
    function isAffine(uint256 a, uint256 b, uint256 c, uint256 screenA, uint256 screenB, uint256 screenC) internal pure returns (bool yes) {
        bool large;
        assembly ("memory-safe") {
            // words compare like rows
            large := add(screenA, EIGHT_ROWS)
            large := or(gt(screenB, large), gt(screenC, large))
        }
        if (large) large = isLarge(screenA, screenB, screenC);
        assembly ("memory-safe") {
            let least := xor(a, mul(xor(a, b), lt(b, a))) // min(a, b)
            let change := xor(xor(a, b), least) // max(a, b)
            least := shr(ATTRIBUTE_DEPTH_AT, xor(least, mul(xor(least, c), lt(c, least)))) // the least depth
            change := sub(shr(ATTRIBUTE_DEPTH_AT, xor(change, mul(xor(change, c), lt(change, c)))), least) // the greatest minus it
            // colours of up to 255 may differ by any amount if depths differ by at most 12 / 255, in large triangles 8 / 255
            yes := iszero(or(gt(mul(add(22, mul(11, large)), change), least), and(or(or(a, b), c), OVERFLOW)))
            if iszero(yes) {
                let inverse := div(ONE_84, least) // z^-1, Q84
                let limits := or(GUARDS, shr(large, LIMITS)) // half of LIMITS if large
                // |z_i - z_j| / z, Q20, times the difference of the colours (Q10), in each lane: if it exceeds the limit, a bit above is
                // cleared; more than 2^32 would not fit the lanes, since colours are up to 20 times 255
                change := sub(b, a) // from here on a pair's difference of attribute words, then of colours times the ratio
                let ratio := sar(ATTRIBUTE_DEPTH_AT, change)
                ratio := shr(Q84_TO_Q20, mul(xor(ratio, sar(255, ratio)), inverse)) // |z_i - z_j| / z
                let most := ratio
                change := mul(change, ratio)
                let guards := and(add(limits, change), sub(limits, change)) // |change| <= limit in each lane
                change := sub(c, a)
                ratio := sar(ATTRIBUTE_DEPTH_AT, change)
                ratio := shr(Q84_TO_Q20, mul(xor(ratio, sar(255, ratio)), inverse)) // |z_i - z_j| / z
                most := or(most, ratio)
                change := mul(change, ratio)
                guards := and(guards, and(add(limits, change), sub(limits, change)))
                change := sub(c, b)
                ratio := sar(ATTRIBUTE_DEPTH_AT, change)
                ratio := shr(Q84_TO_Q20, mul(xor(ratio, sar(255, ratio)), inverse)) // |z_i - z_j| / z
                most := or(most, ratio)
                change := mul(change, ratio)
                guards := and(guards, and(add(limits, change), sub(limits, change)))
                yes := and(lt(most, ONE_32), eq(and(guards, GUARDS), GUARDS))
            }
        }
    }

    /// @dev Returns whether a triangle has more than 8 rows, of more than 3 pixels on average. Shading smaller ones in blocks would be
    /// expensive, with little benefit.
    function isLarge(uint256 a, uint256 b, uint256 c) internal pure returns (bool large) {
        assembly ("memory-safe") {
            let rows := xor(b, mul(xor(b, c), lt(b, c))) // max(b, c)
            rows := shr(SCREEN_PIXEL_ROW_AT, add(rows, mload(ROUND_BOTTOM))) // the row after the last
            rows := sub(rows, shr(SCREEN_PIXEL_ROW_AT, add(a, mload(ROUND_TOP)))) // minus the first
            let x := and(shr(SCREEN_COLUMN_AT, a), SCREEN_COLUMN_MASK)
            a := shr(SCREEN_ROW_AT, a) // the row of the first vertex from here on
            let area := mul(sub(and(shr(SCREEN_COLUMN_AT, c), SCREEN_COLUMN_MASK), x), sub(shr(SCREEN_ROW_AT, b), a))
            area := sub(area, mul(sub(and(shr(SCREEN_COLUMN_AT, b), SCREEN_COLUMN_MASK), x), sub(shr(SCREEN_ROW_AT, c), a)))
            large := and(gt(rows, 8), gt(area, mul(rows, THREE_PIXELS)))
        }
    }

    /// @notice Sets the registers of a triangle whose fragments are shaded individually.
    function setExact(uint256 a, uint256 b, uint256 c, uint256 attributesA, uint256 attributesB, uint256 attributesC, uint256 mode)
        internal pure
    {
        unchecked {
            uint256 nearest = max(attributesA, max(attributesB, attributesC)) >> ATTRIBUTE_DEPTH_AT;
            uint256 farthest = min(attributesA, min(attributesB, attributesC)) >> ATTRIBUTE_DEPTH_AT;
            mode |= IS_PATCHED;
            if (nearest >= 64 * farthest) mode |= IS_STEEP;
            if (nearest >= farthest << DEEP_BITS) mode |= IS_DEEP;
            store(MODE, mode);
            store(PATCH_SIZE, 1);
            store(PATCH_BEGIN, 0);
            store(PATCH_END, GUARD_BAND);
            uint256 color = attributesA & LANES_24;
            store(COLOR_0, (color << Q24) + WEIGHTED_BIAS);
            store(COLOR_1, (attributesB & LANES_24) - color);
            store(COLOR_2, (attributesC & LANES_24) - color);
            attributesA >>= ATTRIBUTE_DEPTH_AT;
            attributesB >>= ATTRIBUTE_DEPTH_AT;
            attributesC >>= ATTRIBUTE_DEPTH_AT;
            store(DEPTH_1, attributesB << DEPTH_FRACTION);
            store(DEPTH_2, attributesC << DEPTH_FRACTION);
            if (mode & IS_DEEP != 0) {
                setDepths(a, b, c, attributesA, attributesB - attributesA, attributesC - attributesA);
                (attributesA, attributesB, attributesC) = (0, 0, 0);
            }
            store(ATTRIBUTE_0, (attributesA << ACCUMULATOR_VERTEX_DEPTH_AT) + WEIGHT_BIAS);
            store(DELTA_1, ((attributesB - attributesA) << ATTRIBUTE_DEPTH_AT) + ATTRIBUTE_S);
            store(DELTA_2, ((attributesC - attributesA) << ATTRIBUTE_DEPTH_AT) + 1);
        }
    }

    /// @dev Sets separate depths, Q32, since barycentric coordinates are too coarse for them.
    /// @param z The depth at the first vertex; zb and zc are the differences to the others.
    function setDepths(uint256 a, uint256 b, uint256 c, uint256 z, uint256 zb, uint256 zc) internal pure {
        assembly ("memory-safe") {
            let x := and(shr(SCREEN_COLUMN_AT, a), SCREEN_COLUMN_MASK)
            let xb := sub(and(shr(SCREEN_COLUMN_AT, b), SCREEN_COLUMN_MASK), x)
            let xc := sub(and(shr(SCREEN_COLUMN_AT, c), SCREEN_COLUMN_MASK), x)
            a := shr(SCREEN_ROW_AT, a) // rows from here on: of the first vertex, and relative to it
            b := sub(shr(SCREEN_ROW_AT, b), a)
            c := sub(shr(SCREEN_ROW_AT, c), a)
            let area := sub(mul(xc, b), mul(xb, c)) // twice the area
            let dx := sdiv(shl(SUBPIXEL_TO_Q32, sub(mul(zc, b), mul(zb, c))), area) // (zc yb - zb yc) / area
            let dy := sdiv(shl(SUBPIXEL_TO_Q32, sub(mul(zb, xc), mul(zc, xb))), area) // (zb xc - zc xb) / area
            mstore(DEEP_DX, dx)
            mstore(DEEP_DY, dy)
            // from the first vertex to the centre of pixel 0 in the first row
            dy := sub(mul(and(sub(0, a), SUBPIXEL_MASK), dy), mul(x, dx)) // y dy - x dx from here on
            mstore(DEEP_START, shl(ATTRIBUTE_DEPTH_AT, add(shl(Q32, z), sar(SUBPIXEL_BITS, dy))))
        }
    }

    /// @notice Sets the normals of the vertices: the first one, Q36, and the differences to the others, Q20.
    function setNormals(uint256 a, uint256 b, uint256 c) internal pure {
        assembly ("memory-safe") {
            a := mload(add(and(a, SCREEN_RECORD_MASK), VERTEX_NORMAL))
            mstore(NORMALS_0, shl(Q20_TO_Q36, a))
            mstore(NORMALS_1, sub(mload(add(and(b, SCREEN_RECORD_MASK), VERTEX_NORMAL)), a))
            mstore(NORMALS_2, sub(mload(add(and(c, SCREEN_RECORD_MASK), VERTEX_NORMAL)), a))
        }
    }

    /// @dev Returns the sum of the squares of two edges, in sub-pixels.
    function squareSize(uint256 a, uint256 b, uint256 c) internal pure returns (uint256 sum) {
        assembly ("memory-safe") {
            let x := and(shr(SCREEN_COLUMN_AT, a), SCREEN_COLUMN_MASK)
            let y := shr(SCREEN_ROW_AT, a)
            let xb := sub(and(shr(SCREEN_COLUMN_AT, b), SCREEN_COLUMN_MASK), x)
            let xc := sub(and(shr(SCREEN_COLUMN_AT, c), SCREEN_COLUMN_MASK), x)
            let yb := sub(shr(SCREEN_ROW_AT, b), y)
            let yc := sub(shr(SCREEN_ROW_AT, c), y)
            sum := add(add(mul(xb, xb), mul(xc, xc)), add(mul(yb, yb), mul(yc, yc)))
        }
    }

    /// @notice Returns the attribute word with its colour multiplied by light, lanes of Q16.
    function lit(uint256 word, uint256 factor) internal pure returns (uint256 product) {
        assembly ("memory-safe") {
            let color := and(word, LANES_24)
            product := and(factor, LANE_32) // blue light
            switch eq(factor, mul(product, ONES))
            case 1 { product := and(shr(LIGHT_FRACTION, mul(color, product)), LANES_24) } // grey: all channels at once
            default {
                product := shr(LIGHT_FRACTION, mul(product, and(color, LANE_24))) // blue
                let green := mul(and(shr(MIDDLE_AT, factor), LANE_32), and(shr(MIDDLE_AT, color), LANE_24))
                product := or(product, shl(MIDDLE_AT, shr(LIGHT_FRACTION, green)))
                product := or(product, shl(UPPER_AT, shr(LIGHT_FRACTION, mul(shr(UPPER_AT, factor), shr(UPPER_AT, color))))) // red
            }
            product := or(product, xor(word, color)) // and the depth as it is
        }
    }
}
