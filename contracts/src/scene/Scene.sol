// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {Fixed} from "../math/Fixed.sol";
import {Vector} from "../math/Vector.sol";
import {Quaternion} from "../math/Quaternion.sol";

// What a caller hands to the renderer. The world is right-handed, +y up; with the default camera the eye is at the origin and looks
// down -z. All lengths are Q32 fixed-point numbers in world units, colours are 0xRRGGBB, and every number takes a whole ABI word. Arrays
// and meshes may stand anywhere in the encoding, in any order, and offsets may lead to the same place: objects that share a mesh, or all
// of their fields, need its bytes once. The bounds of each field stand with its check in `Checks.sol`.

/// @notice The whole picture. Each side 1..2048 pixels.
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
/// @param halfHeight Half the height of what the picture shows: at distance 1 for a perspective camera (the tangent of half the
/// vertical field of view), in world units for an orthographic one.
/// @param near The distance of the near plane; what is nearer is clipped. Positive for a perspective camera.
struct Camera {
    Vector eye;
    Vector target;
    Vector up;
    uint256 projection;
    Fixed halfHeight;
    Fixed near;
}

/// @notice A vertical gradient; one colour where both are equal.
struct Background {
    uint256 top;
    uint256 bottom;
}

uint256 constant DIRECTIONAL = 0;
uint256 constant POINT = 1;

/// @param vector The direction toward a directional light (any length but zero), the position of a point light.
struct Light {
    uint256 kind;
    Vector vector;
    uint256 color;
}

uint256 constant UNLIT = 0;
uint256 constant FLAT = 1;
uint256 constant SMOOTH = 2;

/// @notice How a surface answers light: Blinn-Phong coefficients.
/// @param shading UNLIT shows the vertex colours as they are; FLAT takes the normal of the face, SMOOTH the normals of the vertices.
/// @param ambient What of the ambient light is added, and so on; 0..4 as Q32.
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

/// @notice A mesh with its place in the world: p = position + rotation(scale * v).
/// @param mesh Vertices and faces, packed as `Mesh.sol` says.
/// @param flags The sum of CULL_BACKFACES and WIREFRAME, as wanted.
struct Object {
    bytes mesh;
    Vector position;
    Quaternion rotation;
    Fixed scale;
    Material material;
    uint256 flags;
}

/// @param invert 1 turns every byte v of the picture into 255 - v; else 0.
/// @param ambientLight The colour of the light that comes from everywhere.
/// @param lights At most 4.
/// @param objects Drawn in this order, those that are not opaque after the others; of fragments at equal depth the first stays.
/// @param extensions What is not in the structs, such as spot lights: see `Extensions.sol`. Empty for none.
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

/// @dev Words of the encoding: of a scene before its arrays, and where in it the offsets of those are; of a light; of an object before
/// its mesh.
uint256 constant SCENE_LIGHTS = 18;
uint256 constant SCENE_OBJECTS = 19;
uint256 constant SCENE_EXTENSIONS = 20;
uint256 constant LIGHT_WORDS = 5;
uint256 constant OBJECT_WORDS = 15;
