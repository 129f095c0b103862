// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import "../../words/Registers.sol";

// Computes `normals` and `radiance` of picture.py for flat faces.
// Lighting of flat faces.

/// @dev Fraction bits: of positions in mesh space; of the length of a normal and of its square.
uint256 constant MESH_FRACTION = 32;
uint256 constant LENGTH_FRACTION = 16;
uint256 constant SQUARE_FRACTION = 32;
/// @dev From FACE_N_DOT_RAY_SLOPE times DEPTH_SCALE, without DEPTH_FRACTION, to Q16.
uint256 constant Q166_TO_Q16 = 150;

/// @dev From IS_TURNED_AWAY to the flag TWO_SIDED.
uint256 constant TURNED_TO_TWO_SIDED = 15;

library Lighting {
    /// @notice Computes the normal and light of a flat face from its corners in the mesh.
    /// @param crossing The bits of the triangle's mode, of which IS_TURNED_AWAY turns the normal of a face with two sides.
    /// @return mode How its fragments are lit: the mode of the object, IS_LIT if any light has a highlight there, IS_DIFFUSE if a point
    /// light shines on it; in the latter case, fragments sum the diffuse light of all lights.
    /// @return light The light that does not depend on the fragment, lanes of Q16; undefined if IS_DIFFUSE.
    function setFace(uint256 crossing) internal pure returns (uint256 mode, uint256 light) {
        // the length of the normal, which is twice the area of the face; first its square
        uint256 length;
        assembly ("memory-safe") {
            {
                // the corners, three numbers of `bits` each at the top of a word
                let bits := calldataload(mload(FACE))
                let x := mload(MESH_STRIDE)
                let rest := mload(MESH_VERTICES)
                let p := calldataload(add(rest, mul(x, shr(FACE_FIRST_IN_WORD, bits))))
                let a := calldataload(add(rest, mul(x, and(shr(FACE_SECOND_IN_WORD, bits), FACE_INDEX_MASK))))
                let b := calldataload(add(rest, mul(x, and(shr(FACE_AT, bits), FACE_INDEX_MASK))))
                if crossing {
                    if and(shr(TURNED_TO_TWO_SIDED, crossing), mload(OBJECT_FLAGS)) {
                        x := a // swaps two corners
                        a := b
                        b := x
                    }
                }
                bits := mload(MESH_BITS)
                rest := sub(256, bits)
                x := sar(rest, p) // from here on a coordinate of the first corner
                let ax := sub(sar(rest, a), x)
                let bx := sub(sar(rest, b), x)
                p := shl(bits, p)
                a := shl(bits, a)
                b := shl(bits, b)
                x := sar(rest, p)
                let ay := sub(sar(rest, a), x)
                let by := sub(sar(rest, b), x)
                x := sar(rest, shl(bits, p))
                a := sub(sar(rest, shl(bits, a)), x) // az and bz from here on
                b := sub(sar(rest, shl(bits, b)), x)
                // the cross product of the two edges (ax, ay, a) and (bx, by, b); its coordinates are up to 2^49
                x := sub(mul(ay, b), mul(a, by)) // the normal from here on: x = ay bz - az by
                p := sub(mul(a, bx), mul(ax, b)) // y = az bx - ax bz
                a := sub(mul(ax, by), mul(ay, bx)) // z = ax by - ay bx
                mstore(FACE_NORMAL, add(add(x, shl(MIDDLE_86_AT, p)), shl(UPPER_86_AT, a)))
                length := add(add(mul(x, x), mul(p, p)), mul(a, a)) // x^2 + y^2 + z^2
            }
            mstore(FACE_SQUARE, length)
            length := shl(SQUARE_FRACTION, length)
            {
                // The square root. With h, a multiple of 3, such that the square is m * 4^h and 1 <= m < 64, the line 0.1367 * (m + 8)
                // approximates the root of m with a relative error of 0.231; three steps of Newton's method reduce it to less than 2^-22.
                // If the normal is zero, all products are zero for any divisor.
                let h := mload(FACE_HINT)
                if gt(sub(shr(shl(1, h), length), 1), 62) {
                    length := or(length, iszero(length))
                    // neighbouring faces have similar magnitudes
                    for {} iszero(shr(shl(1, h), length)) {} { h := sub(h, 3) }
                    for {} gt(shr(shl(1, h), length), 63) {} { h := add(h, 3) }
                    mstore(FACE_HINT, h)
                }
                h := shr(10, mul(140, add(shr(h, length), shl(h, 8)))) // 140 / 1024 * (m + 8) * 2^h; the root from here on
                h := shr(1, add(h, div(length, h))) // Newton: (r + x / r) / 2
                h := shr(1, add(h, div(length, h)))
                length := shr(1, add(h, div(length, h)))
            }
            mstore(FACE_LENGTH, length)
        }
        unchecked {
            mode = load(OBJECT_MODE);
            light = load(AMBIENT);
            // if there are no lights, the first record is zero
            uint256 record = LIGHTS;
            while (true) {
                uint256 facing;
                if (load(record + LIGHT_IS_POINT) == 0) {
                    assembly ("memory-safe") {
                        // the middle coefficient of the product; the bits below borrow at most one
                        facing := sar(UPPER_86_AT, mul(mload(FACE_NORMAL), mload(add(record, LIGHT_MESH_X))))
                        facing := sdiv(shl(LENGTH_FRACTION, facing), length) // N.L / |N|, Q24
                    }
                } else {
                    // all ones, but not a literal: see ZERO_SLOT
                    facing = dot(record + LIGHT_MESH_X, ~load(ZERO_SLOT));
                    assembly ("memory-safe") {
                        facing := sdiv(sar(MESH_FRACTION, mul(facing, mload(SCALE))), length) // N.L / |N|, Q16
                        mode := or(mode, mul(IS_LIT_AND_DIFFUSE, sgt(facing, 0)))
                    }
                }
                assembly ("memory-safe") {
                    if sgt(facing, 0) {
                        light := add(light, and(shr(COSINE_FRACTION, mul(mload(add(record, LIGHT_DIFFUSE)), facing)), LANES_32))
                        // a highlight requires the light at each fragment
                        mode := or(mode, shr(SPECULAR_TO_LIT, and(mode, HAS_SPECULAR)))
                    }
                    mstore(add(record, LIGHT_N_DOT_L), facing)
                }
                record += LIGHT_SIZE;
                if (record >= load(LIGHTS_END)) break;
            }
        }
    }

    /// @notice Computes the product of the normal and a ray for fragments that are shaded individually: FACE_N_DOT_RAY and
    /// FACE_N_DOT_RAY_SLOPE.
    function setFacing() internal pure {
        bool isParallel = load(OBJECT_MODE) & IS_ORTHOGRAPHIC != 0;
        // normal * line of sight, or normal * (eye - corner)
        uint256 product = dot(EYE_X + load(ZERO_SLOT), isParallel ? 0 : type(uint256).max);
        assembly ("memory-safe") {
            switch isParallel
            case 0 {
                mstore(FACE_N_DOT_RAY_SLOPE, sdiv(mul(sub(0, product), mload(SCALE_PER_NEAR)), mload(FACE_LENGTH)))
                mstore(FACE_N_DOT_RAY, 0)
            }
            default {
                mstore(FACE_N_DOT_RAY_SLOPE, 0)
                mstore(FACE_N_DOT_RAY, sdiv(shl(Q40, product), mload(FACE_LENGTH)))
            }
        }
    }

    /// @dev Returns normal * (vector - first corner) of the face; if `all` is 0, not all ones, normal * vector; Q32.
    function dot(uint256 vector, uint256 all) private pure returns (uint256 sum) {
        assembly ("memory-safe") {
            let corner := calldataload(mload(FACE)) // the face; its first corner from here on
            corner := calldataload(add(mload(MESH_VERTICES), mul(shr(FACE_FIRST_IN_WORD, corner), mload(MESH_STRIDE))))
            corner := and(corner, all)
            let bits := mload(MESH_BITS)
            let rest := sub(256, bits)
            // unpack the coordinates of the normal, the uppermost first
            let normal := mload(FACE_NORMAL)
            let n := sar(UPPER_86_AT, add(normal, HALF_UPPER_86)) // z
            sum := mul(n, sub(mload(add(vector, 0x40)), shl(MESH_FRACTION, sar(rest, shl(shl(1, bits), corner)))))
            normal := sub(normal, shl(UPPER_86_AT, n))
            n := sar(MIDDLE_86_AT, add(normal, HALF_MIDDLE_86)) // y
            sum := add(sum, mul(n, sub(mload(add(vector, 0x20)), shl(MESH_FRACTION, sar(rest, shl(bits, corner))))))
            n := sub(normal, shl(MIDDLE_86_AT, n)) // x
            sum := add(sum, mul(n, sub(mload(vector), shl(MESH_FRACTION, sar(rest, corner)))))
        }
    }

    /// @notice Returns REACH for a face lit by point lights.
    /// @dev The directions to point lights turn like V: by the same amount if the light is as near as the eye and the face is seen from the
    /// front; by more if the face is seen at an angle, since a pixel covers a longer distance on it. A face seen from behind may hide the
    /// light: its highlight ends where L = -V.
    /// @param farthest The depth of the farthest vertex.
    function pointReach(uint256 farthest) internal pure returns (uint256) {
        unchecked {
            // distances: of the vertex from the eye; of the nearest light and of the eye from the plane of the face; Q16
            uint256 distance = (load(DEPTH_SCALE) >> Q16) / (farthest + 1) + 1;
            uint256 height = type(uint256).max >> 1;
            bool isBehind = load(OBJECT_MODE) & HAS_SPECULAR != 0 && loadSigned(FACE_N_DOT_RAY_SLOPE) > 0;
            uint256 end = load(LIGHTS_END);
            for (uint256 record = LIGHTS; record < end; record += LIGHT_SIZE) {
                uint256 facing = load(record + LIGHT_N_DOT_L);
                if (load(record + LIGHT_IS_POINT) == 0 || int256(facing) < 1) continue;
                if (isBehind && loadSigned(record + LIGHT_Z) > 0) return 0;
                if (facing < height) height = facing;
            }
            int256 plane = loadSigned(FACE_N_DOT_RAY_SLOPE) * loadSigned(DEPTH_SCALE);
            uint256 eyeHeight = uint256(plane < 0 ? -plane : plane) >> Q166_TO_Q16;
            // the cosine of the angle at the vertex is about eyeHeight / distance, and larger elsewhere: increase it by a third
            eyeHeight = 4 * eyeHeight / 3;
            if (eyeHeight < distance) height = height * eyeHeight / distance;
            return load(REACH) * height / (height + distance) * height / (height + distance);
        }
    }
}
