// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {Fixed, ZERO, ONE} from "../math/Fixed.sol";
import {Vector} from "../math/Vector.sol";
import {Quaternion} from "../math/Quaternion.sol";
import {fromEuler} from "../math/Euler.sol";
import {HEADER_SIZE, VERTEX_SIZE, FACE_SIZE} from "../mesh/PackedMesh.sol";
import {
    ANTIALIAS, FOG, GROUND, HEMISPHERE, OPACITIES_OF, OPACITY_OF, RIM, SHADOW, SHADOWS_ALL, SPOT, TEXTURE_OF, TONE, TONE_FILMIC,
    TONE_GAMMA, addRecord, copyBytes
} from "../scene/Records.sol";
import {
    Scene, Canvas, Camera, Background, Light, Material, Object, PERSPECTIVE, DIRECTIONAL, POINT, UNLIT, FLAT, CULL_BACKFACES
} from "../scene/Scene.sol";

/// @notice A mesh in the making: room for so many vertices and faces is set aside at once, and nothing is moved until it is packed.
/// @param vertices Where the next vertex belongs.
/// @param faces Where the next face belongs.
/// @param vertexCount How many there are.
/// @param faceCount How many there are.
/// @param maxVertices How many there is room for.
/// @param maxFaces How many there is room for.
struct Model {
    uint256 vertices;
    uint256 faces;
    uint256 vertexCount;
    uint256 faceCount;
    uint256 maxVertices;
    uint256 maxFaces;
}

using {ModelMaker.vertex, ModelMaker.face, ModelMaker.quad, ModelMaker.box, ModelMaker.pack} for Model global;

