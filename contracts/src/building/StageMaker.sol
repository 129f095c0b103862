// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {fromEuler, sinCosOfHalf} from "../math/Euler.sol";
import {HEADER_SIZE, PackedMesh} from "../mesh/PackedMesh.sol";
import {NORMALS, WIDE} from "../scene/Mesh.sol";
import "../words/Records.sol";
import {addRecord, copyBytes} from "../scene/RecordWriter.sol";
import "../scene/Scene.sol";
import {SceneErrors} from "../scene/SceneErrors.sol";
import {Box, Framing} from "./Framing.sol";
import {Model, ModelMaker} from "./ModelMaker.sol";

/// @notice A scene under construction. `scene` can be drawn at any time; the array of objects grows on demand.
/// @param maxObjects Capacity of the array of objects at `room`.
/// @param room Memory address of the array of objects that this library allocated. An array from elsewhere has no spare capacity.
/// @param bounds Bounds of the meshes that were added with bounds; zero for the others.
/// @param defaultLights Memory address of the array with the default sun, which the first added light replaces.
struct Stage {
    Scene scene;
    uint256 maxObjects;
    uint256 room;
    Box[] bounds;
    uint256 defaultLights;
}

/// @dev The `color` of a preset with which objects keep their colours.
uint256 constant OWN_COLORS = 1 << 24;

/// @notice A look for all objects of a stage, such as `Presets.gold()`.
/// @param color Of all objects, 0xRRGGBB, or OWN_COLORS.
/// @param lights Directional lights; their vectors are to the right, up, and toward a level camera.
struct Preset {
    Material material;
    uint256 color;
    Background background;
    uint256 ambientLight;
    bool wireframe;
    bool invert;
    Light[] lights;
}

using StageMaker for Stage global;
using Framing for Stage global;

