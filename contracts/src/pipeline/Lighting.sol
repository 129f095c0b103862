// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Vector, normalize} from "../math/Vector.sol";
import {Matrix, transposedTimes} from "../math/Quaternion.sol";
import {sqrt} from "../math/Roots.sol";
import {Scene, Object, Light, Material, POINT, FLAT, UNLIT} from "../scene/Scene.sol";
import {LANES_32} from "./FragmentShader.sol";
import {View} from "./View.sol";
import {Mesh} from "../scene/Mesh.sol";
import "./Registers.sol";

/// @dev The scale that makes Q24 of a unit vector: see storeMeshVector.
int256 constant DIRECTION = 1 << 40;

// What the fragment shader needs to know of lights and material, prepared once for the scene, an object, or a face.
library Lighting {
    /// @notice Lights in camera space.
    function setLights(View memory view_, Light[] calldata lights) internal pure {
        unchecked {
            uint256 record = LIGHTS;
            for (uint256 i; i != lights.length; ++i) {
                Light calldata light = lights[i];
                bool isPoint = light.kind == POINT;
                store(record + LIGHT_IS_POINT, isPoint ? 1 : 0);
                Vector memory v = light.vector;
                v = view_.toCamera(isPoint ? v.sub(view_.eye) : normalize(v));
                uint256 shift = isPoint ? 16 : 8;
                storeSigned(record + LIGHT_X, v.x.raw() >> shift);
                storeSigned(record + LIGHT_Y, v.y.raw() >> shift);
                storeSigned(record + LIGHT_Z, v.z.raw() >> shift);
                store(record + LIGHT_COLOR, colorLanes(light.color));
                record += LIGHT_SIZE;
            }
            store(LIGHTS_END, record);
        }
    }

    function colorLanes(uint256 color) private pure returns (uint256) {
        return (color & 0xff) | ((color & 0xff00) << 48) | ((color & 0xff0000) << 96);
    }

    /// @dev Colour bytes times a coefficient (Q32), lanes of Q16 where 255 is one.
    function scaled(uint256 color, int256 coefficient) private pure returns (uint256) {
        unchecked {
            uint256 k = uint256(coefficient) >> 16;
            return ((color & 0xff) * k / 255) | (((color >> 8) & 0xff) * k / 255) << 56 | ((color >> 16) * k / 255) << 112;
        }
    }

    /// @notice Material, and eye and lights in the space of the mesh.
    function setObject(View memory view_, Scene calldata scene, Object calldata object, Matrix memory rotation, Mesh memory mesh) internal pure {
        unchecked {
            Material calldata material = object.material;
            uint256 mode = view_.orthographic ? IS_ORTHOGRAPHIC : 0;
            store(OBJECT_MODE, mode);
            if (material.shading == UNLIT) return;
            setReach(view_, scene.lights, material);
            store(AMBIENT, scaled(scene.ambientLight, material.ambient.raw()));
            store(MESH_VERTICES, mesh.vertices);
            store(MESH_FACES, mesh.faces);
            store(MESH_STRIDE, mesh.stride);
            store(MESH_BITS, mesh.bits);
            Light[] calldata lights = scene.lights;
            uint256 record = LIGHTS;
            bool grey = isGrey(load(AMBIENT));
            for (uint256 i; i != lights.length; ++i) {
                uint256 diffuse = scaled(lights[i].color, material.diffuse.raw());
                grey = grey && isGrey(diffuse);
                store(record + LIGHT_DIFFUSE, diffuse);
                record += LIGHT_SIZE;
            }
            if (material.specular.raw() != 0) mode |= HAS_SPECULAR;
            setSpecular(uint256(material.specular.raw()), material.shininess);
            // without lights the normal makes no difference
            if (material.shading == FLAT || lights.length == 0) {
                mode |= IS_FLAT;
                store(FRAGMENT_SQUARE, 1 << 48);
                store(FRAGMENT_NORMAL_LENGTH, 1 << 24);
                setMeshSpace(view_, scene, object, rotation);
            } else {
                store(FACE_LIGHT, load(AMBIENT));
                store(FACE_LIGHT_40, load(AMBIENT) << 24);
                uint256 focal = uint256(view_.focal) >> 32;
                store(VARYING_REACH, view_.orthographic ? 1 << 60 : focal * focal / 16);
                storeSigned(HALF_REACH, isBroad(material) ? -1 : halfReach(uint256(material.specular.raw()), material.shininess));
                mode |= IS_SMOOTH | IS_LIT | IS_DIFFUSE | (grey ? IS_GREY : 0);
            }
            store(OBJECT_MODE, mode);
        }
    }

    function isGrey(uint256 light) private pure returns (bool) {
        unchecked {
            return light == (light & 0xffffffff) * ONES;
        }
    }

    /// @dev A highlight cos^n changes with its angle by n * angle^2 / 2 about its middle, so over d pixels linear interpolation is
    /// off by n * (d / 2f)^2 / 8, where the focal length f turns pixels into the angle of V, and H turns half as far as V.
    /// One and a half levels of 255 are allowed.
    function setReach(View memory view_, Light[] calldata lights, Material calldata material) private pure {
        unchecked {
            uint256 focal = uint256(view_.focal) >> 32;
            uint256 strength = material.shininess * uint256(material.specular.raw());
            bool point;
            for (uint256 i; i != lights.length; ++i) if (lights[i].kind == POINT) point = true;
            if (point) strength += 2 * uint256(material.diffuse.raw());
            strength *= lights.length;
            if (view_.orthographic) store(REACH, point ? 0 : 1 << 60);
            else store(REACH, strength == 0 ? 1 << 60 : (48 * focal * focal << 32) / (255 * strength));
            if (isBroad(material)) store(REACH, 0);
        }
    }

    /// @dev The square, Q40, of how much half vectors may differ in a triangle. If they are interpolated, their direction is off by d^2/8
    /// at most for a difference d, and cos^n is steepest with about 0.6 * sqrt(n): four levels of 255 are allowed, or d = 1/4.
    function halfReach(uint256 coefficient, uint256 shininess) private pure returns (int256) {
        unchecked {
            uint256 slope = (sqrt(shininess << 64) * coefficient) >> 32;
            if (slope == 0) return 1 << 36;
            // 4 * 8 / (0.6 * 255) = 0.2
            uint256 reach = (uint256(1) << 72) / (5 * slope);
            return reach > 1 << 36 ? int256(1 << 36) : int256(reach);
        }
    }

    /// @dev The highlight is the cosine itself: over its square, where the others are tabulated, it is too steep near zero to be
    /// interpolated, and each fragment takes the root.
    function isBroad(Material calldata material) private pure returns (bool) {
        return material.shininess == 1 && material.specular.raw() != 0;
    }

    function setMeshSpace(View memory view_, Scene calldata scene, Object calldata object, Matrix memory rotation) private pure {
        unchecked {
            int256 scale = object.scale.raw();
            if (scale == 0) return;
            storeSigned(SCALE, scale);
            if (!view_.orthographic) storeSigned(SCALE_PER_NEAR, (scale << 64) / loadSigned(NEAR));
            Vector memory position = object.position;
            if (view_.orthographic) storeMeshVector(EYE_X, rotation.transposedTimes(view_.forward), DIRECTION);
            else storeMeshVector(EYE_X, rotation.transposedTimes(view_.eye.sub(position)), scale);
            Light[] calldata lights = scene.lights;
            uint256 record = LIGHTS;
            for (uint256 i; i != lights.length; ++i) {
                Vector memory v = lights[i].vector;
                if (lights[i].kind == POINT) storeMeshVector(record + LIGHT_MESH_X, rotation.transposedTimes(v.sub(position)), scale);
                else storeMeshVector(record + LIGHT_MESH_X, rotation.transposedTimes(normalize(v)), DIRECTION);
                record += LIGHT_SIZE;
            }
        }
    }

    /// @dev A vector divided by the scale of the mesh, Q32, rounded toward zero; by DIRECTION for a unit vector as Q24. Coordinates of up to
    /// 2^60 leave room for the shift.
    function storeMeshVector(uint256 pointer, Vector memory v, int256 scale) private pure {
        unchecked {
            storeSigned(pointer, (v.x.raw() << 32) / scale);
            storeSigned(pointer + 32, (v.y.raw() << 32) / scale);
            storeSigned(pointer + 64, (v.z.raw() << 32) / scale);
        }
    }

    /// @notice Tabulates coefficient * cos^shininess over cos^2, where it is at least half a level.
    function setSpecular(uint256 coefficient, uint256 shininess) private pure {
        unchecked {
            store(SPECULAR_ROOT, shininess == 1 ? coefficient >> 16 : 0);
            if (coefficient == 0 || shininess == 1) {
                // no square is greater than this
                store(SPECULAR_BEGIN, type(uint256).max);
                return;
            }
            uint256 width = 13;
            for (uint256 k = 1 << 32; k < coefficient; k <<= 1) width += 2;
            width = (width << 24) / shininess;
            if (width > 1 << 24) width = 1 << 24;
            uint256 begin = (1 << 24) - width;
            store(SPECULAR_BEGIN, begin);
            store(SPECULAR_SCALE, (64 << 40) / width);
            uint256 last = (coefficient * power((1 << 24), shininess)) >> 48;
            uint256 pointer = SPECULAR_TABLE + 64 * 32;
            store(pointer, last << 128);
            for (uint256 i = 64; i != 0; ) {
                --i;
                pointer -= 32;
                uint256 value = (coefficient * power(begin + width * i / 64, shininess)) >> 48;
                store(pointer, (value << 128) | (last - value));
                last = value;
            }
        }
    }

    /// @dev square^(exponent / 2), where square is Q24 and the result Q32.
    function power(uint256 square, uint256 exponent) private pure returns (uint256 result) {
        unchecked {
            uint256 base = square << 8;
            result = exponent & 1 == 0 ? 1 << 32 : sqrt(base << 32);
            for (exponent >>= 1; exponent != 0; exponent >>= 1) {
                if (exponent & 1 != 0) result = (result * base) >> 32;
                base = (base * base) >> 32;
            }
        }
    }

    /// @notice Normal and light of a flat face, from its corners in the mesh.
    function setFace(uint256 face) internal pure returns (uint256 mode) {
        unchecked {
            uint256 length = sqrt(setFaceNormal(face));
            mode = load(OBJECT_MODE);
            uint256 light = load(AMBIENT);
            uint256 end = load(LIGHTS_END);
            for (uint256 record = LIGHTS; record < end; record += LIGHT_SIZE) {
                if (load(record + LIGHT_IS_POINT) == 0) {
                    int256 lambert;
                    assembly ("memory-safe") {
                        // normal * direction
                        lambert := add(mul(mload(FACE_NORMAL_X), mload(add(record, LIGHT_MESH_X))), mul(mload(FACE_NORMAL_Y), mload(add(record, LIGHT_MESH_Y))))
                        lambert := sdiv(shl(16, add(lambert, mul(mload(FACE_NORMAL_Z), mload(add(record, LIGHT_MESH_Z))))), length)
                        mstore(add(record, LIGHT_FACING), lambert)
                        if sgt(lambert, 0) {
                            light := add(light, and(shr(24, mul(mload(add(record, LIGHT_DIFFUSE)), lambert)), LANES_32))
                            // a highlight wants the light of each fragment
                            mode := or(mode, shr(2, and(mode, HAS_SPECULAR)))
                        }
                    }
                } else {
                    mode |= facePointLight(record, length);
                }
            }
            // where fragments add the diffuse light of all lights themselves, only the ambient light is left
            store(FACE_LIGHT, mode & IS_DIFFUSE == 0 ? light : load(AMBIENT));
            assembly ("memory-safe") {
                switch and(mode, IS_ORTHOGRAPHIC)
                case 0 {
                    // normal * (corner - eye)
                    light := add(mul(mload(FACE_NORMAL_X), sub(mload(FACE_CORNER_X), mload(EYE_X))), mul(mload(FACE_NORMAL_Y), sub(mload(FACE_CORNER_Y), mload(EYE_Y))))
                    light := add(light, mul(mload(FACE_NORMAL_Z), sub(mload(FACE_CORNER_Z), mload(EYE_Z))))
                    mstore(FACE_FACING_SLOPE, sdiv(mul(light, mload(SCALE_PER_NEAR)), length))
                    mstore(FACE_FACING, 0)
                }
                default {
                    // normal * line of sight
                    light := add(mul(mload(FACE_NORMAL_X), mload(EYE_X)), mul(mload(FACE_NORMAL_Y), mload(EYE_Y)))
                    mstore(FACE_FACING_SLOPE, 0)
                    mstore(FACE_FACING, sdiv(shl(40, add(light, mul(mload(FACE_NORMAL_Z), mload(EYE_Z)))), length))
                }
            }
        }
    }

    /// @return mode What the light adds to the mode of the face.
    function facePointLight(uint256 record, uint256 length) private pure returns (uint256 mode) {
        unchecked {
            int256 x = loadSigned(record + LIGHT_MESH_X) - loadSigned(FACE_CORNER_X);
            int256 y = loadSigned(record + LIGHT_MESH_Y) - loadSigned(FACE_CORNER_Y);
            int256 z = loadSigned(record + LIGHT_MESH_Z) - loadSigned(FACE_CORNER_Z);
            int256 lambert = loadSigned(FACE_NORMAL_X) * x + loadSigned(FACE_NORMAL_Y) * y + loadSigned(FACE_NORMAL_Z) * z;
            lambert = length == 0 ? int256(0) : ((lambert * loadSigned(SCALE)) >> 32) / int256(length);
            storeSigned(record + LIGHT_FACING, lambert);
            return lambert > 0 ? IS_LIT | IS_DIFFUSE : 0;
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
                uint256 facing = load(record + LIGHT_FACING);
                // neither negative nor zero
                if (load(record + LIGHT_IS_POINT) != 0 && facing - 1 < height) height = facing;
            }
            int256 plane = loadSigned(FACE_FACING_SLOPE) * loadSigned(DEPTH_SCALE);
            uint256 eyeHeight = uint256(plane < 0 ? -plane : plane) >> 151;
            // the cosine of the angle at the vertex is about eyeHeight / distance, and larger elsewhere: take a third more
            eyeHeight = 4 * eyeHeight / 3;
            if (eyeHeight < distance) height = height * eyeHeight / distance;
            return load(REACH) * height / (height + distance) * height / (height + distance);
        }
    }

    /// @notice Stores the normal of a face (twice its area long, in units of the mesh) and its first corner (Q32).
    /// @return square The square of the normal, Q32.
    function setFaceNormal(uint256 face) private pure returns (uint256 square) {
        assembly ("memory-safe") {
            function corner(index) -> x, y, z {
                let data := calldataload(add(mload(MESH_VERTICES), mul(index, mload(MESH_STRIDE))))
                let rest := sub(256, mload(MESH_BITS))
                x := sar(rest, data)
                data := shl(mload(MESH_BITS), data)
                y := sar(rest, data)
                z := sar(rest, shl(mload(MESH_BITS), data))
            }
            face := calldataload(add(mload(MESH_FACES), mul(6, face)))
            let px, py, pz := corner(shr(240, face))
            mstore(FACE_CORNER_X, shl(32, px))
            mstore(FACE_CORNER_Y, shl(32, py))
            mstore(FACE_CORNER_Z, shl(32, pz))
            let ax, ay, az := corner(and(shr(224, face), 0xffff))
            ax := sub(ax, px)
            ay := sub(ay, py)
            az := sub(az, pz)
            {
                let bx, by, bz := corner(and(shr(208, face), 0xffff))
                px := sub(bx, px)
                py := sub(by, py)
                pz := sub(bz, pz)
            }
            // a x b, where p is now b
            square := sub(mul(ay, pz), mul(az, py))
            mstore(FACE_NORMAL_X, square)
            az := sub(mul(az, px), mul(ax, pz))
            mstore(FACE_NORMAL_Y, az)
            ax := sub(mul(ax, py), mul(ay, px))
            mstore(FACE_NORMAL_Z, ax)
            square := shl(32, add(add(mul(square, square), mul(az, az)), mul(ax, ax)))
        }
    }
}
