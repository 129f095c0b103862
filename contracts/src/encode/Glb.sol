// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {sqrt} from "../math/Roots.sol";
import {checkLayout, checkObject} from "../scene/Checks.sol";
import {Extensions, OPAQUE} from "../scene/Extensions.sol";
import {OPACITY_OF, RECORD_HEADER} from "../words/Records.sol";
import {Mesh, openMesh} from "../scene/Mesh.sol";
import {Object, Scene, CULL_BACKFACES, WIREFRAME, SMOOTH, UNLIT, Vector, Quaternion} from "../scene/Scene.sol";
import {SceneErrors} from "../scene/SceneErrors.sol";
import {GlbErrors} from "../interfaces/GlbErrors.sol";
import {Bmp} from "./Bmp.sol";
import {LINEAR} from "./Linear.sol";
import {Text} from "./Text.sol";

/// @notice Encodes the objects of a scene as binary glTF files: meshes with colours and normals, transforms and materials. Camera, lights
/// and background are omitted, since viewers provide them.
/// @dev Source: glTF 2.0 (Khronos), KHR_materials_unlit.
///
/// The buffer has two parts for each object. Vertices: position, 3 floats; colour, 4 linear numbers of 16 bits; for smooth surfaces the
/// normal, 3 floats. Indices: 16 bits each, 3 for each face, or 6 for its edges.
library Glb {
    /// @dev The sizes of the file header with the first chunk header, and of a chunk header.
    uint256 private constant HEAD = 20;
    uint256 private constant CHUNK = 8;
    /// @dev The maximum number of characters of the JSON: common to all objects, and for each object.
    uint256 private constant COMMON = 512;
    uint256 private constant EACH = 1536;
    /// @dev The maximum number of decimal places.
    uint256 private constant DIGITS = 10;
    /// @dev Values for `exponent` in `toFloat`: for integers, and for numbers with 23 fraction bits.
    uint256 private constant WHOLE = 127;
    uint256 private constant Q23 = 104;
    /// @dev The lower byte of each two bytes, and the lower two of each four.
    uint256 private constant BYTES = 0x00ff00ff00ff00ff00ff00ff00ff00ff00ff00ff00ff00ff00ff00ff00ff00ff;
    uint256 private constant PAIRS = 0x0000ffff0000ffff0000ffff0000ffff0000ffff0000ffff0000ffff0000ffff;

    /// @dev An object that has faces.
    /// @param index The index of the object.
    /// @param mesh The mesh of the object.
    /// @param stride The size of a vertex in the file, in bytes.
    /// @param indices The number of indices.
    /// @param opacity The opacity, Q24.
    struct Part {
        uint256 index;
        Mesh mesh;
        uint256 stride;
        uint256 indices;
        uint256 opacity;
        bool smooth;
        bool lines;
        bool unlit;
        bool culled;
    }

    /// @notice Returns a GLB file of a scene. Reverts with the renderer's errors if an object is invalid.
    function encode(Scene calldata scene) internal pure returns (bytes memory glb) {
        unchecked {
            bytes memory linear = LINEAR;
            Part[] memory parts = partsOf(scene);
            uint256 begin;
            uint256 target;
            {
                bytes memory room = new bytes(COMMON + EACH * parts.length);
                assembly ("memory-safe") {
                    glb := room
                    begin := add(room, 32)
                }
            }
            target = writeJson(scene, parts, begin + HEAD);
            // pad with spaces to four bytes
            while ((target - begin) & 3 != 0) target = Text.write(target, " ");
            uint256 data = target + CHUNK;
            uint256 end = data;
            // no allocations from here on: writes may exceed the allocated room
            for (uint256 k; k != parts.length; ++k) {
                end = writeVertices(parts[k], linear, end);
                end = writeIndices(parts[k], end);
            }
            (uint256 total, uint256 size) = (Bmp.littleEndian(end - begin), Bmp.littleEndian(end - data));
            uint256 json = Bmp.littleEndian(target - begin - HEAD);
            assembly ("memory-safe") {
                // "glTF", version 2
                let head := or(0x676c544602000000000000000000000000000000000000000000000000000000, shl(160, total))
                head := or(head, or(shl(128, json), shl(96, 0x4a534f4e)))
                mstore(begin, or(head, shr(160, shl(160, mload(begin)))))
                mstore(target, or(or(shl(224, size), shl(192, 0x42494e00)), shr(64, shl(64, mload(target)))))
                mstore(glb, sub(end, begin))
                mstore(0x40, and(add(end, 63), not(31)))
            }
        }
    }

    function partsOf(Scene calldata scene) private pure returns (Part[] memory parts) {
        unchecked {
            checkLayout(scene);
            Extensions.check(scene);
            parts = new Part[](scene.objects.length);
            uint256 count;
            (uint256 record, uint256 end) = Extensions.bounds(scene);
            while (record != end && Extensions.keyOf(record) >> 16 != OPACITY_OF) record = next(record);
            for (uint256 k; k != scene.objects.length; ++k) {
                Object calldata object = scene.objects[k];
                checkObject(object, k);
                uint256 opacity = OPAQUE;
                if (Extensions.isOf(record, end, OPACITY_OF, k)) {
                    opacity = Extensions.opacityOf(record);
                    record = next(record);
                }
                Mesh memory mesh = openMesh(object.mesh);
                if (mesh.vertexCount == 0 || mesh.faceCount == 0) continue;
                Part memory part = parts[count++];
                part.lines = object.flags & WIREFRAME != 0;
                part.unlit = part.lines || object.material.shading == UNLIT;
                part.smooth = !part.unlit && object.material.shading == SMOOTH;
                part.culled = object.flags & CULL_BACKFACES != 0;
                (part.index, part.mesh, part.opacity) = (k, mesh, opacity);
                part.stride = part.smooth ? 32 : 20;
                part.indices = mesh.faceCount * (part.lines ? 6 : 3);
            }
            if (count == 0) revert GlbErrors.NothingToShow();
            assembly ("memory-safe") {
                mstore(parts, count)
            }
        }
    }

    function next(uint256 record) private pure returns (uint256) {
        unchecked {
            return record + RECORD_HEADER + Extensions.sizeOf(record);
        }
    }

    // ---- the document ----

    function writeJson(Scene calldata scene, Part[] memory parts, uint256 target) private pure returns (uint256) {
        unchecked {
            target = Text.write(target, '{"asset":{"version":"2.0","generator":"Shackled"},"scene":0,"scenes":[{"nodes":[');
            bool unlit;
            for (uint256 k; k != parts.length; ++k) {
                target = integer(comma(target, k), int256(k));
                unlit = unlit || parts[k].unlit;
            }
            target = Text.write(target, "]}],");
            if (unlit) target = Text.write(target, '"extensionsUsed":["KHR_materials_unlit"],');
            target = Text.write(target, '"nodes":[');
            for (uint256 k; k != parts.length; ++k) target = node(scene.objects[parts[k].index], comma(target, k), k);
            target = Text.write(target, '],"meshes":[');
            uint256 accessor;
            for (uint256 k; k != parts.length; ++k) {
                target = primitive(parts[k], comma(target, k), k, accessor);
                accessor += parts[k].smooth ? 4 : 3;
            }
            target = Text.write(target, '],"materials":[');
            for (uint256 k; k != parts.length; ++k) target = material(parts[k], comma(target, k));
            target = Text.write(target, '],"accessors":[');
            for (uint256 k; k != parts.length; ++k) target = accessors(parts[k], comma(target, k), 2 * k);
            target = Text.write(target, '],"bufferViews":[');
            uint256 size;
            for (uint256 k; k != parts.length; ++k) (target, size) = views(parts[k], comma(target, k), size);
            target = integer(Text.write(target, '],"buffers":[{"byteLength":'), int256(size));
            return Text.write(target, "}]}");
        }
    }

    function comma(uint256 target, uint256 number) private pure returns (uint256) {
        return number == 0 ? target : Text.write(target, ",");
    }

    function node(Object calldata object, uint256 target, uint256 mesh) private pure returns (uint256) {
        unchecked {
            target = integer(Text.write(target, '{"mesh":'), int256(mesh));
            Vector calldata p = object.position;
            target = decimal(Text.write(target, ',"translation":['), p.x.raw());
            target = decimal(Text.write(target, ","), p.y.raw());
            target = decimal(Text.write(target, ","), p.z.raw());
            Quaternion calldata q = object.rotation;
            (int256 x, int256 y, int256 z, int256 w) = (q.x.raw(), q.y.raw(), q.z.raw(), q.w.raw());
            // with 32 more bits, so that short ones keep their direction
            int256 length = root(uint256(x * x + y * y + z * z + w * w) << 64);
            target = decimal(Text.write(target, '],"rotation":['), (x << 64) / length);
            target = decimal(Text.write(target, ","), (y << 64) / length);
            target = decimal(Text.write(target, ","), (z << 64) / length);
            target = decimal(Text.write(target, ","), (w << 64) / length);
            int256 scale = object.scale.raw();
            target = decimal(Text.write(target, '],"scale":['), scale);
            target = decimal(Text.write(target, ","), scale);
            target = decimal(Text.write(target, ","), scale);
            return Text.write(target, "]}");
        }
    }

    function primitive(Part memory part, uint256 target, uint256 index, uint256 accessor) private pure returns (uint256) {
        unchecked {
            target = integer(Text.write(target, '{"primitives":[{"indices":'), int256(accessor));
            target = integer(Text.write(target, ',"attributes":{"POSITION":'), int256(accessor + 1));
            target = integer(Text.write(target, ',"COLOR_0":'), int256(accessor + 2));
            if (part.smooth) target = integer(Text.write(target, ',"NORMAL":'), int256(accessor + 3));
            target = integer(Text.write(target, '},"material":'), int256(index));
            if (part.lines) target = Text.write(target, ',"mode":1');
            return Text.write(target, "}]}");
        }
    }

    function material(Part memory part, uint256 target) private pure returns (uint256) {
        unchecked {
            target = Text.write(target, '{"pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0.8');
            if (part.opacity != OPAQUE) {
                target = decimal(Text.write(target, ',"baseColorFactor":[1,1,1,'), int256(part.opacity << 8));
                target = Text.write(target, ']},"alphaMode":"BLEND"');
            } else {
                target = Text.write(target, "}");
            }
            if (!part.culled) target = Text.write(target, ',"doubleSided":true');
            if (part.unlit) target = Text.write(target, ',"extensions":{"KHR_materials_unlit":{}}');
            return Text.write(target, "}");
        }
    }

    /// @param view_ The number of the buffer view with the vertices; the next one has the indices.
    function accessors(Part memory part, uint256 target, uint256 view_) private pure returns (uint256) {
        unchecked {
            target = integer(Text.write(target, '{"componentType":5123,"type":"SCALAR","bufferView":'), int256(view_ + 1));
            target = integer(Text.write(target, ',"count":'), int256(part.indices));
            target = Text.write(target, '},{"componentType":5126,"type":"VEC3","min":[');
            (int256[3] memory low, int256[3] memory high) = box(part.mesh);
            target = Text.write(vector(low, target), '],"max":[');
            target = Text.write(vector(high, target), '],"byteOffset":0');
            target = ofVertices(part, target, view_);
            target = Text.write(target, ',{"componentType":5123,"normalized":true,"type":"VEC4","byteOffset":12');
            target = ofVertices(part, target, view_);
            if (!part.smooth) return target;
            target = Text.write(target, ',{"componentType":5126,"type":"VEC3","byteOffset":20');
            return ofVertices(part, target, view_);
        }
    }

    function ofVertices(Part memory part, uint256 target, uint256 view_) private pure returns (uint256) {
        target = integer(Text.write(target, ',"bufferView":'), int256(view_));
        target = integer(Text.write(target, ',"count":'), int256(part.mesh.vertexCount));
        return Text.write(target, "}");
    }

    /// @param offset The offset of the vertices in the buffer. The second result is that of the next object's vertices.
    function views(Part memory part, uint256 target, uint256 offset) private pure returns (uint256, uint256) {
        unchecked {
            uint256 size = part.stride * part.mesh.vertexCount;
            target = integer(Text.write(target, '{"buffer":0,"target":34962,"byteStride":'), int256(part.stride));
            target = extent(target, offset, size);
            offset += size;
            target = Text.write(target, ',{"buffer":0,"target":34963');
            target = extent(target, offset, 2 * part.indices);
            return (target, offset + ((2 * part.indices + 3) & ~uint256(3)));
        }
    }

    function extent(uint256 target, uint256 offset, uint256 size) private pure returns (uint256) {
        target = integer(Text.write(target, ',"byteOffset":'), int256(offset));
        target = integer(Text.write(target, ',"byteLength":'), int256(size));
        return Text.write(target, "}");
    }

    function vector(int256[3] memory v, uint256 target) private pure returns (uint256) {
        target = Text.write(integer(target, v[0]), ",");
        target = Text.write(integer(target, v[1]), ",");
        return integer(target, v[2]);
    }

    /// @dev Writes an integer.
    function integer(uint256 target, int256 value) private pure returns (uint256) {
        unchecked {
            if (value < 0) {
                target = Text.write(target, "-");
                value = -value;
            }
            uint256 digits = 1;
            for (int256 rest = value / 10; rest != 0; rest /= 10) ++digits;
            put(target, uint256(value), digits);
            return target + digits;
        }
    }

    /// @dev Writes a number (Q32) without trailing zeros.
    function decimal(uint256 target, int256 value) private pure returns (uint256) {
        unchecked {
            if (value < 0) {
                target = Text.write(target, "-");
                value = -value;
            }
            // rounded to nearest
            uint256 scaled = (uint256(value) * 10 ** DIGITS + (1 << 31)) >> 32;
            target = integer(target, int256(scaled / 10 ** DIGITS));
            uint256 fraction = scaled % 10 ** DIGITS;
            if (fraction == 0) return target;
            target = Text.write(target, ".");
            uint256 digits = DIGITS;
            for (; fraction % 10 == 0; fraction /= 10) --digits;
            put(target, fraction, digits);
            return target + digits;
        }
    }

    /// @dev Writes the last `digits` digits of a number.
    function put(uint256 target, uint256 value, uint256 digits) private pure {
        assembly ("memory-safe") {
            for { let place := add(target, digits) } gt(place, target) {} {
                place := sub(place, 1)
                mstore8(place, add(48, mod(value, 10)))
                value := div(value, 10)
            }
        }
    }

    // ---- the buffer ----

    /// @dev Returns the minimum and maximum coordinates.
    function box(Mesh memory mesh) private pure returns (int256[3] memory low, int256[3] memory high) {
        (uint256 vertices, uint256 count, uint256 bits, uint256 stride) = (mesh.vertices, mesh.vertexCount, mesh.bits, mesh.stride);
        assembly ("memory-safe") {
            let cut := sub(256, bits)
            let end := add(vertices, mul(count, stride))
            for { let axis := 0 } lt(axis, 3) { axis := add(axis, 1) } {
                let place := add(vertices, mul(axis, shr(3, bits)))
                let least := sar(cut, calldataload(place))
                let most := least
                for {} lt(place, end) { place := add(place, stride) } {
                    let value := sar(cut, calldataload(place))
                    if slt(value, least) { least := value }
                    if sgt(value, most) { most := value }
                }
                mstore(add(low, shl(5, axis)), least)
                mstore(add(high, shl(5, axis)), most)
            }
        }
    }

    function writeVertices(Part memory part, bytes memory linear, uint256 target) private pure returns (uint256) {
        unchecked {
            (uint256 place, uint256 bits, uint256 stride) = (part.mesh.vertices, part.mesh.bits, part.mesh.stride);
            for (uint256 end = place + part.mesh.vertexCount * stride; place != end; place += stride) {
                uint256 vertex;
                uint256 red;
                uint256 green;
                uint256 blue;
                assembly ("memory-safe") {
                    vertex := calldataload(place)
                    // the colour follows the three coordinates
                    let color := shr(232, shl(mul(3, bits), vertex))
                    let table := add(linear, 32)
                    red := shr(240, mload(add(table, shl(1, shr(16, color)))))
                    green := shr(240, mload(add(table, shl(1, and(shr(8, color), 0xff)))))
                    blue := shr(240, mload(add(table, shl(1, and(color, 0xff)))))
                }
                uint256 lanes = (toFloat(int256(vertex) >> (256 - bits), WHOLE) << 224)
                    | (toFloat(int256(vertex << bits) >> (256 - bits), WHOLE) << 192)
                    | (toFloat(int256(vertex << (2 * bits)) >> (256 - bits), WHOLE) << 160)
                    | (((green << 16) | red) << 128) | ((0xffff0000 | blue) << 96);
                if (part.smooth) lanes |= normal(vertex << (3 * bits + 24));
                lanes = ((lanes & BYTES) << 8) | ((lanes >> 8) & BYTES);
                lanes = ((lanes & PAIRS) << 16) | ((lanes >> 16) & PAIRS);
                assembly ("memory-safe") {
                    mstore(target, lanes)
                }
                target += part.stride;
            }
            return target;
        }
    }

    /// @dev Returns three floats of a unit vector.
    /// @param packed Three numbers of 10 bits, the first in the uppermost bits.
    function normal(uint256 packed) private pure returns (uint256) {
        unchecked {
            (int256 x, int256 y, int256 z) = (int256(packed) >> 246, int256(packed << 10) >> 246, int256(packed << 20) >> 246);
            if (x | y | z == 0) z = 1;
            // with 20 fraction bits
            int256 length = root(uint256(x * x + y * y + z * z) << 40);
            return (toFloat((x << 43) / length, Q23) << 64) | (toFloat((y << 43) / length, Q23) << 32) | toFloat((z << 43) / length, Q23);
        }
    }

    /// @dev Returns the 32-bit float of an integer below 2^24, exactly.
    /// @param exponent The exponent of the float if the integer were 1.
    function toFloat(int256 value, uint256 exponent) private pure returns (uint256 bits) {
        assembly ("memory-safe") {
            if value {
                let negative := slt(value, 0)
                let size := xor(sub(value, negative), sub(0, negative))
                // the index of its highest bit
                let highest := shl(4, lt(0xffff, size))
                highest := or(highest, shl(3, lt(0xff, shr(highest, size))))
                highest := or(highest, shl(2, lt(0xf, shr(highest, size))))
                highest := or(highest, shl(1, lt(3, shr(highest, size))))
                highest := or(highest, lt(1, shr(highest, size)))
                // the highest bit is implicit
                bits := and(shl(sub(23, highest), size), 0x7fffff)
                bits := or(or(shl(31, negative), shl(23, add(exponent, highest))), bits)
            }
        }
    }

    function writeIndices(Part memory part, uint256 target) private pure returns (uint256 end) {
        unchecked {
            (uint256 place, uint256 count, uint256 vertices) = (part.mesh.faces, part.mesh.faceCount, part.mesh.vertexCount);
            bool lines = part.lines;
            end = target + ((2 * part.indices + 3) & ~uint256(3));
            uint256 wrong = count;
            assembly ("memory-safe") {
                for { let k := 0 } lt(k, count) { k := add(k, 1) } {
                    let face := shr(208, calldataload(add(place, mul(6, k))))
                    let a := shr(32, face)
                    let b := and(shr(16, face), 0xffff)
                    let c := and(face, 0xffff)
                    if iszero(and(and(lt(a, vertices), lt(b, vertices)), lt(c, vertices))) {
                        wrong := k
                        break
                    }
                    // little-endian
                    face := or(shl(8, and(face, BYTES)), and(shr(8, face), BYTES))
                    switch lines
                    case 0 {
                        mstore(target, shl(208, face))
                        target := add(target, 6)
                    }
                    default {
                        // a, b; b, c; c, a
                        let edges := or(shl(64, shr(16, face)), shl(32, and(face, 0xffffffff)))
                        edges := or(edges, or(shl(16, and(face, 0xffff)), shr(32, face)))
                        mstore(target, shl(160, edges))
                        target := add(target, 12)
                    }
                }
                // pad with zeros to four bytes
                mstore(target, 0)
            }
            if (wrong != count) revert SceneErrors.IndexOutOfRange(part.index, wrong, vertices);
        }
    }

    /// @dev Returns the square root, with one more step of Newton's method.
    function root(uint256 x) private pure returns (int256) {
        unchecked {
            uint256 r = sqrt(x);
            return int256((r + x / r) >> 1);
        }
    }
}
