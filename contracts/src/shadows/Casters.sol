// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Indices} from "../pipeline/geometry/Indices.sol";
import {Triangles} from "../pipeline/geometry/Triangles.sol";
import {Extensions} from "../scene/Extensions.sol";
import {Mesh, openMesh} from "../scene/Mesh.sol";
import {GROUND, OPACITY_OF, SHADOWS_ALL, SHADOWS_FRONT_FACES} from "../words/Records.sol";
import {CULL_BACKFACES, Object, Scene, WIREFRAME, Vector} from "../scene/Scene.sol";
import {CASTER_SIZE, FACE_RECORD_SIZE, FACE_SIDE, Faces, PLANES_SIZE, SET_SHIFT, INDEX_IN_SET} from "./Faces.sol";
import {BUCKETS, Frame, LightSpace, PLACE_SIZE} from "./LightSpace.sol";
import {CHAINS} from "./Outlines.sol";
import "../words/Registers.sol";

// Computes the planes of `Shadow` of picture.py.
// Reads all faces of a scene, and finds those that cast shadows.

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
struct ShadowScene {
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

library Casters {
    /// @dev Returns whether an object casts a shadow: not wireframes, translucent objects, or grounds.
    function casts(Scene calldata scene, uint256 index) private pure returns (bool) {
        return scene.objects[index].flags & WIREFRAME == 0 && Extensions.find(scene, OPACITY_OF, index) == 0
            && !Extensions.isBlended(scene, index) && Extensions.find(scene, GROUND, index) == 0;
    }

    /// @dev Writes all vertices in world space.
    /// @return bounds The bounds of the casters: the minimum coordinates, then the maximum ones.
    function readVertices(Scene calldata scene, ShadowScene memory state) internal pure returns (int256[6] memory bounds) {
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

    /// @dev Writes all faces, and the sets of those that cast shadows.
    /// @param rule Which faces of culled objects cast shadows; 0 if none do, and faces are only counted.
    function readFaces(Scene calldata scene, ShadowScene memory state, uint256 rule) internal pure {
        unchecked {
            state.casters = freeMemory();
            if (rule == 0) {
                uint256 begin = state.faces[0];
                assembly ("memory-safe") {
                    calldatacopy(begin, calldatasize(), sub(mload(0x40), begin)) // zeros
                }
                return;
            }
            uint256 end = state.casters;
            for (uint256 i; i != scene.objects.length; ++i) {
                setFreeMemory(end + 0x100);
                Object calldata object = scene.objects[i];
                Mesh memory mesh = openMesh(object.mesh);
                end = readObject(state, mesh, i, end, casts(scene, i) ? (object.flags & CULL_BACKFACES == 0 ? SHADOWS_ALL : rule) : 0);
            }
            uint256 count = (end - state.casters) / CASTER_SIZE;
            uint256 words = (count + INDEX_IN_SET) >> SET_SHIFT;
            (state.casterCount, state.words, state.sets) = (count, words, end);
            uint256 size = 5 * BUCKETS * words * 32 * state.frame.sides;
            assembly ("memory-safe") {
                calldatacopy(end, calldatasize(), size) // zeros
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
    function readObject(ShadowScene memory state, Mesh memory mesh, uint256 index, uint256 end, uint256 rule)
        private pure returns (uint256)
    {
        unchecked {
            uint256 face = state.faces[index];
            uint256 vertices = state.vertices[index];
            bool isPoint = state.frame.isPoint;
            uint256 last = state.faces[index + 1];
            for (uint256 source = mesh.faces; face != last; source += FACE_SIZE) {
                uint256 numbers = Triangles.readIndices(source);
                uint256 a = vertices + PLACE_SIZE * (numbers >> FACE_FIRST_AT);
                uint256 b = vertices + PLACE_SIZE * ((numbers >> FACE_SECOND_AT) & FACE_INDEX_MASK);
                uint256 c = vertices + PLACE_SIZE * (numbers & FACE_INDEX_MASK);
                Faces.write(face, a, b, c, isPoint);
                if (rule != 0) {
                    int256 side = loadSigned(face + FACE_SIDE);
                    if (side != 0 && (rule == SHADOWS_ALL || (side > 0) == (rule == SHADOWS_FRONT_FACES))) {
                        store(end, face);
                        Faces.pack(end + 0x20, a, b, c);
                        end += CASTER_SIZE;
                    }
                }
                face += FACE_RECORD_SIZE;
            }
            return end;
        }
    }
}
