// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Extensions} from "../scene/Extensions.sol";
import {SHADOW} from "../words/Records.sol";
import {Mesh, openMesh} from "../scene/Mesh.sol";
import {Object, Scene, CULL_BACKFACES, FLAT, UNLIT, WIREFRAME, ZERO, Vector, normalize} from "../scene/Scene.sol";
import {Triangles} from "../pipeline/geometry/Triangles.sol";
import {Transform} from "../uniforms/Transform.sol";
import {View} from "../uniforms/View.sol";
import {Casters, ShadowScene} from "./Casters.sol";
import {Clipping} from "./Clipping.sol";
import {CASTER_SIZE, FACE_ENTRY, FACE_RECORD_SIZE, FACE_SIDE, Faces, PLANES_SIZE} from "./Faces.sol";
import {LightSpace} from "./LightSpace.sol";
import {Outlines} from "./Outlines.sol";
import {SHADOW_DARK, SHADOW_ENTRY_AT, SHADOW_ENTRY_SIZE} from "./ShadowRows.sol";
import {COVERED, MISSED, Receiver, Receivers} from "./Receivers.sol";
import "../words/EffectRegisters.sol";

// Computes `Shadow` of picture.py.
// Computes which parts of which faces a light does not reach.
//
// Every shadow caster is a set of four half-spaces, exact in integers: its three sides as seen from the light, and the half-space behind
// it. For each face that the light may reach, the faces that may shade it are found: see Faces. Most faces are entirely lit or entirely
// dark; for the others, each half-space becomes a function of the position on the canvas: see Outlines.

