// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Mesh} from "../scene/Mesh.sol";
import {Rectangle, CULL_BACKFACES, WIREFRAME} from "../scene/Scene.sol";
import {Indices} from "./geometry/Indices.sol";
import {VertexShader} from "./geometry/VertexShader.sol";
import {PrimitiveAssembly} from "./geometry/PrimitiveAssembly.sol";
import {Clipper} from "./geometry/Clipper.sol";
import {Compositor} from "./Compositor.sol";
import "../words/Registers.sol";

// Computes `draw` of picture.py, band by band.
// Draws a picture from beginning to end. Memory contains, in this order: registers, vertices and listed triangles of all objects, the
// pixels, and the depths of a band of rows.

/// @dev The number of pixels in a band, which bounds the depth buffer for pictures of any size.
uint256 constant BAND_PIXELS = 16384;

/// @param pixels The address of the pixels: rows from the bottom without padding; blue, green, red. Two free words precede it.
/// @param size The length of the pixels in bytes, or of the pixels and the depths after them: see RETURNS_DEPTHS.
/// @param triangles The number of faces to draw: see PrimitiveAssembly.
/// @param litPixels The number of pixels they cover, if counted.
struct Picture {
    uint256 pixels;
    uint256 size;
    uint256 triangles;
    uint256 litPixels;
}

