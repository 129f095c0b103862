// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Object, Rectangle, Scene, TWO_SIDED, UNLIT, WIREFRAME, Matrix} from "../scene/Scene.sol";
import {Extensions, OPAQUE} from "../scene/Extensions.sol";
import {ANTIALIAS, OPACITY_OF, RECORD_HEADER} from "../words/Records.sol";
import {Mesh, openMesh} from "../scene/Mesh.sol";
import {Lights} from "./Lights.sol";
import {Materials} from "./Materials.sol";
import {MeshSpace} from "./MeshSpace.sol";
import {Runs} from "./Runs.sol";
import {TileCulling} from "./TileCulling.sol";
import {SampleDepths} from "./SampleDepths.sol";
import {Transform} from "./Transform.sol";
import {View, lookAt} from "./View.sol";
import "../words/Registers.sol";

// Computes the values of `read` of picture.py as registers.
// Computes the constants of a frame or an object. The Renderer fills the registers at their addresses in the engine, and passes them on
// unchanged. The calldata of an engine consists of
//
//   4 bytes            selector
//   FRAME_SIZE bytes   the registers of the frame
//                      the scene, as in the calldata of the Renderer, with everything after it; the engine reads its meshes. For a
//                      tile, these contain only the faces that may touch it: see TileCulling. Then a word of any content
//   for each object:   its registers, OBJECT_BYTES bytes; omitted for objects without faces in a tile
//                      the pixels and depths drawn by other engines: see DRAWN_BEFORE

/// @dev Vertices of a surface with two sides, for each of which OpenEdges has a number of 16 bits on either side.
uint256 constant MOST_WITH_BACKS = 32767;

