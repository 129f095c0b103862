// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {sqrt} from "../math/Roots.sol";
import {PackedMesh} from "../mesh/PackedMesh.sol";
import {MAX_CANVAS, inRange} from "../scene/Checks.sol";
import {Camera, Object, Scene, PERSPECTIVE, Vector, Fixed, ZERO, ONE, Matrix} from "../scene/Scene.sol";

/// @notice Moves the camera so that a rotating scene stays within the picture.
/// @dev A vertex at height h above the centre, along the axis, and at distance r from the axis moves on a circle. On the circle, a linear
/// function with the gradient n is at most n.centre + h * n.axis + r * |n - (n.axis) axis|. Each side of the picture is such a function:
/// the distance by which the camera must move back to show a point at that side.
library FollowingCamera {
    /// @dev The part of half the picture that can be filled: 0.92.
    int256 private constant FILLED = 3951369912;

    /// @param along n.axis.
    /// @param across |n - (n.axis) axis|.
    /// @param most The maximum of h * along + r * across over all vertices, Q64.
    struct Side {
        int256 along;
        int256 across;
        int256 most;
    }

    /// @notice Moves a perspective camera back, or enlarges the view of an orthographic one, until no vertex leaves the picture at any
    /// angle; never the other way. An invalid camera is left unchanged.
    /// @param center A point on the axis.
    /// @param axis The unit axis.
    function hold(Scene memory scene, Vector memory center, Vector memory axis) internal pure {
        unchecked {
            Camera memory camera = scene.camera;
            (uint256 width, uint256 height) = (scene.canvas.width, scene.canvas.height);
            if (width == 0 || width > MAX_CANVAS || height == 0 || height > MAX_CANVAS) return;
            bool known = fits(camera.eye) && fits(camera.target) && fits(camera.up) && camera.halfHeight > ZERO;
            if (!known || !inRange(camera.halfHeight.raw())) return;
            Vector memory forward = camera.target.sub(camera.eye).normalize();
            Vector memory right = forward.cross(camera.up.normalize()).normalize();
            if (forward.isZero() || right.isZero()) return;
            bool perspective = camera.projection == PERSPECTIVE;
            Fixed inverse = Fixed.wrap(int256(1 << 96) / (FILLED * camera.halfHeight.raw()));
            Vector memory upward = right.cross(forward).scale(inverse);
            right = right.scale(Fixed.wrap(inverse.raw() * int256(height) / int256(width)));
            Vector[4] memory gradients = [right, right.scale(Fixed.wrap(-(1 << 32))), upward, upward.scale(Fixed.wrap(-(1 << 32)))];
            Side[4] memory sides;
            for (uint256 i; i != 4; ++i) {
                if (perspective) gradients[i] = gradients[i].sub(forward);
                Fixed along = gradients[i].dot(axis);
                Vector memory rest = gradients[i].sub(axis.scale(along));
                sides[i] = Side(along.raw(), length(rest), type(int256).min);
            }
            for (uint256 k; k != scene.objects.length; ++k) reach(scene.objects[k], center, axis, sides);
            Vector memory offset = center.sub(camera.eye);
            Fixed most = perspective ? ZERO : ONE;
            for (uint256 i; i != 4; ++i) {
                Fixed needed = gradients[i].dot(offset) + Fixed.wrap(sides[i].most >> 32);
                if (needed > most) most = needed;
            }
            if (perspective) camera.eye = camera.eye.sub(forward.scale(most));
            else camera.halfHeight = camera.halfHeight * most;
        }
    }

    /// @dev Raises `most` of each side by the vertices of an object.
    function reach(Object memory object, Vector memory center, Vector memory axis, Side[4] memory sides) private pure {
        unchecked {
            (uint256 place, uint256 end, uint256 size, uint256 stride) = PackedMesh.vertices(object.mesh);
            Matrix memory m = object.rotation.toMatrix();
            // axis and centre in mesh space, at world scale
            (axis, center) = (m.transposedTimes(axis), m.transposedTimes(object.position.sub(center)));
            (int256 a, int256 b, int256 c) = (axis.x.raw(), axis.y.raw(), axis.z.raw());
            int256 scale = object.scale.raw();
            for (; place < end; place += stride) {
                int256 x = coordinate(place, size) * scale + center.x.raw();
                int256 y = coordinate(place + size, size) * scale + center.y.raw();
                int256 z = coordinate(place + 2 * size, size) * scale + center.z.raw();
                int256 h = (a * x + b * y + c * z) >> 32;
                int256 square = x * x + y * y + z * z - h * h;
                int256 r = square > 0 ? int256(sqrt(uint256(square))) : int256(0);
                assembly ("memory-safe") {
                    for { let i := 0 } lt(i, 0x80) { i := add(i, 0x20) } {
                        let side := mload(add(sides, i))
                        let value := add(mul(h, mload(side)), mul(r, mload(add(side, 0x20))))
                        if sgt(value, mload(add(side, 0x40))) { mstore(add(side, 0x40), value) }
                    }
                }
            }
        }
    }

    /// @dev Returns a coordinate of a vertex, which occupies the uppermost bits of the word at `place`.
    function coordinate(uint256 place, uint256 size) private pure returns (int256 value) {
        assembly ("memory-safe") {
            value := sar(sub(256, shl(3, size)), mload(place))
        }
    }

    function length(Vector memory v) private pure returns (int256) {
        unchecked {
            (int256 x, int256 y, int256 z) = (v.x.raw(), v.y.raw(), v.z.raw());
            return int256(sqrt(uint256(x * x + y * y + z * z)));
        }
    }

    function fits(Vector memory v) private pure returns (bool) {
        return inRange(v.x.raw()) && inRange(v.y.raw()) && inRange(v.z.raw());
    }
}
