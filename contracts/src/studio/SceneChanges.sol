// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {sqrt} from "../math/Roots.sol";
import {PackedMesh} from "../mesh/PackedMesh.sol";
import {ANTIALIAS as ANTIALIAS_RECORD} from "../words/Records.sol";
import {addRecord} from "../scene/RecordWriter.sol";
import {WIDE} from "../scene/Mesh.sol";
import {Scene, Object, Fixed, Vector, Quaternion, Matrix} from "../scene/Scene.sol";
import {checkPosition, checkRotation, checkScale, inRange} from "../scene/Checks.sol";
import {ANTIALIAS, BACKGROUND, CANVAS, INVERT, PAINT, TURN, Changes} from "../interfaces/Changes.sol";
import {StudioErrors} from "../interfaces/StudioErrors.sol";

/// @notice Applies changes to a scene.
library SceneChanges {
    int256 private constant MAX_PART = 1 << 48;

    /// @dev Meshes must be in the format of `Mesh.sol`.
    function make(Scene memory scene, Changes memory changes) internal pure {
        uint256 fields = changes.fields;
        if (fields > 63) revert StudioErrors.UnknownChanges(fields);
        if (fields & TURN != 0) {
            checkTurn(changes.turn);
            checkPlaces(scene);
            turn(scene, changes.turn, middle(scene));
        }
        if (fields & PAINT != 0) {
            if (changes.color > 0xffffff) revert StudioErrors.ColorOutOfRange(changes.color);
            for (uint256 k; k < scene.objects.length; ++k) PackedMesh.paint(scene.objects[k].mesh, changes.color);
        }
        if (fields & BACKGROUND != 0) scene.background = changes.background;
        if (fields & INVERT != 0) scene.invert = changes.invert;
        if (fields & CANVAS != 0) scene.canvas = changes.canvas;
        if (fields & ANTIALIAS != 0) scene.extensions = addRecord(scene.extensions, ANTIALIAS_RECORD, 0, "");
    }

    /// @notice Checks the ranges of the fields used here; the renderer checks the rest.
    function checkPlaces(Scene memory scene) internal pure {
        for (uint256 k; k < scene.objects.length; ++k) checkPlace(scene.objects[k], k);
    }

    function checkPlace(Object memory object, uint256 index) private pure {
        Vector memory p = object.position;
        checkPosition(p.x.raw(), p.y.raw(), p.z.raw(), index);
        uint256 format = object.mesh.length == 0 ? 0 : uint8(object.mesh[0]);
        checkScale(object.scale.raw(), format & WIDE == 0 ? 16 : 24, index);
        Quaternion memory q = object.rotation;
        checkRotation(q.x.raw(), q.y.raw(), q.z.raw(), q.w.raw(), index);
    }

    /// @notice Rotates all objects about a point.
    function turn(Scene memory scene, Quaternion memory q, Vector memory center) internal pure {
        Matrix memory m = q.toMatrix();
        for (uint256 k; k < scene.objects.length; ++k) {
            Object memory object = scene.objects[k];
            object.position = center.add(m.times(object.position.sub(center)));
            object.rotation = times(q, object.rotation);
        }
    }

    /// @notice Returns the centre of all objects, each represented by the bounding sphere of the bounding box of its vertices.
    function middle(Scene memory scene) internal pure returns (Vector memory center) {
        unchecked {
            Vector memory low;
            Vector memory high;
            for (uint256 k; k < scene.objects.length; ++k) {
                (Vector memory place, Fixed radius) = ball(scene.objects[k]);
                if (k == 0) {
                    (low, high) = (place.sub(Vector(radius, radius, radius)), place.add(Vector(radius, radius, radius)));
                    continue;
                }
                (low.x, high.x) = span(low.x, high.x, place.x, radius);
                (low.y, high.y) = span(low.y, high.y, place.y, radius);
                (low.z, high.z) = span(low.z, high.z, place.z, radius);
            }
            return low.add(high).scale(Fixed.wrap(1 << 31));
        }
    }

    function span(Fixed low, Fixed high, Fixed place, Fixed radius) private pure returns (Fixed, Fixed) {
        return (place - radius < low ? place - radius : low, place + radius > high ? place + radius : high);
    }

    /// @dev Returns the bounding sphere of the bounding box of an object's vertices.
    function ball(Object memory object) private pure returns (Vector memory place, Fixed radius) {
        unchecked {
            (int256[3] memory low, int256[3] memory high) = PackedMesh.box(object.mesh);
            Vector memory twice = Vector(
                Fixed.wrap((low[0] + high[0]) << 32), Fixed.wrap((low[1] + high[1]) << 32), Fixed.wrap((low[2] + high[2]) << 32)
            );
            Fixed half = Fixed.wrap(object.scale.raw() >> 1);
            place = object.position.add(object.rotation.toMatrix().times(twice.scale(half)));
            (int256 x, int256 y, int256 z) = (high[0] - low[0], high[1] - low[1], high[2] - low[2]);
            radius = Fixed.wrap(int256(sqrt(uint256(x * x + y * y + z * z) << 64))) * half;
        }
    }

    /// @dev Returns p * q: q applied first, then p. If both are so short that the product would lose digits, it is scaled by 2^32, which is
    /// the same rotation.
    function times(Quaternion memory p, Quaternion memory q) private pure returns (Quaternion memory) {
        unchecked {
            (int256 a, int256 b, int256 c, int256 d) = (p.x.raw(), p.y.raw(), p.z.raw(), p.w.raw());
            (int256 e, int256 f, int256 g, int256 h) = (q.x.raw(), q.y.raw(), q.z.raw(), q.w.raw());
            int256 x = d * e + a * h + b * g - c * f;
            int256 y = d * f - a * g + b * h + c * e;
            int256 z = d * g + a * f - b * e + c * h;
            int256 w = d * h - a * e - b * f - c * g;
            uint256 shift = 32;
            if (inRange(x) && inRange(y) && inRange(z) && inRange(w)) shift = 0;
            return Quaternion(Fixed.wrap(x >> shift), Fixed.wrap(y >> shift), Fixed.wrap(z >> shift), Fixed.wrap(w >> shift));
        }
    }

    function checkTurn(Quaternion memory q) private pure {
        bool fits = fit(q.x) && fit(q.y) && fit(q.z) && fit(q.w);
        if (!fits || q.x.raw() | q.y.raw() | q.z.raw() | q.w.raw() == 0) revert StudioErrors.TurnOutOfRange();
    }

    function fit(Fixed part) private pure returns (bool) {
        return part.raw() >= -MAX_PART && part.raw() <= MAX_PART;
    }
}
