// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Quadratic} from "./Quadratic.sol";
import "../../words/Registers.sol";

// The light of a lamp on smooth triangles of several pixels. The products of SmoothTriangle need a root and two divisions at each fragment;
// here these are done at six nodes, and what they yield is interpolated: a word of two lanes, both Q24, has the square of the cosine
// between normal and half vector in the lower 85 bits, and N * L of unit vectors, which may be negative, above. From nodes to fragments are
// 48 more bits.
//
// If a normal turns by the angle d along an edge, the third derivatives of both are at most 1 and 4, per d, and that of the highlight, a
// function of the square, at most 2.4 * sqrt(n) of its strength m where it is steepest. An error of D * d^3 / 125 (see FlatShading) is
// 255 * d^3 / 125 levels of the diffuse light, 0.7 for d^2 = 1/2, the most that is allowed, and 5 * sqrt(n) * m * d^3 of the highlight: 4
// levels for n = 28, m = 0.4, d = 0.72. It is measured in the middle of the triangle: within a level and a quarter of each, or the products
// are kept.

/// @dev The greatest square of a turn, Q20.
uint256 constant MOST_TURN = 0x80000;
/// @dev 9 times 1.25 levels of 255, Q24; 1.25 levels, Q56. Just before the last entry of the table, Q40.
uint256 constant N_DOT_L_ERROR = 740175;
uint256 constant SHINE_ERROR = 353235088261144;
uint256 constant BEFORE_SPECULAR_LAST = 0x3fffffffffff;
/// @dev From products of Q20 to N * N in the unit of ROOT_SLOPE, Q68; to N * L, divided by the double length, Q34, to Q24; from N * H
/// squared and divided to Q24.
uint256 constant Q20_TO_Q68 = 48;
uint256 constant N_DOT_L_SHIFT = 39;
uint256 constant Q20_TO_Q24 = 4;

library SmoothLight {
    /// @notice Replaces the coefficients of a triangle's products by those of the light, if they are exact enough.
    function normalise() internal pure returns (bool done) {
        assembly ("memory-safe") {
            // the light for products that are multiplied by 2^k
            function at(products, k) -> light {
                let square := sar(UPPER_85_AT, products) // N.N
                let t := sar(LOWER_85_TO_TOP, shl(LOWER_85_TO_TOP, products)) // N.H
                t := mul(t, sgt(t, 0)) // max(N.H, 0)
                light := shr(k, div(shl(Q20_TO_Q24, mul(t, t)), square)) // (N.H)^2 / N.N
                square := shl(sub(Q20_TO_Q68, k), square)
                t := add(shr(ROOT_SHIFT, mul(ROOT_SLOPE, square)), ROOT_AT_0) // about 2 |N|, Q34
                t := add(t, div(square, t)) // one step of Newton
                square := shl(sub(N_DOT_L_SHIFT, k), sar(LOWER_85_TO_TOP, shl(MIDDLE_85_TO_TOP, products))) // N.L
                light := add(light, shl(MIDDLE_85_AT, sdiv(square, t)))
            }

            let a := mload(QUADRATIC_1)
            let b := mload(QUADRATIC_S)
            let c := mload(QUADRATIC_T)
            let ab := mload(QUADRATIC_SS)
            let ac := mload(QUADRATIC_TT)
            let bc := sub(add(ab, ac), mload(QUADRATIC_ST))
            // the upper lanes of these are the squares of turns
            done := and(slt(sar(UPPER_85_AT, ab), MOST_TURN), slt(sar(UPPER_85_AT, ac), MOST_TURN))
            done := and(done, slt(sar(UPPER_85_AT, bc), MOST_TURN))
            if done {
                b := add(add(a, b), ab) // the products at the second and the third vertex
                c := add(add(a, c), ac)
                // in the middle, nine times: 3 (a + b + c) - (ab + ac + bc)
                let middle := sub(mul(3, add(add(a, b), c)), add(add(ab, ac), bc))
                let exact := shl(UPPER_85_AT, div(sar(UPPER_85_AT, middle), 9))
                exact := add(exact, sdiv(sar(LOWER_85_TO_TOP, shl(LOWER_85_TO_TOP, middle)), 9))
                exact := at(add(exact, shl(MIDDLE_85_AT, sdiv(sar(LOWER_85_TO_TOP, shl(MIDDLE_85_TO_TOP, middle)), 9))), 0)
                ab := at(sub(shl(1, add(a, b)), ab), 2) // four times the products at the midpoint
                ac := at(sub(shl(1, add(a, c)), ac), 2)
                bc := at(sub(shl(1, add(b, c)), bc), 2)
                a := at(a, 0)
                b := at(b, 0)
                c := at(c, 0)
                // nine times the light there: 4 (ab + ac + bc) - (a + b + c)
                middle := sub(shl(2, add(add(ab, ac), bc)), add(add(a, b), c))
                let t := sub(sar(MIDDLE_85_AT, middle), mul(9, sar(MIDDLE_85_AT, exact))) // the error of N.L, nine times
                done := lt(add(t, N_DOT_L_ERROR), mul(2, N_DOT_L_ERROR))
                exact := and(exact, LANE_85)
                t := sdiv(sar(LOWER_85_TO_TOP, shl(LOWER_85_TO_TOP, middle)), 9) // a square of a cosine
                middle := sub(exact, t)
                middle := xor(middle, sar(SIGN_AT, middle)) // its error
                if slt(exact, t) { exact := t } // max
                if sgt(exact, mload(SPECULAR_BEGIN)) {
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
