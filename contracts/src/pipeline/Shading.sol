// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {WEIGHTED_BIAS} from "./FragmentLight.sol";
import {Lighting} from "./Lighting.sol";
import {VERTEX_NORMAL} from "./SmoothLight.sol";
import "./Registers.sol";

// What the ways to shade a triangle have in common: whether colours may be linear on the screen, and the registers of those that are, and
// of those of which each fragment is lit for itself.

/// @dev A bit above the numbers of each lane; and the limit of a pair: 4 times 3 levels, Q30.
uint256 constant GUARDS = 0x00400000000000004000000000000040000000000000;
uint256 constant LIMITS = 0x00000003000000000000030000000000000300000000;
uint256 constant COLOR_LANES = 0xffffff00000000ffffff00000000ffffff;

library Shading {
    /// @notice The attribute words of the vertices with these screen words.
    function attributesOf(uint256 a, uint256 b, uint256 c) internal pure returns (uint256, uint256, uint256) {
        assembly ("memory-safe") {
            a := mload(add(and(a, SCREEN_RECORD_MASK), VERTEX_ATTRIBUTES))
            b := mload(add(and(b, SCREEN_RECORD_MASK), VERTEX_ATTRIBUTES))
            c := mload(add(and(c, SCREEN_RECORD_MASK), VERTEX_ATTRIBUTES))
        }
        return (a, b, c);
    }

    /// @notice The normal and the light of a flat face.
    /// @return mode How its fragments are lit. If by highlights only, the colours of the attribute words have the rest of the light on
    /// them.
    function setFace(uint256 attributesA, uint256 attributesB, uint256 attributesC)
        internal
        pure
        returns (uint256 mode, uint256, uint256, uint256)
    {
        unchecked {
            mode = Lighting.setFace();
            Lighting.setFacing();
            if (mode & IS_DIFFUSE == 0 && load(FACE_LIGHT) != ONES << 16) {
                return (mode, lit(attributesA), lit(attributesB), lit(attributesC));
            }
            return (mode, attributesA, attributesB, attributesC);
        }
    }

    /// @dev The registers of a triangle whose colours change linearly.
    function setLinear(uint256 attributesA, uint256 attributesB, uint256 attributesC, uint256 mode) internal pure {
        assembly ("memory-safe") {
            mstore(MODE, mode)
            mstore(ATTRIBUTE_0, add(shl(ACCUMULATOR_FRACTION, attributesA), COLOR_BIAS))
            mstore(DELTA_1, sub(attributesB, attributesA))
            mstore(DELTA_2, sub(attributesC, attributesA))
        }
    }

    /// @dev Whether colours interpolated linearly on the screen are within four levels of the perspective-correct ones, or within two in
    /// triangles that are large, on which the mean error of a picture depends. With weights w, depths z and colours c the two part by the
    /// sum of w_i w_j (z_i - z_j) (c_i - c_j) / z over the three pairs of vertices, where w_i w_j is 1/4 at most, and their sum 1/3: three
    /// levels, or one and a half, are allowed to each pair alone.
    function isAffine(uint256 a, uint256 b, uint256 c, uint256 screenA, uint256 screenB, uint256 screenC)
        internal
        pure
        returns (bool yes)
    {
        uint256 least;
        uint256 most;
        uint256 bright;
        assembly ("memory-safe") {
            least := xor(a, mul(xor(a, b), lt(b, a)))
            most := xor(xor(a, b), least)
            least := shr(ATTRIBUTE_DEPTH_AT, xor(least, mul(xor(least, c), lt(c, least))))
            most := sub(shr(ATTRIBUTE_DEPTH_AT, xor(most, mul(xor(most, c), lt(most, c)))), least)
            bright := and(or(or(a, b), c), OVERFLOW)
            // colours of up to 255 may differ as they like where depths do not by more than 8 / 255, in small triangles 12 / 255
            yes := iszero(or(gt(mul(33, most), least), bright))
        }
        if (yes) return true;
        bool large = isLarge(screenA, screenB, screenC);
        assembly ("memory-safe") {
            yes := iszero(or(or(gt(mul(22, most), least), bright), large))
            if iszero(yes) {
                let limits := or(GUARDS, shr(large, LIMITS))
                let inverse := div(0x1000000000000000000000, least)
                b := sub(b, a)
                c := sub(c, a)
                a := sub(c, b)
                // |z_i - z_j| / z, Q20
                let rb := sar(ATTRIBUTE_DEPTH_AT, b)
                rb := shr(64, mul(xor(rb, sar(255, rb)), inverse))
                let rc := sar(ATTRIBUTE_DEPTH_AT, c)
                rc := shr(64, mul(xor(rc, sar(255, rc)), inverse))
                let ra := sar(ATTRIBUTE_DEPTH_AT, a)
                ra := shr(64, mul(xor(ra, sar(255, ra)), inverse))
                // more would not fit the lanes where colours are up to 20 times 255
                yes := lt(or(or(rb, rc), ra), ONE_32)
                // its product with the difference of the colours (Q10), in each lane: if it is above the limit, a bit above is cleared
                b := mul(b, rb)
                c := mul(c, rc)
                a := mul(a, ra)
                rb := and(and(add(limits, b), sub(limits, b)), and(add(limits, c), sub(limits, c)))
                rb := and(and(rb, GUARDS), and(add(limits, a), sub(limits, a)))
                yes := and(yes, eq(rb, GUARDS))
            }
        }
    }

    /// @dev Whether a triangle has more than 8 rows, of more than 3 pixels in the mean. To shade others in blocks would be dear, and
    /// change little.
    function isLarge(uint256 a, uint256 b, uint256 c) internal pure returns (bool large) {
        unchecked {
            uint256 rows = ((max(b, c) + load(ROUND_BOTTOM)) >> SCREEN_PIXEL_ROW_AT) - ((a + load(ROUND_TOP)) >> SCREEN_PIXEL_ROW_AT);
            large = rows > 8 && doubleArea(a, b, c) > rows * (3 << 17);
        }
    }

    /// @notice The registers of a triangle of which each fragment is lit for itself.
    function setExact(uint256 a, uint256 b, uint256 c, uint256 attributesA, uint256 attributesB, uint256 attributesC, uint256 mode)
        internal
        pure
    {
        unchecked {
            uint256 nearest = max(attributesA, max(attributesB, attributesC)) >> ATTRIBUTE_DEPTH_AT;
            uint256 farthest = min(attributesA, min(attributesB, attributesC)) >> ATTRIBUTE_DEPTH_AT;
            mode |= IS_PATCHED;
            if (nearest >= 64 * farthest) mode |= IS_STEEP;
            if (nearest >= farthest << 12) mode |= IS_DEEP;
            store(MODE, mode);
            store(PATCH_SIZE, 1);
            store(PATCH_BEGIN, 0);
            store(PATCH_END, GUARD_BAND);
            uint256 color = attributesA & COLOR_LANES;
            store(COLOR_0, (color << 24) + WEIGHTED_BIAS);
            store(COLOR_1, (attributesB & COLOR_LANES) - color);
            store(COLOR_2, (attributesC & COLOR_LANES) - color);
            attributesA >>= ATTRIBUTE_DEPTH_AT;
            attributesB >>= ATTRIBUTE_DEPTH_AT;
            attributesC >>= ATTRIBUTE_DEPTH_AT;
            store(DEPTH_1, attributesB << 8);
            store(DEPTH_2, attributesC << 8);
            if (mode & IS_DEEP != 0) {
                setDepths(a, b, c, attributesA, attributesB - attributesA, attributesC - attributesA);
                (attributesA, attributesB, attributesC) = (0, 0, 0);
            }
            store(ATTRIBUTE_0, (attributesA << ACCUMULATOR_VERTEX_DEPTH_AT) + WEIGHT_BIAS);
            store(DELTA_1, ((attributesB - attributesA) << ATTRIBUTE_DEPTH_AT) + ATTRIBUTE_S);
            store(DELTA_2, ((attributesC - attributesA) << ATTRIBUTE_DEPTH_AT) + 1);
        }
    }

    /// @dev Depths by themselves, Q32, for which barycentric coordinates are too coarse.
    /// @param z The depth at the first vertex; zb, zc the differences to the others.
    function setDepths(uint256 a, uint256 b, uint256 c, uint256 z, uint256 zb, uint256 zc) internal pure {
        assembly ("memory-safe") {
            let x := and(shr(SCREEN_COLUMN_AT, a), SCREEN_COLUMN_MASK)
            let xb := sub(and(shr(SCREEN_COLUMN_AT, b), SCREEN_COLUMN_MASK), x)
            let xc := sub(and(shr(SCREEN_COLUMN_AT, c), SCREEN_COLUMN_MASK), x)
            a := shr(SCREEN_ROW_AT, a)
            b := sub(shr(SCREEN_ROW_AT, b), a)
            c := sub(shr(SCREEN_ROW_AT, c), a)
            let area := sub(mul(xc, b), mul(xb, c))
            let dx := sdiv(shl(40, sub(mul(zc, b), mul(zb, c))), area)
            let dy := sdiv(shl(40, sub(mul(zb, xc), mul(zc, xb))), area)
            mstore(DEEP_DX, shl(ATTRIBUTE_DEPTH_AT, dx))
            mstore(DEEP_DY, shl(ATTRIBUTE_DEPTH_AT, dy))
            // from the first vertex to the centre of pixel 0 in the first row
            mstore(DEEP_START, shl(ATTRIBUTE_DEPTH_AT, add(shl(32, z), sar(8, sub(mul(and(sub(0, a), SUBPIXEL_MASK), dy), mul(x, dx))))))
        }
    }

    /// @notice The normals of the vertices: the first, Q36, and the differences to the others, Q20.
    function setNormals(uint256 a, uint256 b, uint256 c) internal pure {
        assembly ("memory-safe") {
            a := mload(add(and(a, SCREEN_RECORD_MASK), VERTEX_NORMAL))
            mstore(NORMALS_0, shl(16, a))
            mstore(NORMALS_1, sub(mload(add(and(b, SCREEN_RECORD_MASK), VERTEX_NORMAL)), a))
            mstore(NORMALS_2, sub(mload(add(and(c, SCREEN_RECORD_MASK), VERTEX_NORMAL)), a))
        }
    }

    /// @dev The sum of the squares of two edges, in sub-pixels.
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

    /// @dev Twice the area, in sub-pixels.
    function doubleArea(uint256 a, uint256 b, uint256 c) internal pure returns (uint256 area) {
        assembly ("memory-safe") {
            let x := and(shr(SCREEN_COLUMN_AT, a), SCREEN_COLUMN_MASK)
            let y := shr(SCREEN_ROW_AT, a)
            area := mul(sub(and(shr(SCREEN_COLUMN_AT, c), SCREEN_COLUMN_MASK), x), sub(shr(SCREEN_ROW_AT, b), y))
            area := sub(area, mul(sub(and(shr(SCREEN_COLUMN_AT, b), SCREEN_COLUMN_MASK), x), sub(shr(SCREEN_ROW_AT, c), y)))
        }
    }

    function min(uint256 a, uint256 b) internal pure returns (uint256) {
        return a < b ? a : b;
    }

    function max(uint256 a, uint256 b) internal pure returns (uint256) {
        return a > b ? a : b;
    }

    /// @dev The attribute word with the light of the face on its colour.
    function lit(uint256 word) private pure returns (uint256 product) {
        assembly ("memory-safe") {
            let factor := mload(FACE_LIGHT)
            let color := and(word, COLOR_LANES)
            product := and(factor, LANE_32)
            switch eq(factor, mul(product, ONES))
            case 1 { product := and(shr(16, mul(color, product)), COLOR_LANES) }
            default {
                product := shr(16, mul(product, and(color, LANE_24)))
                product := or(
                    product,
                    shl(MIDDLE_AT, shr(16, mul(and(shr(MIDDLE_AT, factor), LANE_32), and(shr(MIDDLE_AT, color), LANE_24))))
                )
                product := or(product, shl(UPPER_AT, shr(16, mul(shr(UPPER_AT, factor), shr(UPPER_AT, color)))))
            }
            product := or(product, xor(word, color))
        }
    }
}