abstract contract Pipeline is PrimitiveAssembly {
    /// @notice Returns the end of the registers that this engine uses.
    function registersEnd() internal pure virtual returns (uint256) {
        return REGISTERS_END;
    }

    /// @notice Returns the number of pixels in a band of this picture: BAND_PIXELS, or a part of it if it has few faces.
    function bandPixels() internal pure virtual returns (uint256) {
        return BAND_PIXELS;
    }

    /// @notice Called once, when the uniforms of the frame are in their registers.
    function openFrame() internal pure virtual {}

    /// @notice Called when the uniforms of an object are in their registers, before it is drawn.
    /// @param records The address of the object's vertex records.
    function openObject(uint256 records) internal pure virtual {}

    /// @notice Returns whether all triangles of an object are listed before any of them is drawn.
    function isListed() internal pure virtual returns (bool) {
        return false;
    }

    /// @notice Called when all triangles of an object are listed, if `isListed`: with the beginning and end of the list, before which
    /// are the vertex records, from the third address on, except for those that clipping made.
    /// @param free An address from which on memory is free, not before the end of the list. The word at that end is free, too.
    /// @return The first free address.
    function closeList(uint256, uint256, uint256, uint256 free) internal pure virtual returns (uint256) {
        return free;
    }

    /// @notice Called for each band before anything is drawn, with what `openPicture` was given.
    function openLists(uint256[3][] memory) internal pure virtual {}

    /// @notice Fills the pixels with the background, or with what was drawn before, and reserves memory for the depths after them.
    /// @param image The address of the pixels.
    /// @param bandRows The number of rows in a band.
    /// @param lists For each object, the vertex records, and the beginning and end of its list of triangles.
    /// @return size The number of bytes from `image` on to return: see Picture.
    function openPicture(Rectangle memory tile, uint256 image, uint256 bandRows, uint256[3][] memory lists)
        internal pure virtual returns (uint256 size);

    /// @notice Prepares the depths for the rows from `top` (inclusive) to `bottom` (exclusive) of the tile.
    function openBand(Rectangle memory tile, uint256 image, uint256 top, uint256 bottom) internal pure virtual;

    /// @notice Writes the samples of the band to its pixels.
    function closeBand() internal pure virtual;

    /// @notice Returns the number of covered pixels of the band, which has `bandRows` rows.
    function litPixels(uint256 bandRows) internal pure virtual returns (uint256);

    /// @notice Draws a part of the canvas. The calldata after the selector is in the format of `Uniforms.sol`.
    /// @return Two words without the ABI's offsets and lengths: the number of triangles left after culling and clipping, and the number of
    /// pixels they cover (0 if not counted); then the pixels, blue, green, red, rows from the bottom; then the depths, if requested.
    function drawTile() external pure returns (bytes memory) {
        Picture memory picture = draw();
        assembly ("memory-safe") {
            let data := sub(mload(picture), 0x40)
            mstore(data, mload(add(picture, 0x40)))
            mstore(add(data, 0x20), mload(add(picture, 0x60)))
            return(data, add(0x40, mload(add(picture, 0x20))))
        }
    }

    function draw() private pure returns (Picture memory picture) {
        unchecked {
            reserveRegisters(REGISTERS, registersEnd());
            copyCalldata(REGISTERS, 4, FRAME_SIZE);
            // allocated once: later allocations follow the depths, and would expand memory over untouched rows
            Rectangle memory tile;
            Mesh memory mesh;
            assembly ("memory-safe") {
                tile := TILE_X
                mesh := MESH_VERTICES
            }
            store(STRIDE_LANES, (8 * tile.width << EDGE_ADDRESS_FRACTION) * ONES_128);

            uint256 bandRows = bandPixels() / tile.width;
            if (bandRows > tile.height) bandRows = tile.height;
            bool atOnce = bandRows == tile.height;
            // for each object, the vertex records, and the beginning and end of its list of triangles
            uint256[3][] memory lists = new uint256[3][](load(OBJECT_COUNT));
            openFrame();
            uint256 uniforms = load(OBJECTS);
            for (uint256 i; i != lists.length; ++i) {
                uniforms = readObject(uniforms);
                uint256 drawn;
                (lists[i][0], lists[i][1], lists[i][2], drawn) = assembleObject(mesh, load(OBJECT_FIRST) + i, atOnce);
                // fully transparent objects are only checked
                if (load(OPACITY) != 0) picture.triangles += drawn;
            }

            uint256 image = freeMemory() + 64;
            picture.pixels = image;
            if (load(ONLY_COUNTS) != 0) return picture;
            picture.size = openPicture(tile, image, bandRows, lists);

            for (uint256 bottom = tile.height; bottom != 0;) {
                // bands go upward, like the rows of the file
                uint256 top = bottom < bandRows ? 0 : bottom - bandRows;
                store(BAND_TOP, tile.y + PIXEL_BIAS + top);
                store(BAND_BOTTOM, tile.y + PIXEL_BIAS + bottom);
                openBand(tile, image, top, bottom);
                openLists(lists);
                uniforms = load(OBJECTS);
                for (uint256 i; i != lists.length; ++i) {
                    // the uniforms of a single object are still in place
                    if (lists.length != 1) uniforms = readObject(uniforms);
                    openObject(lists[i][0]);
                    uint256 mode = load(OBJECT_MODE);
                    if (load(OPACITY) == 0) continue;
                    if (mode & IS_BLENDED != 0) {
                        // first find the nearest surface, then draw its colour
                        store(OBJECT_MODE, (mode & IS_ORTHOGRAPHIC) | IS_DEPTH_PASS);
                        drawObject(mesh, lists[i], atOnce, recordShift(mode));
                        store(OBJECT_MODE, mode);
                    }
                    picture.triangles += drawObject(mesh, lists[i], atOnce, recordShift(mode));
                }
                closeBand();
                if (load(COUNT_PIXELS) != 0) picture.litPixels += litPixels(bottom - top);
                bottom = top;
            }

            if (load(INVERT) != 0) Compositor.invert(image, picture.size);
        }
    }

    /// @dev Reads the uniforms of an object into their registers.
    /// @return next The position of the next object's uniforms.
    function readObject(uint256 position) internal pure returns (uint256 next) {
        unchecked {
            uint256 size;
            assembly ("memory-safe") {
                size := calldataload(position)
            }
            copyCalldata(OBJECT_BYTES, position, size);
            return position + size;
        }
    }

    function copyCalldata(uint256 target, uint256 position, uint256 size) internal pure {
        assembly ("memory-safe") {
            calldatacopy(target, position, size)
        }
    }

    /// @return drawn The number of faces drawn that were not listed before.
    function drawObject(Mesh memory mesh, uint256[3] memory list, bool atOnce, uint256 shift) private pure returns (uint256 drawn) {
        uint256 flags = load(OBJECT_FLAGS);
        // not a literal: see ZERO_SLOT
        if (atOnce && flags & WIREFRAME == 0 && !isListed()) {
            (, drawn) = assemble(mesh, list[0], shift, load(ZERO_SLOT), flags & CULL_BACKFACES != 0);
        }
        drawList(list[1], list[2]);
    }

    /// @dev Makes the vertices and triangles of the current object, after the data already in memory.
    /// @param atOnce Whether faces that need no clipping are drawn immediately, rather than listed.
    function assembleObject(Mesh memory mesh, uint256 index, bool atOnce)
        private pure returns (uint256 records, uint256 list, uint256 end, uint256 drawn)
    {
        unchecked {
            uint256 mode = load(OBJECT_MODE);
            uint256 shift = recordShift(mode);
            records = freeMemory();
            store(HAS_CLIPPED, 0);
            VertexShader.run(mesh, records, 1 << shift, isSmooth());
            Indices.check(mesh, index);
            list = records + (mesh.vertexCount << shift);
            if (hasBacks()) list = VertexShader.addBacks(records, list, 1 << shift);
            end = list;
            bool cull = load(OBJECT_FLAGS) & CULL_BACKFACES != 0;
            bool isWireframe = load(OBJECT_FLAGS) & WIREFRAME != 0;
            if (!atOnce || isWireframe || isListed()) (end, drawn) = assemble(mesh, records, shift, list, cull);
            if (isWireframe) end = dropShared(list, end, records, shift);
            uint256 free = end;
            if (load(HAS_CLIPPED) != 0) {
                uint256 cut;
                (end, free, cut) = Clipper.run(mesh, records, shift, end, cull, hasBacks());
                drawn += cut;
            }
            if (isListed()) free = closeList(list, end, records, free);
            setFreeMemory(free);
        }
    }

    /// @dev Returns the size of a vertex record as a power of two: position, colour, and the data that fragment shading stores there.
    function recordShift(uint256 mode) internal pure virtual returns (uint256) {
        unchecked {
            if (mode & IS_SMOOTH != 0) return 8;
            // flat with highlights: two words for each light
            if (mode & HAS_SPECULAR != 0) {
                uint256 end = load(LIGHTS_END);
                return end > LIGHTS + 3 * LIGHT_SIZE ? 9 : end > LIGHTS + LIGHT_SIZE ? 8 : 7;
            }
            return 6;
        }
    }
}
