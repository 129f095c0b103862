// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {NORMALS, WIDE} from "../scene/Mesh.sol";
import {Camera, Material, Object, Scene, PERSPECTIVE, UNLIT} from "../scene/Scene.sol";
import {StudioErrors} from "../interfaces/StudioErrors.sol";

/// @notice Finds numbers that were probably not multiplied by 2^32: values so small that an object becomes invisible or black. The numbers
/// of a scene are Q32: 2^32 is 1.
library Units {
    // Scales, coefficients and distances from eye to target below these bounds are taken for numbers that were not converted to Q32.
    int256 private constant SMALL_SCALE = 1 << 10;
    int256 private constant SMALL_COEFFICIENT = 1 << 12;
    int256 private constant SMALL_DISTANCE = 1 << 16;

    /// @notice Reverts if a number of the scene looks as if it was not converted to Q32. The renderer checks all ranges.
    function check(Scene memory scene) internal pure {
        unchecked {
            Camera memory camera = scene.camera;
            (int256 x, int256 y, int256 z) = (camera.eye.x.raw(), camera.eye.y.raw(), camera.eye.z.raw());
            int256 distance = largest(x - camera.target.x.raw(), y - camera.target.y.raw(), z - camera.target.z.raw());
            // only the direction of an orthographic camera matters
            if (camera.projection == PERSPECTIVE && distance != 0 && distance < SMALL_DISTANCE) {
                // `fit` moves the camera close to objects that are too small
                for (uint256 k; k != scene.objects.length; ++k) {
                    int256 scale = scene.objects[k].scale.raw();
                    if (scale > 0 && scale < SMALL_SCALE) revert StudioErrors.ScaleLooksUnscaled(k, scale);
                }
                revert StudioErrors.CameraLooksUnscaled(x, y, z);
            }
            for (uint256 k; k != scene.objects.length; ++k) {
                Object memory object = scene.objects[k];
                int256 scale = object.scale.raw();
                if (scale > 0 && scale < SMALL_SCALE && isUnseen(object, camera)) revert StudioErrors.ScaleLooksUnscaled(k, scale);
                Material memory material = object.material;
                int256 most = largest(material.ambient.raw(), material.diffuse.raw(), material.specular.raw());
                if (most != 0 && most < SMALL_COEFFICIENT && material.shading != UNLIT) {
                    revert StudioErrors.MaterialLooksUnscaled(k, most);
                }
            }
        }
    }

    /// @dev Returns whether the largest mesh of this format would be smaller than a pixel of the largest canvas, which has 2^11 rows.
    function isUnseen(Object memory object, Camera memory camera) private pure returns (bool) {
        unchecked {
            bytes memory mesh = object.mesh;
            bool isShort = mesh.length != 0 && uint8(mesh[0]) <= NORMALS + WIDE && uint8(mesh[0]) & WIDE == 0;
            int256 extent = object.scale.raw() << (isShort ? 16 : 24);
            int256 halfHeight = camera.halfHeight.raw();
            if (camera.projection == PERSPECTIVE) {
                halfHeight = halfHeight * largest(
                    object.position.x.raw() - camera.eye.x.raw(),
                    object.position.y.raw() - camera.eye.y.raw(),
                    object.position.z.raw() - camera.eye.z.raw()
                ) >> 32;
            }
            return extent << 10 < halfHeight;
        }
    }

    /// @dev Returns the largest magnitude.
    function largest(int256 x, int256 y, int256 z) private pure returns (int256 most) {
        unchecked {
            most = x < 0 ? -x : x;
            if (y > most || -y > most) most = y < 0 ? -y : y;
            if (z > most || -z > most) most = z < 0 ? -z : z;
        }
    }
}
