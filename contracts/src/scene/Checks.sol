// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import "./Scene.sol";
import {Extensions} from "./Extensions.sol";
import {loadCalldata} from "../words/Memory.sol";
import {NORMALS, WIDE} from "./Mesh.sol";
import {SceneErrors} from "./SceneErrors.sol";

// Every bound on which the pipeline relies. Within these bounds no sum and no product in it overflows, and no packed number exceeds its
// lane.

uint256 constant MAX_CANVAS = 2048;
uint256 constant MAX_LIGHTS = 4;
uint256 constant MAX_SHININESS = 128;
/// @dev 2^26 world units, Q32.
int256 constant MAX_COORDINATE = 1 << 58;
/// @dev Half the extent of a scaled mesh: 2^27 world units, Q32.
int256 constant MAX_EXTENT = 1 << 59;
/// @dev 4, Q32.
int256 constant MAX_COEFFICIENT = 4 << 32;

/// @notice Checks a scene, except for the vertex indices of the faces, which primitive assembly checks.
function checkScene(Scene calldata scene, Rectangle memory tile) pure {
    unchecked {
        checkLayout(scene);
        (uint256 width, uint256 height) = (scene.canvas.width, scene.canvas.height);
        if (width == 0 || width > MAX_CANVAS || height == 0 || height > MAX_CANVAS) revert SceneErrors.CanvasSize(width, height);
        if (
            tile.width == 0 || tile.height == 0 || tile.width > width || tile.height > height || tile.x > width - tile.width
                || tile.y > height - tile.height
        ) revert SceneErrors.RectangleOutsideCanvas(tile.x, tile.y, tile.width, tile.height);
        checkCamera(scene.camera);
        checkColor(scene.background.top);
        checkColor(scene.background.bottom);
        checkColor(scene.ambientLight);
        if (scene.invert > 1) revert SceneErrors.NotAFlag(scene.invert);
        uint256 lights = scene.lights.length;
        if (lights > MAX_LIGHTS) revert SceneErrors.TooManyLights(lights);
        for (uint256 i; i != lights; ++i) checkLight(scene.lights[i], i);
        for (uint256 i; i != scene.objects.length; ++i) checkObject(scene.objects[i], i);
        Extensions.check(scene);
    }
}

/// @dev Validates the offsets and lengths of the ABI encoding before anything is read through them.
function checkLayout(Scene calldata scene) pure {
    unchecked {
        uint256 base;
        assembly ("memory-safe") {
            base := scene
        }
        checkTail(base, base + 32 * SCENE_LIGHTS, 32 * LIGHT_WORDS);
        uint256 objects = checkTail(base, base + 32 * SCENE_OBJECTS, 32);
        checkTail(base, base + 32 * SCENE_EXTENSIONS, 1);
        uint256 count = loadCalldata(objects);
        objects += 32;
        for (uint256 i; i != count; ++i) {
            uint256 object = objects + loadCalldata(objects + 32 * i);
            if (loadCalldata(objects + 32 * i) > msg.data.length || object + 32 * OBJECT_WORDS > msg.data.length) {
                revert SceneErrors.MalformedScene(objects + 32 * i);
            }
            checkTail(object, object, 1);
        }
    }
}

/// @notice Checks that an offset points to an array within the calldata, and returns the position of the array.
/// @param base The position from which the offset counts.
/// @param position The calldata position of the offset.
/// @param size The size of an element in bytes.
/// @return tail The calldata position of the array's length.
function checkTail(uint256 base, uint256 position, uint256 size) pure returns (uint256 tail) {
    unchecked {
        tail = base + loadCalldata(position);
        uint256 end = msg.data.length;
        if (loadCalldata(position) > end || tail + 32 > end) revert SceneErrors.MalformedScene(position);
        uint256 length = loadCalldata(tail);
        if (length > end || tail + 32 + length * size > end) revert SceneErrors.MalformedScene(tail);
    }
}

function checkCamera(Camera calldata camera) pure {
    if (camera.projection > ORTHOGRAPHIC) revert SceneErrors.UnknownProjection(camera.projection);
    bool perspective = camera.projection == PERSPECTIVE;
    // tangent of half the field of view: 2^-10 to 2^10; orthographic half height: 2^-12 to 2^26 units
    if (
        camera.halfHeight.raw() < (perspective ? int256(1 << 22) : int256(1 << 20))
            || camera.halfHeight.raw() > (perspective ? int256(1 << 42) : int256(1 << 58))
    ) revert SceneErrors.HalfHeightOutOfRange(camera.halfHeight.raw());
    if (camera.near.raw() < (perspective ? int256(1) : -MAX_COORDINATE) || camera.near.raw() > MAX_COORDINATE) {
        revert SceneErrors.NearOutOfRange(camera.near.raw());
    }
    checkCameraVector(camera.eye);
    checkCameraVector(camera.target);
    checkCameraVector(camera.up);
}

