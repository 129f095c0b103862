// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {Fixed, ZERO, ONE} from "../math/Fixed.sol";
import {Vector, normalize} from "../math/Vector.sol";
import {Matrix, Quaternion} from "../math/Quaternion.sol";

// The input of the renderer. The world is right-handed with +y up; the default camera has the eye at the origin and looks along -z. All
// lengths are Q32 fixed-point numbers in world units, colours are 0xRRGGBB, and every number takes a whole ABI word. Arrays and meshes can
// be anywhere in the encoding, in any order, and offsets can coincide: objects that share a mesh or all of their fields need its bytes only
// once. `Checks.sol` contains the bounds of each field.

/// @notice The size of the whole picture, 1..2048 pixels for each side.
struct Canvas {
    uint256 width;
    uint256 height;
}

/// @notice The part of the canvas to draw, in pixels from the top left corner.
struct Rectangle {
    uint256 x;
    uint256 y;
    uint256 width;
    uint256 height;
}

uint256 constant PERSPECTIVE = 0;
uint256 constant ORTHOGRAPHIC = 1;

/// @param projection PERSPECTIVE or ORTHOGRAPHIC.
/// @param halfHeight Half the height of the visible area: at distance 1 for a perspective camera (the tangent of half the vertical field of
/// view), in world units for an orthographic one.
/// @param near The distance of the near plane; anything nearer is clipped. Positive for a perspective camera.
struct Camera {
    Vector eye;
    Vector target;
    Vector up;
    uint256 projection;
    Fixed halfHeight;
    Fixed near;
}

/// @notice A vertical gradient; a single colour if both are equal.
struct Background {
    uint256 top;
    uint256 bottom;
}

uint256 constant DIRECTIONAL = 0;
uint256 constant POINT = 1;

/// @param vector The direction toward a directional light (any length but zero), or the position of a point light.
struct Light {
    uint256 kind;
    Vector vector;
    uint256 color;
}

uint256 constant UNLIT = 0;
uint256 constant FLAT = 1;
uint256 constant SMOOTH = 2;

/// @notice How a surface reflects light: Blinn-Phong coefficients.
/// @param shading UNLIT shows the vertex colours unchanged; FLAT uses the normal of the face, SMOOTH the normals of the vertices.
/// @param ambient The coefficient of the ambient light, 0..4, Q32; `diffuse` and `specular` likewise.
/// @param shininess The exponent of the highlight, 1..128.
struct Material {
    uint256 shading;
    Fixed ambient;
    Fixed diffuse;
    Fixed specular;
    uint256 shininess;
}

uint256 constant CULL_BACKFACES = 1;
uint256 constant WIREFRAME = 2;
uint256 constant TWO_SIDED = 4;

/// @notice A mesh placed in the world: p = position + rotation(scale * v).
/// @param mesh Vertices and faces in the format of `Mesh.sol`.
/// @param flags The sum of CULL_BACKFACES, WIREFRAME and TWO_SIDED, which lights what is seen from behind as from the front (but wires);
/// 0 for none of them.
struct Object {
    bytes mesh;
    Vector position;
    Quaternion rotation;
    Fixed scale;
    Material material;
    uint256 flags;
}

/// @param invert 1 replaces every byte v of the picture with 255 - v; otherwise 0.
/// @param ambientLight The colour of the ambient light.
/// @param lights At most 4.
/// @param objects Drawn in this order, translucent objects after the others; of fragments at equal depth the first one remains.
/// @param extensions Further properties, such as spot lights: see `Extensions.sol`. Empty for none.
struct Scene {
    Canvas canvas;
    Camera camera;
    Background background;
    uint256 invert;
    uint256 ambientLight;
    Light[] lights;
    Object[] objects;
    bytes extensions;
}

/// @dev Sizes in words of the ABI encoding: of a scene before its arrays, and the positions of their offsets; of a light; of an object
/// before its mesh.
uint256 constant SCENE_LIGHTS = 18;
uint256 constant SCENE_OBJECTS = 19;
uint256 constant SCENE_EXTENSIONS = 20;
uint256 constant LIGHT_WORDS = 5;
uint256 constant OBJECT_WORDS = 15;
