// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Fixed} from "../math/Fixed.sol";
import {Vector} from "../math/Vector.sol";
import {
    Rectangle,
    Camera,
    Light,
    Material,
    Object,
    Scene,
    PERSPECTIVE,
    ORTHOGRAPHIC,
    DIRECTIONAL,
    POINT,
    SMOOTH
} from "./Scene.sol";
import {NORMALS, WIDE} from "./Mesh.sol";

// Every bound that the pipeline relies on. Within them no sum and no product in it overflows, and no packed number leaves its lane.

uint256 constant MAX_CANVAS = 2048;
uint256 constant MAX_LIGHTS = 4;
uint256 constant MAX_SHININESS = 128;
/// @dev 2^26 world units.
int256 constant MAX_COORDINATE = 1 << 58;
/// @dev Half the extent of a scaled mesh, in world units times 2^32: 2^27 units.
int256 constant MAX_EXTENT = 1 << 59;
/// @dev 4.
int256 constant MAX_COEFFICIENT = 4 << 32;

/// @notice The number at this place of the call, an offset or a length, leads beyond the end of the call.
error MalformedScene(uint256 position);
error CanvasSize(uint256 width, uint256 height);
error RectangleOutsideCanvas(uint256 x, uint256 y, uint256 width, uint256 height);
error UnknownProjection(uint256 projection);
error HalfHeightOutOfRange(int256 halfHeight);
error NearOutOfRange(int256 near);
error CoordinateOutOfRange(int256 x, int256 y, int256 z);
/// @notice The eye is at the target, or `up` is zero or points along the line of sight.
error NoViewDirection();
error NotAColor(uint256 value);
error NotAFlag(uint256 value);
error TooManyLights(uint256 count);
error UnknownLight(uint256 light, uint256 kind);
error LightWithoutDirection(uint256 light);
/// @notice The header is not that of a mesh: `format` has bits that mean nothing, or the bytes end before it is complete.
error MeshHeader(uint256 object, uint256 format, uint256 length);
/// @notice The counts of the header ask for `expected` bytes in all, `actual` were given.
error MeshLength(uint256 object, uint256 expected, uint256 actual);
error UnknownShading(uint256 object, uint256 shading);
error CoefficientOutOfRange(uint256 object, int256 value);
error ShininessOutOfRange(uint256 object, uint256 shininess);
error RotationIsZero(uint256 object);
error ScaleOutOfRange(uint256 object, int256 scale);
/// @notice Smooth shading needs normals in the mesh.
error NoNormals(uint256 object);
error UnknownFlags(uint256 object, uint256 flags);
error IndexOutOfRange(uint256 object, uint256 face, uint256 vertexCount);

/// @notice Everything but the vertex numbers of the faces, which the primitive assembly checks.
function checkScene(Scene calldata scene, Rectangle memory tile) pure {
    unchecked {
        checkLayout(scene);
        (uint256 width, uint256 height) = (scene.canvas.width, scene.canvas.height);
        if (width == 0 || width > MAX_CANVAS || height == 0 || height > MAX_CANVAS) revert CanvasSize(width, height);
        if (
            tile.width == 0 || tile.height == 0 || tile.width > width || tile.height > height || tile.x > width - tile.width
                || tile.y > height - tile.height
        ) revert RectangleOutsideCanvas(tile.x, tile.y, tile.width, tile.height);
        checkCamera(scene.camera);
        checkColor(scene.background.top);
        checkColor(scene.background.bottom);
        checkColor(scene.ambientLight);
        if (scene.invert > 1) revert NotAFlag(scene.invert);
        uint256 lights = scene.lights.length;
        if (lights > MAX_LIGHTS) revert TooManyLights(lights);
        for (uint256 i; i != lights; ++i) checkLight(scene.lights[i], i);
        for (uint256 i; i != scene.objects.length; ++i) checkObject(scene.objects[i], i);
    }
}

/// @dev Follows the offsets and lengths of the call before anything is read through them.
function checkLayout(Scene calldata scene) pure {
    unchecked {
        uint256 base;
        assembly ("memory-safe") {
            base := scene
        }
        // words of a scene before its arrays, and of a light and an object
        checkTail(base, base + 32 * 18, 32 * 5);
        uint256 objects = checkTail(base, base + 32 * 19, 32);
        uint256 count = word(objects);
        objects += 32;
        for (uint256 i; i != count; ++i) {
            uint256 object = objects + word(objects + 32 * i);
            if (word(objects + 32 * i) > msg.data.length || object + 32 * 15 > msg.data.length) revert MalformedScene(objects + 32 * i);
            checkTail(object, object, 1);
        }
    }
}

