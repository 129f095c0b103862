// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {LIT, OPEN, SmoothVertex} from "./SmoothVertex.sol";
import "../../words/Registers.sol";

// Computes `cosines_of` of picture.py as quotients of quadratic functions.
// The light of a single lamp on smooth surfaces. Normals N are interpolated between the vertices, and so are the directions L to the light
// and the half vectors H between light and eye, which turn little within a triangle. With the barycentric coordinates w and any vectors P,
// Q
//
//   P * Q = sum w_i P_i * Q_i - sum over the edges w_i w_j (P_i - P_j) * (Q_i - Q_j)
//
// is quadratic, so a fragment reads three numbers from forward differences (see Quadratic), rather than vectors:
//
//   N * N, N * L, N * H     Q20 at the vertices, Q68 at a fragment, in lanes of 85 bits, N * N uppermost
//   diffuse  = N * L / |N|
//   specular = ((N * H)^2 / N * N)^(shininess / 2)
//
// Perspective correction needs no division: the normals are multiplied by the depths of their vertices, so that the result, linear on the
// screen, has the direction of the normal, and a length that cancels.
//
// The difference from the light computed at the fragment itself, in levels of 255; triangles without these bounds are shaded per fragment:
// see FragmentLight:
//   - Between two points seen at an angle d and at different distances, a linearly interpolated direction has an error of at most
//     d * (ratio of the distances - 1) / 4; for an edge of length e in distances neither factor is above e, and the product not
//     above e^2 / 2, so the error is at most e^2 / 8: see Materials.smoothReach. Lamps must not be much nearer than the eye.
//   - H turns with the ray and with the direction to the lamp, both by up to an edge e, and L + V, of the length s, is divided by s: its
//     second derivative across is a sum of terms e^2 / s and e^2 / s^2. The error of its direction is taken as 0.15 e^2 for s^2 >= 3,
//     as 0.6 e^2 for s^2 >= 1, where e^2 is the sum of the squares of two edges, and for lamps of the change of depth too. Times the
//     steepest slope of cos^n: see Specular.
//   - Between unit vectors the interpolated H is too short by the factor 1 - sum w_i w_j (H_i - H_j)^2 / 2; this is compensated for N * H
//     where |N| = 1. If |N| is less, by perspective or between vertices, the product is too large by (1 - |N|) / |N| of that: with q for
//     the least N * N, by at most d^2 / 6 * (1 - q) / 2q for half vectors that differ by d. Times n, the slope of cos^n where it is 1.
//   - If the first is above four levels, or the second above three and a half, products are made exact at the edge midpoints too. Errors
//     are of third order then: along each edge s (1 - s) (1 - 2s) times a skew, which is at most 1/9 of it, and in the middle the product
//     of the three weights. The skews are measured, and so is the error at the point (1/2, 1/4, 1/4): together at most 3.5 levels, unless
//     no point of the triangle can be near the highlight, on triangles of at most 20 times the size.
//   - A search for the worst triangles, with specular coefficients of up to 1.5, finds sums of all these errors of 12 levels (before these
//     bounds 55): see tests/test_smooth_light.py. Random scenes stay below 4: see docs/conformance.md.
//   - Colours are perspective-correct where linear ones would be too inaccurate (Shading.isAffine): they are multiplied by the weights of
//     the normals, and divided at each fragment by its depth, which is the sum of the weights.
//   - N * N is 1/4 to 17/16; in this range one step of Newton's method from a linear function gives its root to 1/1300. In a triangle it is
//     at least the minimum of the vertices minus a third of the largest square of a change, since the sum of w_i w_j is at most 1/3.

/// @dev The results of `setLight`.
uint256 constant UNBOUNDED_LIGHT = 0;
uint256 constant AFFINE_LIGHT = 1;
uint256 constant STEEP_LIGHT = 2;