function checkLight(Light calldata light, uint256 index) pure {
    if (light.kind > POINT) revert SceneErrors.UnknownLight(index, light.kind);
    (int256 x, int256 y, int256 z) = (light.vector.x.raw(), light.vector.y.raw(), light.vector.z.raw());
    if (!inRange(x) || !inRange(y) || !inRange(z)) revert SceneErrors.LightOutOfRange(index, x, y, z);
    if (light.color > 0xffffff) revert SceneErrors.LightNotAColor(index, light.color);
    if (light.kind == DIRECTIONAL && x | y | z == 0) {
        revert SceneErrors.LightWithoutDirection(index);
    }
}

function checkObject(Object calldata object, uint256 index) pure {
    unchecked {
        (uint256 bits, bool hasNormals) = checkMesh(object.mesh, index);
        checkPosition(object.position.x.raw(), object.position.y.raw(), object.position.z.raw(), index);
        Material calldata material = object.material;
        if (material.shading > SMOOTH) revert SceneErrors.UnknownShading(index, material.shading);
        if (material.shading == SMOOTH && !hasNormals) revert SceneErrors.NoNormals(index);
        checkCoefficient(material.ambient, index);
        checkCoefficient(material.diffuse, index);
        checkCoefficient(material.specular, index);
        if (material.shininess == 0 || material.shininess > MAX_SHININESS) {
            revert SceneErrors.ShininessOutOfRange(index, material.shininess);
        }
        if (object.flags > 7) revert SceneErrors.UnknownFlags(index, object.flags);
        checkScale(object.scale.raw(), bits, index);
        Quaternion calldata q = object.rotation;
        checkRotation(q.x.raw(), q.y.raw(), q.z.raw(), q.w.raw(), index);
    }
}

function checkPosition(int256 x, int256 y, int256 z, uint256 object) pure {
    if (!inRange(x) || !inRange(y) || !inRange(z)) revert SceneErrors.PositionOutOfRange(object, x, y, z);
}

/// @param bits The bits of a mesh coordinate.
function checkScale(int256 scale, uint256 bits, uint256 object) pure {
    if (scale < 0 || scale > MAX_EXTENT >> (bits - 1)) revert SceneErrors.ScaleOutOfRange(object, scale);
}

function checkRotation(int256 x, int256 y, int256 z, int256 w, uint256 object) pure {
    if (!inRange(x) || !inRange(y) || !inRange(z) || !inRange(w)) revert SceneErrors.RotationOutOfRange(object, x, y, z, w);
    if (x | y | z | w == 0) revert SceneErrors.RotationIsZero(object);
}

/// @return bits The bits of a coordinate.
function checkMesh(bytes calldata data, uint256 index) pure returns (uint256 bits, bool hasNormals) {
    unchecked {
        uint256 header;
        assembly ("memory-safe") {
            header := shr(216, calldataload(data.offset))
        }
        uint256 format = data.length == 0 ? 0 : header >> 32;
        if (data.length < 5 || format > NORMALS + WIDE) revert SceneErrors.MeshHeader(index, format, data.length);
        bits = format & WIDE == 0 ? 16 : 24;
        hasNormals = format & NORMALS != 0;
        uint256 vertexSize = 3 * bits / 8 + (hasNormals ? 7 : 3);
        uint256 expected = 5 + ((header >> 16) & 0xffff) * vertexSize + (header & 0xffff) * 6;
        if (data.length != expected) revert SceneErrors.MeshLength(index, expected, data.length);
    }
}

function checkCoefficient(Fixed value, uint256 index) pure {
    if (value.raw() < 0 || value.raw() > MAX_COEFFICIENT) revert SceneErrors.CoefficientOutOfRange(index, value.raw());
}

function checkColor(uint256 value) pure {
    if (value > 0xffffff) revert SceneErrors.NotAColor(value);
}

function checkCameraVector(Vector calldata v) pure {
    (int256 x, int256 y, int256 z) = (v.x.raw(), v.y.raw(), v.z.raw());
    if (!inRange(x) || !inRange(y) || !inRange(z)) revert SceneErrors.CameraOutOfRange(x, y, z);
}

function inRange(int256 value) pure returns (bool) {
    return value >= -MAX_COORDINATE && value <= MAX_COORDINATE;
}
