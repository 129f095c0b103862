// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import "../../words/SampleRegisters.sol";

// Interpolates `cosines_of` of picture.py between six places of a triangle.
// The light of a lamp on smooth triangles of several pixels. The products of SmoothTriangle need a root and two divisions at each fragment;
// here these are done at six nodes, and what they yield is interpolated: N * H and N * L of unit vectors, Q19, in the lower two of four
// signed lanes of 64 bits; those of a second lamp are in the other two. Fragments have 34 more bits: coordinates are Q17, LESS_BITS shorter
// than those of products. In a triangle of 200 pixels, their rounding moves the light by 1/1300 of it.
//
// If a normal turns by the angle d along an edge, the third derivatives of both are about d^3. The light of a lamp may be off by 2 * d^3
// levels of 255, so edges may turn by up to d^2 = 0.65. The highlight, of the strength m, changes with the angle by up to 0.6 * sqrt(n)
// * m: where there may be one, d^2 is at most 1 / sqrt(n * m). There is none if no node has a square of N * H above FAR_FROM_HIGHLIGHT -
// 0.19. Other triangles keep their products. A search for the worst triangles finds 12.2 levels: see tests/test_smooth_light.py. A
// comparison at one point within the triangle in place of these bounds would not do: there may be hundreds of levels elsewhere.

/// @dev The greatest square of a turn, Q20: 0.65; the least N * N at vertices: 3/4, so that it is 1/2 at midpoints. From there to 17/16, a
/// step of Newton's method from NEAR_ROOT_AT_0 + (N * N) * NEAR_ROOT_SLOPE >> ROOT_SHIFT gives its root to 1/23,000.
uint256 constant MOST_TURN = 0xa6666;
uint256 constant LEAST_SQUARE_20 = 0xc0000;
uint256 constant NEAR_ROOT_SLOPE = 594;
uint256 constant NEAR_ROOT_AT_0 = 7268834047;
/// @dev From products of Q20 to N * N in the unit of ROOT_SLOPE, Q68; to others, divided by the double length, Q34, to Q19; the bits that
/// coordinates are shorter.
uint256 constant Q20_TO_Q68 = 48;
uint256 constant PRODUCT_TO_LIGHT = 34;
uint256 constant LESS_BITS = 7;

library SmoothLight {
    /// @notice Replaces the coefficients of a triangle's products by those of the light, if they are exact enough.
    function normalise() internal pure returns (bool done) {
        assembly ("memory-safe") {
            // the light for products that are multiplied by 2^k
            function at(products, k) -> light {
                let square := shl(sub(Q20_TO_Q68, k), sar(UPPER_85_AT, products)) // N.N
                let t := add(shr(ROOT_SHIFT, mul(NEAR_ROOT_SLOPE, square)), NEAR_ROOT_AT_0) // about |N|, Q34
                t := add(t, div(square, t)) // one step of Newton: 2 |N|
                k := sub(PRODUCT_TO_LIGHT, k)
                light := sdiv(shl(k, sar(LOWER_85_TO_TOP, shl(LOWER_85_TO_TOP, products))), t) // N.H
                light := add(light, shl(LANE_1_AT, sdiv(shl(k, sar(LOWER_85_TO_TOP, shl(MIDDLE_85_TO_TOP, products))), t))) // N.L
            }

            // whether a node may be in the highlight
            function isShiny(light) -> yes { yes := sgt(signextend(LANE_64_LAST_BYTE, light), mload(COSINE_FAR)) }

            let a := mload(QUADRATIC_1)
            let ab := mload(QUADRATIC_SS)
            let ac := mload(QUADRATIC_TT)
            let bc := sub(add(ab, ac), mload(QUADRATIC_ST))
            // the upper lanes of these are the squares of turns
            let turn := ab
            if sgt(ac, turn) { turn := ac }
            if sgt(bc, turn) { turn := bc } // max(ab, ac, bc)
            turn := sar(UPPER_85_AT, turn)
            let b := add(add(a, mload(QUADRATIC_S)), ab) // the products at the second and the third vertex
            let c := add(add(a, mload(QUADRATIC_T)), ac)
            let least := a
            if slt(b, least) { least := b }
            if slt(c, least) { least := c } // min(a, b, c)
            if and(slt(turn, MOST_TURN), sgt(sar(UPPER_85_AT, least), LEAST_SQUARE_20)) {
                ab := at(sub(shl(1, add(a, b)), ab), 2) // four times the products at the midpoint
                ac := at(sub(shl(1, add(a, c)), ac), 2)
                bc := at(sub(shl(1, add(b, c)), bc), 2)
                a := at(a, 0)
                b := at(b, 0)
                c := at(c, 0)
                done := or(or(isShiny(ab), isShiny(ac)), or(isShiny(bc), or(isShiny(a), or(isShiny(b), isShiny(c)))))
                done := or(iszero(done), slt(turn, mload(SHINY_TURN)))
                if done {
                    // as Quadratic.fromNodes
                    ab := sub(shl(2, ab), shl(1, add(a, b)))
                    ac := sub(shl(2, ac), shl(1, add(a, c)))
                    mstore(QUADRATIC_ST, sub(sub(sub(shl(2, bc), shl(1, add(b, c))), ab), ac))
                    mstore(QUADRATIC_SS, sub(0, ab))
                    mstore(QUADRATIC_TT, sub(0, ac))
                    mstore(QUADRATIC_S, add(sub(b, a), ab))
                    mstore(QUADRATIC_T, add(sub(c, a), ac))
                    mstore(QUADRATIC_1, a)
                }
            }
        }
    }
}
