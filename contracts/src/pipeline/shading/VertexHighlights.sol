// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import "../../words/Registers.sol";

// Computes the half vectors of `cosines_of` of picture.py at vertices of flat faces.
// Computes the highlights of directional lights at the vertices of a flat face.
//
// The half vector H = L - V, for unit vectors L to the light and V along the ray, is stored in mesh space, Q32; its dot product with the
// normal of a face is the middle coefficient of one product of words: coordinates of normals are up to 2^49, so it is below 2^83. The error
// of H is at most 2^-22, since rays and directions are Q24. Its square is stored in the unit in which
//
//   (N.H)^2 / (N.N * square)
//
// is an index into the table of the highlight: cos^2 times the number of entries per unit, Q24. To keep rounding from exceeding the last
// entry, H^2 is increased by 2^-20, more than its error: cos^n changes by at most n/2 * 2^-20 / H^2, or, with a shininess of 128 and H^2 =
// 1, by 0.016 levels.

/// @dev 1 + 2^-21, Q24.
uint256 constant ABOVE_ONE_24 = 0x1000008;
/// @dev 1, Q56: divided by a length of Q24 it is Q32, which converts Q48 to Q80.
uint256 constant ONE_56 = 0x100000000000000;
/// @dev Conversions between Q formats; and from a square (Q48, half of it times the length) to the unit in which it is stored.
uint256 constant Q24_TO_Q80 = 56;
uint256 constant Q80_TO_Q32 = 48;
uint256 constant Q40_TO_Q10 = 30;
uint256 constant SQUARE_SHIFT = 33;

library VertexHighlights {
    /// @notice Adds the highlights at the vertices to the attribute words of a flat triangle. Vertex records cache the values that do not
    /// depend on the face.
    /// @param a, b, c The screen words of the vertices.
    /// @param p, q, r The attribute words.
    function addTo(uint256 a, uint256 b, uint256 c, uint256 p, uint256 q, uint256 r) internal pure returns (uint256, uint256, uint256) {
        assembly ("memory-safe") {
            // for each light, H and its square, after the first two words of a record
            function fill(vertex) {
                let x := mload(vertex)
                let y := add(mload(RAY_TOP), sar(SUBPIXEL_BITS, mul(shr(SCREEN_ROW_AT, x), mload(RAY_STEP)))) // RAY_TOP + row * RAY_STEP
                x := and(shr(SCREEN_COLUMN_AT, x), SCREEN_COLUMN_MASK)
                x := add(mload(RAY_LEFT), sar(SUBPIXEL_BITS, mul(x, mload(RAY_STEP))))
                if mload(FRAME_IS_ORTHOGRAPHIC) {
                    x := 0
                    y := 0
                }
                let square := add(add(mul(x, x), mul(y, y)), ONE_48) // |r|^2, Q48
                let length := add(mload(LENGTH_AT_0), shr(Q48, mul(square, mload(LENGTH_SLOPE)))) // |r|, Q24
                length := shr(1, add(length, div(square, length))) // Newton: (l + x / l) / 2
                for { let steps := mload(LENGTH_STEPS) } steps { steps := sub(steps, 1) } {
                    length := shr(1, add(length, div(square, length)))
                }
                // V, Q80
                let ray := add(add(mul(x, mload(NORMAL_X)), mul(y, mload(NORMAL_Y))), shl(COSINE_FRACTION, mload(NORMAL_Z)))
                ray := mul(ray, div(ONE_56, length)) // r / |r|
                for { let record := LIGHTS } 1 {} {
                    vertex := add(vertex, HALF_SIZE)
                    square := sub(shl(Q24_TO_Q80, mload(add(record, LIGHT_MESH_X))), ray) // square from here on: L - V, Q80
                    mstore(add(vertex, HALF_VECTOR), sub(and(shr(Q80_TO_Q32, add(square, HALF_86)), Q32_86), HALF_Q32_86))
                    // H^2 = 2 * (length - L.V) / length
                    square := add(mul(mload(add(record, LIGHT_X)), x), mul(mload(add(record, LIGHT_Y)), y)) // then L.r, H^2 / 2 * length
                    square := sub(mul(length, ABOVE_ONE_24), add(square, shl(COSINE_FRACTION, mload(add(record, LIGHT_Z)))))
                    mstore(add(vertex, HALF_SQUARE), sdiv(shl(SQUARE_SHIFT, square), mul(length, mload(SPECULAR_SCALE))))
                    record := add(record, LIGHT_SIZE)
                    if iszero(lt(record, mload(LIGHTS_END))) { break }
                }
            }

            // the light of a light record for a vertex whose cached values are at `kept`: lanes of Q10
            function shine(record, kept) -> color {
                let place := sar(UPPER_86_AT, mul(mload(FACE_NORMAL), mload(add(kept, HALF_VECTOR)))) // N.H
                place := mul(place, sgt(place, 0)) // max(N.H, 0)
                place := div(mul(place, place), mul(mload(FACE_SQUARE), mload(add(kept, HALF_SQUARE)))) // (N.H)^2 / (N.N * square)
                place := sub(place, mload(SPECULAR_OFFSET)) // from here on the index into the table, Q24
                if sgt(place, 0) {
                    color := mload(add(SPECULAR_TABLE, and(shr(SPECULAR_ENTRY_SHIFT_24, place), SPECULAR_ENTRY_MASK_24)))
                    // (value * 2^24 + increase * fraction of the index), Q40, is the upper half of a product
                    color := shr(SPECULAR_VALUE_AT, mul(color, or(ONE_24, and(shl(SPECULAR_VALUE_AT, place), SPECULAR_REST_AT_128))))
                    color := and(shr(Q40_TO_Q10, mul(mload(add(record, LIGHT_COLOR)), color)), LANES_24)
                }
            }

            a := add(and(a, SCREEN_RECORD_MASK), VERTEX_SIZE) // from here on the addresses of half vectors
            b := add(and(b, SCREEN_RECORD_MASK), VERTEX_SIZE)
            c := add(and(c, SCREEN_RECORD_MASK), VERTEX_SIZE)
            if iszero(mload(a)) { fill(sub(a, VERTEX_SIZE)) }
            if iszero(mload(b)) { fill(sub(b, VERTEX_SIZE)) }
            if iszero(mload(c)) { fill(sub(c, VERTEX_SIZE)) }
            for { let record := LIGHTS } 1 {} {
                if sgt(mload(add(record, LIGHT_N_DOT_L)), 0) {
                    p := add(p, shine(record, a))
                    q := add(q, shine(record, b))
                    r := add(r, shine(record, c))
                }
                record := add(record, LIGHT_SIZE)
                if iszero(lt(record, mload(LIGHTS_END))) { break }
                a := add(a, HALF_SIZE)
                b := add(b, HALF_SIZE)
                c := add(c, HALF_SIZE)
            }
        }
        return (p, q, r);
    }
}
