// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import "./Registers.sol";

// How the lights meet a flat face.
library Lighting {
    /// @notice Normal and light of a flat face, from its corners in the mesh.
    /// @return mode How its fragments are lit: the mode of the object, IS_LIT if any light has highlights there, IS_DIFFUSE if a point
    /// light shines on it.
    function setFace() internal pure returns (uint256 mode) {
        assembly ("memory-safe") {
            function corner(index) -> x, y, z {
                let data := calldataload(add(mload(MESH_VERTICES), mul(index, mload(MESH_STRIDE))))
                let bits := mload(MESH_BITS)
                let rest := sub(256, bits)
                x := sar(rest, data)
                data := shl(bits, data)
                y := sar(rest, data)
                z := sar(rest, shl(bits, data))
            }

            // normal * vector
            function dot(vector) -> sum {
                sum := add(mul(mload(FACE_NORMAL_X), mload(vector)), mul(mload(FACE_NORMAL_Y), mload(add(vector, 0x20))))
                sum := add(sum, mul(mload(FACE_NORMAL_Z), mload(add(vector, 0x40))))
            }

            // normal * first corner, Q32
            function plane() -> sum {
                let x, y, z := corner(shr(240, calldataload(mload(FACE))))
                sum := add(mul(mload(FACE_NORMAL_X), x), mul(mload(FACE_NORMAL_Y), y))
                sum := shl(32, add(sum, mul(mload(FACE_NORMAL_Z), z)))
            }

            let face
            // the length of the normal, which is twice the area of the face
            let length
            {
                face := shr(208, calldataload(mload(FACE)))
                let px, py, pz := corner(shr(32, face))
                let ax, ay, az := corner(and(shr(16, face), 0xffff))
                ax := sub(ax, px)
                ay := sub(ay, py)
                az := sub(az, pz)
                let bx, by, bz := corner(and(face, 0xffff))
                bx := sub(bx, px)
                by := sub(by, py)
                bz := sub(bz, pz)
                // a x b
                face := sub(mul(ay, bz), mul(az, by))
                mstore(FACE_NORMAL_X, face)
                px := face
                length := mul(face, face)
                face := sub(mul(az, bx), mul(ax, bz))
                mstore(FACE_NORMAL_Y, face)
                px := add(px, shl(85, face))
                length := add(length, mul(face, face))
                face := sub(mul(ax, by), mul(ay, bx))
                mstore(FACE_NORMAL_Z, face)
                // coordinates of up to 2^49
                mstore(FACE_NORMAL, add(px, shl(170, face)))
                length := add(length, mul(face, face))
                mstore(FACE_SQUARE, length)
                length := shl(32, length)
            }
            {
                // the square root, as in FragmentLight; where the normal is zero, all products are, whatever they are divided by
                length := or(length, iszero(length))
                let h := mload(NORMAL_HINT)
                if gt(sub(shr(shl(1, h), length), 1), 2) {
                    // that of a neighbour is near
                    for {} iszero(shr(shl(1, h), length)) {} { h := sub(h, 1) }
                    for {} gt(shr(shl(1, h), length), 3) {} { h := add(h, 1) }
                    mstore(NORMAL_HINT, h)
                }
                face := shr(10, mul(351, add(shr(h, length), shl(h, 2))))
                face := shr(1, add(face, div(length, face)))
                length := shr(1, add(face, div(length, face)))
                mstore(FACE_LENGTH, length)
            }
            mode := mload(OBJECT_MODE)
            face := mload(AMBIENT)
            for { let record := LIGHTS } lt(record, mload(LIGHTS_END)) { record := add(record, LIGHT_SIZE) } {
                let facing
                switch mload(add(record, LIGHT_IS_POINT))
                case 0 {
                    // the middle lane of a product with lanes the other way round; what is below takes one away at most, and bit 255 is
                    // of the lane above
                    facing := sar(171, shl(1, mul(mload(FACE_NORMAL), mload(add(record, LIGHT_MESH_X)))))
                    facing := sdiv(shl(16, facing), length)
                    if sgt(facing, 0) {
                        face := add(face, and(shr(24, mul(mload(add(record, LIGHT_DIFFUSE)), facing)), LANES_32))
                        // a highlight wants the light of each fragment
                        mode := or(mode, shr(2, and(mode, HAS_SPECULAR)))
                    }
                }
                default {
                    facing := sdiv(sar(32, mul(sub(dot(add(record, LIGHT_MESH_X)), plane()), mload(SCALE))), length)
                    // IS_LIT | IS_DIFFUSE
                    mode := or(mode, mul(6, sgt(facing, 0)))
                }
                mstore(add(record, LIGHT_N_DOT_L), facing)
            }
            // where fragments add the diffuse light of all lights themselves, only the ambient light is left
            if and(mode, IS_DIFFUSE) { face := mload(AMBIENT) }
            mstore(FACE_LIGHT, face)
        }
    }

    /// @notice The product of the normal and a ray, as fragments want it that are lit for themselves: FACE_N_DOT_RAY and
    /// FACE_N_DOT_RAY_SLOPE.
    function setFacing() internal pure {
        assembly ("memory-safe") {
            function corner(index) -> x, y, z {
                let data := calldataload(add(mload(MESH_VERTICES), mul(index, mload(MESH_STRIDE))))
                let bits := mload(MESH_BITS)
                let rest := sub(256, bits)
                x := sar(rest, data)
                data := shl(bits, data)
                y := sar(rest, data)
                z := sar(rest, shl(bits, data))
            }

            // normal * vector
            function dot(vector) -> sum {
                sum := add(mul(mload(FACE_NORMAL_X), mload(vector)), mul(mload(FACE_NORMAL_Y), mload(add(vector, 0x20))))
                sum := add(sum, mul(mload(FACE_NORMAL_Z), mload(add(vector, 0x40))))
            }

            // normal * first corner, Q32
            function plane() -> sum {
                let x, y, z := corner(shr(240, calldataload(mload(FACE))))
                sum := add(mul(mload(FACE_NORMAL_X), x), mul(mload(FACE_NORMAL_Y), y))
                sum := shl(32, add(sum, mul(mload(FACE_NORMAL_Z), z)))
            }

            switch and(mload(OBJECT_MODE), IS_ORTHOGRAPHIC)
            case 0 {
                // normal * (corner - eye)
                mstore(FACE_N_DOT_RAY_SLOPE, sdiv(mul(sub(plane(), dot(EYE_X)), mload(SCALE_PER_NEAR)), mload(FACE_LENGTH)))
                mstore(FACE_N_DOT_RAY, 0)
            }
            default {
                // normal * line of sight
                mstore(FACE_N_DOT_RAY_SLOPE, 0)
                mstore(FACE_N_DOT_RAY, sdiv(shl(40, dot(EYE_X)), mload(FACE_LENGTH)))
            }
        }
    }

    /// @notice REACH for the face, on which point lights shine.
    /// @dev Their directions turn as well as V: by as much where the light is as near as the eye and the face is seen from the front; where
    /// the face is seen at an angle, by more, since a pixel is a longer way on it.
    /// @param farthest The depth of its farthest vertex.
    function pointReach(uint256 farthest) internal pure returns (uint256) {
        unchecked {
            // of the vertex from the eye, and of the nearest light and the eye from the plane of the face, Q16
            uint256 distance = (load(DEPTH_SCALE) >> 16) / (farthest + 1) + 1;
            uint256 height = type(uint256).max >> 1;
            uint256 end = load(LIGHTS_END);
            for (uint256 record = LIGHTS; record < end; record += LIGHT_SIZE) {
                uint256 facing = load(record + LIGHT_N_DOT_L);
                // neither negative nor zero
                if (load(record + LIGHT_IS_POINT) != 0 && facing - 1 < height) height = facing;
            }
            int256 plane = loadSigned(FACE_N_DOT_RAY_SLOPE) * loadSigned(DEPTH_SCALE);
            uint256 eyeHeight = uint256(plane < 0 ? -plane : plane) >> 150;
            // the cosine of the angle at the vertex is about eyeHeight / distance, and larger elsewhere: take a third more
            eyeHeight = 4 * eyeHeight / 3;
            if (eyeHeight < distance) height = height * eyeHeight / distance;
            return load(REACH) * height / (height + distance) * height / (height + distance);
        }
    }
}
