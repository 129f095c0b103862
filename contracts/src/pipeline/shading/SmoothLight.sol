// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Quadratic} from "./Quadratic.sol";
import "../../words/SampleRegisters.sol";

// The light of a lamp on smooth triangles of several pixels. The products of SmoothTriangle need a root and two divisions at each fragment;
// here these are done at six nodes, and what they yield is interpolated: N * H and N * L of unit vectors, Q19, in the lower two of four
// signed lanes of 64 bits; those of a second lamp are in the other two. Fragments have 34 more bits: coordinates are Q17, LESS_BITS shorter
// than those of products. In a triangle of 200 pixels, their rounding moves the light by 1/1300 of it.
//
// If a normal turns by the angle d along an edge, the third derivatives of both are at most d^3; that of N * H is the sine of its angle
// times that, so an error of it changes the highlight by as much as an equal change of the angle, by at most 0.6 * sqrt(n) of its strength
// m. With errors of D / 125 for a third derivative D (see FlatShading), that is 2 * d^3 levels of 255 of the diffuse light, and 1.2 *
// sqrt(n) * m * d^3 of the highlight: 3.6 for n = 28, m = 0.4 and d = 1.12, the greatest turn that is allowed. Both are measured at (1/2,
// 1/4, 1/4), where errors are 27/32 of those in the middle, for each lamp: within 1.75 levels, or the products are kept.

/// @dev The greatest square of a turn, Q20: 5/4; the least N * N at vertices: 3/4, so that it is 7/16 at midpoints. From there to 17/16,
/// a step of Newton's method from NEAR_ROOT_AT_0 + (N * N) * NEAR_ROOT_SLOPE >> ROOT_SHIFT gives its root to 1/3,500, from 1/2 on to
/// 1/23,000.
uint256 constant MOST_TURN = 0x140000;
uint256 constant LEAST_SQUARE_20 = 0xc0000;
uint256 constant NEAR_ROOT_SLOPE = 594;
uint256 constant NEAR_ROOT_AT_0 = 7268834047;
/// @dev 8 times 1.75 levels of 255, Q19; 1.75 levels, Q56. Just before the last entry of the table, Q40.
uint256 constant N_DOT_L_ERROR = 28784;
uint256 constant SHINE_ERROR = 494512900260290;
uint256 constant BEFORE_SPECULAR_LAST = 0x3fffffffffff;
/// @dev From products of Q20 to N * N in the unit of ROOT_SLOPE, Q68; to others, divided by the double length, Q34, to Q19; from Q19 to
/// Q24; the position of eight times Q19, as Q24, with its lane at the top; the bits that coordinates are shorter.
uint256 constant Q20_TO_Q68 = 48;
uint256 constant PRODUCT_TO_LIGHT = 34;
uint256 constant Q19_TO_Q24 = 5;
uint256 constant EIGHT_Q19_TO_Q24_AT = 190;
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

            let a := mload(QUADRATIC_1)
            let ab := mload(QUADRATIC_SS)
            let ac := mload(QUADRATIC_TT)
            let bc := sub(add(ab, ac), mload(QUADRATIC_ST))
            // the upper lanes of these are the squares of turns
            done := and(slt(sar(UPPER_85_AT, ab), MOST_TURN), slt(sar(UPPER_85_AT, ac), MOST_TURN))
            done := and(done, slt(sar(UPPER_85_AT, bc), MOST_TURN))
            let b := add(add(a, mload(QUADRATIC_S)), ab) // the products at the second and the third vertex
            let c := add(add(a, mload(QUADRATIC_T)), ac)
            let least := LEAST_SQUARE_20
            done := and(done, and(sgt(sar(UPPER_85_AT, a), least), and(sgt(sar(UPPER_85_AT, b), least), sgt(sar(UPPER_85_AT, c), least))))
            if done {
                // from the products at (1/2, 1/4, 1/4), sixteen times: 8 a + 4 (b + c) - 2 (ab + ac) - bc
                let exact := at(sub(add(shl(3, a), shl(2, add(b, c))), add(shl(1, add(ab, ac)), bc)), 4)
                ab := at(sub(shl(1, add(a, b)), ab), 2) // four times the products at the midpoint
                ac := at(sub(shl(1, add(a, c)), ac), 2)
                bc := at(sub(shl(1, add(b, c)), bc), 2)
                a := at(a, 0)
                b := at(b, 0)
                c := at(c, 0)
                // eight times the light there: 4 (ab + ac) + 2 bc - b - c
                let middle := sub(add(shl(2, add(ab, ac)), shl(1, bc)), add(b, c))
                let t := sub(sar(LANE_1_AT, middle), shl(3, sar(LANE_1_AT, exact))) // the error of N.L, eight times
                done := lt(add(t, N_DOT_L_ERROR), mul(2, N_DOT_L_ERROR))
                exact := shl(Q19_TO_Q24, signextend(7, exact)) // N.H
                t := sar(EIGHT_Q19_TO_Q24_AT, shl(LANE_0_TO_TOP, middle))
                middle := sub(exact, t)
                middle := xor(middle, sar(SIGN_AT, middle)) // its error
                if slt(exact, t) { exact := t } // max
                if sgt(exact, mload(COSINE_BEGIN)) {
                    middle := shr(sub(Q24, 1), mul(exact, middle)) // of the square
                    exact := shr(Q24, mul(exact, exact))
                    exact := mul(sub(exact, mload(SPECULAR_BEGIN)), mload(SPECULAR_SCALE)) // an index into the table, Q40
                    if gt(exact, BEFORE_SPECULAR_LAST) { exact := BEFORE_SPECULAR_LAST }
                    t := mload(add(SPECULAR_TABLE, and(shr(SPECULAR_ENTRY_SHIFT, exact), SPECULAR_ENTRY_MASK)))
                    t := and(t, LANE_32) // the increase
                    done := and(done, lt(mul(mul(middle, mload(SPECULAR_SCALE)), t), SHINE_ERROR))
                }
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