library Uniforms {
    /// @notice Writes the calldata with which the engine draws a part of the canvas.
    /// @param room The number of bytes to leave free before the calldata, from the free memory pointer on.
    /// @return data The beginning of the calldata.
    /// @return end The end of the calldata.
    function write(bytes4 selector, Scene calldata scene, Rectangle memory tile, uint256 room)
        internal pure returns (uint256 data, uint256 end)
    {
        unchecked {
            // once for all calls
            if (freeMemory() < REGISTERS_END) reserveRegisters(REGISTERS, REGISTERS_END);
            View memory view_ = lookAt(scene.camera, scene.canvas.width, scene.canvas.height);
            uint256 extension = setFrame(view_, scene, tile);
            int256[2] memory range = [type(int256).max, type(int256).min];
            data = freeMemory() + room;
            uint256 size;
            uint256 moved;
            bool culls = tile.width < scene.canvas.width || tile.height < scene.canvas.height;
            // texture coordinates depend on the vertex indices and shadows on the face numbers, which culling changes
            culls = culls && !Extensions.isLong(scene) && TileCulling.areApart(scene);
            assembly ("memory-safe") {
                size := sub(calldatasize(), scene)
                mstore(data, selector)
                end := add(data, add(4, FRAME_SIZE))
                calldatacopy(end, scene, size)
                // the difference between positions in the engine's calldata and in this one
                moved := sub(add(4, FRAME_SIZE), scene)
                end := add(add(end, size), 32)
                mstore(OBJECTS, sub(end, data))
                mstore(OBJECTS_BEGIN, sub(end, data))
                mcopy(add(data, 4), REGISTERS, FRAME_SIZE)
            }
            uint256 count;
            for (uint256 i; i != scene.objects.length; ++i) {
                // frees the memory allocated for an object
                setFreeMemory(end);
                extension = setOpacity(scene, i, extension);
                if (!setObject(view_, scene, i, tile, moved, culls ? data + moved : 0, range)) continue;
                ++count;
                assembly ("memory-safe") {
                    mcopy(end, OBJECT_BYTES, mload(OBJECT_BYTES))
                    end := add(end, mload(OBJECT_BYTES))
                }
            }
            if (load(FRAME_IS_ANTIALIASED) != 0) SampleDepths.set(data + 4, range);
            Runs.setCount(data, count);
            setFreeMemory(data - room);
        }
    }

    /// @notice Sets the tile, the background, and the lights in camera space.
    /// @return extension The first record of the scene's extensions that does not belong to a light.
    function setFrame(View memory view_, Scene calldata scene, Rectangle memory tile) private pure returns (uint256 extension) {
        unchecked {
            store(COLUMN_BEGIN, tile.x + PIXEL_BIAS);
            store(COLUMN_END, tile.x + tile.width + PIXEL_BIAS);
            store(DEPTH_STRIDE, 8 * tile.width);
            assembly ("memory-safe") {
                mcopy(TILE_X, tile, 0x80)
            }
            (uint256 record, uint256 end) = Extensions.behind(scene, ANTIALIAS - 1);
            store(FRAME_IS_ANTIALIASED, record == end ? 0 : 1);
            setBackground(scene, tile);
            store(INVERT, scene.invert);
            extension = Lights.set(view_, scene);
        }
    }

    /// @dev Sets lanes of Q24: the lowest row of the tile, and the upward change from row to row.
    function setBackground(Scene calldata scene, Rectangle memory tile) private pure {
        unchecked {
            (uint256 top, uint256 bottom, uint256 height) = (scene.background.top, scene.background.bottom, scene.canvas.height);
            uint256 step = laneStep(top, bottom, height == 1 ? 1 : height - 1);
            uint256 lowest = (Lights.colorLanes(height == 1 ? top : bottom) << 24) + (ONES << 23);
            store(BACKGROUND, lowest + step * (height - tile.y - tile.height));
            store(BACKGROUND_STEP, step);
        }
    }

    function laneStep(uint256 top, uint256 bottom, uint256 rows) private pure returns (uint256 step) {
        unchecked {
            for (uint256 i; i != 3; ++i) {
                int256 difference = int256((top >> (8 * i)) & 0xff) - int256((bottom >> (8 * i)) & 0xff);
                step += uint256((difference << 24) / int256(rows)) << (MIDDLE_AT * i);
            }
        }
    }

    /// @param extension The next record of the scene's extensions.
    /// @return The record after the ones read here.
    function setOpacity(Scene calldata scene, uint256 object, uint256 extension) private pure returns (uint256) {
        unchecked {
            (, uint256 end) = Extensions.bounds(scene);
            if (!Extensions.isOf(extension, end, OPACITY_OF, object)) {
                store(OPACITY, OPAQUE);
                return extension;
            }
            store(OPACITY, Extensions.opacityOf(extension));
            return extension + RECORD_HEADER + Extensions.sizeOf(extension);
        }
    }

    /// @param moved The difference between the scene's positions in the engine's calldata and in this one; may be negative.
    /// @param copied If not 0, the mesh is reduced to the faces that may touch the tile; the difference between the scene's address in
    /// memory and its calldata offset.
    /// @param range The distances of all vertices, if the scene is antialiased: see SampleDepths.
    /// @return Whether there is something to draw.
    function setObject(
        View memory view_,
        Scene calldata scene,
        uint256 number,
        Rectangle memory tile,
        uint256 moved,
        uint256 copied,
        int256[2] memory range
    ) private pure returns (bool) {
        unchecked {
            Object calldata object = scene.objects[number];
            Matrix memory rotation = object.rotation.toMatrix();
            Transform.setMatrix(view_, object, rotation);
            Transform.setRounding(tile, object.flags & WIREFRAME != 0);
            Mesh memory mesh = openMesh(object.mesh);
            if (load(FRAME_IS_ANTIALIASED) != 0) SampleDepths.widen(mesh, range);
            if (copied != 0) {
                TileCulling.run(mesh, copied, number);
                if (mesh.faceCount == 0) return false;
            }
            mesh.vertices += moved;
            mesh.faces += moved;
            assembly ("memory-safe") {
                mcopy(MESH_VERTICES, mesh, 0xc0)
            }
            store(OBJECT_FLAGS, object.flags);
            store(BACK_COUNT, 0);
            uint256 mode = view_.orthographic ? IS_ORTHOGRAPHIC : 0;
            bool hasEffects = load(EFFECTS_SIZE) != 0;
            if (load(OPACITY) != OPAQUE) mode |= IS_BLENDED;
            else if (hasEffects && Extensions.isBlended(scene, number)) mode |= IS_BLENDED;
            uint256 end = OBJECT_LIT;
            if (object.material.shading != UNLIT) {
                mode |= Materials.set(view_, scene, object.material);
                if (mode & IS_SMOOTH != 0 && object.flags == TWO_SIDED) {
                    store(BACK_COUNT, mesh.vertexCount);
                    // OpenEdges numbers all records
                    if (mesh.vertexCount > MOST_WITH_BACKS) mode &= ~IS_QUADRATIC;
                }
                if (mode & IS_SMOOTH != 0) Transform.setNormalMatrix(view_, rotation);
                else MeshSpace.set(view_, scene, object, rotation);
                // no square exceeds the beginning of an absent table
                if (load(SPECULAR_BEGIN) != NO_HIGHLIGHT) end = SPECULAR_TABLE_END;
                else end = OBJECT_LIGHTS + scene.lights.length * LIGHT_SIZE;
            }
            if (hasEffects) {
                store(OBJECT_NUMBER, number);
                end = OBJECT_END;
            }
            store(OBJECT_MODE, mode);
            store(OBJECT_BYTES, end - OBJECT_BYTES);
            return true;
        }
    }
}