library Shadows {
    uint256 private constant LIT = 0;

    /// @notice Computes the parts that the light of the SHADOW does not reach. The registers of the frame must be set: see EffectUniforms.
    /// @return begin The address of the result: for each object a word, the offset of its faces' entries from the beginning. Then the
    /// entries, 4 bytes for each face of all objects: 0 if it is lit, 1 if it is dark, otherwise the offset, in words, of the functions of
    /// the shadows on it: see Outlines. The entries are padded to whole words, with at least 28 bytes.
    /// @return size The size of the result in bytes.
    function cast(Scene calldata scene, View memory view_) internal pure returns (uint256 begin, uint256 size) {
        unchecked {
            uint256 light = (load(SHADOW_LIGHT) - LIGHTS) / LIGHT_SIZE;
            ShadowScene memory state;
            (state.width, state.height, state.light) = (scene.canvas.width, scene.canvas.height, light);
            int256[6] memory bounds = Casters.readVertices(scene, state);
            if (bounds[0] <= bounds[3]) {
                state.frame = LightSpace.frameOf(scene.lights[light], bounds);
                LightSpace.place(state.frame, state.vertices[0], state.vertices[scene.objects.length]);
                setEye(scene, view_, state);
                Casters.readFaces(scene, state, loadCalldata(Extensions.find(scene, SHADOW, light)));
                Receiver memory receiver;
                (receiver.isPoint, receiver.chains) = (state.frame.isPoint, state.chains);
                Receivers.open(receiver);
                for (uint256 i; i != scene.objects.length; ++i) shadeObject(scene, view_, state, receiver, i);
            } else {
                Casters.readFaces(scene, state, 0);
            }
            return answer(state);
        }
    }

    function setEye(Scene calldata scene, View memory view_, ShadowScene memory state) private pure {
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

    /// @dev Sets the entries of the faces of an object.
    function shadeObject(Scene calldata scene, View memory view_, ShadowScene memory state, Receiver memory receiver, uint256 index)
        private pure
    {
        unchecked {
            Object calldata object = scene.objects[index];
            Mesh memory mesh = openMesh(object.mesh);
            bool isReceiver = object.material.shading != UNLIT && object.flags & WIREFRAME == 0;
            if (isReceiver) {
                Transform.setMatrix(view_, object, object.rotation.toMatrix());
                assembly ("memory-safe") {
                    mcopy(MESH_VERTICES, mesh, 0xc0) // the registers of the mesh
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
                let i := mload(add(face, 0x20)) // its normal n
                let j := mload(add(face, 0x40)) // n.y
                let k := mload(add(face, 0x60))
                seen := add(add(mul(i, mload(eye)), mul(j, mload(add(eye, 0x20)))), mul(k, mload(add(eye, 0x40)))) // n . eye
                switch isOrthographic
                case 0 { // perspective
                    let a := and(mload(face), FACE_A_MASK) // n . (eye - a)
                    seen := sub(seen, add(add(mul(i, mload(a)), mul(j, mload(add(a, 0x20)))), mul(k, mload(add(a, 0x40))))) // - n . a
                }
                default { seen := sub(0, seen) } // the eye is against the viewing direction
                let sign := sar(SIGN_AT, i) // -1 if negative
                slack := sub(xor(i, sign), sign) // |i|
                sign := sar(SIGN_AT, j)
                slack := add(slack, sub(xor(j, sign), sign)) // + |j|
                sign := sar(SIGN_AT, k)
                slack := add(slack, sub(xor(k, sign), sign)) // + |k|
                slack := shl(2, slack) // 4 (|i| + |j| + |k|): more than the rounding of coordinates changes
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
                    let data := calldataload(place) // the normal n of a vertex
                    cosine := mul(sar(MESH_NORMAL_AT, data), mload(toward)) // n.x toward.x
                    cosine := add(cosine, mul(sar(MESH_NORMAL_AT, shl(MESH_NORMAL_Y, data)), mload(add(toward, 0x20)))) // + n.y toward.y
                    cosine := add(cosine, mul(sar(MESH_NORMAL_AT, shl(MESH_NORMAL_Z, data)), mload(add(toward, 0x40)))) // n . toward
                }
                if (cosine > 0) return false;
            }
            return true;
        }
    }

    /// @return The entry of a face: LIT, SHADOW_DARK, or the address of a list: see Outlines.finish.
    function shadeFace(ShadowScene memory state, Receiver memory receiver, uint256 face, uint256 source) private pure returns (uint256) {
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
                        Outlines.clear(receiver);
                        return SHADOW_DARK;
                    }
                    if (!receiver.isPlaced) Clipping.place(receiver, Triangles.readIndices(source), state.width, state.height);
                    Outlines.add(receiver, caster);
                }
            }
            return receiver.isPlaced ? Outlines.finish(receiver, state.heads) : LIT;
        }
    }

    /// @dev Writes the entries and lists of all faces.
    function answer(ShadowScene memory state) private pure returns (uint256 begin, uint256 size) {
        unchecked {
            uint256 objects = state.faces.length - 1;
            (uint256 face, uint256 last) = (state.faces[0], state.faces[objects]);
            begin = freeMemory();
            uint256 target = begin + 32 * objects;
            for (uint256 i; i != objects; ++i) {
                store(begin + 32 * i, target - begin + SHADOW_ENTRY_SIZE * ((state.faces[i] - face) / FACE_RECORD_SIZE));
            }
            // entries are written as words, of which the last reaches beyond it
            uint256 end = target + ((SHADOW_ENTRY_SIZE * ((last - face) / FACE_RECORD_SIZE) + 63 - SHADOW_ENTRY_SIZE) & ~uint256(31));
            for (; face != last; face += FACE_RECORD_SIZE) {
                uint256 entry = load(face + FACE_ENTRY);
                store(target, (entry > SHADOW_DARK ? end - begin : entry) << SHADOW_ENTRY_AT);
                if (entry > SHADOW_DARK) end = copyList(entry, end);
                target += SHADOW_ENTRY_SIZE;
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
                mcopy(target, add(list, 0x20), mload(list)) // without its size
            }
            store(end - 32, load(end - 32) | LAST_EDGE);
        }
    }
}