/// @dev Products of vectors, one of which is doubled: shifts that move them, as Q20, from the upper lane to the upper, middle and lowest
/// one, where n and m of `products` are Q30; the last one for two bits more; and the position of one of half vectors, Q29 and Q21.
uint256 constant PRODUCT_TO_UPPER = 41;
uint256 constant PRODUCT_TO_MIDDLE = 116;
uint256 constant PRODUCT_TO_LOWER = 201;
uint256 constant PRODUCT_TO_LOWER_4 = 199;
uint256 constant HALF_SQUARE_AT = 180;
/// @dev Q20: three times the minimum square of an interpolated normal, 3/4; and three times one.
uint256 constant LEAST_SQUARE_3 = 0xc0000;
uint256 constant THREE_20 = 0x300000;
/// @dev A weight (Q10): 1 - 11/255 (43.5 of 1,024).
uint256 constant NEAR_ONE = 980;
/// @dev 3/8, Q40: the maximum square of a change of half vectors between vertices.
uint256 constant MOST_HALF_CHANGE = 0x6000000000;
/// @dev Three and a half levels, as 12 times as much (Q50) and as 32 times (Q30), in the unit of HALF_SLOPE.
uint256 constant THREE_AND_A_HALF = 0x2000000000000;
uint256 constant THREE_AND_A_HALF_16 = 1431655765;

/// @dev The offset from a vertex normal to the normal with reversed lanes.
uint256 constant REVERSED = 0x20;

