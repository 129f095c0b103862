// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {ADDRESS} from "../pixels/LinearSpans.sol";
import "../../words/Registers.sol";

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

/// @dev Words of a vertex record: the normal; the normal with reversed lanes; the direction to the light with reversed lanes, Q21 and even;
/// the half vector, Q29; the half vector with reversed lanes, Q21 and even. LIT if they are present and bounded, UNBOUNDED if they cannot
/// be used, otherwise 0; and OPEN if |L + V|^2 is at least 3.
uint256 constant VERTEX_NORMAL = 0x40;
uint256 constant VERTEX_REVERSED = 0x60;
uint256 constant VERTEX_LIGHT = 0x80;
uint256 constant VERTEX_HALF = 0xa0;
uint256 constant VERTEX_HALF_REVERSED = 0xc0;
uint256 constant VERTEX_STATE = 0xe0;
uint256 constant LIT = 1;
uint256 constant UNBOUNDED = 2;
uint256 constant OPEN = 4;

/// @dev The results of `setLight`.
uint256 constant UNBOUNDED_LIGHT = 0;
uint256 constant AFFINE_LIGHT = 1;
uint256 constant STEEP_LIGHT = 2;

/// @dev Half the range of a lane of 85 bits, for vectors of Q20.
uint256 constant VECTOR_BIAS = 0x100000000000000000000080000000000000000000040000000;

/// @dev Products of vectors, one of which is doubled: shifts that move them, as Q20, from the upper lane to the upper, middle and lowest
/// one, where n and m of `products` are Q30; and shifts of a square of Q40 and of one of half vectors, Q29 and Q21.
uint256 constant PRODUCT_TO_UPPER = 41;
uint256 constant PRODUCT_TO_MIDDLE = 116;
uint256 constant PRODUCT_TO_LOWER = 201;
uint256 constant SQUARE_AT = 171;
uint256 constant HALF_SQUARE_AT = 180;
/// @dev From Q20 to the Q29 of VERTEX_HALF.
uint256 constant Q20_TO_Q29 = 9;
/// @dev 15/16 and 1/8, Q40: the minimum of the squares of normals and their range.
uint256 constant LEAST_SQUARE = 0xf000000000;
uint256 constant SQUARES = 0x2000000000;
/// @dev 1, Q40: half vectors L + V shorter than one turn too fast; and 3, one less.
uint256 constant LEAST_HALF_SQUARE = 0x10000000000;
uint256 constant BELOW_OPEN_HALF_SQUARE = 0x2ffffffffff;
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

/// @dev At fragments: twice the root of N * N, Q34, is approximated within 3 % by ROOT_AT_0 + (N * N) * ROOT_SLOPE >> ROOT_SHIFT.
uint256 constant ROOT_AT_0 = 5892665057;
uint256 constant ROOT_SLOPE = 702;
uint256 constant ROOT_SHIFT = 44;
/// @dev The positions of N * L as Q59 and N * H as Q46, with their lanes at the top of a word.
uint256 constant N_DOT_L_AT = 180;
uint256 constant N_DOT_H_AT = 193;