/// @notice Meshes of coloured triangles, made step by step on chain: without normals, coordinates of 16 bits.
library ModelMaker {
    /// @notice A contract counts vertices and faces in 16 bits.
    error ModelTooLarge(uint256 vertices, uint256 faces);
    error TooManyVertices(uint256 most);
    error TooManyFaces(uint256 most);
    /// @notice Coordinates are whole numbers from -32,768 to 32,767.
    error PositionOutOfRange(int256 x, int256 y, int256 z);
    error NotAColor(uint256 color);
    /// @notice A face names a vertex that is not there yet.
    error NoSuchVertex(uint256 vertex, uint256 vertexCount);

    /// @notice An empty mesh with room for as many vertices and faces.
    function model(uint256 maxVertices, uint256 maxFaces) internal pure returns (Model memory made) {
        unchecked {
            if (maxVertices > 65535 || maxFaces > 65535) revert ModelTooLarge(maxVertices, maxFaces);
            (made.maxVertices, made.maxFaces) = (maxVertices, maxFaces);
            assembly ("memory-safe") {
                // the length and the header, the vertices, and a word that may be written behind them; the faces likewise
                let begin := add(mload(0x40), 37)
                let faces := add(begin, add(mul(maxVertices, VERTEX_SIZE), 32))
                mstore(made, begin)
                mstore(add(made, 0x20), faces)
                mstore(0x40, and(add(add(faces, mul(maxFaces, FACE_SIZE)), 63), not(31)))
            }
        }
    }

    /// @notice Adds a vertex, its colour 0xRRGGBB; its number.
    function vertex(Model memory m, int256 x, int256 y, int256 z, uint256 color) internal pure returns (uint256 index) {
        unchecked {
            index = m.vertexCount;
            if (index == m.maxVertices) revert TooManyVertices(index);
            if (int16(x) != x || int16(y) != y || int16(z) != z) revert PositionOutOfRange(x, y, z);
            if (color > 0xffffff) revert NotAColor(color);
            uint256 packed = (uint256(uint16(int16(x))) << 56) | (uint256(uint16(int16(y))) << 40)
                | (uint256(uint16(int16(z))) << 24) | color;
            uint256 target = m.vertices;
            assembly ("memory-safe") {
                mstore(target, shl(184, packed))
            }
            m.vertices = target + VERTEX_SIZE;
            m.vertexCount = index + 1;
        }
    }

    /// @notice Adds a face of three vertices, counter-clockwise as seen from the front.
    function face(Model memory m, uint256 a, uint256 b, uint256 c) internal pure {
        unchecked {
            uint256 count = m.vertexCount;
            if (a >= count || b >= count || c >= count) revert NoSuchVertex(a >= count ? a : b >= count ? b : c, count);
            if (m.faceCount == m.maxFaces) revert TooManyFaces(m.faceCount);
            uint256 target = m.faces;
            assembly ("memory-safe") {
                mstore(target, shl(208, or(or(shl(32, a), shl(16, b)), c)))
            }
            m.faces = target + FACE_SIZE;
            ++m.faceCount;
        }
    }

    /// @notice Adds two faces: a, b, c, d counter-clockwise as seen from the front.
    function quad(Model memory m, uint256 a, uint256 b, uint256 c, uint256 d) internal pure {
        face(m, a, b, c);
        face(m, a, c, d);
    }

    /// @notice Adds a box: 8 vertices, 12 faces. The first corner must be the lower one.
    function box(Model memory m, int256 x0, int256 y0, int256 z0, int256 x1, int256 y1, int256 z1, uint256 color) internal pure {
        uint256 v = vertex(m, x0, y0, z0, color);
        vertex(m, x1, y0, z0, color);
        vertex(m, x1, y1, z0, color);
        vertex(m, x0, y1, z0, color);
        vertex(m, x0, y0, z1, color);
        vertex(m, x1, y0, z1, color);
        vertex(m, x1, y1, z1, color);
        vertex(m, x0, y1, z1, color);
        quad(m, v + 4, v + 5, v + 6, v + 7);
        quad(m, v, v + 3, v + 2, v + 1);
        quad(m, v + 1, v + 2, v + 6, v + 5);
        quad(m, v, v + 4, v + 7, v + 3);
        quad(m, v + 3, v + 7, v + 6, v + 2);
        quad(m, v, v + 1, v + 5, v + 4);
    }

    /// @notice The bytes of the mesh, in place: nothing may be added afterwards. Each call returns the same bytes.
    function pack(Model memory m) internal pure returns (bytes memory mesh) {
        unchecked {
            uint256 vertexSize = VERTEX_SIZE * m.vertexCount;
            uint256 faceSize = FACE_SIZE * m.faceCount;
            uint256 end = m.vertices;
            uint256 first = m.faces - faceSize;
            uint256 header = (m.vertexCount << 16) | m.faceCount;
            assembly ("memory-safe") {
                // whole words: what the last one has beyond the faces is cleared below
                for { let k := 0 } lt(k, faceSize) { k := add(k, 32) } { mstore(add(end, k), mload(add(first, k))) }
                let begin := sub(end, vertexSize)
                mesh := sub(begin, 37)
                // the header has a byte of zeros before it, and overwrites nothing: it is put into the word that ends where vertices begin
                mstore(mesh, add(HEADER_SIZE, add(vertexSize, faceSize)))
                mstore(sub(begin, 5), or(shl(216, header), shr(40, mload(begin))))
                mstore(add(end, faceSize), 0)
            }
            // where the faces are now; closed for more
            m.faces = end + faceSize;
            (m.maxVertices, m.maxFaces) = (m.vertexCount, m.faceCount);
        }
    }
}

/// @notice A scene in the making; `scene` is what the renderer takes, at any time.
/// @param maxObjects How many objects there is room for.
struct Stage {
    Scene scene;
    uint256 maxObjects;
}

using {
    StageMaker.look, StageMaker.background, StageMaker.sun, StageMaker.lamp, StageMaker.spot, StageMaker.add, StageMaker.fade,
    StageMaker.antialias, StageMaker.hemisphere, StageMaker.rim, StageMaker.fog, StageMaker.tone,
    StageMaker.shadow, StageMaker.ground, StageMaker.texture, StageMaker.opacities
} for Stage global;

