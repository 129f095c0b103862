// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {sinCosOfHalf} from "../math/Euler.sol";
import {PackedMesh} from "../mesh/PackedMesh.sol";
import {NORMALS, WIDE} from "../scene/Mesh.sol";
import {Camera, Canvas, Object, ORTHOGRAPHIC, PERSPECTIVE, Vector, Fixed, ONE, ZERO} from "../scene/Scene.sol";
import {SceneErrors} from "../scene/SceneErrors.sol";
import {Stage, StageMaker} from "./StageMaker.sol";

/// @notice An axis-aligned box, given by two opposite corners.
struct Box {
    Vector low;
    Vector high;
}

/// @title Framing: places the camera, and fits objects into boxes.
library Framing {
    /// @notice A field of view must be at least 0.112 and below 180 degrees (Q32).
    error FieldOfViewOutOfRange(int256 degrees_);
    /// @notice The height of an orthographic view must be above 0 (Q32).
    error HeightOutOfRange(int256 height);
    /// @notice The scene has no vertices, or the viewing direction is zero.
    error NothingToFit();
    /// @notice The object's mesh is stored or compact, so its bounds are unknown: pass them to `add`.
    error BoundsUnknown(uint256 object);
    /// @notice The object, or the box for it, has no size.
    error NoRoom(uint256 object);

    /// @dev The part of the half-height and half-width that is used, in percent: the margin is 8 % of them on each side.
    int256 private constant USED = 92;
    /// @dev Near plane of an orthographic camera; it clips nothing.
    int256 private constant BEHIND_ALL = -(1 << 58);
    int256 private constant MAX = type(int256).max;
    /// @dev The least half-height of a perspective camera: see `Checks.sol`.
    Fixed private constant SMALLEST_TANGENT = Fixed.wrap(1 << 22);

    /// @dev The axes of the camera.
    struct Axes {
        Vector right;
        Vector up;
        Vector toward;
    }

    /// @notice Places the camera at `eye`, upright, looking at `target`; if it looks straight down or up, -z or z is up in the picture.
    /// Projection and near plane do not change; the near plane of a new stage is at 1 unit.
    function look(Stage memory made, Vector memory eye, Vector memory target) internal pure {
        Camera memory camera = made.scene.camera;
        Vector memory up = StageMaker.units(0, 1, 0);
        if (eye.x.raw() == target.x.raw() && eye.z.raw() == target.z.raw()) up = StageMaker.units(0, 0, eye.y > target.y ? -1 : int256(1));
        (camera.eye, camera.target, camera.up) = (eye, target, up);
        lightFromLeft(made);
    }

    /// @notice Makes the camera perspective with a vertical field of view in whole degrees, 1..179. The default is 50.
    function fieldOfView(Stage memory made, int256 degrees_) internal pure {
        fieldOfView(made, StageMaker.unit(degrees_));
    }

    /// @notice Makes the camera perspective with a vertical field of view in degrees, about 0.12 to 179.8.
    function fieldOfView(Stage memory made, Fixed degrees_) internal pure {
        if (degrees_.raw() <= 0 || degrees_.raw() >= 180 << 32) revert FieldOfViewOutOfRange(degrees_.raw());
        Camera memory camera = made.scene.camera;
        (Fixed sine, Fixed cosine) = sinCosOfHalf(degrees_.raw());
        if (sine / cosine < SMALLEST_TANGENT) revert FieldOfViewOutOfRange(degrees_.raw());
        if (camera.projection != PERSPECTIVE) camera.near = ONE;
        (camera.projection, camera.halfHeight) = (PERSPECTIVE, sine / cosine);
    }

    /// @notice Makes the camera orthographic.
    /// @param height Visible height, from top to bottom, in whole units.
    function orthographic(Stage memory made, int256 height) internal pure {
        orthographic(made, StageMaker.unit(height));
    }

    /// @notice Makes the camera orthographic.
    /// @param height Visible height, from top to bottom, in units.
    function orthographic(Stage memory made, Fixed height) internal pure {
        if (height.raw() <= 0) revert HeightOutOfRange(height.raw());
        Camera memory camera = made.scene.camera;
        (camera.projection, camera.halfHeight) = (ORTHOGRAPHIC, Fixed.wrap(height.raw() >> 1));
        camera.near = Fixed.wrap(BEHIND_ALL);
    }

    /// @notice Moves the camera so that all objects fill the picture except for a margin of 8 %; sets the visible height of an orthographic
    /// camera accordingly. Call it after all objects are placed.
    /// @dev Each side of the picture is a plane through the eye with all vertices on one side of it. The extent of the objects along its
    /// normal gives its position; the planes of opposite sides intersect in the eye.
    /// @param toward Direction from the objects to the eye, of any length: (0, 0, 1) is the front.
    function fit(Stage memory made, Vector memory toward) internal pure {
        Camera memory camera = made.scene.camera;
        Axes memory axes = axesOf(toward);
        Fixed aspect = aspectOf(made.scene.canvas);
        bool isPerspective = camera.projection == PERSPECTIVE;
        Fixed tangent = isPerspective ? camera.halfHeight * StageMaker.percent(USED) : ZERO;
        (Fixed x, Fixed width) = span(made, axes.right, axes.toward.scale(tangent * aspect));
        (Fixed y, Fixed height) = span(made, axes.up, axes.toward.scale(tangent));
        camera.target = axes.right.scale(x).add(axes.up.scale(y));
        height = larger(width / aspect, height);
        (Fixed z, Fixed depth) = span(made, axes.toward, StageMaker.units(0, 0, 0));
        Fixed distance;
        if (!isPerspective) {
            // a line along the viewing direction fits any height
            camera.halfHeight = height.raw() == 0 ? ONE : height / StageMaker.percent(USED);
            distance = depth + ONE;
        } else {
            distance = height / tangent - z;
            // objects that are long along the viewing direction may fit at any distance: as in Python, a thousandth of their size is left
            // before the eye, so that the near plane clips nothing
            Fixed size = larger(depth, height);
            Fixed least = depth + (size.raw() == 0 ? ONE : Fixed.wrap(size.raw() / 500 + 1));
            distance = larger(distance, least);
            // small scenes are seen from closer than 1 unit
            camera.near = smaller(ONE, Fixed.wrap(distance.raw() / 1024 + 1));
        }
        camera.target = camera.target.add(axes.toward.scale(z));
        (camera.eye, camera.up) = (camera.target.add(axes.toward.scale(distance)), axes.up);
        lightFromLeft(made);
    }

    /// @notice Scales and moves the last object so that it is centred in a box and as large as fits. Set its rotation first.
    /// @param room The box, given by any two opposite corners.
    function place(Stage memory made, Box memory room) internal pure {
        uint256 count = made.scene.objects.length;
        if (count == 0) revert StageMaker.NoSuchObject(0, 0);
        Object memory object = made.scene.objects[count - 1];
        (object.position, object.scale) = (StageMaker.units(0, 0, 0), ONE);
        Fixed scale = Fixed.wrap(MAX);
        Vector memory middle = StageMaker.units(0, 0, 0);
        (middle.x, scale) = placed(made, StageMaker.units(1, 0, 0), room.high.x - room.low.x, scale);
        (middle.y, scale) = placed(made, StageMaker.units(0, 1, 0), room.high.y - room.low.y, scale);
        (middle.z, scale) = placed(made, StageMaker.units(0, 0, 1), room.high.z - room.low.z, scale);
        if (scale.raw() == 0 || scale.raw() == MAX) revert NoRoom(count - 1);
        object.scale = scale;
        object.position = room.low.add(room.high).scale(Fixed.wrap(1 << 31)).sub(middle.scale(scale));
    }

    /// @notice Returns the box between two opposite corners, in whole units.
    function box(int256 x0, int256 y0, int256 z0, int256 x1, int256 y1, int256 z1) internal pure returns (Box memory) {
        return Box(StageMaker.units(x0, y0, z0), StageMaker.units(x1, y1, z1));
    }

    /// @notice Returns the box between two opposite corners, each given by x, y and z in whole units.
    function box(int256[3] memory low, int256[3] memory high) internal pure returns (Box memory) {
        return box(low[0], low[1], low[2], high[0], high[1], high[2]);
    }

    /// @dev Returns the middle of the last object along an axis, and the smaller of `most` and the scale at which it fills `room`.
    function placed(Stage memory made, Vector memory axis, Fixed room, Fixed most) private pure returns (Fixed middle, Fixed scale) {
        uint256 index = made.scene.objects.length - 1;
        (Fixed high, bool any) = reach(made, index, axis);
        if (!any) revert NoRoom(index);
        (Fixed low,) = reach(made, index, Vector(ZERO - axis.x, ZERO - axis.y, ZERO - axis.z));
        middle = Fixed.wrap((high - low).raw() >> 1);
        scale = most;
        if (high + low > ZERO) scale = smaller(most, (room < ZERO ? ZERO - room : room) / (high + low));
    }

    /// @dev Returns width / height.
    function aspectOf(Canvas memory canvas) private pure returns (Fixed) {
        if (canvas.width == 0 || canvas.height == 0) revert SceneErrors.CanvasSize(canvas.width, canvas.height);
        return StageMaker.fraction(int256(canvas.width), int256(canvas.height));
    }

    /// @dev Moves the default sun to the upper left of the viewer.
    function lightFromLeft(Stage memory made) private pure {
        unchecked {
            if (!made.hasDefaultSun()) return;
            (Vector memory eye, Vector memory target) = (made.scene.camera.eye, made.scene.camera.target);
            // a quarter, so that sums stay within the range of lights
            int256 x = (eye.x.raw() - target.x.raw()) / 4;
            int256 y = (eye.y.raw() - target.y.raw()) / 4;
            int256 z = (eye.z.raw() - target.z.raw()) / 4;
            int256 up = (x < 0 ? -x : x) + (z < 0 ? -z : z);
            if (up | y == 0) return;
            made.scene.lights[0].vector = Vector(Fixed.wrap(x - z / 2), Fixed.wrap(y + up * 3 / 4), Fixed.wrap(z + x / 2));
        }
    }

    /// @dev Returns the axes of an upright camera; seen from straight above or below, -z or z is up.
    function axesOf(Vector memory toward) private pure returns (Axes memory axes) {
        if (toward.isZero()) revert NothingToFit();
        axes.toward = toward.normalize();
        axes.right = StageMaker.units(0, 1, 0).cross(axes.toward);
        if (axes.right.isZero()) axes.right = StageMaker.units(1, 0, 0);
        axes.right = axes.right.normalize();
        axes.up = axes.toward.cross(axes.right);
    }

    /// @dev Returns half the difference and half the sum of the extents along axis + slope and slope - axis.
    function span(Stage memory made, Vector memory axis, Vector memory slope) private pure returns (Fixed middle, Fixed half) {
        (Fixed up, Fixed down) = (reach(made, axis.add(slope)), reach(made, slope.sub(axis)));
        return (Fixed.wrap((up - down).raw() >> 1), Fixed.wrap((up + down).raw() >> 1));
    }

    /// @dev Returns the largest dot product of a point of the objects and a direction.
    function reach(Stage memory made, Vector memory direction) private pure returns (Fixed most) {
        unchecked {
            uint256 count = made.scene.objects.length;
            bool found;
            for (uint256 k; k != count; ++k) {
                (Fixed each, bool any) = reach(made, k, direction);
                if (any && (!found || each > most)) (most, found) = (each, true);
            }
            if (!found) revert NothingToFit();
        }
    }

    /// @dev Returns the same for one object, and whether it has vertices.
    function reach(Stage memory made, uint256 index, Vector memory direction) private pure returns (Fixed most, bool any) {
        Object memory object = made.scene.objects[index];
        // the direction in the coordinates of the mesh
        Vector memory d = object.rotation.toMatrix().transposedTimes(direction).scale(object.scale);
        (most, any) = reachOfMesh(made, object.mesh, index, d);
        most = most + direction.dot(object.position);
    }

    /// @dev Returns the same for a mesh: from its bounds if they were passed to `add`, otherwise from its vertices.
    function reachOfMesh(Stage memory made, bytes memory mesh, uint256 index, Vector memory d) private pure returns (Fixed, bool) {
        if (made.isOwn() && index < made.bounds.length) {
            Box memory box_ = made.bounds[index];
            if (!box_.low.isZero() || !box_.high.isZero()) {
                return (larger(d.x * box_.low.x, d.x * box_.high.x) + larger(d.y * box_.low.y, d.y * box_.high.y)
                        + larger(d.z * box_.low.z, d.z * box_.high.z), true);
            }
        }
        if (mesh.length == 0 || uint8(mesh[0]) > NORMALS + WIDE) revert BoundsUnknown(index);
        return PackedMesh.reach(mesh, d);
    }

    function larger(Fixed a, Fixed b) private pure returns (Fixed) {
        return a > b ? a : b;
    }

    function smaller(Fixed a, Fixed b) private pure returns (Fixed) {
        return a < b ? a : b;
    }
}