library SmoothLight {
    /// @notice Computes the coefficients of a triangle's quadratic products.
    /// @param a, b, c The screen words of the vertices.
    /// @param size The sum of the squares of two edges.
    /// @return kind UNBOUNDED_LIGHT if the error may be too large; AFFINE_LIGHT if the depths of the vertices are so similar that colours
    /// can be interpolated linearly; otherwise STEEP_LIGHT.
    function setLight(uint256 a, uint256 b, uint256 c, uint256 size) internal pure returns (uint256 kind) {
        assembly ("memory-safe") {
            // as in FragmentLight
            function root(value, hint) -> r {
                let h := mload(hint)
                if gt(sub(shr(shl(1, h), value), 1), 2) {
                    h := shl(7, lt(0xffffffffffffffffffffffffffffffff, value))
                    h := or(h, shl(6, lt(0xffffffffffffffff, shr(h, value))))
                    h := or(h, shl(5, lt(0xffffffff, shr(h, value))))
                    h := or(h, shl(4, lt(0xffff, shr(h, value))))
                    h := or(h, shl(3, lt(0xff, shr(h, value))))
                    h := or(h, shl(2, lt(0xf, shr(h, value))))
                    h := shr(1, or(h, shl(1, lt(0x3, shr(h, value)))))
                    mstore(hint, h)
                }
                r := shr(10, mul(351, add(shr(h, value), shl(h, 2))))
                r := shr(1, add(r, div(value, r)))
                r := shr(1, add(r, div(value, r)))
            }
            // fills the part of a vertex record that is common to all adjacent triangles
            function setVertex(vertex) {
                let n := mload(add(vertex, VERTEX_NORMAL))
                let r := add(n, VECTOR_BIAS)
                r := shl(1, sub(or(or(shl(UPPER_85_AT, and(r, LANE_85)), shr(UPPER_85_AT, r)), and(r, MIDDLE_LANE_85)), VECTOR_BIAS))
                mstore(add(vertex, VERTEX_REVERSED), r)
                // the square of the normal, Q40, must be 15/16 to 17/16
                setDirections(vertex, lt(sub(sar(SQUARE_AT, mul(n, r)), LEAST_SQUARE), SQUARES))
            }

            // sets the directions to the light and halfway to the eye, and the state: LIT if they and the normal are bounded
            function setDirections(vertex, bounded) {
                let screen := mload(vertex)
                // the ray (x, y, 1), Q24
                let x := add(
                    mload(RAY_LEFT),
                    sar(SUBPIXEL_BITS, mul(and(shr(SCREEN_COLUMN_AT, screen), SCREEN_COLUMN_MASK), mload(RAY_STEP)))
                )
                let y := add(mload(RAY_TOP), sar(SUBPIXEL_BITS, mul(shr(SCREEN_ROW_AT, screen), mload(RAY_STEP))))
                let lx := mload(add(LIGHTS, LIGHT_X))
                let ly := mload(add(LIGHTS, LIGHT_Y))
                let lz := mload(add(LIGHTS, LIGHT_Z))
                let length := ONE_24
                if mload(add(LIGHTS, LIGHT_IS_POINT)) {
                    // from the vertex to the light, Q16
                    let z := div(mload(DEPTH_SCALE), shr(ATTRIBUTE_DEPTH_AT, mload(add(vertex, VERTEX_ATTRIBUTES))))
                    let place := sar(Q40, mul(x, z))
                    lx := sub(lx, place)
                    let square := mul(place, place)
                    place := sar(Q40, mul(y, z))
                    ly := sub(ly, place)
                    square := add(square, mul(place, place))
                    z := shr(Q16, z)
                    lz := sub(lz, z)
                    square := add(square, mul(z, z))
                    length := add(add(mul(lx, lx), mul(ly, ly)), mul(lz, lz))
                    // the light must not be nearer than the eye by more than a factor of the root of 5/4
                    bounded := and(bounded, iszero(gt(shl(2, square), mul(5, length))))
                    // not a literal: see ZERO_SLOT; copies for the other two roots, of each vertex, are wanted
                    length := root(length, add(add(LIGHTS, LIGHT_HINT), mload(ZERO_SLOT)))
                }
                lx := sdiv(shl(Q20, lx), length)
                ly := sdiv(shl(Q20, ly), length)
                lz := sdiv(shl(Q20, lz), length)
                mstore(add(vertex, VERTEX_LIGHT), shl(1, add(add(lz, shl(MIDDLE_85_AT, ly)), shl(UPPER_85_AT, lx))))
                if mload(FRAME_IS_ORTHOGRAPHIC) {
                    x := 0
                    y := 0
                }
                // H = L + V, where V is the reversed ray
                length := root(add(add(mul(x, x), mul(y, y)), ONE_48), RAY_HINT)
                lx := sub(lx, sdiv(shl(Q20, x), length))
                ly := sub(ly, sdiv(shl(Q20, y), length))
                lz := sub(lz, div(ONE_44, length))
                length := add(add(mul(lx, lx), mul(ly, ly)), mul(lz, lz))
                // not opposite to the light, where it turns arbitrarily fast
                bounded := and(bounded, gt(length, LEAST_HALF_SQUARE))
                let open := shl(2, gt(length, BELOW_OPEN_HALF_SQUARE))
                length := root(length, HALF_HINT)
                lx := sdiv(shl(Q20, lx), length)
                ly := sdiv(shl(Q20, ly), length)
                lz := sdiv(shl(Q20, lz), length)
                mstore(add(vertex, VERTEX_HALF), shl(Q20_TO_Q29, add(add(lx, shl(MIDDLE_85_AT, ly)), shl(UPPER_85_AT, lz))))
                mstore(add(vertex, VERTEX_HALF_REVERSED), shl(1, add(add(lz, shl(MIDDLE_85_AT, ly)), shl(UPPER_85_AT, lx))))
                mstore(add(vertex, VERTEX_STATE), or(open, sub(UNBOUNDED, bounded)))
            }

            // lanes: n * r, n * l, m * h, where r, l, h have reversed lanes; n and m are Q30, the sums Q20. A dot product is in the
            // uppermost lane of the product of two words, except for bit 255, which would be the lowest bit of the next lane: it is 0,
            // since one of the vectors is doubled.
            function products(n, r, l, m, h) -> packed {
                packed := and(sar(PRODUCT_TO_UPPER, mul(n, r)), UPPER_LANE_85)
                packed := add(packed, and(sar(PRODUCT_TO_MIDDLE, mul(n, l)), UPPER_LANES_85))
                packed := add(packed, sar(PRODUCT_TO_LOWER, mul(m, h)))
            }

            // the normals of a vertex times a weight (Q10), and its products
            function atVertex(vertex, weight, place) -> packed {
                let n := mul(weight, mload(add(vertex, VERTEX_NORMAL)))
                let r := mul(weight, mload(add(vertex, VERTEX_REVERSED)))
                mstore(place, n)
                mstore(add(place, REVERSED), r)
                packed := products(n, r, mload(add(vertex, VERTEX_LIGHT)), n, mload(add(vertex, VERTEX_HALF_REVERSED)))
            }

            // products of the changes from one vertex to another
            function along(u, v, placeU, placeV) -> packed {
                let n := sub(mload(placeV), mload(placeU))
                let h := sub(mload(add(v, VERTEX_HALF)), mload(add(u, VERTEX_HALF)))
                let reversed := sub(mload(add(v, VERTEX_HALF_REVERSED)), mload(add(u, VERTEX_HALF_REVERSED)))
                let square := sar(HALF_SQUARE_AT, mul(h, reversed))
                if sgt(square, mload(HALF_CHANGE)) { mstore(HALF_CHANGE, square) }
                square := sub(mload(add(v, VERTEX_LIGHT)), mload(add(u, VERTEX_LIGHT)))
                packed := products(n, sub(mload(add(placeV, REVERSED)), mload(add(placeU, REVERSED))), square, sub(n, h), reversed)
            }

            // sets MIDDLE to the middle of two vertices, without a normal
            function setMiddle(u, v) {
                mstore(MIDDLE, shl(SCREEN_COLUMN_AT, shr(1, add(shr(SCREEN_COLUMN_AT, mload(u)), shr(SCREEN_COLUMN_AT, mload(v))))))
                u := add(u, VERTEX_ATTRIBUTES)
                v := shr(ATTRIBUTE_DEPTH_AT, mload(add(v, VERTEX_ATTRIBUTES)))
                v := shl(ATTRIBUTE_DEPTH_AT, shr(1, add(shr(ATTRIBUTE_DEPTH_AT, mload(u)), v)))
                mstore(add(MIDDLE, VERTEX_ATTRIBUTES), v)
                // not literals: see ZERO_SLOT
                u := mload(ZERO_SLOT)
                setDirections(add(MIDDLE, u), add(1, u))
            }

            function size20(value) -> positive { positive := xor(value, sar(255, value)) }
            function lowest(packed) -> value { value := sar(LOWER_85_TO_TOP, shl(LOWER_85_TO_TOP, packed)) }

            // the maximum of a cos^2 and of that of N and H, Q20, from products that are multiplied by 2^shift
            function nearer(packed, shift, square) -> most {
                most := lowest(packed)
                most := div(mul(mul(most, most), sgt(most, 0)), shl(shift, sar(UPPER_85_AT, packed)))
                if lt(most, square) { most := square }
            }

            // The correction that makes the light at the midpoint exact: four times the error there, (N_u + N_v) * (L_u + L_v - 2 L), and
            // the same for H, which is not too short there. What remains along the edge is s (1 - s) (1 - 2s) times a skew, of which
            // HALF_SKEW has twice the largest: the change of the turning of H, 2 H * (H_v - H_u), and that of N, (N_v - N_u) * (H_u + H_v -
            // 2 H).
            function correction(u, v, placeU, placeV) -> packed {
                setMiddle(u, v)
                let n := add(mload(placeU), mload(placeV))
                let t := sub(add(mload(add(u, VERTEX_LIGHT)), mload(add(v, VERTEX_LIGHT))), shl(1, mload(add(MIDDLE, VERTEX_LIGHT))))
                packed := and(sar(PRODUCT_TO_MIDDLE, mul(n, t)), UPPER_LANES_85)
                t := add(mload(add(u, VERTEX_HALF_REVERSED)), mload(add(v, VERTEX_HALF_REVERSED)))
                t := sub(t, shl(1, mload(add(MIDDLE, VERTEX_HALF_REVERSED))))
                packed := add(packed, sar(PRODUCT_TO_LOWER, mul(n, t)))
                let skew := size20(sar(PRODUCT_TO_LOWER, mul(sub(mload(placeV), mload(placeU)), t)))
                n := sub(mload(add(u, VERTEX_HALF)), mload(add(v, VERTEX_HALF)))
                t := sub(mload(add(u, VERTEX_HALF_REVERSED)), mload(add(v, VERTEX_HALF_REVERSED)))
                packed := add(packed, sar(PRODUCT_TO_LOWER, mul(n, t)))
                // half vectors are Q29, normals Q30
                skew := shl(1, add(skew, size20(sar(sub(PRODUCT_TO_LOWER, 2), mul(mload(add(MIDDLE, VERTEX_HALF)), t)))))
                if gt(skew, mload(HALF_SKEW)) { mstore(HALF_SKEW, skew) }
            }

            a := and(a, SCREEN_RECORD_MASK)
            b := and(b, SCREEN_RECORD_MASK)
            c := and(c, SCREEN_RECORD_MASK)
            kind := and(and(mload(add(a, VERTEX_STATE)), mload(add(b, VERTEX_STATE))), mload(add(c, VERTEX_STATE)))
            if iszero(and(kind, LIT)) {
                if iszero(mload(add(a, VERTEX_STATE))) { setVertex(a) }
                if iszero(mload(add(b, VERTEX_STATE))) { setVertex(b) }
                if iszero(mload(add(c, VERTEX_STATE))) { setVertex(c) }
                kind := and(and(mload(add(a, VERTEX_STATE)), mload(add(b, VERTEX_STATE))), mload(add(c, VERTEX_STATE)))
            }
            switch and(kind, LIT)
            case 0 { kind := UNBOUNDED_LIGHT }
            default {
                let p := ONE_10
                let q := ONE_10
                let r := ONE_10
                // where H turns fast, a fourth of the reach
                let reach := shr(shl(1, iszero(and(kind, OPEN))), mload(SMOOTH_REACH))
                kind := AFFINE_LIGHT
                if iszero(mload(FRAME_IS_ORTHOGRAPHIC)) {
                    // depths relative to the greatest of them
                    p := shr(ATTRIBUTE_DEPTH_AT, mload(add(a, VERTEX_ATTRIBUTES)))
                    q := shr(ATTRIBUTE_DEPTH_AT, mload(add(b, VERTEX_ATTRIBUTES)))
                    r := shr(ATTRIBUTE_DEPTH_AT, mload(add(c, VERTEX_ATTRIBUTES)))
                    let depth := p
                    if gt(q, depth) { depth := q }
                    if gt(r, depth) { depth := r }
                    p := div(shl(Q10, p), depth)
                    q := div(shl(Q10, q), depth)
                    r := div(shl(Q10, r), depth)
                    // colours of up to 255 may differ by any amount if depths differ by at most 12 / 255: see Shading.isAffine
                    kind := add(AFFINE_LIGHT, or(or(lt(p, NEAR_ONE), lt(q, NEAR_ONE)), lt(r, NEAR_ONE)))
                    if and(mload(add(LIGHTS, LIGHT_IS_POINT)), shr(1, kind)) {
                        depth := p
                        if lt(q, depth) { depth := q }
                        if lt(r, depth) { depth := r }
                        // the change of depth, as long as it would be on the screen; weights below a half have N * N below 1/4
                        depth := div(shl(Q32, sub(ONE_10, depth)), mul(add(depth, 1), mload(RAY_STEP)))
                        size := add(size, mul(depth, depth))
                    }
                }
                // places are literals, since copies for them are wanted: every triangle needs them
                p := atVertex(a, p, NORMAL_0)
                q := atVertex(b, q, NORMAL_1)
                r := atVertex(c, r, NORMAL_2)
                mstore(HALF_CHANGE, 0)
                let ab := along(a, b, NORMAL_0, NORMAL_1)
                let ac := along(a, c, NORMAL_0, NORMAL_2)
                let bc := along(b, c, NORMAL_1, NORMAL_2)
                // the least N * N is the minimum of the vertices minus a third of the largest square of a change: three times that
                let least := p
                if slt(q, least) { least := q }
                if slt(r, least) { least := r }
                least := mul(3, sar(UPPER_85_AT, least))
                {
                    let most := sub(least, LEAST_SQUARE_3)
                    most := and(and(slt(sar(UPPER_85_AT, ab), most), slt(sar(UPPER_85_AT, ac), most)), slt(sar(UPPER_85_AT, bc), most))
                    kind := mul(kind, most)
                }
                let change := mload(HALF_CHANGE)
                // 3 - 3q is at most three times 3q
                if and(or(gt(mul(mul(3, change), mload(HALF_SLOPE)), THREE_AND_A_HALF), iszero(lt(size, reach))), gt(kind, 0)) {
                    let most := ab
                    if sgt(ac, most) { most := ac }
                    if sgt(bc, most) { most := bc }
                    most := sar(UPPER_85_AT, most)
                    least := sub(least, most)
                    // 1 if the products must be exact at the midpoints
                    let isLarge := sgt(mul(mul(change, mload(HALF_SLOPE)), sub(THREE_20, least)), mul(least, THREE_AND_A_HALF))
                    if or(isLarge, iszero(lt(size, reach))) {
                        kind := mul(kind, and(lt(size, mload(SMOOTH_REACH_3)), lt(change, MOST_HALF_CHANGE)))
                        if kind {
                            mstore(HALF_SKEW, 0)
                            // not literals: see ZERO_SLOT
                            let normals := add(NORMAL_0, mload(ZERO_SLOT))
                            let normalsB := add(normals, sub(NORMAL_1, NORMAL_0))
                            let normalsC := add(normals, sub(NORMAL_2, NORMAL_0))
                            ab := add(ab, correction(a, b, normals, normalsB))
                            kind := mul(kind, and(mload(add(MIDDLE, VERTEX_STATE)), LIT))
                            ac := add(ac, correction(a, c, normals, normalsC))
                            kind := mul(kind, and(mload(add(MIDDLE, VERTEX_STATE)), LIT))
                            bc := add(bc, correction(b, c, normalsB, normalsC))
                            kind := mul(kind, and(mload(add(MIDDLE, VERTEX_STATE)), LIT))
                            setMiddle(a, MIDDLE)
                            // 16 times the products at (1/2, 1/4, 1/4), and the error of N * H there, in the lowest lane
                            let inner := sub(add(shl(3, p), shl(2, add(q, r))), add(shl(1, add(ab, ac)), bc))
                            let error := add(add(shl(1, mload(NORMAL_0)), mload(NORMAL_1)), mload(NORMAL_2))
                            error := shl(2, sar(PRODUCT_TO_LOWER, mul(error, mload(add(MIDDLE, VERTEX_HALF_REVERSED)))))
                            error := add(size20(lowest(sub(error, inner))), mload(HALF_SKEW))
                            error := mul(mul(error, mload(HALF_SLOPE)), add(THREE_20, least))
                            if gt(error, mul(least, THREE_AND_A_HALF_16)) {
                                // not near the highlight, by the nodes, between which vectors turn by less than half as much
                                let none := mload(ZERO_SLOT)
                                error := nearer(inner, add(none, 4), none)
                                error := nearer(sub(shl(1, add(p, q)), ab), add(none, 2), error)
                                error := nearer(sub(shl(1, add(p, r)), ac), add(none, 2), error)
                                error := nearer(sub(shl(1, add(q, r)), bc), add(none, 2), error)
                                error := nearer(p, none, nearer(q, none, nearer(r, none, error)))
                                error := add(error, shr(2, add(most, shr(Q20, change))))
                                kind := mul(kind, slt(error, mload(FAR_FROM_HIGHLIGHT)))
                            }
                        }
                    }
                }
                mstore(QUADRATIC_1, p)
                mstore(QUADRATIC_S, sub(sub(q, p), ab))
                mstore(QUADRATIC_T, sub(sub(r, p), ac))
                mstore(QUADRATIC_SS, ab)
                mstore(QUADRATIC_ST, sub(add(ab, ac), bc))
                mstore(QUADRATIC_TT, ac)
            }
        }
    }

    /// @notice Draws the fragments of a smooth triangle: see PixelRasterizer.drawParts.
    function drawParts(uint256 edges, uint256 rows, uint256 row) internal pure {
        assembly ("memory-safe") {
            // Fragments of a row; `light` contains the products at the first one, `step` their change to the next. `plain` is a literal, so
            // that the compiler generates two functions: 1 for grey light on linear colours.
            function span(p, end, attribute, light, step, plain) {
                let pixel := add(mload(IMAGE_ORIGIN), mul(3, shr(3, p)))
                for {} 1 {} {
                    if gt(attribute, or(mload(p), BEHIND_DEPTH)) {
                        // copying a few bytes is cheaper than inserting them into a word
                        mstore(0, attribute)
                        mcopy(p, 0, 8)
                        // N * N, Q68, and twice its root, Q34
                        let square := shr(UPPER_85_AT, light)
                        let length := add(shr(ROOT_SHIFT, mul(ROOT_SLOPE, square)), ROOT_AT_0)
                        length := add(length, div(square, length))
                        let factor := mload(FACE_LIGHT_40)
                        let sum := HALF_LEVEL
                        // N * L, Q59
                        let t := sar(N_DOT_L_AT, shl(MIDDLE_85_TO_TOP, light))
                        if sgt(t, 0) {
                            // divided by |N|, Q24
                            factor := add(factor, mul(mload(add(LIGHTS, LIGHT_DIFFUSE)), div(t, length)))
                            // N * H, Q46
                            t := sar(N_DOT_H_AT, shl(LOWER_85_TO_TOP, light))
                            if sgt(t, 0) {
                                t := div(mul(t, t), square)
                                if gt(t, mload(SPECULAR_BEGIN)) {
                                    t := mul(sub(t, mload(SPECULAR_BEGIN)), mload(SPECULAR_SCALE))
                                    if gt(t, SPECULAR_LAST) { t := SPECULAR_LAST }
                                    let entry := mload(add(SPECULAR_TABLE, and(shr(SPECULAR_ENTRY_SHIFT, t), SPECULAR_ENTRY_MASK)))
                                    entry := add(
                                        shr(SPECULAR_VALUE_AT, entry),
                                        shr(Q16, mul(and(entry, LANE_32), and(shr(SPECULAR_REST_AT, t), SPECULAR_REST_MASK)))
                                    )
                                    sum := add(sum, and(shr(Q16_TO_Q10, mul(mload(add(LIGHTS, LIGHT_COLOR)), entry)), LANES_24))
                                }
                            }
                        }
                        t := and(shr(ACCUMULATOR_FRACTION, attribute), LANES_24)
                        switch plain
                        case 1 { t := add(sum, and(shr(Q16, mul(t, and(shr(BLUE_Q40_AT, factor), LANE_32))), LANES_24)) }
                        default {
                            if and(mload(MODE), IS_STEEP) {
                                t := and(shr(Q16, mul(t, div(mload(NEAREST), shr(ACCUMULATOR_DEPTH_AT, attribute)))), LANES_24)
                            }
                            factor := shr(Q40_TO_Q16, factor)
                            sum := add(sum, shr(Q16, mul(and(t, LANE_24), and(factor, LANE_32))))
                            t := shr(MIDDLE_AT, t)
                            sum := add(sum, shl(MIDDLE_AT, shr(Q16, mul(and(t, LANE_24), and(shr(MIDDLE_AT, factor), LANE_32)))))
                            t := add(sum, shl(UPPER_AT, shr(Q16, mul(shr(MIDDLE_AT, t), shr(UPPER_AT, factor)))))
                        }
                        // lanes above 255 get all bits of 255
                        if and(t, OVERFLOW) { t := or(t, mul(and(shr(OVERFLOW_CARRY_AT, add(t, OVERFLOW_TO_CARRY)), ONES), BYTE_Q10)) }
                        mstore(0, mul(and(t, BYTES_Q10), Q10_TO_PIXEL))
                        mcopy(pixel, 0, 3)
                    }
                    p := add(p, 8)
                    if eq(p, end) { break }
                    pixel := add(pixel, 3)
                    attribute := add(attribute, mload(DX))
                    light := add(light, step)
                    step := add(step, mload(QUADRATIC_DXX))
                }
            }
            let mode := mload(MODE)
            // 0 for most triangles, 1 if only the light or the colours need more
            mode := or(and(mode, IS_CUT_OR_CROSSING), iszero(eq(and(mode, IS_GREY_OR_STEEP), IS_GREY)))
            // START is relative to column 0; make it relative to address 0
            let start := sub(mload(START), mul(mload(DX_8), row))
            mstore(DX, shl(3, mload(DX_8)))
            mstore(ROW_STEP, add(mload(DY), mul(mload(DX_8), mload(DEPTH_STRIDE))))
            let light := mload(QUADRATIC_START)
            let down := mload(QUADRATIC_DY)
            // half the second difference, and the first difference without it: the value at column x is then that at column 0 plus x * (DX
            // + x * HALF_DXX). The bit lost at the top does no harm: x * (x - 1) is even.
            mstore(QUADRATIC_HALF_DXX, shr(1, mload(QUADRATIC_DXX)))
            mstore(QUADRATIC_DX, sub(mload(QUADRATIC_DX), mload(QUADRATIC_HALF_DXX)))
            for {} 1 {} {
                if gt(mode, 1) {
                    // only the rows in the band
                    let stride := mload(DEPTH_STRIDE)
                    let count := sdiv(sub(add(row, mul(stride, mload(BAND_TOP))), mload(DEPTH_ORIGIN)), stride)
                    if sgt(count, 0) {
                        if gt(count, rows) { count := rows }
                        rows := sub(rows, count)
                        row := sub(row, mul(stride, count))
                        edges := add(edges, mul(mload(SLOPES), count))
                        start := add(start, mul(mload(ROW_STEP), count))
                    }
                    count := sdiv(sub(add(row, mul(stride, mload(BAND_BOTTOM))), mload(DEPTH_ORIGIN)), stride)
                    if slt(count, rows) {
                        rows := mul(count, sgt(count, 0))
                        mstore(LOWER_ROWS, 0)
                    }
                }
                for {} rows {} {
                    let p := and(shr(EDGE_ADDRESS_FRACTION, edges), ADDRESS)
                    let end := and(shr(EDGE_RIGHT_ADDRESS_AT, edges), ADDRESS)
                    if gt(mode, 1) {
                        // addresses may be negative beside the tile, columns are not
                        end := sub(edges, mul(shl(EDGE_ADDRESS_FRACTION, row), ONES_128))
                        p := and(shr(EDGES_LEFT_COLUMN_AT, end), EDGES_LEFT_COLUMN_MASK)
                        end := shr(EDGES_RIGHT_COLUMN_AT, end)
                        if lt(p, mload(COLUMN_BEGIN)) { p := mload(COLUMN_BEGIN) }
                        if gt(end, mload(COLUMN_END)) { end := mload(COLUMN_END) }
                        // a row without pixels remains empty if addresses are negative
                        if gt(p, end) { end := p }
                        p := add(row, shl(3, p))
                        end := add(row, shl(3, end))
                    }
                    if lt(p, end) {
                        let step := shr(3, sub(p, row))
                        let first := mul(step, mload(QUADRATIC_HALF_DXX))
                        {
                            let mean := add(mload(QUADRATIC_DX), first)
                            first := add(add(mean, first), mload(QUADRATIC_HALF_DXX))
                            mean := add(light, mul(step, mean))
                            step := first
                            first := mean
                        }
                        switch and(mode, 1)
                        case 0 { span(p, end, add(start, mul(mload(DX_8), p)), first, step, 1) }
                        default { span(p, end, add(start, mul(mload(DX_8), p)), first, step, 0) }
                    }
                    edges := add(edges, mload(SLOPES))
                    start := add(start, mload(ROW_STEP))
                    row := sub(row, mload(DEPTH_STRIDE))
                    light := add(light, down)
                    down := add(down, mload(QUADRATIC_DYY))
                    mstore(QUADRATIC_DX, add(mload(QUADRATIC_DX), mload(QUADRATIC_DXY)))
                    rows := sub(rows, 1)
                }
                rows := mload(LOWER_ROWS)
                if iszero(rows) { break }
                edges := or(and(edges, mload(LOWER_KEPT)), mload(LOWER_EDGE))
                mstore(SLOPES, mload(LOWER_SLOPES))
                mstore(LOWER_ROWS, 0)
            }
        }
    }
}
