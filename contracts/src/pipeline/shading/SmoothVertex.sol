// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {sqrtNear} from "../../math/Roots.sol";
import "../../words/Registers.sol";

// Computes what `cosines_of` of picture.py needs of a vertex.
// The part of a vertex record of a smooth surface that is common to all adjacent triangles, for the light of one lamp: see SmoothTriangle.

/// @dev VERTEX_STATE: LIT if the words of the record are present and bounded, UNBOUNDED if they cannot be used, otherwise 0; and OPEN if
/// |L + V|^2 is at least 3. The bits of the first two; above them NUMBERS: see OpenEdges.
uint256 constant LIT = 1;
uint256 constant UNBOUNDED = 2;
uint256 constant OPEN = 4;
uint256 constant IS_FILLED = 3;

/// @dev Half the range of a lane of 85 bits, for vectors of Q20.
uint256 constant VECTOR_BIAS = 0x100000000000000000000080000000000000000000040000000;
/// @dev The position of the square of a normal, Q40, in the product of a normal and twice the one with reversed lanes.
uint256 constant SQUARE_AT = 171;
/// @dev From Q20 to the Q29 of VERTEX_HALF.
uint256 constant Q20_TO_Q29 = 9;
/// @dev 15/16 and 1/8, Q40: the minimum of the squares of normals and their range.
uint256 constant LEAST_SQUARE = 0xf000000000;
uint256 constant SQUARES = 0x2000000000;
/// @dev 1, Q40: half vectors L + V shorter than one turn too fast; and 3, one less.
uint256 constant LEAST_HALF_SQUARE = 0x10000000000;
uint256 constant BELOW_OPEN_HALF_SQUARE = 0x2ffffffffff;

