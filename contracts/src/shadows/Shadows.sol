// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {ZERO} from "../math/Fixed.sol";
import {Vector, normalize} from "../math/Vector.sol";
import {Extensions} from "../scene/Extensions.sol";
import {GROUND, OPACITIES_OF, OPACITY_OF, SHADOW, SHADOWS_ALL, SHADOWS_FRONT_FACES} from "../words/Records.sol";
import {Mesh, openMesh} from "../scene/Mesh.sol";
import {Object, Scene, CULL_BACKFACES, FLAT, UNLIT, WIREFRAME} from "../scene/Scene.sol";
import {Indices} from "../pipeline/geometry/Indices.sol";
import {Triangles} from "../pipeline/geometry/Triangles.sol";
import {Transform} from "../uniforms/Transform.sol";
import {View} from "../uniforms/View.sol";
import {ADDRESS_MASK, CASTER_SIZE, FACE_ENTRY, FACE_RECORD_SIZE, FACE_SIDE, Faces, PLANES_SIZE} from "./Faces.sol";
import {BUCKETS, Frame, LightSpace, PLACE_SIZE} from "./LightSpace.sol";
import {CHAINS, COVERED, LAST_EDGE, MISSED, Receiver, Receivers} from "./Receivers.sol";
import "../words/EffectRegisters.sol";

// Computes which parts of which faces a light does not reach.
//
// Every shadow caster is a set of four half-spaces, exact in integers: its three sides as seen from the light, and the half-space behind
// it. For each face that the light may reach, the faces that may shade it are found: see Faces. Most faces are entirely lit or entirely
// dark; for the others, each half-space becomes a function of the position on the canvas: see Receivers.