/// @title StageMaker: builds scenes on chain, step by step.
/// @notice Numbers have the type `Fixed` (Q32). Integer parameters are whole numbers: lengths in units, angles in degrees, coefficients in
/// percent. `units`, `unit`, `percent` and `fraction` return `Fixed` numbers. The renderer checks all ranges when it draws the scene; a
/// number that its record cannot hold is refused here, with the same error.
library StageMaker {
    /// @notice A scene has at most 65,536 objects.
    error TooManyObjects(uint256 most);
    /// @notice A scene has at most 4 lights.
    error TooManyLights(uint256 most);
    /// @notice The scene has only `count` objects.
    error NoSuchObject(uint256 object, uint256 count);
    /// @notice The scene has no light that could cast shadows.
    error NoLight();
    /// @notice The angles of a spot light must be from 0 to 180 degrees, the inner one not above the outer one (Q32).
    error SpotAnglesOutOfRange(int256 inner, int256 outer);
    /// @notice The mesh is stored or compact; only packed meshes can be painted. `IStudio.mesh` returns a stored mesh in packed form.
    error MeshNotPacked(uint256 object);
    /// @notice A mesh of `vertexCount` vertices needs as many values.
    error NotOnePerVertex(uint256 vertexCount, uint256 values);
    /// @notice A palette has 2, 4, 16 or 256 colours of 3 bytes.
    error TexturePalette(uint256 size);
    /// @notice A texture has 1 to 256 texels along each side.
    error TextureSize(uint256 width, uint256 height);
    /// @notice The texels must have `expected` bytes.
    error TextureTexels(uint256 expected, uint256 actual);
    /// @notice Texture coordinates must be from -128 to below 128, in units of 1 / 65,536.
    error TextureCoordinates(uint256 vertex, int256 u, int256 v);

    uint256 private constant MAX_LIGHTS = 4;
    uint256 private constant MAX_OBJECTS = 65536;

    /// @notice Returns an empty scene of width x height pixels.
    function stage(uint256 width, uint256 height) internal pure returns (Stage memory) {
        return stage(width, height, 4);
    }

    /// @notice Returns an empty scene: the eye 1,000 units in front of the origin, a field of view of 50 degrees, white ambient light, a
    /// sun from the upper left until another light is added, a dark background.
    /// @param maxObjects Initial capacity for objects; the right number saves the gas of growing.
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

    /// @notice Adds an object at the origin, with scale 1 and back-face culling.
    /// @param mesh A packed mesh, or the reference to a stored mesh that `IStudio.meshAt` returns. Objects may share a mesh.
    /// @return object The object; set its position, rotation, scale and flags as needed.
    function add(Stage memory made, bytes memory mesh, Material memory material) internal pure returns (Object memory object) {
        Box memory unknown;
        return add(made, mesh, material, unknown);
    }

    /// @notice Adds an object with a stored mesh and its bounds, which `place` and `fit` need.
    /// @param bounds The lowest and the highest coordinates of the mesh: see `Framing.box`.
    function add(Stage memory made, bytes memory mesh, Material memory material, Box memory bounds)
        internal pure returns (Object memory object)
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

    /// @notice Sets the colour of all vertices of the last object, 0xRRGGBB.
    function paint(Stage memory made, uint256 color) internal pure {
        paint(made, last(made), color);
    }

    /// @notice Sets the colour of all vertices of an object, 0xRRGGBB. Objects that share its mesh keep their colours.
    /// @param object Index of the object, from 0, in the order in which objects were added.
    function paint(Stage memory made, uint256 object, uint256 color) internal pure {
        uint256 count = made.scene.objects.length;
        if (object >= count) revert NoSuchObject(object, count);
        checkColor(color);
        bytes memory mesh = made.scene.objects[object].mesh;
        if (mesh.length == 0 || uint8(mesh[0]) > NORMALS + WIDE) revert MeshNotPacked(object);
        bytes memory own = bytes.concat(mesh);
        PackedMesh.paint(own, color);
        made.scene.objects[object].mesh = own;
    }

    /// @notice Gives all objects a material and colours, and the scene lights and a background. Call it when the camera is placed, before
    /// `spot`, `shadow` and `ground`. A smooth material becomes flat for meshes without normals. Stored meshes keep their shading, and can
    /// only have a preset with OWN_COLORS.
    function preset(Stage memory made, Preset memory look) internal pure {
        unchecked {
            Scene memory s = made.scene;
            for (uint256 k; k != s.objects.length; ++k) {
                if (look.color != OWN_COLORS) paint(made, k, look.color);
                Object memory object = s.objects[k];
                Material memory m = look.material;
                object.material = Material(shadingOf(object, m.shading), m.ambient, m.diffuse, m.specular, m.shininess);
                object.flags = (object.flags & ~WIREFRAME) | (look.wireframe ? WIREFRAME : 0);
            }
            (s.background, s.ambientLight, s.invert) = (look.background, look.ambientLight, look.invert ? 1 : 0);
            Vector memory toward = s.camera.eye.sub(s.camera.target);
            toward.y = ZERO;
            toward = toward.isZero() ? units(0, 0, 1) : toward.normalize();
            s.lights = new Light[](look.lights.length);
            for (uint256 k; k != s.lights.length; ++k) {
                Vector memory v = look.lights[k].vector;
                Vector memory right = Vector(toward.z, ZERO, ZERO - toward.x).scale(v.x);
                s.lights[k] = Light(DIRECTIONAL, right.add(toward.scale(v.z)).add(Vector(ZERO, v.y, ZERO)), look.lights[k].color);
            }
        }
    }

    /// @dev Returns the shading that an object has instead of the one that is wanted.
    function shadingOf(Object memory object, uint256 wanted) private pure returns (uint256) {
        uint256 own = object.material.shading;
        if (wanted == UNLIT || own == SMOOTH && wanted == SMOOTH) return wanted;
        bytes memory mesh = object.mesh;
        if (mesh.length == 0 || uint8(mesh[0]) > NORMALS + WIDE) return own == UNLIT ? FLAT : own;
        return uint8(mesh[0]) & NORMALS == 0 ? FLAT : wanted;
    }

    /// @notice Adds a directional light.
    /// @param toward Direction toward the light, of any length.
    /// @param color 0xRRGGBB.
    function sun(Stage memory made, Vector memory toward, uint256 color) internal pure {
        addLight(made, Light(DIRECTIONAL, toward, color));
    }

    /// @notice Adds a point light.
    /// @param place Its position.
    /// @param color 0xRRGGBB.
    function lamp(Stage memory made, Vector memory place, uint256 color) internal pure {
        addLight(made, Light(POINT, place, color));
    }

    /// @notice Adds a spot light, with angles in whole degrees.
    function spot(Stage memory made, Vector memory place, Vector memory toward, int256 inner, int256 outer, uint256 color) internal pure {
        spot(made, place, toward, unit(inner), unit(outer), color);
    }

    /// @notice Adds a spot light.
    /// @param place Its position.
    /// @param toward Direction of its axis, of any length.
    /// @param inner Angle from the axis up to which the light is full, in degrees.
    /// @param outer Angle from the axis at which the light has fallen to zero, in degrees, at least `inner`, at most 180.
    /// @param color 0xRRGGBB.
    function spot(Stage memory made, Vector memory place, Vector memory toward, Fixed inner, Fixed outer, uint256 color) internal pure {
        if (inner.raw() < 0 || inner > outer || outer.raw() > 180 << 32) revert SpotAnglesOutOfRange(inner.raw(), outer.raw());
        lamp(made, place, color);
        uint256 light = made.scene.lights.length - 1;
        made.scene.extensions = addRecord(made.scene.extensions, SPOT, light, cone(light, toward, inner, outer));
    }

    /// @dev Returns the record of a spot light.
    function cone(uint256 light, Vector memory toward, Fixed inner, Fixed outer) private pure returns (bytes memory) {
        (int256 x, int256 y, int256 z) = (toward.x.raw(), toward.y.raw(), toward.z.raw());
        if (int64(x) != x || int64(y) != y || int64(z) != z) revert SceneErrors.SpotOutOfRange(light, x, y, z);
        (, Fixed cosInner) = sinCosOfHalf(2 * inner.raw());
        (, Fixed cosOuter) = sinCosOfHalf(2 * outer.raw());
        return abi.encodePacked(int64(x), int64(y), int64(z), int64(cosInner.raw()), int64(cosOuter.raw()));
    }

    /// @notice Removes all lights but the ambient one, including the default sun. Call it before `spot` and `shadow`.
    function dark(Stage memory made) internal pure {
        made.scene.lights = new Light[](0);
    }

    /// @notice Sets the opacity of the last object, in percent from 0 to 99.
    function opacity(Stage memory made, int256 value) internal pure {
        opacity(made, percent(value));
    }

    /// @notice Sets the opacity of the last object, from 0 to below 1.
    function opacity(Stage memory made, Fixed value) internal pure {
        uint256 level = uint256(value.raw()) >> 8;
        if (uint32(level) != level) revert SceneErrors.OpacityOutOfRange(last(made), level);
        made.scene.extensions = addRecord(made.scene.extensions, OPACITY_OF, last(made), abi.encodePacked(uint32(level)));
    }

    /// @notice Turns on anti-aliasing, with four samples per pixel.
    function antialias(Stage memory made) internal pure {
        extend(made, ANTIALIAS, "");
    }

    /// @notice Adds light from above and from below, 0xRRGGBB, which is multiplied by the ambient coefficients of materials. The picture is
    /// antialiased, as with each of the following effects.
    function hemisphere(Stage memory made, uint256 above, uint256 below) internal pure {
        checkColor(above);
        checkColor(below);
        extend(made, HEMISPHERE, abi.encodePacked(uint24(above), uint24(below)));
    }

    /// @notice Adds light along silhouettes.
    /// @param color 0xRRGGBB.
    /// @param power From 1, wide, to 16, narrow.
    function rim(Stage memory made, uint256 color, uint256 power) internal pure {
        checkColor(color);
        if (uint8(power) != power) revert SceneErrors.RimPowerOutOfRange(power);
        extend(made, RIM, abi.encodePacked(uint24(color), uint8(power)));
    }

    /// @notice Adds fog that begins `near` whole units from the eye and hides everything beyond `far` units.
    /// @param color 0xRRGGBB.
    function fog(Stage memory made, uint256 color, uint256 near, uint256 far) internal pure {
        checkColor(color);
        if ((near | far) >> 31 != 0) revert SceneErrors.FogOutOfRange(int256(near << 32), int256(far << 32));
        extend(made, FOG, abi.encodePacked(uint24(color), uint64(near << 32), uint64(far << 32)));
    }

    /// @notice Sets the tone mapping.
    /// @param exposure Multiplier of all light, in percent from 1 to 6,400.
    /// @param filmic Whether bright light is compressed by a filmic curve; otherwise it is clamped.
    /// @param gamma Whether light is added in linear space; otherwise in sRGB values.
    function tone(Stage memory made, uint256 exposure, bool filmic, bool gamma) internal pure {
        uint256 flags = (filmic ? TONE_FILMIC : 0) | (gamma ? TONE_GAMMA : 0);
        uint256 factor = (exposure << 16) / 100;
        if (exposure >> 16 != 0) revert SceneErrors.ExposureOutOfRange(factor);
        extend(made, TONE, abi.encodePacked(uint32(factor), uint8(flags)));
    }

    /// @notice Sets the colour of the light that the last object emits, 0xRRGGBB, which is added to the light that it reflects.
    function emission(Stage memory made, uint256 color) internal pure {
        checkColor(color);
        made.scene.extensions = addRecord(made.scene.extensions, EMISSION_OF, last(made), abi.encode(color));
    }

    /// @notice Multiplies the colours of the last object by a texture: see Texture.sol.
    /// @param flags The sum of TEXTURE_BILINEAR and TEXTURE_CLAMP.
    /// @param palette 2, 4, 16 or 256 colours of three bytes, so that texels are indices of 1, 2, 4 or 8 bits; if it is empty, texels are
    /// colours.
    /// @param texels Rows from the top, without padding between them.
    /// @param uvs Texture coordinates of each vertex, in units of 1 / 65,536 of the image, from its upper left corner.
    function texture(
        Stage memory made, uint256 width, uint256 height, uint256 flags, bytes memory palette, bytes memory texels, int256[2][] memory uvs
    ) internal pure {
        unchecked {
            uint256 bits = 24;
            if (palette.length != 0) {
                bits = 1;
                while (bits < 8 && palette.length > 3 << bits) bits <<= 1;
                if (palette.length != 3 << bits) revert TexturePalette(palette.length);
            }
            if (width - 1 > 255 || height - 1 > 255) revert TextureSize(width, height);
            if (flags > TEXTURE_BILINEAR | TEXTURE_CLAMP) revert SceneErrors.TextureFormat(last(made), flags, bits);
            checkCount(made, uvs.length);
            uint256 expected = (width * height * bits + 7) / 8;
            if (texels.length != expected) revert TextureTexels(expected, texels.length);
            bytes memory head = abi.encodePacked(uint8(flags), uint8(width - 1), uint8(height - 1), uint8(bits), palette, texels);
            uint256 size = head.length + 6 * uvs.length;
            // whole words, and space for one more, which is written past the end
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

    /// @notice Sets the opacity of each vertex of the last object.
    /// @param levels One byte per vertex, from 0, transparent, to 255, opaque.
    function opacities(Stage memory made, bytes memory levels) internal pure {
        unchecked {
            checkCount(made, levels.length);
            // whole words, at least one
            bytes memory content = new bytes(levels.length == 0 ? 32 : (levels.length + 31) & ~uint256(31));
            copyBytes(content, 0, levels, 0, levels.length);
            made.scene.extensions = addRecord(made.scene.extensions, OPACITIES_OF, last(made), content);
        }
    }

    /// @notice Makes the last light cast shadows; at most one light of a scene can.
    function shadow(Stage memory made) internal pure {
        unchecked {
            shadow(made, made.scene.lights.length - 1);
        }
    }

    /// @notice Makes a light cast shadows, by its index from 0; that of a preset is 0.
    function shadow(Stage memory made, uint256 light) internal pure {
        if (light >= made.scene.lights.length) revert NoLight();
        made.scene.extensions = addRecord(made.scene.extensions, SHADOW, light, abi.encode(SHADOWS_ALL));
    }

    /// @notice Adds a horizontal, matte disc that receives shadows and casts none. It is opaque in the middle and fades out toward its
    /// edge. Place it just below the objects, and add it after `fit`.
    /// @param color 0xRRGGBB.
    /// @param radius Whole units, up to 67,108,864.
    function ground(Stage memory made, uint256 color, Vector memory middle, uint256 radius) internal pure returns (Object memory object) {
        if (radius >> 31 != 0) revert SceneErrors.GroundOutOfRange(made.scene.objects.length, 0, radius << 32);
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

    /// @notice Returns the rotation about the x axis, then the y axis, then the z axis, by whole degrees.
    function turned(int256 x, int256 y, int256 z) internal pure returns (Quaternion memory) {
        return fromEuler(unit(x), unit(y), unit(z));
    }

    /// @notice Returns the rotation about the x axis, then the y axis, then the z axis, by degrees.
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

    /// @notice Returns value / 100.
    function percent(int256 value) internal pure returns (Fixed) {
        return Fixed.wrap(value * 4294967296 / 100);
    }

    /// @notice Returns numerator / denominator, such as (1, 3), a third, or (45, 2), 22.5.
    function fraction(int256 numerator, int256 denominator) internal pure returns (Fixed) {
        return Fixed.wrap(numerator * 4294967296 / denominator);
    }

    /// @notice Returns a material with flat shading. Coefficients are percentages, 0..400; the shininess is 1..128.
    function flat(int256 ambient, int256 diffuse, int256 specular, uint256 shininess) internal pure returns (Material memory) {
        return Material(FLAT, percent(ambient), percent(diffuse), percent(specular), shininess);
    }

    /// @notice Returns a material with flat shading; coefficients 0..4.
    function flat(Fixed ambient, Fixed diffuse, Fixed specular, uint256 shininess) internal pure returns (Material memory) {
        return Material(FLAT, ambient, diffuse, specular, shininess);
    }

    /// @notice Returns a material with smooth shading, for meshes with normals: see `ModelMaker.packSmooth`. Coefficients are percentages,
    /// 0..400; the shininess is 1..128.
    function smooth(int256 ambient, int256 diffuse, int256 specular, uint256 shininess) internal pure returns (Material memory) {
        return Material(SMOOTH, percent(ambient), percent(diffuse), percent(specular), shininess);
    }

    /// @notice Returns a material with smooth shading, for meshes with normals; coefficients 0..4.
    function smooth(Fixed ambient, Fixed diffuse, Fixed specular, uint256 shininess) internal pure returns (Material memory) {
        return Material(SMOOTH, ambient, diffuse, specular, shininess);
    }

    /// @notice Returns a material whose colours are shown without lighting.
    function unlit() internal pure returns (Material memory) {
        return Material(UNLIT, ONE, ZERO, ZERO, 1);
    }

    /// @notice Returns whether the array of objects has the spare capacity that `maxObjects` states.
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

    /// @dev Returns the memory address of an array.
    function address_(Light[] memory lights) private pure returns (uint256 place) {
        assembly ("memory-safe") {
            place := lights
        }
    }

    /// @dev Returns the index of the last object.
    function last(Stage memory made) private pure returns (uint256) {
        unchecked {
            uint256 count = made.scene.objects.length;
            if (count == 0) revert NoSuchObject(0, 0);
            return count - 1;
        }
    }

    /// @dev Reverts if the last object's mesh is packed, so that its vertices can be counted, and has another number of them.
    function checkCount(Stage memory made, uint256 values) private pure {
        bytes memory mesh = made.scene.objects[last(made)].mesh;
        if (mesh.length < HEADER_SIZE || uint8(mesh[0]) > NORMALS + WIDE) return;
        uint256 vertexCount = uint256(uint8(mesh[1])) << 8 | uint8(mesh[2]);
        if (values != vertexCount) revert NotOnePerVertex(vertexCount, values);
    }

    /// @dev Reverts if a colour is not 0xRRGGBB.
    function checkColor(uint256 color) private pure {
        if (color > 0xffffff) revert ModelMaker.NotAColor(color);
    }

    /// @dev Sets a record of the whole scene.
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

    /// @dev Moves the objects to an array with capacity for `most`.
    function setRoom(Stage memory made, uint256 most) private pure {
        unchecked {
            if (most > MAX_OBJECTS) most = MAX_OBJECTS;
            (Object[] memory objects, Box[] memory boxes) = (made.scene.objects, made.bounds);
            uint256 count = objects.length;
            // the bounds of objects from elsewhere are unknown
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