library SmoothVertex {
    /// @notice Fills those records of three vertices that are new, and returns what their states have in common.
    /// @param a, b, c The addresses of the vertex records.
    function fillNew(uint256 a, uint256 b, uint256 c) internal pure returns (uint256 state) {
        unchecked {
            if (load(a + VERTEX_STATE) & IS_FILLED == 0) fill(a);
            if (load(b + VERTEX_STATE) & IS_FILLED == 0) fill(b);
            if (load(c + VERTEX_STATE) & IS_FILLED == 0) fill(c);
            return load(a + VERTEX_STATE) & load(b + VERTEX_STATE) & load(c + VERTEX_STATE);
        }
    }

    /// @notice Sets the record at MIDDLE to the middle of two vertices, without a normal.
    /// @param u, v The addresses of the vertex records.
    function setMiddle(uint256 u, uint256 v) internal pure {
        assembly ("memory-safe") {
            // row and column: the mean of both
            mstore(MIDDLE, shl(SCREEN_COLUMN_AT, shr(1, add(shr(SCREEN_COLUMN_AT, mload(u)), shr(SCREEN_COLUMN_AT, mload(v))))))
            u := add(u, VERTEX_ATTRIBUTES) // an address of its attributes from here on; v the depth
            v := shr(ATTRIBUTE_DEPTH_AT, mload(add(v, VERTEX_ATTRIBUTES)))
            v := shl(ATTRIBUTE_DEPTH_AT, shr(1, add(shr(ATTRIBUTE_DEPTH_AT, mload(u)), v))) // (depth of u + depth of v) / 2
            mstore(add(MIDDLE, VERTEX_ATTRIBUTES), v)
        }
        unchecked {
            // not literals: see ZERO_SLOT
            u = load(ZERO_SLOT);
            setDirections(u + MIDDLE, u + 1);
        }
    }

    /// @dev Fills the words of a record after its normal: the reversed normal, L, and H.
    function fill(uint256 vertex) private pure {
        uint256 bounded;
        assembly ("memory-safe") {
            let n := mload(add(vertex, VERTEX_NORMAL)) // N, Q20, and r the reversed one, doubled
            let r := add(n, VECTOR_BIAS) // positive lanes
            r := shl(1, sub(or(or(shl(UPPER_85_AT, and(r, LANE_85)), shr(UPPER_85_AT, r)), and(r, MIDDLE_LANE_85)), VECTOR_BIAS))
            mstore(add(vertex, VERTEX_REVERSED), r)
            // the square of the normal, Q40, must be 15/16 to 17/16
            bounded := lt(sub(sar(SQUARE_AT, mul(n, r)), LEAST_SQUARE), SQUARES)
        }
        setDirections(vertex, bounded);
    }

    /// @dev Sets L and H of a record, and its state: LIT if they are bounded, and its normal is.
    function setDirections(uint256 vertex, uint256 bounded) private pure {
        unchecked {
            // the ray (x, y, 1), Q24
            uint256 x;
            uint256 y;
            assembly ("memory-safe") {
                y := mload(vertex) // the screen word, for now
                x := and(shr(SCREEN_COLUMN_AT, y), SCREEN_COLUMN_MASK)
                x := add(mload(RAY_LEFT), sar(SUBPIXEL_BITS, mul(x, mload(RAY_STEP)))) // RAY_LEFT + column * RAY_STEP
                y := add(mload(RAY_TOP), sar(SUBPIXEL_BITS, mul(shr(SCREEN_ROW_AT, y), mload(RAY_STEP))))
            }
            uint256 length = ONE_24;
            uint256 light = LIGHTS + load(LIGHT_OFFSET);
            uint256 lx = load(light + LIGHT_X);
            uint256 ly = load(light + LIGHT_Y);
            uint256 lz = load(light + LIGHT_Z);
            if (load(light + LIGHT_IS_POINT) != 0) {
                assembly ("memory-safe") {
                    // from the vertex to the light, Q16
                    let z := div(mload(DEPTH_SCALE), shr(ATTRIBUTE_DEPTH_AT, mload(add(vertex, VERTEX_ATTRIBUTES)))) // distance, Q32
                    let place := sar(Q40, mul(x, z)) // Q24 * Q32 to Q16
                    lx := sub(lx, place)
                    let square := mul(place, place)
                    place := sar(Q40, mul(y, z)) // y of the vertex, Q16
                    ly := sub(ly, place)
                    square := add(square, mul(place, place)) // + y^2
                    z := shr(Q16, z)
                    lz := sub(lz, z)
                    square := add(square, mul(z, z)) // of the distance from the eye, Q32
                    length := add(add(mul(lx, lx), mul(ly, ly)), mul(lz, lz)) // |L|^2, Q32
                    // the light must not be nearer than the eye by more than a factor of the root of 5/4
                    bounded := and(bounded, iszero(gt(shl(2, square), mul(5, length)))) // 4 * square <= 5 * |L|^2
                }
                length = sqrtNear(length, light + LIGHT_HINT);
            }
            assembly ("memory-safe") {
                lx := sdiv(shl(Q20, lx), length) // L / |L|, Q20
                ly := sdiv(shl(Q20, ly), length)
                lz := sdiv(shl(Q20, lz), length)
                mstore(add(vertex, VERTEX_LIGHT), shl(1, add(add(lz, shl(MIDDLE_85_AT, ly)), shl(UPPER_85_AT, lx)))) // 2 L, reversed
                if mload(FRAME_IS_ORTHOGRAPHIC) {
                    x := 0
                    y := 0
                }
                length := add(add(mul(x, x), mul(y, y)), ONE_48) // x^2 + y^2 + 1, Q48
            }
            // H = L + V, where V is the reversed ray; hints are not literals here: see ZERO_SLOT
            length = sqrtNear(length, load(ZERO_SLOT) + RAY_HINT);
            assembly ("memory-safe") {
                lx := sub(lx, sdiv(shl(Q20, x), length)) // Q20; H from here on
                ly := sub(ly, sdiv(shl(Q20, y), length))
                lz := sub(lz, div(ONE_44, length)) // 1 / |r|: Q44 / Q24
                length := add(add(mul(lx, lx), mul(ly, ly)), mul(lz, lz)) // |H|^2, Q40
                // not opposite to the light, where it turns arbitrarily fast
                bounded := and(bounded, gt(length, LEAST_HALF_SQUARE))
            }
            uint256 state = length > BELOW_OPEN_HALF_SQUARE ? OPEN : 0;
            length = sqrtNear(length, load(ZERO_SLOT) + HALF_HINT);
            assembly ("memory-safe") {
                lx := sdiv(shl(Q20, lx), length) // H / |H|, Q20
                ly := sdiv(shl(Q20, ly), length)
                lz := sdiv(shl(Q20, lz), length)
                mstore(add(vertex, VERTEX_HALF), shl(Q20_TO_Q29, add(add(lx, shl(MIDDLE_85_AT, ly)), shl(UPPER_85_AT, lz)))) // H, Q29
                mstore(add(vertex, VERTEX_HALF_REVERSED), shl(1, add(add(lz, shl(MIDDLE_85_AT, ly)), shl(UPPER_85_AT, lx)))) // 2 H
                vertex := add(vertex, VERTEX_STATE)
                mstore(vertex, or(and(mload(vertex), NUMBERS), or(state, sub(UNBOUNDED, bounded)))) // bounded ? LIT : UNBOUNDED
            }
        }
    }
}
