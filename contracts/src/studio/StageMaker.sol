// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {Fixed, ZERO, ONE} from "../math/Fixed.sol";
import {Vector} from "../math/Vector.sol";
import {Quaternion} from "../math/Quaternion.sol";
import {fromEuler} from "../math/Euler.sol";
import {PackedMesh} from "../mesh/PackedMesh.sol";
import {NORMALS, WIDE} from "../scene/Mesh.sol";
import {
    ANTIALIAS, FOG, GROUND, HEMISPHERE, OPACITIES_OF, OPACITY_OF, RIM, SHADOW, SHADOWS_ALL, SPOT, TEXTURE_OF, TONE, TONE_FILMIC,
    TONE_GAMMA, addRecord, copyBytes
} from "../scene/Records.sol";
import {
    Scene, Canvas, Background, Light, Material, Object, PERSPECTIVE, DIRECTIONAL, POINT, UNLIT, FLAT, SMOOTH, CULL_BACKFACES
} from "../scene/Scene.sol";
import {Box, Framing} from "./Framing.sol";
import {Model, ModelMaker} from "./ModelMaker.sol";

/// @notice A scene in the making; `scene` is what the renderer takes, at any time. Its room for objects grows when it is used up.
/// @param maxObjects How many objects there is room for in `room`.
/// @param room Where `scene.objects` was when an object was added: an array that came from elsewhere has no room behind it.
/// @param bounds Those of meshes, as far as they were told.
/// @param defaultLights Where `scene.lights` is while the default sun is in it, which the first light that is added replaces.
struct Stage {
    Scene scene;
    uint256 maxObjects;
    uint256 room;
    Box[] bounds;
    uint256 defaultLights;
}

using StageMaker for Stage global;
using Framing for Stage global;