/// @notice Checks that an offset leads to an array that lies within the call.
/// @param base What the offset counts from.
/// @param position Where the offset is in calldata.
/// @param size Bytes of an element.
/// @return tail Where the length of the array is.
function checkTail(uint256 base, uint256 position, uint256 size) pure returns (uint256 tail) {
    unchecked {
        tail = base + word(position);
        uint256 end = msg.data.length;
        if (word(position) > end || tail + 32 > end) revert MalformedScene(position);
        uint256 length = word(tail);
        if (length > end || tail + 32 + length * size > end) revert MalformedScene(tail);
    }
}

function word(uint256 position) pure returns (uint256 value) {
    assembly ("memory-safe") {
        value := calldataload(position)
    }
}

function checkCamera(Camera calldata camera) pure {
    if (camera.projection > ORTHOGRAPHIC) revert UnknownProjection(camera.projection);
    bool perspective = camera.projection == PERSPECTIVE;
    // the tangent of half the field of view from 2^-10 to 2^10, a height from 2^-12 to 2^26 units
    if (
        camera.halfHeight.raw() < (perspective ? int256(1 << 22) : int256(1 << 20))
            || camera.halfHeight.raw() > (perspective ? int256(1 << 42) : int256(1 << 58))
    ) revert HalfHeightOutOfRange(camera.halfHeight.raw());
    if (camera.near.raw() < (perspective ? int256(1) : -MAX_COORDINATE) || camera.near.raw() > MAX_COORDINATE) {
        revert NearOutOfRange(camera.near.raw());
    }
    checkVector(camera.eye);
    checkVector(camera.target);
    checkVector(camera.up);
}

function checkLight(Light calldata light, uint256 index) pure {
    if (light.kind > POINT) revert UnknownLight(index, light.kind);
    checkVector(light.vector);
    checkColor(light.color);
    if (light.kind == DIRECTIONAL && (light.vector.x.raw() | light.vector.y.raw() | light.vector.z.raw()) == 0) {
        revert LightWithoutDirection(index);
    }
}

function checkObject(Object calldata object, uint256 index) pure {
    unchecked {
        (uint256 bits, bool hasNormals) = checkMesh(object.mesh, index);
        checkVector(object.position);
        Material calldata material = object.material;
        if (material.shading > SMOOTH) revert UnknownShading(index, material.shading);
        if (material.shading == SMOOTH && !hasNormals) revert NoNormals(index);
        checkCoefficient(material.ambient, index);
        checkCoefficient(material.diffuse, index);
        checkCoefficient(material.specular, index);
        if (material.shininess == 0 || material.shininess > MAX_SHININESS) revert ShininessOutOfRange(index, material.shininess);
        if (object.flags > 3) revert UnknownFlags(index, object.flags);
        int256 scale = object.scale.raw();
        if (scale < 0 || scale > MAX_EXTENT >> (bits - 1)) revert ScaleOutOfRange(index, scale);
        (int256 x, int256 y) = (object.rotation.x.raw(), object.rotation.y.raw());
        (int256 z, int256 w) = (object.rotation.z.raw(), object.rotation.w.raw());
        if (!inRange(x) || !inRange(y) || !inRange(z) || !inRange(w)) revert CoordinateOutOfRange(x, y, z);
        if (x | y | z | w == 0) revert RotationIsZero(index);
    }
}

/// @return bits Of a coordinate.
function checkMesh(bytes calldata data, uint256 index) pure returns (uint256 bits, bool hasNormals) {
    unchecked {
        uint256 header;
        assembly ("memory-safe") {
            header := shr(216, calldataload(data.offset))
        }
        uint256 format = data.length == 0 ? 0 : header >> 32;
        if (data.length < 5 || format > NORMALS + WIDE) revert MeshHeader(index, format, data.length);
        bits = format & WIDE == 0 ? 16 : 24;
        hasNormals = format & NORMALS != 0;
        uint256 vertexSize = 3 * bits / 8 + (hasNormals ? 7 : 3);
        uint256 expected = 5 + ((header >> 16) & 0xffff) * vertexSize + (header & 0xffff) * 6;
        if (data.length != expected) revert MeshLength(index, expected, data.length);
    }
}

function checkCoefficient(Fixed value, uint256 index) pure {
    if (value.raw() < 0 || value.raw() > MAX_COEFFICIENT) revert CoefficientOutOfRange(index, value.raw());
}

function checkColor(uint256 value) pure {
    if (value > 0xffffff) revert NotAColor(value);
}

function checkVector(Vector calldata v) pure {
    (int256 x, int256 y, int256 z) = (v.x.raw(), v.y.raw(), v.z.raw());
    if (!inRange(x) || !inRange(y) || !inRange(z)) revert CoordinateOutOfRange(x, y, z);
}

function inRange(int256 value) pure returns (bool) {
    return value >= -MAX_COORDINATE && value <= MAX_COORDINATE;
}
