// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Matrix} from "../math/Quaternion.sol";
import {Object, Rectangle, Scene, UNLIT, WIREFRAME} from "../scene/Scene.sol";
import {Extensions, OPACITY_SIZE, OPAQUE} from "../scene/Extensions.sol";
import {ANTIALIAS, OPACITIES_OF, OPACITY_OF, RECORD_HEADER} from "../scene/Records.sol";
import {Mesh, openMesh} from "../scene/Mesh.sol";
import {Lights} from "./Lights.sol";
import {Materials} from "./Materials.sol";
import {MeshSpace} from "./MeshSpace.sol";
import {Runs} from "./Runs.sol";
import {TileCulling} from "./TileCulling.sol";
import {SampleDepths} from "./SampleDepths.sol";
import {Transform} from "./Transform.sol";
import {View, lookAt} from "./View.sol";
import "../pipeline/Registers.sol";

// What is computed once for a frame or an object. The Renderer fills the registers at the addresses that they have in the engine, and
// hands them on as they stand. The data of a call of the engine are
//
//   4 bytes            selector
//   FRAME_SIZE bytes   the registers of the frame
//                      the scene, as it stands in the call of the Renderer, with all that follows it; the engine reads the meshes of it,
//                      in which for a tile only those faces are left that may touch it: see TileCulling. Then a word of any content
//   for each object:   its registers, OBJECT_BYTES bytes; not for those without faces in a tile
//                      what other engines have drawn before: see DRAWN_BEFORE

library Uniforms {
    /// @notice Writes the data of the call that has the engine draw a part of the canvas.
    /// @param room Bytes that are left free before them; free memory begins there.
    /// @return data Where they begin.
    /// @return end Where they end.
    function write(bytes4 selector, Scene calldata scene, Rectangle memory tile, bool countPixels, uint256 room)
        internal
        pure
        returns (uint256 data, uint256 end)
    {
        unchecked {
            // once for all calls
            if (freeMemory() < REGISTERS_END) reserveRegisters(REGISTERS, REGISTERS_END);
            View memory view_ = lookAt(scene.camera, scene.canvas.width, scene.canvas.height);
            uint256 extension = setFrame(view_, scene, tile);
            store(COUNT_PIXELS, countPixels ? 1 : 0);
            int256[2] memory range = [type(int256).max, type(int256).min];
            data = freeMemory() + room;
            uint256 size;
            uint256 moved;
            bool culls = tile.width < scene.canvas.width || tile.height < scene.canvas.height;
            // the coordinates of a texture are told by the numbers of vertices, and shadows by those of faces, which culling changes
            culls = culls && !Extensions.isLong(scene) && TileCulling.areApart(scene);
            assembly ("memory-safe") {
                size := sub(calldatasize(), scene)
                mstore(data, selector)
                end := add(data, add(4, FRAME_SIZE))
                calldatacopy(end, scene, size)
                // the place in the engine's calldata of what is at 0 in these
                moved := sub(add(4, FRAME_SIZE), scene)
                end := add(add(end, size), 32)
                mstore(OBJECTS, sub(end, data))
                mstore(OBJECTS_BEGIN, sub(end, data))
                mcopy(add(data, 4), REGISTERS, FRAME_SIZE)
            }
            uint256 count;
            for (uint256 i; i != scene.objects.length; ++i) {
                // what is allocated for an object is given up with it
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

    /// @notice Tile, background, and lights in camera space.
    /// @return extension The first record of the scene's extensions that belongs to no light.
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

    /// @dev Lanes of Q24: the lowest row of the tile, and the change from row to row upwards.
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
    /// @return The one after what is read here.
    function setOpacity(Scene calldata scene, uint256 object, uint256 extension) private pure returns (uint256) {
        unchecked {
            (, uint256 end) = Extensions.bounds(scene);
            if (!Extensions.isOf(extension, end, OPACITY_OF, object)) {
                store(OPACITY, OPAQUE);
                return extension;
            }
            store(OPACITY, Extensions.opacityOf(extension));
            return extension + RECORD_HEADER + OPACITY_SIZE;
        }
    }

    /// @param moved How much farther the scene stands in the engine's calldata; may be negative.
    /// @param copied If not 0, only what may touch the tile is to be left of the mesh; the scene in memory is so much farther.
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
            uint256 mode = view_.orthographic ? IS_ORTHOGRAPHIC : 0;
            bool hasEffects = load(EFFECTS) != 0;
            if (load(OPACITY) != OPAQUE) mode |= IS_BLENDED;
            else if (hasEffects && Extensions.find(scene, OPACITIES_OF, number) != 0) mode |= IS_BLENDED;
            uint256 end = OBJECT_LIT;
            if (object.material.shading != UNLIT) {
                mode |= Materials.set(view_, scene, object.material);
                if (mode & IS_SMOOTH != 0) Transform.setNormalMatrix(view_, rotation);
                else MeshSpace.set(view_, scene, object, rotation);
                // no square is beyond the beginning of a table that is not there
                if (load(SPECULAR_BEGIN) != type(uint256).max) end = SPECULAR_TABLE_END;
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