/// @title StageMaker: scenes made step by step on chain.
/// @notice Numbers are of the type `Fixed` (Q32), or whole where a parameter is an integer: lengths in units, angles in degrees,
/// coefficients in per cent. `units`, `unit`, `percent` and `fraction` make numbers. What is out of range is told by the renderer.
library StageMaker {
    /// @notice A scene has at most 65,536 objects.
    error TooManyObjects(uint256 most);
    /// @notice A scene has at most 4 lights.
    error TooManyLights(uint256 most);
    /// @notice The scene has only so many objects.
    error NoSuchObject(uint256 object, uint256 count);
    /// @notice There is no light that could cast shadows.
    error NoLight();
    /// @notice The mesh is stored or compact: only one that is packed can be painted. `IStudio.mesh` returns a stored mesh as it is packed.
    error MeshNotPacked(uint256 object);
    /// @notice A palette has 2, 4, 16 or 256 colours of 3 bytes.
    error TexturePalette(uint256 size);
    /// @notice A texture has 1 to 256 texels along each side.
    error TextureSize(uint256 width, uint256 height);
    /// @notice Its texels have `expected` bytes.
    error TextureTexels(uint256 expected, uint256 actual);
    /// @notice Coordinates are from -128 to below 128, in 65,536ths.
    error TextureCoordinates(uint256 vertex, int256 u, int256 v);

    uint256 private constant MAX_LIGHTS = 4;
    uint256 private constant MAX_OBJECTS = 65536;

    /// @notice Returns an empty scene of width * height pixels.
    function stage(uint256 width, uint256 height) internal pure returns (Stage memory) {
        return stage(width, height, 4);
    }

    /// @notice Returns an empty scene: the eye 1,000 units in front of the origin, 50 degrees of view, white ambient light, a sun from the
    /// upper left until other light is added, a dark background.
    /// @param maxObjects For how many objects room is set aside, which saves the gas of growing.
    function stage(uint256 width, uint256 height, uint256 maxObjects) internal pure returns (Stage memory made) {
        Scene memory s = made.scene;
        s.canvas = Canvas(width, height);
        s.lights = new Light[](1);
        s.lights[0].color = 0xffffff;
        made.defaultLights = address_(s.lights);
        Framing.look(made, units(0, 0, 1000), units(0, 0, 0));
        // the tangent of half of 50 degrees
        (s.camera.projection, s.camera.halfHeight, s.camera.near) = (PERSPECTIVE, Fixed.wrap(2002776142), ONE);
        s.background = Background(0x2e3648, 0x8892a2);
        s.ambientLight = 0xffffff;
        setRoom(made, maxObjects);
    }

    /// @notice Sets the background, 0xRRGGBB, from top to bottom.
    function background(Stage memory made, uint256 top, uint256 bottom) internal pure {
        made.scene.background = Background(top, bottom);
    }

    /// @notice Adds an object at the origin, a unit long for each step of its coordinates, without the faces that turn away.
    /// @param mesh Packed, or what `IStudio.meshAt` returns for one that is stored. Objects may share it.
    /// @return object The object, which can be changed: its position, rotation, scale and flags.
    function add(Stage memory made, bytes memory mesh, Material memory material) internal pure returns (Object memory object) {
        Box memory unknown;
        return add(made, mesh, material, unknown);
    }

    /// @notice Adds an object whose mesh is stored, so that only its bounds are known here. `place` and `fit` need them.
    /// @param bounds The lowest and the highest coordinates of the mesh: see `Framing.box`.
    function add(Stage memory made, bytes memory mesh, Material memory material, Box memory bounds)
        internal
        pure
        returns (Object memory object)
    {
        unchecked {
            uint256 count = made.scene.objects.length;
            if (count == MAX_OBJECTS) revert TooManyObjects(MAX_OBJECTS);
            if (!isOwn(made) || count == made.maxObjects) setRoom(made, 2 * count + 4);
            Vector memory origin;
            object = Object(mesh, origin, Quaternion(ZERO, ZERO, ZERO, ONE), ONE, material, CULL_BACKFACES);
            (Object[] memory objects, Box[] memory boxes) = (made.scene.objects, made.bounds);
            assembly ("memory-safe") {
                mstore(objects, add(count, 1))
                mstore(boxes, add(count, 1))
            }
            (objects[count], boxes[count]) = (object, bounds);
        }
    }

    /// @notice Gives all vertices of the object that was added last one colour, 0xRRGGBB.
    function paint(Stage memory made, uint256 color) internal pure {
        paint(made, last(made), color);
    }

    /// @notice Gives all vertices of one of the objects one colour, 0xRRGGBB; objects that share its mesh keep theirs.
    /// @param object Its number, from 0, in the order in which objects were added.
    function paint(Stage memory made, uint256 object, uint256 color) internal pure {
        uint256 count = made.scene.objects.length;
        if (object >= count) revert NoSuchObject(object, count);
        if (color > 0xffffff) revert ModelMaker.NotAColor(color);
        bytes memory mesh = made.scene.objects[object].mesh;
        if (mesh.length == 0 || uint8(mesh[0]) > NORMALS + WIDE) revert MeshNotPacked(object);
        bytes memory own = bytes.concat(mesh);
        PackedMesh.paint(own, color);
        made.scene.objects[object].mesh = own;
    }

    /// @notice Adds light from a direction.
    /// @param toward The direction in which the light stands, of any length.
    /// @param color 0xRRGGBB.
    function sun(Stage memory made, Vector memory toward, uint256 color) internal pure {
        addLight(made, Light(DIRECTIONAL, toward, color));
    }

    /// @notice Adds light from a place.
    /// @param color 0xRRGGBB.
    function lamp(Stage memory made, Vector memory place, uint256 color) internal pure {
        addLight(made, Light(POINT, place, color));
    }

    /// @notice Adds light from a place that shines into a cone only, whole up to where the cosine of the angle to `toward` is `inner` per
    /// cent, none from `outer` per cent on. The coordinates of `toward` are below 2^31 units.
    /// @param color 0xRRGGBB.
    function spot(Stage memory made, Vector memory place, Vector memory toward, int256 inner, int256 outer, uint256 color) internal pure {
        lamp(made, place, color);
        bytes memory cone = abi.encodePacked(
            int64(toward.x.raw()), int64(toward.y.raw()), int64(toward.z.raw()), int64(percent(inner).raw()), int64(percent(outer).raw())
        );
        made.scene.extensions = addRecord(made.scene.extensions, SPOT, made.scene.lights.length - 1, cone);
    }

    /// @notice Removes all lights, the default sun, too; only the ambient light is left. Comes before `spot` and `shadow`.
    function dark(Stage memory made) internal pure {
        made.scene.lights = new Light[](0);
    }

    /// @notice Has the object that was added last hide only so many per cent, 0..99, of what is behind it.
    function fade(Stage memory made, int256 opacity) internal pure {
        fade(made, percent(opacity));
    }

    /// @notice Has the object that was added last hide only a part, from 0 to below 1, of what is behind it.
    function fade(Stage memory made, Fixed opacity) internal pure {
        bytes memory content = abi.encodePacked(uint32(uint256(opacity.raw()) >> 8));
        made.scene.extensions = addRecord(made.scene.extensions, OPACITY_OF, last(made), content);
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

    /// @notice Sets how light becomes colours: multiplied by so many per cent, up to 6,400; bright light compressed as on film or cut off;
    /// added up in linear space, or as sRGB values.
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
            made.scene.extensions = addRecord(made.scene.extensions, TEXTURE_OF, last(made), content);
        }
    }

    /// @notice Has each vertex of the object that was added last hide only so much of what is behind it.
    /// @param levels A byte for each vertex of the mesh, from 0, not seen, to 255, opaque.
    function opacities(Stage memory made, bytes memory levels) internal pure {
        unchecked {
            // whole words, at least one
            bytes memory content = new bytes(levels.length == 0 ? 32 : (levels.length + 31) & ~uint256(31));
            copyBytes(content, 0, levels, 0, levels.length);
            made.scene.extensions = addRecord(made.scene.extensions, OPACITIES_OF, last(made), content);
        }
    }

    /// @notice Has objects cast shadows in the light that was added last; one light of a scene at most.
    function shadow(Stage memory made) internal pure {
        unchecked {
            uint256 count = made.scene.lights.length;
            if (count == 0) revert NoLight();
            made.scene.extensions = addRecord(made.scene.extensions, SHADOW, count - 1, abi.encode(SHADOWS_ALL));
        }
    }

    /// @notice Adds a level, matte disc, 0xRRGGBB, which catches shadows and casts none: opaque around its middle, and gone `radius` units
    /// from it. It stands best just below what is on it, and is added after it, and after `fit`.
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
        made.scene.extensions = addRecord(made.scene.extensions, GROUND, last(made), radii);
    }

    /// @notice Returns the rotation about the x axis, then y, then z, by whole degrees.
    function turned(int256 x, int256 y, int256 z) internal pure returns (Quaternion memory) {
        return fromEuler(unit(x), unit(y), unit(z));
    }

    /// @notice Returns the rotation about the x axis, then y, then z, by degrees.
    function turned(Fixed x, Fixed y, Fixed z) internal pure returns (Quaternion memory) {
        return fromEuler(x, y, z);
    }

    /// @notice Returns a point or a direction, in whole units.
    function units(int256 x, int256 y, int256 z) internal pure returns (Vector memory) {
        return Vector(unit(x), unit(y), unit(z));
    }

    /// @notice Returns a whole number.
    function unit(int256 value) internal pure returns (Fixed) {
        return Fixed.wrap(value * 4294967296);
    }

    /// @notice Returns so many hundredths.
    function percent(int256 value) internal pure returns (Fixed) {
        return Fixed.wrap(value * 4294967296 / 100);
    }

    /// @notice Returns a fraction: (1, 3) a third, (125, 1000) twelve and a half per cent, (45, 2) as an angle 22.5 degrees.
    function fraction(int256 numerator, int256 denominator) internal pure returns (Fixed) {
        return Fixed.wrap(numerator * 4294967296 / denominator);
    }

    /// @notice Returns a surface with faces of one shade each. All but the shininess, 1..128, are per cent, 0..400.
    function flat(int256 ambient, int256 diffuse, int256 specular, uint256 shininess) internal pure returns (Material memory) {
        return Material(FLAT, percent(ambient), percent(diffuse), percent(specular), shininess);
    }

    /// @notice Returns a surface with faces of one shade each; coefficients 0..4.
    function flat(Fixed ambient, Fixed diffuse, Fixed specular, uint256 shininess) internal pure returns (Material memory) {
        return Material(FLAT, ambient, diffuse, specular, shininess);
    }

    /// @notice Returns a smooth surface, for meshes with normals: see `ModelMaker.packSmooth`. All but the shininess, 1..128, are per cent,
    /// 0..400.
    function smooth(int256 ambient, int256 diffuse, int256 specular, uint256 shininess) internal pure returns (Material memory) {
        return Material(SMOOTH, percent(ambient), percent(diffuse), percent(specular), shininess);
    }

    /// @notice Returns a smooth surface, for meshes with normals; coefficients 0..4.
    function smooth(Fixed ambient, Fixed diffuse, Fixed specular, uint256 shininess) internal pure returns (Material memory) {
        return Material(SMOOTH, ambient, diffuse, specular, shininess);
    }

    /// @notice Returns a surface that shows its colours as they are.
    function unlit() internal pure returns (Material memory) {
        return Material(UNLIT, ONE, ZERO, ZERO, 1);
    }

    /// @notice Returns whether the array of objects is one with room behind it.
    function isOwn(Stage memory made) internal pure returns (bool own) {
        Object[] memory objects = made.scene.objects;
        uint256 room = made.room;
        assembly ("memory-safe") {
            own := eq(objects, room)
        }
    }

    /// @notice Returns whether the only light is the default sun.
    function hasDefaultSun(Stage memory made) internal pure returns (bool) {
        return address_(made.scene.lights) == made.defaultLights;
    }

    /// @dev Where an array is in memory.
    function address_(Light[] memory lights) private pure returns (uint256 place) {
        assembly ("memory-safe") {
            place := lights
        }
    }

    /// @dev The number of the object that was added last.
    function last(Stage memory made) private pure returns (uint256) {
        unchecked {
            uint256 count = made.scene.objects.length;
            if (count == 0) revert NoSuchObject(0, 0);
            return count - 1;
        }
    }

    /// @dev Sets a record of the scene.
    function extend(Stage memory made, uint256 kind, bytes memory content) private pure {
        made.scene.extensions = addRecord(made.scene.extensions, kind, 0, content);
    }

    function addLight(Stage memory made, Light memory light) private pure {
        unchecked {
            Light[] memory old = made.scene.lights;
            uint256 count = hasDefaultSun(made) ? 0 : old.length;
            if (count >= MAX_LIGHTS) revert TooManyLights(MAX_LIGHTS);
            Light[] memory lights = new Light[](count + 1);
            for (uint256 k; k != count; ++k) lights[k] = old[k];
            lights[count] = light;
            made.scene.lights = lights;
        }
    }

    /// @dev Moves the objects to where there is room for more.
    function setRoom(Stage memory made, uint256 most) private pure {
        unchecked {
            if (most > MAX_OBJECTS) most = MAX_OBJECTS;
            (Object[] memory objects, Box[] memory boxes) = (made.scene.objects, made.bounds);
            uint256 count = objects.length;
            // where the array came from elsewhere
            if (!isOwn(made)) boxes = new Box[](count);
            uint256 room;
            assembly ("memory-safe") {
                room := mload(0x40)
                let size := mul(32, add(most, 1))
                mstore(0x40, add(room, mul(2, size)))
                for { let k := 0 } iszero(gt(k, count)) { k := add(k, 1) } {
                    let place := add(room, mul(32, k))
                    mstore(place, mload(add(objects, mul(32, k))))
                    mstore(add(place, size), mload(add(boxes, mul(32, k))))
                }
                objects := room
                boxes := add(room, size)
            }
            (made.scene.objects, made.bounds) = (objects, boxes);
            (made.room, made.maxObjects) = (room, most);
        }
    }
}