library SmoothTriangle {
    /// @notice Computes the coefficients of a triangle's quadratic products.
    /// @param a, b, c The screen words of the vertices.
    /// @param size The sum of the squares of two edges.
    /// @param corrects Whether products are made exact at midpoints where they must be: a literal, since one engine has no room for that.
    /// @return kind UNBOUNDED_LIGHT if the error may be too large; AFFINE_LIGHT if the depths of the vertices are so similar that colours
    /// can be interpolated linearly; otherwise STEEP_LIGHT.
    function setLight(uint256 a, uint256 b, uint256 c, uint256 size, bool corrects) internal pure returns (uint256 kind) {
        unchecked {
            // the addresses of the vertex records from here on
            (a, b, c) = (a & SCREEN_RECORD_MASK, b & SCREEN_RECORD_MASK, c & SCREEN_RECORD_MASK);
            uint256 reach = load(a + VERTEX_STATE) & load(b + VERTEX_STATE) & load(c + VERTEX_STATE);
            if (reach & LIT == 0) {
                reach = SmoothVertex.fillNew(a, b, c);
                if (reach & LIT == 0) return UNBOUNDED_LIGHT;
            }
            // where H turns fast, a fourth of the reach
            reach = load(SMOOTH_REACH) >> (reach & OPEN == 0 ? 2 : 0);
            // weights, Q10
            (uint256 p, uint256 q, uint256 r) = (ONE_10, ONE_10, ONE_10);
            kind = AFFINE_LIGHT;
            assembly ("memory-safe") {
                if iszero(mload(FRAME_IS_ORTHOGRAPHIC)) {
                    // depths relative to the greatest of them
                    p := shr(ATTRIBUTE_DEPTH_AT, mload(add(a, VERTEX_ATTRIBUTES))) // depth of a
                    q := shr(ATTRIBUTE_DEPTH_AT, mload(add(b, VERTEX_ATTRIBUTES)))
                    r := shr(ATTRIBUTE_DEPTH_AT, mload(add(c, VERTEX_ATTRIBUTES)))
                    let depth := p
                    if gt(q, depth) { depth := q } // max(p, q)
                    if gt(r, depth) { depth := r } // max(p, q, r)
                    p := div(shl(Q10, p), depth) // depth of a / the greatest, Q10
                    q := div(shl(Q10, q), depth)
                    r := div(shl(Q10, r), depth)
                    // colours of up to 255 may differ by any amount if depths differ by at most 12 / 255: see Shading.isAffine
                    kind := add(AFFINE_LIGHT, or(or(lt(p, NEAR_ONE), lt(q, NEAR_ONE)), lt(r, NEAR_ONE))) // any < NEAR_ONE ? STEEP : AFFINE
                    if and(mload(add(add(LIGHTS, LIGHT_IS_POINT), mload(LIGHT_OFFSET))), shr(1, kind)) { // a lamp, and STEEP_LIGHT
                        depth := p // the least weight from here on
                        if lt(q, depth) { depth := q }
                        if lt(r, depth) { depth := r } // min(p, q, r)
                        // the change of depth, as long as it would be on the screen; weights below a half have N * N below 1/4
                        depth := div(shl(Q32, sub(ONE_10, depth)), mul(add(depth, 1), mload(RAY_STEP))) // (1 - least) / least / RAY_STEP
                        size := add(size, mul(depth, depth)) // size + change^2
                    }
                }
            }
            uint256 ab;
            uint256 ac;
            uint256 bc;
            assembly ("memory-safe") {
                // The products of three pairs of vectors in lanes: n * o, n * l, m * h, where o, l, h have reversed lanes; n and m are
                // Q30, the sums Q20. A dot product is in the uppermost lane of the product of two words, except for bit 255, which would be
                // the lowest bit of the next lane: it is 0, since one of the vectors is doubled.
                function products(n, o, l, m, h) -> packed {
                    packed := and(sar(PRODUCT_TO_UPPER, mul(n, o)), UPPER_LANE_85) // n * o
                    packed := add(packed, and(sar(PRODUCT_TO_MIDDLE, mul(n, l)), UPPER_LANES_85)) // n * l; its sign fills the upper lane
                    packed := add(packed, sar(PRODUCT_TO_LOWER, mul(m, h))) // m * h
                }

                // the products at a vertex, whose normals are multiplied by a weight (Q10) and kept at `place`
                function atVertex(vertex, weight, place) -> packed {
                    let n := mul(weight, mload(add(vertex, VERTEX_NORMAL))) // weight * N
                    let o := mul(weight, mload(add(vertex, VERTEX_REVERSED))) // the same, reversed
                    mstore(place, n)
                    mstore(add(place, REVERSED), o)
                    packed := products(n, o, mload(add(vertex, VERTEX_LIGHT)), n, mload(add(vertex, VERTEX_HALF_REVERSED)))
                }

                // the products of the changes from one vertex to another, whose normals are at `placeU` and `placeV`; updates HALF_CHANGE
                function along(u, v, placeU, placeV) -> packed {
                    let h := sub(mload(add(v, VERTEX_HALF)), mload(add(u, VERTEX_HALF))) // H_v - H_u
                    let reversed := sub(mload(add(v, VERTEX_HALF_REVERSED)), mload(add(u, VERTEX_HALF_REVERSED)))
                    let square := sar(HALF_SQUARE_AT, mul(h, reversed)) // (H_v - H_u)^2, Q40
                    if sgt(square, mload(HALF_CHANGE)) { mstore(HALF_CHANGE, square) } // max(HALF_CHANGE, square)
                    square := sub(mload(placeV), mload(placeU)) // N_v - N_u from here on; u the change of L
                    u := sub(mload(add(v, VERTEX_LIGHT)), mload(add(u, VERTEX_LIGHT)))
                    v := sub(mload(add(placeV, REVERSED)), mload(add(placeU, REVERSED)))
                    packed := products(square, v, u, sub(square, h), reversed)
                }

                // places are literals, since copies for them are wanted: every triangle needs them
                p := atVertex(a, p, NORMAL_0) // the products at the vertices from here on
                q := atVertex(b, q, NORMAL_1)
                r := atVertex(c, r, NORMAL_2)
                mstore(HALF_CHANGE, 0)
                ab := along(a, b, NORMAL_0, NORMAL_1)
                ac := along(a, c, NORMAL_0, NORMAL_2)
                bc := along(b, c, NORMAL_1, NORMAL_2)
            }
            uint256 least;
            uint256 change = load(HALF_CHANGE);
            assembly ("memory-safe") {
                // the least N * N is the minimum of the vertices minus a third of the largest square of a change: three times that
                least := p
                if slt(q, least) { least := q } // words compare like their upper lanes, N * N
                if slt(r, least) { least := r } // min(p, q, r)
                least := mul(3, sar(UPPER_85_AT, least)) // 3 * min(N * N), Q20
                let most := sub(least, LEAST_SQUARE_3) // the squares of all changes must be below it
                most := and(and(slt(sar(UPPER_85_AT, ab), most), slt(sar(UPPER_85_AT, ac), most)), slt(sar(UPPER_85_AT, bc), most))
                kind := mul(kind, most) // most ? kind : UNBOUNDED_LIGHT
            }
            if (kind == UNBOUNDED_LIGHT) return kind;
            // 3 - 3q is at most three times 3q
            if (size >= reach || 3 * change * load(HALF_SLOPE) > THREE_AND_A_HALF) {
                uint256 most;
                assembly ("memory-safe") {
                    most := ab
                    if sgt(ac, most) { most := ac }
                    if sgt(bc, most) { most := bc } // max(ab, ac, bc)
                    most := sar(UPPER_85_AT, most) // the largest square of a change, Q20
                    least := sub(least, most) // 3 * min(N * N) - max((N_i - N_j)^2)
                }
                if (size >= reach || isTurning(change, least)) {
                    if (!corrects) return UNBOUNDED_LIGHT;
                    // the products must be exact at the midpoints
                    if (size >= load(SMOOTH_REACH_3) || change >= MOST_HALF_CHANGE) return UNBOUNDED_LIGHT;
                    // addresses that are not literals: see ZERO_SLOT (those of atVertex and along are, since copies of these pay)
                    uint256 none = load(ZERO_SLOT);
                    store(HALF_SKEW, none);
                    ab += correction(a, b, none + NORMAL_0, none + NORMAL_1);
                    if (load(MIDDLE + VERTEX_STATE) & LIT == 0) return UNBOUNDED_LIGHT;
                    ac += correction(a, c, none + NORMAL_0, none + NORMAL_2);
                    if (load(MIDDLE + VERTEX_STATE) & LIT == 0) return UNBOUNDED_LIGHT;
                    bc += correction(b, c, none + NORMAL_1, none + NORMAL_2);
                    if (load(MIDDLE + VERTEX_STATE) & LIT == 0) return UNBOUNDED_LIGHT;
                    SmoothVertex.setMiddle(a, none + MIDDLE);
                    if (isSkewed(p, q, r, ab, ac, bc, least, most + (change >> Q20))) return UNBOUNDED_LIGHT;
                }
            }
            assembly ("memory-safe") {
                mstore(QUADRATIC_1, p)
                mstore(QUADRATIC_S, sub(sub(q, p), ab)) // q - p - ab: along the edge p + s (q - p) - s (1 - s) ab
                mstore(QUADRATIC_T, sub(sub(r, p), ac)) // r - p - ac
                mstore(QUADRATIC_SS, ab)
                mstore(QUADRATIC_ST, sub(add(ab, ac), bc)) // ab + ac - bc
                mstore(QUADRATIC_TT, ac)
            }
        }
    }

    /// @dev Returns the correction that makes the light at the midpoint exact: four times the error there, (N_u + N_v) * (L_u + L_v - 2 L),
    /// and the same for H, which is not too short there. What remains along the edge is s (1 - s) (1 - 2s) times a skew, of which HALF_SKEW
    /// has twice the largest: the change of the turning of H, 2 H * (H_v - H_u), and that of N, (N_v - N_u) * (H_u + H_v - 2 H).
    function correction(uint256 u, uint256 v, uint256 placeU, uint256 placeV) private pure returns (uint256 packed) {
        SmoothVertex.setMiddle(u, v);
        assembly ("memory-safe") {
            function size20(value) -> positive { positive := xor(value, sar(255, value)) }

            let n := add(mload(placeU), mload(placeV)) // N_u + N_v
            // L_u + L_v - 2 L
            let t := sub(add(mload(add(u, VERTEX_LIGHT)), mload(add(v, VERTEX_LIGHT))), shl(1, mload(add(MIDDLE, VERTEX_LIGHT))))
            packed := and(sar(PRODUCT_TO_MIDDLE, mul(n, t)), UPPER_LANES_85) // (N_u + N_v) * (L_u + L_v - 2 L)
            t := add(mload(add(u, VERTEX_HALF_REVERSED)), mload(add(v, VERTEX_HALF_REVERSED)))
            t := sub(t, shl(1, mload(add(MIDDLE, VERTEX_HALF_REVERSED)))) // H_u + H_v - 2 H
            packed := add(packed, sar(PRODUCT_TO_LOWER, mul(n, t))) // + (N_u + N_v) * t, in the lowest lane
            let skew := size20(sar(PRODUCT_TO_LOWER, mul(sub(mload(placeV), mload(placeU)), t))) // |(N_v - N_u) * t|
            n := sub(mload(add(u, VERTEX_HALF)), mload(add(v, VERTEX_HALF))) // H_u - H_v from here on, t the same reversed
            t := sub(mload(add(u, VERTEX_HALF_REVERSED)), mload(add(v, VERTEX_HALF_REVERSED)))
            packed := add(packed, sar(PRODUCT_TO_LOWER, mul(n, t))) // + (H_u - H_v)^2
            // half vectors are Q29, normals Q30: 2 H * (H_u - H_v)
            skew := shl(1, add(skew, size20(sar(PRODUCT_TO_LOWER_4, mul(mload(add(MIDDLE, VERTEX_HALF)), t)))))
            if gt(skew, mload(HALF_SKEW)) { mstore(HALF_SKEW, skew) } // max(HALF_SKEW, skew)
        }
    }

    /// @dev Returns whether the length of the normals makes the products too inaccurate: (1 - q) / q times the square of the change of H.
    /// @param least Three times the least N * N, 3q.
    function isTurning(uint256 change, uint256 least) private pure returns (bool yes) {
        assembly ("memory-safe") {
            yes := sgt(mul(mul(change, mload(HALF_SLOPE)), sub(THREE_20, least)), mul(least, THREE_AND_A_HALF))
        }
    }

    /// @dev Returns whether the error of products that are exact at vertices and midpoints is too large within the triangle, and it may be
    /// near the highlight. MIDDLE is the vertex at (1/2, 1/4, 1/4).
    /// @param least Three times the least N * N.
    /// @param turn The largest squares of changes of N and of H, Q20.
    function isSkewed(uint256 p, uint256 q, uint256 r, uint256 ab, uint256 ac, uint256 bc, uint256 least, uint256 turn)
        private pure returns (bool yes)
    {
        assembly ("memory-safe") {
            function lowest(packed) -> value { value := sar(LOWER_85_TO_TOP, shl(LOWER_85_TO_TOP, packed)) }

            // the maximum of a cos^2 and of that of N and H, Q20, from products that are multiplied by 2^shift
            function nearer(packed, shift, square) -> most {
                most := lowest(packed)
                most := div(mul(mul(most, most), sgt(most, 0)), shl(shift, sar(UPPER_85_AT, packed))) // (N * H)^2 / N * N
                if lt(most, square) { most := square } // max(most, square)
            }

            // 16 times the products at (1/2, 1/4, 1/4), and the error of N * H there, in the lowest lane
            let inner := sub(add(shl(3, p), shl(2, add(q, r))), add(shl(1, add(ab, ac)), bc)) // 8 p + 4 (q + r) - 2 (ab + ac) - bc
            let error := add(add(shl(1, mload(NORMAL_0)), mload(NORMAL_1)), mload(NORMAL_2)) // 4 N
            error := shl(2, sar(PRODUCT_TO_LOWER, mul(error, mload(add(MIDDLE, VERTEX_HALF_REVERSED))))) // 16 N * H
            error := lowest(sub(error, inner)) // 16 times the error of N * H
            error := add(xor(error, sar(255, error)), mload(HALF_SKEW)) // |error| + HALF_SKEW
            error := mul(mul(error, mload(HALF_SLOPE)), add(THREE_20, least))
            if gt(error, mul(least, THREE_AND_A_HALF_16)) { // error * slope / N * N > 3.5 levels
                // not near the highlight, by the nodes, between which vectors turn by less than half as much
                error := nearer(inner, 4, 0) // a cos^2 from here on
                error := nearer(sub(shl(1, add(p, q)), ab), 2, error) // 4 times the products at a midpoint: 2 (p + q) - ab
                error := nearer(sub(shl(1, add(p, r)), ac), 2, error)
                error := nearer(sub(shl(1, add(q, r)), bc), 2, error)
                error := nearer(p, 0, nearer(q, 0, nearer(r, 0, error))) // max of the three vertices too
                yes := iszero(slt(add(error, shr(2, turn)), mload(FAR_FROM_HIGHLIGHT)))
            }
        }
    }
}
