// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {sqrt} from "../math/Roots.sol";
import {FragmentShader} from "./FragmentShader.sol";
import {Lighting} from "./Lighting.sol";
import {OUTSIDE_BIT} from "./PrimitiveAssembly.sol";
import "./Registers.sol";

// bias of the lanes: half a level for colours
uint256 constant COLOR_BIAS = 0x100000000000200000000000002000000000000020000000000;
uint256 constant WEIGHT_BIAS = 0x100000000000000000000000000000000400000000000004000;
uint256 constant EPSILON = 0x400000000000004000000000000040000;
uint256 constant GUARDS = 0x0040000000000000400000000000004000000000000;
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
                if (load(HAS_POINT_LIGHT) != 0) store(FACE_DISTANCE, (load(DEPTH_SCALE) >> 16) / (1 + (min(attributesA, min(attributesB, attributesC)) >> 168)));
                mode = Lighting.setFace((word >> 128) & 0xffff);
                if (mode & IS_DIFFUSE == 0 && load(FACE_LIGHT) != ONES << 16) {
                    attributesA = lit(attributesA);
                    attributesB = lit(attributesB);
                    attributesC = lit(attributesC);
                }
            }
            bool affine = isAffine(attributesA, attributesB, attributesC);
            if (mode & IS_DIFFUSE == 0 && affine && (mode & IS_LIT == 0 || squareSize(a, b, c) < load(FACE_REACH))) {
                if (mode & IS_LIT != 0) {
                    attributesA = FragmentShader.vertexHighlights(attributesA, a);
                    attributesB = FragmentShader.vertexHighlights(attributesB, b);
                    attributesC = FragmentShader.vertexHighlights(attributesC, c);
                }
                assembly ("memory-safe") {
                    // colours above 255 need a loop that keeps them there
                    mode := iszero(iszero(and(or(or(attributesA, attributesB), attributesC), 0xfc000000000000fc000000000000fc0000)))
                    mstore(MODE, or(mode, and(shr(139, word), 256)))
                    mstore(LANE_BIAS, COLOR_BIAS)
                }
            } else {
                barycentric(a, b, c, attributesA, attributesB, attributesC, mode | ((word >> 139) & IS_CROSSING), affine);
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

    function barycentric(uint256 a, uint256 b, uint256 c, uint256 attributesA, uint256 attributesB, uint256 attributesC, uint256 mode, bool affine) private pure {
        unchecked {
            uint256 color = attributesA & COLOR_LANES;
            if (mode & IS_SMOOTH != 0 && setVectors(a, b, c)) {
                store(MODE, affine || mode & IS_ORTHOGRAPHIC != 0 ? mode | IS_VARYING : mode | IS_VARYING | IS_STEEP);
                color <<= 16;
            } else {
                mode |= IS_BARYCENTRIC;
                color <<= 24;
                if (mode & IS_SMOOTH == 0) {
                    uint256 size = blockSize(squareSize(a, b, c), mode, attributesA >> 168, attributesB >> 168, attributesC >> 168);
                    store(BLOCK, size);
                    if (size > 1) mode |= IS_BLOCKED;
                }
                store(MODE, mode);
            }
            store(LANE_BIAS, WEIGHT_BIAS);
            // a little more against rounding below zero
            store(COLOR_0, color + EPSILON);
            color = attributesA & COLOR_LANES;
            store(COLOR_1, (attributesB & COLOR_LANES) - color);
            store(COLOR_2, (attributesC & COLOR_LANES) - color);
            store(DEPTH_1, attributesB >> 168 << 8);
            store(DEPTH_2, attributesC >> 168 << 8);
        }
    }

    /// @notice Prepares the vectors of a smooth triangle.
    /// @return varying Whether they turn so little that light and half vectors may be interpolated as well.
    function setVectors(uint256 a, uint256 b, uint256 c) private pure returns (bool varying) {
        unchecked {
            spread(NORMALS_0, 0x40, a, b, c);
            // with several lights most of the work would be done for each of them all the same
            if (load(LIGHTS_END) != LIGHTS + LIGHT_SIZE || squareSize(a, b, c) >= load(VARYING_REACH)) return false;
            if (vertexWord(a, 0x60) == 0) FragmentShader.setVaryings(a);
            if (vertexWord(b, 0x60) == 0) FragmentShader.setVaryings(b);
            if (vertexWord(c, 0x60) == 0) FragmentShader.setVaryings(c);
            spread(REVERSED_0, 0x60, a, b, c);
            spread(HALF_0, 0xa0, a, b, c);
            spread(HALF_REVERSED_0, 0xc0, a, b, c);
            // at most 60 degrees between normals: the square of a change is 1; and 1/16 for half vectors, Q40
            if (
                changes(NORMALS_0, REVERSED_0) > 1 << 40 || changes(HALF_0, HALF_REVERSED_0) > 1 << 36
            ) return false;
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

    /// @dev Pixels over which neither light nor perspective bends the colour by more than a level.
    function blockSize(uint256 square, uint256 mode, uint256 za, uint256 zb, uint256 zc) private pure returns (uint256 size) {
        unchecked {
            uint256 nearest = max(za, max(zb, zc));
            uint256 farthest = min(za, min(zb, zc));
            uint256 reach = square * farthest / (64 * (nearest - farthest) + 1);
            if (mode & IS_LIT != 0) reach = min(reach, load(FACE_REACH));
            reach = sqrt(reach) >> 8;
            return reach > 16 ? 16 : reach == 0 ? 1 : reach;
        }
    }

    function max(uint256 a, uint256 b) private pure returns (uint256) {
        return a > b ? a : b;
    }

    function attributes(uint256 screenWord) private pure returns (uint256 word) {
        assembly ("memory-safe") {
            word := mload(add(and(screenWord, 0xffffffff), 32))
        }
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

    /// @dev Whether colours interpolated linearly on the screen are within three levels of the perspective-correct ones. Between vertices
    /// at depths z and z + dz whose colours differ by dc the two part by dc * dz / 4z at most.
    function isAffine(uint256 a, uint256 b, uint256 c) private pure returns (bool yes) {
        assembly ("memory-safe") {
            let depth := shr(168, a)
            let dz := sub(shr(168, b), depth)
            let dz2 := sub(shr(168, c), depth)
            // |dz| | |dz2|: at least the larger, less than twice it; 2^18 - 1 keeps the bound below 2^50
            dz := or(or(xor(dz, sar(255, dz)), xor(dz2, sar(255, dz2))), 0x3ffff)
            // bound of dc, Q10, in each lane, with a bit above that a difference beyond it clears
            depth := add(mul(div(mul(12288, depth), dz), ONES), GUARDS)
            b := sub(b, a)
            c := sub(c, a)
            yes := eq(and(and(and(add(depth, b), sub(depth, b)), and(add(depth, c), sub(depth, c))), GUARDS), GUARDS)
        }
    }
}
