// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import "./Registers.sol";

// The highlights of directional lights at the vertices of a flat face.
//
// The half vector H = L - V, for unit vectors L to the light and V along the ray, is kept in the space of the mesh, Q32, where the product
// with the normal of a face is the middle lane of one product of words: coordinates of normals are up to 2^49, so that it is below 2^83.
// H is off by 2^-22 at most, as rays and directions are Q24.

/// @dev Three lanes of 85 bits: half of a lane in each; what is left of a lane that is shifted down by 48 bits; half of that.
uint256 constant HALF_85 = 0x4000000000000000000002000000000000000000001000000000000000000000;
uint256 constant LOW_37 = 0x7ffffffffc000000000003ffffffffe000000000001fffffffff;
uint256 constant HALF_37 = 0x4000000000000000000002000000000000000000001000000000;

library VertexHighlights {
    /// @notice Adds the highlights at its vertices to the attribute words of a flat triangle. Records of vertices keep what does not depend
    /// on the face.
    /// @param a, b, c The screen words of its vertices, whose attribute words are in ATTRIBUTE_0, DELTA_1 and DELTA_2.
    function addAll(uint256 a, uint256 b, uint256 c) internal pure {
        assembly ("memory-safe") {
            // for each light H, and its square, Q40: 2 * (length - L.V) / length
            function fill(vertex) {
                let x := mload(vertex)
                let y := add(mload(RAY_TOP), sar(8, mul(shr(128, x), mload(RAY_STEP))))
                x := add(mload(RAY_LEFT), sar(8, mul(and(shr(64, x), 0xfffff), mload(RAY_STEP))))
                if mload(FRAME_IS_ORTHOGRAPHIC) {
                    x := 0
                    y := 0
                }
                let square := add(add(mul(x, x), mul(y, y)), 0x1000000000000)
                let length := add(mload(LENGTH_AT_0), shr(48, mul(square, mload(LENGTH_SLOPE))))
                length := shr(1, add(length, div(square, length)))
                for { let steps := mload(LENGTH_STEPS) } steps { steps := sub(steps, 1) } {
                    length := shr(1, add(length, div(square, length)))
                }
                // V, Q80
                let ray := add(add(mul(x, mload(NORMAL_X)), mul(y, mload(NORMAL_Y))), shl(24, mload(NORMAL_Z)))
                ray := mul(ray, div(0x100000000000000, length))
                for { let record := LIGHTS } lt(record, mload(LIGHTS_END)) { record := add(record, LIGHT_SIZE) } {
                    vertex := add(vertex, 0x40)
                    square := sub(shl(56, mload(add(record, LIGHT_MESH_X))), ray)
                    mstore(vertex, sub(and(shr(48, add(square, HALF_85)), LOW_37), HALF_37))
                    square := add(mul(mload(add(record, LIGHT_X)), x), mul(mload(add(record, LIGHT_Y)), y))
                    square := sub(shl(24, sub(length, mload(add(record, LIGHT_Z)))), square)
                    mstore(add(vertex, 32), sdiv(shl(17, square), length))
                }
            }

            // the light of a record on a vertex, what of it the vertex keeps, and its attribute word
            function shine(record, kept, pointer) {
                // the square of N.H / (|N| * |H|), Q24
                let half := sar(171, shl(1, mul(mload(FACE_NORMAL), mload(kept))))
                if sgt(half, 0) {
                    half := div(mul(half, half), mul(mload(FACE_SQUARE), mload(add(kept, 32))))
                    if gt(half, mload(SPECULAR_BEGIN)) {
                        half := mul(sub(half, mload(SPECULAR_BEGIN)), mload(SPECULAR_SCALE))
                        if gt(half, 0x400000000000) { half := 0x400000000000 }
                        let entry := mload(add(SPECULAR_TABLE, and(shr(35, half), 0xffffe0)))
                        entry := add(shr(128, entry), shr(16, mul(and(entry, 0xffffffff), and(shr(24, half), 0xffff))))
                        entry := and(shr(6, mul(mload(add(record, LIGHT_COLOR)), entry)), LANES_24)
                        mstore(pointer, add(mload(pointer), entry))
                    }
                }
            }

            a := add(and(a, 0xffffffff), 0x40)
            b := add(and(b, 0xffffffff), 0x40)
            c := add(and(c, 0xffffffff), 0x40)
            if iszero(mload(a)) { fill(sub(a, 0x40)) }
            if iszero(mload(b)) { fill(sub(b, 0x40)) }
            if iszero(mload(c)) { fill(sub(c, 0x40)) }
            for { let record := LIGHTS } lt(record, mload(LIGHTS_END)) { record := add(record, LIGHT_SIZE) } {
                if sgt(mload(add(record, LIGHT_N_DOT_L)), 0) {
                    shine(record, a, ATTRIBUTE_0)
                    shine(record, b, DELTA_1)
                    shine(record, c, DELTA_2)
                }
                a := add(a, 0x40)
                b := add(b, 0x40)
                c := add(c, 0x40)
            }
        }
    }
}
