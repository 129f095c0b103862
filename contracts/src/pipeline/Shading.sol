// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {sqrt} from "../math/Roots.sol";
import {FragmentShader, OVERFLOW, WEIGHTED_BIAS} from "./FragmentShader.sol";
import {Lighting} from "./Lighting.sol";
import "./Registers.sol";

// bias of the lanes: half a level for colours
uint256 constant COLOR_BIAS = 0x100000000000200000000000002000000000000020000000000;
/// @dev Lifts every colour of which a fragment may come out above 255 into the bits of OVERFLOW: half a level, by which fragments are
/// rounded, and eight steps of Q10 more, since interpolation is off by one at most.
uint256 constant NEARLY_ABOVE = 0x2080000000000020800000000000208;
uint256 constant WEIGHT_BIAS = 0x100000000000000000000000000000000400000000000004000;
/// @dev Keeps colours between interpolated vectors (Q26) from being rounded below zero: 1/32 of a level.
uint256 constant VARYING_BIAS = 0x2000000000000020000000000000200000;
/// @dev A bit above the numbers of each lane; and the limit of a pair: 4 times 3 levels, Q30.
uint256 constant GUARDS = 0x00400000000000004000000000000040000000000000;
uint256 constant LIMITS = 0x00000003000000000000030000000000000300000000;
uint256 constant COLOR_LANES = 0xffffff00000000ffffff00000000ffffff;

