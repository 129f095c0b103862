// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {sqrt} from "../math/Roots.sol";
import {Camera, ORTHOGRAPHIC, Fixed, Vector, normalize} from "../scene/Scene.sol";
import {SceneErrors} from "../scene/SceneErrors.sol";
import "../words/Registers.sol";

// Computes `Camera` of picture.py.

/// @notice The camera and its projection. Camera space has x to the right, y down, z forward, like the rows of a picture; the distance of a
/// point is its z.
/// @param focal Sub-pixels per unit at distance 1 (perspective) or per unit (orthographic), Q32.
/// @param centerX Twice the sub-pixel column of the canvas centre relative to a pixel centre, plus one half for rounding; `centerY`
/// likewise.
struct View {
    Vector eye;
    Vector right;
    Vector down;
    Vector forward;
    bool orthographic;
    int256 focal;
    int256 centerX;
    int256 centerY;
}

using {toCamera} for View global;

/// @notice Computes the basis of the camera, and sets the registers that depend only on camera and canvas.
function lookAt(Camera calldata camera, uint256 width, uint256 height) pure returns (View memory view_) {
    unchecked {
        view_.eye = camera.eye;
        view_.forward = normalize(camera.target.sub(camera.eye));
        view_.right = normalize(view_.forward.cross(normalize(camera.up)));
        if (view_.right.isZero()) revert SceneErrors.NoViewDirection();
        view_.down = view_.forward.cross(view_.right);

        view_.orthographic = camera.projection == ORTHOGRAPHIC;
        // sub-pixels of half the height
        view_.focal = (int256(height) << (SUBPIXEL_BITS - 1 + Q32 + Q32)) / camera.halfHeight.raw();
        view_.centerX = 2 * int256(width * HALF_PIXEL + (PIXEL_BIAS << SUBPIXEL_BITS) - HALF_PIXEL) + 1;
        view_.centerY = 2 * int256(height * HALF_PIXEL + (PIXEL_BIAS << SUBPIXEL_BITS) - HALF_PIXEL) + 1;

        store(FRAME_IS_ORTHOGRAPHIC, view_.orthographic ? 1 : 0);
        storeSigned(NEAR, camera.near.raw());
        storeSigned(DEPTH_SCALE, view_.orthographic ? int256(1 << DEPTH_BITS) : camera.near.raw() << DEPTH_BITS);
        setRays(view_, width, height);
    }
}

/// @dev Sets the ray through the centre of a pixel, and the constants for its length.
function setRays(View memory view_, uint256 width, uint256 height) pure {
    unchecked {
        // for parallel rays, positions in world units (Q32) instead
        int256 step =
            (view_.orthographic ? int256(1 << (SUBPIXEL_BITS + Q32 + Q32)) : int256(1 << (SUBPIXEL_BITS + Q32 + Q24))) / view_.focal;
        storeSigned(RAY_STEP, step);
        storeSigned(RAY_LEFT, ((int256(1) - int256(width + 2 * PIXEL_BIAS)) * step) / 2);
        storeSigned(RAY_TOP, ((int256(1) - int256(height + 2 * PIXEL_BIAS)) * step) / 2);
        if (view_.orthographic) step = 0;

        // The square root is approximated by the chord between the centre and the corner of the canvas, raised by half its maximum error
        uint256 x = width * uint256(step) / 2;
        uint256 y = height * uint256(step) / 2;
        uint256 square = ONE_48 + x * x + y * y;
        uint256 corner = sqrt(square);
        uint256 slope = ((corner - ONE_24) << Q48) / (square - ONE_48 + 1);
        uint256 raised = (corner - ONE_24) * (corner - ONE_24) / (8 * (corner + ONE_24));
        store(LENGTH_SLOPE, slope);
        store(LENGTH_AT_0, ONE_24 - slope + raised);
        // relative error of the first step: 2^-16 for corner lengths up to 1.3 times the centre's; each further step squares and halves it
        store(LENGTH_STEPS, corner < ONE_24 * 13 / 10 ? 0 : corner < ONE_24 * 5 / 2 ? 1 : corner < ONE_24 * 6 ? 2 : 12);
    }
}

/// @notice Returns a direction in camera space.
function toCamera(View memory view_, Vector memory v) pure returns (Vector memory) {
    return Vector(view_.right.dot(v), view_.down.dot(v), view_.forward.dot(v));
}
