// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Matrix, transposedTimes} from "../math/Quaternion.sol";
import {Scene, Object, Light, POINT, Vector, normalize} from "../scene/Scene.sol";
import {View} from "./View.sol";
import "../words/Registers.sol";

// Prepares `toward` and `Camera.toward` of picture.py for flat faces, in the space of the mesh.
// Flat faces are lit in mesh space, where their corners are small integers.

/// @dev The scale that converts a unit vector to Q24: see storeMeshVector.
int256 constant DIRECTION = int256(1 << (Q32 + Q32 - Q24));

library MeshSpace {
    /// @notice Sets the scale, and eye and lights in mesh space.
    function set(View memory view_, Scene calldata scene, Object calldata object, Matrix memory rotation) internal pure {
        unchecked {
            int256 scale = object.scale.raw();
            if (scale == 0) return;
            storeSigned(SCALE, scale);
            if (!view_.orthographic) storeSigned(SCALE_PER_NEAR, (scale << (Q32 + Q32)) / loadSigned(NEAR));
            Vector memory position = object.position;
            if (view_.orthographic) storeMeshVector(EYE_X, rotation.transposedTimes(view_.forward), DIRECTION);
            else storeMeshVector(EYE_X, rotation.transposedTimes(view_.eye.sub(position)), scale);
            storeLanes(NORMAL_X, rotation.transposedTimes(view_.right));
            storeLanes(NORMAL_Y, rotation.transposedTimes(view_.down));
            storeLanes(NORMAL_Z, rotation.transposedTimes(view_.forward));
            Light[] calldata lights = scene.lights;
            uint256 record = LIGHTS;
            for (uint256 i; i != lights.length; ++i) {
                Vector memory v = lights[i].vector;
                if (lights[i].kind == POINT) storeMeshVector(record + LIGHT_MESH_X, rotation.transposedTimes(v.sub(position)), scale);
                else storeLanes(record + LIGHT_MESH_X, rotation.transposedTimes(normalize(v)));
                record += LIGHT_SIZE;
            }
        }
    }

    /// @dev Stores a unit vector, Q24, in signed lanes of 86 bits, z lowest.
    function storeLanes(uint256 pointer, Vector memory v) internal pure {
        unchecked {
            uint256 shift = Q32 - Q24;
            storeSigned(pointer, ((v.x.raw() >> shift) << UPPER_86_AT) + ((v.y.raw() >> shift) << MIDDLE_86_AT) + (v.z.raw() >> shift));
        }
    }

    /// @dev Stores a vector divided by the scale of the mesh, Q32, rounded toward zero; divided by DIRECTION, a unit vector as Q24.
    /// Coordinates of up to 2^60 leave room for the shift.
    function storeMeshVector(uint256 pointer, Vector memory v, int256 scale) private pure {
        unchecked {
            storeSigned(pointer, (v.x.raw() << Q32) / scale);
            storeSigned(pointer + 32, (v.y.raw() << Q32) / scale);
            storeSigned(pointer + 64, (v.z.raw() << Q32) / scale);
        }
    }
}