/// @notice How finely a triangle has to be shaded.
library Shading {
    function prepare(uint256 word) internal pure {
        unchecked {
            uint256 a;
            uint256 b;
            uint256 c;
            uint256 attributesA;
            uint256 attributesB;
            uint256 attributesC;
            assembly ("memory-safe") {
                c := and(shr(64, word), 0xffffffff)
                a := mload(c)
                attributesA := mload(add(c, 32))
                c := and(shr(32, word), 0xffffffff)
                b := mload(c)
                attributesB := mload(add(c, 32))
                c := and(word, 0xffffffff)
                attributesC := mload(add(c, 32))
                c := mload(c)
            }
            uint256 mode = load(OBJECT_MODE);
            if (mode & IS_FLAT != 0) {
                mode = Lighting.setFace((word >> 128) & 0xffff);
                if (mode & IS_DIFFUSE == 0 && load(FACE_LIGHT) != ONES << 16) {
                    attributesA = lit(attributesA);
                    attributesB = lit(attributesB);
                    attributesC = lit(attributesC);
                }
            }
            if (
                mode & IS_DIFFUSE == 0 && isAffine(attributesA, attributesB, attributesC, word)
                    && (mode & IS_LIT == 0 || squareSize(a, b, c) < load(REACH))
            ) {
                if (mode & IS_LIT != 0) {
                    attributesA = FragmentShader.vertexHighlights(attributesA, a);
                    attributesB = FragmentShader.vertexHighlights(attributesB, b);
                    attributesC = FragmentShader.vertexHighlights(attributesC, c);
                }
                assembly ("memory-safe") {
                    // colours above 255 need a loop that keeps them there
                    mode := or(or(add(attributesA, NEARLY_ABOVE), add(attributesB, NEARLY_ABOVE)), add(attributesC, NEARLY_ABOVE))
                    mode := iszero(iszero(and(mode, OVERFLOW)))
                    mstore(MODE, or(mode, and(shr(139, word), 256)))
                    mstore(LANE_BIAS, COLOR_BIAS)
                }
            } else {
                barycentric(a, b, c, attributesA, attributesB, attributesC, mode | ((word >> 139) & IS_CROSSING));
                attributesA = attributesA >> 168 << 168;
                attributesB = (attributesB >> 168 << 168) | (1 << 56);
                attributesC = (attributesC >> 168 << 168) | 1;
            }
            assembly ("memory-safe") {
                mstore(ATTRIBUTE_0, attributesA)
                mstore(ATTRIBUTE_1, attributesB)
                mstore(ATTRIBUTE_2, attributesC)
            }
        }
    }

    function min(uint256 a, uint256 b) private pure returns (uint256) {
        return a < b ? a : b;
    }

    /// @dev The sum of the squares of two edges, in sub-pixels.
    function squareSize(uint256 a, uint256 b, uint256 c) private pure returns (uint256 sum) {
        assembly ("memory-safe") {
            let x := and(shr(64, a), 0xfffff)
            let y := shr(128, a)
            let xb := sub(and(shr(64, b), 0xfffff), x)
            let xc := sub(and(shr(64, c), 0xfffff), x)
            let yb := sub(shr(128, b), y)
            let yc := sub(shr(128, c), y)
            sum := add(add(mul(xb, xb), mul(xc, xc)), add(mul(yb, yb), mul(yc, yc)))
        }
    }

    function barycentric(uint256 a, uint256 b, uint256 c, uint256 attributesA, uint256 attributesB, uint256 attributesC, uint256 mode)
        private
        pure
    {
        unchecked {
            uint256 color = attributesA & COLOR_LANES;
            uint256 nearest = max(attributesA, max(attributesB, attributesC)) >> 168;
            uint256 farthest = min(attributesA, min(attributesB, attributesC)) >> 168;
            if (mode & IS_SMOOTH != 0) spread(NORMALS_0, 0x40, a, b, c);
            // weights of 16 bits bear a division by depths that differ by a factor of two
            if (mode & IS_SMOOTH != 0 && nearest < 2 * farthest && setVectors(a, b, c)) {
                mode |= IS_VARYING;
                // else the weights of linear interpolation are right to 1/128
                if (32 * (nearest - farthest) >= farthest && mode & IS_ORTHOGRAPHIC == 0) mode |= IS_STEEP;
                color = (color << 16) + VARYING_BIAS;
            } else {
                mode |= IS_BARYCENTRIC;
                if (nearest >= 64 * farthest) mode |= IS_STEEP;
                if (nearest >= farthest << 12) mode |= IS_DEEP;
                color = (color << 24) + WEIGHTED_BIAS;
                if (mode & IS_SMOOTH == 0) {
                    uint256 size = blockSize(squareHeight(a, b, c), mode, nearest, farthest);
                    store(BLOCK, size);
                    store(BLOCK_BEGIN, load(COLUMN_BEGIN) / size * size);
                    if (size > 1) mode |= IS_BLOCKED;
                }
            }
            store(MODE, mode);
            store(LANE_BIAS, WEIGHT_BIAS);
            store(COLOR_0, color);
            color = attributesA & COLOR_LANES;
            store(COLOR_1, (attributesB & COLOR_LANES) - color);
            store(COLOR_2, (attributesC & COLOR_LANES) - color);
            store(DEPTH_1, attributesB >> 168 << 8);
            store(DEPTH_2, attributesC >> 168 << 8);
        }
    }

    /// @notice Prepares the vectors of a smooth triangle, of which the normals are there.
    /// @return varying Whether they turn so little that light and half vectors may be interpolated as well.
    function setVectors(uint256 a, uint256 b, uint256 c) private pure returns (bool varying) {
        unchecked {
            // with several lights most of the work would be done for each of them all the same
            if (load(LIGHTS_END) != LIGHTS + LIGHT_SIZE || squareSize(a, b, c) >= load(VARYING_REACH)) return false;
            if (vertexWord(a, 0x60) == 0) FragmentShader.setVaryings(a);
            if (vertexWord(b, 0x60) == 0) FragmentShader.setVaryings(b);
            if (vertexWord(c, 0x60) == 0) FragmentShader.setVaryings(c);
            spread(REVERSED_0, 0x60, a, b, c);
            spread(HALF_0, 0xa0, a, b, c);
            spread(HALF_REVERSED_0, 0xc0, a, b, c);
            // at most 60 degrees between normals: the square of a change is 1, Q40
            if (changes(NORMALS_0, REVERSED_0) > 1 << 40 || changes(HALF_0, HALF_REVERSED_0) > loadSigned(HALF_REACH)) return false;
            spread(TO_LIGHT_0, 0x80, a, b, c);
            return true;
        }
    }

    /// @dev At least the larger of the squares of the changes of a vector to the second and to the third vertex, Q40.
    function changes(uint256 vectors, uint256 reversed) private pure returns (int256 squares) {
        assembly ("memory-safe") {
            squares := sar(171, shl(1, mul(mload(add(vectors, 0x20)), mload(add(reversed, 0x20)))))
            squares := or(squares, sar(171, shl(1, mul(mload(add(vectors, 0x40)), mload(add(reversed, 0x40))))))
        }
    }

    function vertexWord(uint256 screenWord, uint256 offset) private pure returns (uint256 word) {
        assembly ("memory-safe") {
            word := mload(add(and(screenWord, 0xffffffff), offset))
        }
    }

    /// @dev A value of the three vertices as the value at the first, Q36, and the differences to the others, Q20.
    function spread(uint256 pointer, uint256 offset, uint256 a, uint256 b, uint256 c) private pure {
        assembly ("memory-safe") {
            a := mload(add(and(a, 0xffffffff), offset))
            mstore(pointer, shl(16, a))
            mstore(add(pointer, 0x20), sub(mload(add(and(b, 0xffffffff), offset)), a))
            mstore(add(pointer, 0x40), sub(mload(add(and(c, 0xffffffff), offset)), a))
        }
    }

    /// @dev Twice the area, in sub-pixels.
    function doubleArea(uint256 a, uint256 b, uint256 c) private pure returns (uint256 area) {
        assembly ("memory-safe") {
            let x := and(shr(64, a), 0xfffff)
            let y := shr(128, a)
            area := mul(sub(and(shr(64, c), 0xfffff), x), sub(shr(128, b), y))
            area := sub(area, mul(sub(and(shr(64, b), 0xfffff), x), sub(shr(128, c), y)))
        }
    }

    /// @dev The square of about the least height of a triangle, in sub-pixels: the square of twice its area by that of a longest edge,
    /// for which the sum of the squares of two edges stands.
    function squareHeight(uint256 a, uint256 b, uint256 c) private pure returns (uint256) {
        unchecked {
            uint256 area = doubleArea(a, b, c);
            return area * area / squareSize(a, b, c);
        }
    }

    /// @dev Pixels over which interpolation between exact colours does little harm. Over n pixels of a triangle of height h perspective
    /// bends them by dc * dz / 4z * (n / h)^2, times the factor by which colours change faster where it is far: by 6 levels of 255, or 4.5
    /// without light, where black and white, the least height and the farthest end come together, which leaves less than 4 in the pictures
    /// that are measured. REACH is the square of the n for one and a half levels of light.
    function blockSize(uint256 square, uint256 mode, uint256 nearest, uint256 farthest)
        private
        pure
        returns (uint256 size)
    {
        unchecked {
            uint256 bend = (mode & IS_LIT == 0 ? 14 : 10) * (nearest - farthest) + 1;
            uint256 reach = square * farthest / bend * farthest / (nearest + 1);
            if (mode & IS_LIT != 0) reach = min(reach, 2 * (mode & IS_DIFFUSE == 0 ? load(REACH) : Lighting.pointReach(farthest)));
            reach = sqrt(reach) >> 8;
            return reach > 16 ? 16 : reach == 0 ? 1 : reach;
        }
    }

    function max(uint256 a, uint256 b) private pure returns (uint256) {
        return a > b ? a : b;
    }

    /// @dev The attribute word with the light of the face on its colour.
    function lit(uint256 word) private pure returns (uint256 product) {
        assembly ("memory-safe") {
            let factor := mload(FACE_LIGHT)
            let color := and(word, COLOR_LANES)
            product := and(factor, 0xffffffff)
            switch eq(factor, mul(product, ONES))
            case 1 { product := and(shr(16, mul(color, product)), COLOR_LANES) }
            default {
                product := shr(16, mul(product, and(color, 0xffffff)))
                product := or(product, shl(56, shr(16, mul(and(shr(56, factor), 0xffffffff), and(shr(56, color), 0xffffff)))))
                product := or(product, shl(112, shr(16, mul(shr(112, factor), shr(112, color)))))
            }
            product := or(product, xor(word, color))
        }
    }

    /// @dev Whether colours interpolated linearly on the screen are within four levels of the perspective-correct ones, or within two in
    /// triangles that are large, on which the mean error of a picture depends. With weights w, depths z and colours c the two part by the
    /// sum of w_i w_j (z_i - z_j) (c_i - c_j) / z over the three pairs of vertices, where w_i w_j is 1/4 at most, and their sum 1/3: three
    /// levels, or one and a half, are allowed to each pair alone.
    function isAffine(uint256 a, uint256 b, uint256 c, uint256 word) private pure returns (bool yes) {
        uint256 least;
        uint256 most;
        uint256 bright;
        assembly ("memory-safe") {
            least := xor(a, mul(xor(a, b), lt(b, a)))
            most := xor(xor(a, b), least)
            least := shr(168, xor(least, mul(xor(least, c), lt(c, least))))
            most := sub(shr(168, xor(most, mul(xor(most, c), lt(most, c)))), least)
            bright := and(or(or(a, b), c), OVERFLOW)
            // colours of up to 255 may differ as they like where depths do not by more than 8 / 255, in small triangles 12 / 255
            yes := iszero(or(gt(mul(33, most), least), bright))
        }
        if (yes) return true;
        bool large = isLarge(word);
        assembly ("memory-safe") {
            yes := iszero(or(or(gt(mul(22, most), least), bright), large))
            if iszero(yes) {
                let limits := or(GUARDS, shr(large, LIMITS))
                let inverse := div(0x1000000000000000000000, least)
                b := sub(b, a)
                c := sub(c, a)
                a := sub(c, b)
                // |z_i - z_j| / z, Q20
                let rb := sar(168, b)
                rb := shr(64, mul(xor(rb, sar(255, rb)), inverse))
                let rc := sar(168, c)
                rc := shr(64, mul(xor(rc, sar(255, rc)), inverse))
                let ra := sar(168, a)
                ra := shr(64, mul(xor(ra, sar(255, ra)), inverse))
                // more would not fit the lanes where colours are up to 20 times 255
                yes := lt(or(or(rb, rc), ra), 0x100000000)
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
    function isLarge(uint256 word) private pure returns (bool large) {
        unchecked {
            uint256 rows = ((word >> 112) & 0xffff) - ((word >> 96) & 0xffff);
            if (rows > 8) {
                large = doubleArea(load((word >> 64) & 0xffffffff), load((word >> 32) & 0xffffffff), load(word & 0xffffffff)) > rows * (3 << 17);
            }
        }
    }
}