library Shadows {
    /// @dev The data in memory, by addresses.
    /// @param frame The space of the light.
    /// @param vertices, faces For each object, the beginning of its vertices and faces.
    /// @param begin, end The bounds of the faces.
    /// @param casters The faces that cast shadows: see Faces.
    /// @param sets The tables of sets, of `words` words each: see Faces.
    /// @param boxes The search ranges of a face: see Faces.writeBoxes.
    /// @param planes The address for the functions of casters.
    /// @param heads A word for each row of the canvas, which has the size `width` by `height`; 0 except while lists are sorted.
    /// @param chains See Receiver.
    /// @param light The number of the light; `toward` is the direction toward it in mesh space: see turnsAway.
    /// @param eye The eye in light space; for an orthographic camera, the viewing direction.
    struct State {
        Frame frame;
        uint256[] vertices;
        uint256[] faces;
        uint256 end;
        uint256 casters;
        uint256 casterCount;
        uint256 sets;
        uint256 words;
        uint256 boxes;
        uint256 planes;
        uint256 heads;
        uint256 chains;
        uint256 width;
        uint256 height;
        int256[3] eye;
        uint256 light;
        Vector toward;
    }

    uint256 private constant LIT = 0;
    uint256 private constant DARK = 1;
    uint256 private constant ENTRY_BITS = 32;
    uint256 private constant ENTRIES = 8;

    /// @notice Computes the parts that the light of the SHADOW does not reach. The registers of the frame must be set: see EffectUniforms.
    /// @return begin The address of the result: for each object a word, the offset of its faces' entries from the beginning. Then the
    /// entries, 4 bytes for each face of all objects: 0 if it is lit, 1 if it is dark, otherwise the offset, in words, of the functions of
    /// the shadows on it: see Receivers. The entries are padded to whole words.
    /// @return size The size of the result in bytes.
    function cast(Scene calldata scene, View memory view_) internal pure returns (uint256 begin, uint256 size) {
        unchecked {
            uint256 light = (load(SHADOW_LIGHT) - LIGHTS) / LIGHT_SIZE;
            State memory state;
            (state.width, state.height, state.light) = (scene.canvas.width, scene.canvas.height, light);
            int256[6] memory bounds = readVertices(scene, state);
            if (bounds[0] <= bounds[3]) {
                state.frame = LightSpace.frameOf(scene.lights[light], bounds);
                LightSpace.place(state.frame, state.vertices[0], state.vertices[scene.objects.length]);
                setEye(scene, view_, state);
                readFaces(scene, state, Extensions.word(Extensions.find(scene, SHADOW, light)));
                Receiver memory receiver;
                (receiver.isPoint, receiver.chains) = (state.frame.isPoint, state.chains);
                Receivers.open(receiver);
                for (uint256 i; i != scene.objects.length; ++i) shadeObject(scene, view_, state, receiver, i);
            } else {
                readFaces(scene, state, 0);
            }
            return answer(state);
        }
    }

    /// @dev Returns whether an object casts a shadow: not wireframes, translucent objects, or grounds.
    function casts(Scene calldata scene, uint256 index) private pure returns (bool) {
        return scene.objects[index].flags & WIREFRAME == 0 && Extensions.find(scene, OPACITY_OF, index) == 0
            && Extensions.find(scene, OPACITIES_OF, index) == 0 && Extensions.find(scene, GROUND, index) == 0;
    }

    /// @dev Writes all vertices in world space.
    /// @return bounds The bounds of the casters: the minimum coordinates, then the maximum ones.
    function readVertices(Scene calldata scene, State memory state) private pure returns (int256[6] memory bounds) {
        unchecked {
            for (uint256 i; i != 3; ++i) (bounds[i], bounds[i + 3]) = (type(int256).max, type(int256).min);
            uint256 count = scene.objects.length;
            state.vertices = new uint256[](count + 1);
            state.faces = new uint256[](count + 1);
            uint256 faces;
            uint256 end;
            for (uint256 i; i != count; ++i) {
                Mesh memory mesh = openMesh(scene.objects[i].mesh);
                Indices.check(mesh, i);
                state.vertices[i] = end;
                state.faces[i] = faces;
                end += PLACE_SIZE * mesh.vertexCount;
                faces += FACE_RECORD_SIZE * mesh.faceCount;
            }
            (state.vertices[count], state.faces[count]) = (end, faces);
            // the memory for reading an object follows all vertices
            uint256 begin = freeMemory();
            setFreeMemory(begin + end);
            for (uint256 i; i <= count; ++i) {
                state.vertices[i] += begin;
                state.faces[i] += begin + end;
            }
            for (uint256 i; i != count; ++i) {
                Object calldata object = scene.objects[i];
                LightSpace.writeWorld(object, openMesh(object.mesh), object.rotation.toMatrix(), state.vertices[i]);
                if (casts(scene, i)) LightSpace.widen(bounds, state.vertices[i], state.vertices[i + 1]);
                setFreeMemory(begin + end);
            }
            setFreeMemory(state.faces[count]);
        }
    }

    function setEye(Scene calldata scene, View memory view_, State memory state) private pure {
        unchecked {
            Vector memory v = view_.orthographic ? view_.forward : scene.camera.eye;
            (int256 x, int256 y, int256 z) = (v.x.raw(), v.y.raw(), v.z.raw());
            if (view_.orthographic) {
                int256 radius = state.frame.radius;
                (x, y, z) = LightSpace.directionOf(state.frame, (x * radius) >> 32, (y * radius) >> 32, (z * radius) >> 32);
            } else {
                (x, y, z) = LightSpace.placeOf(state.frame, x, y, z);
            }
            (state.eye[0], state.eye[1], state.eye[2]) = (x, y, z);
        }
    }

    /// @dev Writes all faces, and the sets of those that cast shadows.
    /// @param rule Which faces of culled objects cast shadows; 0 if none do, and faces are only counted.
    function readFaces(Scene calldata scene, State memory state, uint256 rule) private pure {
        unchecked {
            state.casters = freeMemory();
            if (rule == 0) {
                assembly ("memory-safe") {
                    let begin := mload(add(mload(add(state, 0x40)), 0x20))
                    calldatacopy(begin, calldatasize(), sub(mload(0x40), begin))
                }
                return;
            }
            uint256 end = state.casters;
            for (uint256 i; i != scene.objects.length; ++i) {
                setFreeMemory(end + 0x100);
                Object calldata object = scene.objects[i];
                Mesh memory mesh = openMesh(object.mesh);
                end = readObject(
                    state, mesh, i, end, casts(scene, i) ? (object.flags & CULL_BACKFACES == 0 ? SHADOWS_ALL : rule) : 0
                );
            }
            uint256 count = (end - state.casters) / CASTER_SIZE;
            uint256 words = (count + 255) >> 8;
            (state.casterCount, state.words, state.sets) = (count, words, end);
            uint256 size = 5 * BUCKETS * words * 32 * state.frame.sides;
            assembly ("memory-safe") {
                calldatacopy(end, calldatasize(), size)
            }
            state.planes = end + size;
            state.boxes = state.planes + PLANES_SIZE * count;
            state.heads = state.boxes + 0x40 * state.frame.sides;
            state.chains = state.heads + 32 * state.height;
            setFreeMemory(state.chains + 32 * CHAINS);
            for (uint256 i; i != count; ++i) {
                uint256 corners = load(load(state.casters + CASTER_SIZE * i));
                uint256 boxesEnd = Faces.writeBoxes(state.boxes, state.sets, words, state.frame, corners);
                for (uint256 p = state.boxes; p != boxesEnd; p += 0x40) Faces.insert(load(p), words, i, load(p + 0x20));
            }
            for (uint256 i; i != state.frame.sides; ++i) Faces.complete(state.sets + i * (size / state.frame.sides), words);
        }
    }

    /// @param end The address for appending those that cast shadows.
    /// @param rule Which of them cast shadows; 0 for none.
    function readObject(State memory state, Mesh memory mesh, uint256 index, uint256 end, uint256 rule)
        private
        pure
        returns (uint256)
    {
        unchecked {
            uint256 face = state.faces[index];
            uint256 vertices = state.vertices[index];
            bool isPoint = state.frame.isPoint;
            uint256 last = state.faces[index + 1];
            for (uint256 source = mesh.faces; face != last; source += FACE_SIZE) {
                uint256 numbers = Triangles.readIndices(source);
                Faces.write(
                    face,
                    vertices + PLACE_SIZE * (numbers >> FACE_FIRST_AT),
                    vertices + PLACE_SIZE * ((numbers >> FACE_SECOND_AT) & FACE_INDEX_MASK),
                    vertices + PLACE_SIZE * (numbers & FACE_INDEX_MASK),
                    isPoint
                );
                if (rule != 0) {
                    int256 side = loadSigned(face + FACE_SIDE);
                    if (side != 0 && (rule == SHADOWS_ALL || (side > 0) == (rule == SHADOWS_FRONT_FACES))) {
                        store(end, face);
                        Faces.pack(end + 0x20, load(face));
                        end += CASTER_SIZE;
                    }
                }
                face += FACE_RECORD_SIZE;
            }
            return end;
        }
    }

    /// @dev Sets the entries of the faces of an object.
    function shadeObject(Scene calldata scene, View memory view_, State memory state, Receiver memory receiver, uint256 index)
        private
        pure
    {
        unchecked {
            Object calldata object = scene.objects[index];
            Mesh memory mesh = openMesh(object.mesh);
            bool isReceiver = object.material.shading != UNLIT && object.flags & WIREFRAME == 0;
            if (isReceiver) {
                Transform.setMatrix(view_, object, object.rotation.toMatrix());
                assembly ("memory-safe") {
                    mcopy(MESH_VERTICES, mesh, 0xc0)
                }
            }
            uint256 source = mesh.faces;
            bool isFlat = object.material.shading == FLAT;
            bool isCulled = object.flags & CULL_BACKFACES != 0;
            if (isReceiver && !isFlat && isCulled && !state.frame.isPoint) {
                state.toward = object.rotation.toMatrix().transposedTimes(normalize(scene.lights[state.light].vector));
            } else {
                state.toward = Vector(ZERO, ZERO, ZERO);
            }
            uint256 last = state.faces[index + 1];
            for (uint256 face = state.faces[index]; face != last; face += FACE_RECORD_SIZE) {
                uint256 entry = LIT;
                if (
                    isReceiver && receives(face, state.eye, view_.orthographic, isFlat, isCulled)
                        && (loadSigned(face + FACE_SIDE) > 0 || !turnsAway(state.toward, mesh, source))
                ) {
                    entry = shadeFace(state, receiver, face, source);
                }
                store(face + FACE_ENTRY, entry);
                source += FACE_SIZE;
            }
        }
    }

    /// @dev Returns whether a face may be seen on the side that the light reaches.
    function receives(uint256 face, int256[3] memory eye, bool isOrthographic, bool isFlat, bool isCulled) private pure returns (bool) {
        unchecked {
            int256 side = loadSigned(face + FACE_SIDE);
            if (side == 0) return false;
            int256 seen;
            int256 slack;
            assembly ("memory-safe") {
                let i := mload(add(face, 0x20))
                let j := mload(add(face, 0x40))
                let k := mload(add(face, 0x60))
                seen := add(add(mul(i, mload(eye)), mul(j, mload(add(eye, 0x20)))), mul(k, mload(add(eye, 0x40))))
                switch isOrthographic
                case 0 {
                    let a := and(mload(face), ADDRESS_MASK)
                    seen := sub(seen, add(add(mul(i, mload(a)), mul(j, mload(add(a, 0x20)))), mul(k, mload(add(a, 0x40)))))
                }
                default { seen := sub(0, seen) }
                let sign := sar(255, i)
                slack := sub(xor(i, sign), sign)
                sign := sar(255, j)
                slack := add(slack, sub(xor(j, sign), sign))
                sign := sar(255, k)
                slack := add(slack, sub(xor(k, sign), sign))
                slack := shl(2, slack)
            }
            if (isCulled && seen < -slack) return false;
            // with smooth shading, the light may be positive on faces turned away
            return !isFlat || (seen >= -slack && seen <= slack) || (seen > 0) == (side > 0);
        }
    }

    /// @dev Returns whether all normals of a smooth face point away from a directional light, so that it is not lit.
    /// @param toward The direction toward the light in mesh space; zero if unknown.
    function turnsAway(Vector memory toward, Mesh memory mesh, uint256 source) private pure returns (bool) {
        unchecked {
            if (toward.isZero()) return false;
            uint256 numbers = Triangles.readIndices(source);
            uint256 normals = mesh.vertices + 3 * mesh.bits / 8 + 3;
            for (uint256 i; i != 48; i += 16) {
                uint256 place = normals + ((numbers >> i) & FACE_INDEX_MASK) * mesh.stride;
                int256 cosine;
                assembly ("memory-safe") {
                    let data := calldataload(place)
                    cosine := mul(sar(MESH_NORMAL_AT, data), mload(toward))
                    cosine := add(cosine, mul(sar(MESH_NORMAL_AT, shl(MESH_NORMAL_Y, data)), mload(add(toward, 0x20))))
                    cosine := add(cosine, mul(sar(MESH_NORMAL_AT, shl(MESH_NORMAL_Z, data)), mload(add(toward, 0x40))))
                }
                if (cosine > 0) return false;
            }
            return true;
        }
    }

    /// @return The entry of a face: LIT, DARK, or the address of a list: see Receivers.finish.
    function shadeFace(
        State memory state,
        Receiver memory receiver,
        uint256 face,
        uint256 source
    ) private pure returns (uint256) {
        unchecked {
            uint256 corners = load(face);
            bool isSet;
            receiver.isPlaced = false;
            uint256 boxesEnd = Faces.writeBoxes(state.boxes, state.sets, state.words, state.frame, corners);
            for (uint256 offset; offset != 32 * state.words; offset += 32) {
                uint256 bits;
                for (uint256 p = state.boxes; p != boxesEnd; p += 0x40) {
                    bits |= Faces.candidates(load(p), state.words, load(p + 0x20), offset);
                }
                if (bits != 0 && !isSet) {
                    isSet = true;
                    Receivers.setFace(receiver, face);
                }
                while (bits != 0) {
                    uint256 caster;
                    (caster, bits) = Receivers.next(receiver, bits, state.casters + 8 * CASTER_SIZE * offset);
                    if (caster == 0) break;
                    uint256 plane = state.planes + PLANES_SIZE * ((caster - state.casters) / CASTER_SIZE);
                    caster = load(caster);
                    uint256 shade = Receivers.test(receiver, caster, plane);
                    if (shade == MISSED) continue;
                    if (shade == COVERED) {
                        Receivers.clear(receiver);
                        return DARK;
                    }
                    if (!receiver.isPlaced) Receivers.place(receiver, Triangles.readIndices(source), state.width, state.height);
                    Receivers.add(receiver, caster);
                }
            }
            return receiver.isPlaced ? Receivers.finish(receiver, state.heads) : LIT;
        }
    }

    /// @dev Writes the entries and lists of all faces.
    function answer(State memory state) private pure returns (uint256 begin, uint256 size) {
        unchecked {
            uint256 face = state.faces[0];
            uint256 last = state.faces[state.faces.length - 1];
            begin = freeMemory();
            uint256 objects = state.faces.length - 1;
            uint256 target = begin + 32 * objects;
            for (uint256 i; i != objects; ++i) {
                store(begin + 32 * i, 32 * objects + (ENTRY_BITS / 8) * ((state.faces[i] - face) / FACE_RECORD_SIZE));
            }
            uint256 end = target + (((ENTRY_BITS / 8) * ((last - face) / FACE_RECORD_SIZE) + 31) & ~uint256(31));
            while (face != last) {
                uint256 word = 0;
                for (uint256 i; i != ENTRIES; ++i) {
                    word <<= ENTRY_BITS;
                    if (face == last) continue;
                    uint256 entry = load(face + FACE_ENTRY);
                    face += FACE_RECORD_SIZE;
                    if (entry > DARK) {
                        word |= end - begin;
                        end = copyList(entry, end);
                    } else {
                        word |= entry;
                    }
                }
                store(target, word);
                target += 32;
            }
            size = end - begin;
        }
    }

    /// @dev Copies a list.
    /// @return end The address after the last word.
    function copyList(uint256 list, uint256 target) private pure returns (uint256 end) {
        unchecked {
            end = target + load(list);
            assembly ("memory-safe") {
                mcopy(target, add(list, 0x20), mload(list))
            }
            store(end - 32, load(end - 32) | LAST_EDGE);
        }
    }
}