/// @notice Scenes made step by step on chain. Lengths are whole units where a parameter is an int256, angles whole degrees, coefficients
/// per cent. What is out of range is told by the renderer.
library StageMaker {
    error TooManyObjects(uint256 most);
    error TooManyLights(uint256 most);
    /// @notice A palette has 2, 4, 16 or 256 colours of 3 bytes.
    error TexturePalette(uint256 size);
    /// @notice A texture has 1 to 256 texels along each side.
    error TextureSize(uint256 width, uint256 height);
    /// @notice Its texels have `expected` bytes.
    error TextureTexels(uint256 expected, uint256 actual);
    /// @notice Coordinates are from -128 to below 128, in 65,536ths.
    error TextureCoordinates(uint256 vertex, int256 u, int256 v);

    uint256 private constant MAX_LIGHTS = 4;

    /// @notice An empty scene with room for as many objects: the eye 1,000 units in front of the origin, 50 degrees of view, white ambient
    /// light and no other, a dark background.
    function stage(uint256 width, uint256 height, uint256 maxObjects) internal pure returns (Stage memory made) {
        Scene memory s = made.scene;
        s.canvas = Canvas(width, height);
        look(made, units(0, 0, 1000), units(0, 0, 0));
        // the tangent of half of 50 degrees
        s.camera.halfHeight = Fixed.wrap(2002776142);
        s.background = Background(0x2e3648, 0x8892a2);
        s.ambientLight = 0xffffff;
        s.objects = new Object[](maxObjects);
        s.lights = new Light[](MAX_LIGHTS);
        made.maxObjects = maxObjects;
        setCounts(s, 0, 0);
    }

    /// @notice The camera, upright, at `eye`, looking at `target`. What is nearer than a unit is not seen.
    function look(Stage memory made, Vector memory eye, Vector memory target) internal pure {
        Camera memory camera = made.scene.camera;
        (camera.eye, camera.target, camera.up) = (eye, target, units(0, 1, 0));
        (camera.projection, camera.near) = (PERSPECTIVE, ONE);
    }

    /// @notice The background, from top to bottom.
    function background(Stage memory made, uint256 top, uint256 bottom) internal pure {
        made.scene.background = Background(top, bottom);
    }

    /// @notice Adds light from a direction.
    function sun(Stage memory made, Vector memory toward, uint256 color) internal pure {
        addLight(made.scene, Light(DIRECTIONAL, toward, color));
    }

    /// @notice Adds light from a place.
    function lamp(Stage memory made, Vector memory place, uint256 color) internal pure {
        addLight(made.scene, Light(POINT, place, color));
    }

    /// @notice Adds light from a place that shines into a cone only, whole up to where the cosine of the angle to `toward` is `inner` per
    /// cent, none from `outer` per cent on. The coordinates of `toward` are below 2^31 units.
    function spot(Stage memory made, Vector memory place, Vector memory toward, int256 inner, int256 outer, uint256 color) internal pure {
        uint256 index = made.scene.lights.length;
        lamp(made, place, color);
        bytes memory cone = abi.encodePacked(
            int64(toward.x.raw()), int64(toward.y.raw()), int64(toward.z.raw()), int64(percent(inner).raw()), int64(percent(outer).raw())
        );
        made.scene.extensions = addRecord(made.scene.extensions, SPOT, index, cone);
    }

    /// @notice Has the object that was added last hide only so many per cent, 0..99, of what is behind it.
    function fade(Stage memory made, int256 opacity) internal pure {
        unchecked {
            bytes memory content = abi.encodePacked(uint32(uint256(percent(opacity).raw()) >> 8));
            made.scene.extensions = addRecord(made.scene.extensions, OPACITY_OF, made.scene.objects.length - 1, content);
        }
    }

    /// @notice Smooths the edges of the picture.
    function antialias(Stage memory made) internal pure {
        extend(made, ANTIALIAS, "");
    }

    /// @notice Adds light from above, 0xRRGGBB, and from below, in proportion to the ambient coefficients of materials. The picture is
    /// antialiased, as with each of the following.
    function hemisphere(Stage memory made, uint256 above, uint256 below) internal pure {
        extend(made, HEMISPHERE, abi.encodePacked(uint24(above), uint24(below)));
    }

    /// @notice Adds light along outlines, 0xRRGGBB, from wide to narrow by its power, 1 to 16.
    function rim(Stage memory made, uint256 color, uint256 power) internal pure {
        extend(made, RIM, abi.encodePacked(uint24(color), uint8(power)));
    }

    /// @notice Adds fog, 0xRRGGBB, that begins `near` units from the eye and hides everything from `far` units on.
    function fog(Stage memory made, uint256 color, uint256 near, uint256 far) internal pure {
        extend(made, FOG, abi.encodePacked(uint24(color), uint64(near << 32), uint64(far << 32)));
    }

    /// @notice How light becomes colours: multiplied by so many per cent, up to 6,400; bright light compressed as on film or cut off; added
    /// up in linear space, or as sRGB values.
    function tone(Stage memory made, uint256 exposure, bool filmic, bool gamma) internal pure {
        uint256 flags = (filmic ? TONE_FILMIC : 0) | (gamma ? TONE_GAMMA : 0);
        extend(made, TONE, abi.encodePacked(uint32((exposure << 16) / 100), uint8(flags)));
    }

    /// @notice Multiplies the colours of the object that was added last by an image: see Texture.sol.
    /// @param flags The sum of TEXTURE_BILINEAR and TEXTURE_CLAMP.
    /// @param palette 2, 4, 16 or 256 colours of three bytes, of which texels are numbers of 1, 2, 4 or 8 bits; or nothing: texels are
    /// colours.
    /// @param texels Rows from the top, one after the other.
    /// @param uvs Of each vertex of the mesh, in 65,536ths of the image from its upper left corner.
    function texture(
        Stage memory made,
        uint256 width,
        uint256 height,
        uint256 flags,
        bytes memory palette,
        bytes memory texels,
        int256[2][] memory uvs
    ) internal pure {
        unchecked {
            uint256 bits = 24;
            if (palette.length != 0) {
                bits = 1;
                while (bits < 8 && palette.length > 3 << bits) bits <<= 1;
                if (palette.length != 3 << bits) revert TexturePalette(palette.length);
            }
            if (width - 1 > 255 || height - 1 > 255) revert TextureSize(width, height);
            uint256 expected = (width * height * bits + 7) / 8;
            if (texels.length != expected) revert TextureTexels(expected, texels.length);
            bytes memory head = abi.encodePacked(uint8(flags), uint8(width - 1), uint8(height - 1), uint8(bits), palette, texels);
            uint256 size = head.length + 6 * uvs.length;
            // whole words, and room for one that is written behind
            bytes memory content = new bytes(((size + 31) & ~uint256(31)) + 32);
            copyBytes(content, 0, head, 0, head.length);
            assembly ("memory-safe") {
                mstore(content, sub(mload(content), 32))
                head := add(add(content, 32), mload(head))
            }
            for (uint256 k; k != uvs.length; ++k) {
                (int256 u, int256 v) = (uvs[k][0], uvs[k][1]);
                if (int24(u) != u || int24(v) != v) revert TextureCoordinates(k, u, v);
                assembly ("memory-safe") {
                    mstore(add(head, mul(6, k)), or(shl(232, u), shl(208, and(v, 0xffffff))))
                }
            }
            made.scene.extensions = addRecord(made.scene.extensions, TEXTURE_OF, made.scene.objects.length - 1, content);
        }
    }

    /// @notice Has each vertex of the object that was added last hide only so much of what is behind it.
    /// @param levels A byte for each vertex of the mesh, from 0, not seen, to 255, opaque.
    function opacities(Stage memory made, bytes memory levels) internal pure {
        unchecked {
            // whole words, at least one
            bytes memory content = new bytes(levels.length == 0 ? 32 : (levels.length + 31) & ~uint256(31));
            copyBytes(content, 0, levels, 0, levels.length);
            made.scene.extensions = addRecord(made.scene.extensions, OPACITIES_OF, made.scene.objects.length - 1, content);
        }
    }

    /// @notice Has objects cast shadows in the light that was added last; one light of a scene at most.
    function shadow(Stage memory made) internal pure {
        bytes memory rule = abi.encode(SHADOWS_ALL);
        made.scene.extensions = addRecord(made.scene.extensions, SHADOW, made.scene.lights.length - 1, rule);
    }

    /// @notice Adds a level, matte disc, 0xRRGGBB, which catches shadows and casts none: opaque around its middle, and gone `radius` units
    /// from it. It stands best just below what is on it, and is added after it.
    function ground(Stage memory made, uint256 color, Vector memory middle, uint256 radius) internal pure returns (Object memory object) {
        Model memory square = ModelMaker.model(4, 2);
        square.vertex(-1, 0, -1, color);
        square.vertex(-1, 0, 1, color);
        square.vertex(1, 0, 1, color);
        square.vertex(1, 0, -1, color);
        square.quad(0, 1, 2, 3);
        object = add(made, square.pack(), flat(40, 70, 0, 1));
        (object.position, object.scale) = (middle, Fixed.wrap(int256(radius << 32)));
        bytes memory radii = abi.encode((radius << 32) * 2 / 5 << 192 | radius << 160);
        made.scene.extensions = addRecord(made.scene.extensions, GROUND, made.scene.objects.length - 1, radii);
    }

    /// @dev Sets a record of the scene.
    function extend(Stage memory made, uint256 kind, bytes memory content) private pure {
        made.scene.extensions = addRecord(made.scene.extensions, kind, 0, content);
    }

    /// @notice Adds an object at the origin, a unit long for each step of its coordinates, without the faces that turn away. What is
    /// returned can be changed.
    function add(Stage memory made, bytes memory mesh, Material memory material) internal pure returns (Object memory object) {
        Scene memory s = made.scene;
        uint256 count = s.objects.length;
        if (count == made.maxObjects) revert TooManyObjects(count);
        setCounts(s, count + 1, s.lights.length);
        object = s.objects[count];
        (object.mesh, object.material) = (mesh, material);
        (object.rotation, object.scale) = (Quaternion(ZERO, ZERO, ZERO, ONE), ONE);
        object.flags = CULL_BACKFACES;
    }

    /// @notice The rotation about the x axis, then y, then z.
    function turned(int256 x, int256 y, int256 z) internal pure returns (Quaternion memory) {
        return fromEuler(unit(x), unit(y), unit(z));
    }

    /// @notice A point or a direction, in whole units.
    function units(int256 x, int256 y, int256 z) internal pure returns (Vector memory) {
        return Vector(unit(x), unit(y), unit(z));
    }

    /// @notice A whole number.
    function unit(int256 value) internal pure returns (Fixed) {
        return Fixed.wrap(value * 4294967296);
    }

    /// @notice So many hundredths.
    function percent(int256 value) internal pure returns (Fixed) {
        return Fixed.wrap(value * 4294967296 / 100);
    }

    /// @notice A surface with faces of one shade each.
    function flat(int256 ambient, int256 diffuse, int256 specular, uint256 shininess) internal pure returns (Material memory) {
        return Material(FLAT, percent(ambient), percent(diffuse), percent(specular), shininess);
    }

    /// @notice A surface that shows its colours as they are.
    function unlit() internal pure returns (Material memory) {
        return Material(UNLIT, ONE, ZERO, ZERO, 1);
    }

    function addLight(Scene memory s, Light memory light) private pure {
        uint256 count = s.lights.length;
        if (count == MAX_LIGHTS) revert TooManyLights(count);
        setCounts(s, s.objects.length, count + 1);
        s.lights[count] = light;
    }

    /// @dev There is room in memory behind both arrays, up to the sizes with which they were made.
    function setCounts(Scene memory s, uint256 objects, uint256 lights) private pure {
        (Object[] memory o, Light[] memory l) = (s.objects, s.lights);
        assembly ("memory-safe") {
            mstore(o, objects)
            mstore(l, lights)
        }
    }
}
