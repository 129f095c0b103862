// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Mesh} from "../scene/Mesh.sol";
import {Rectangle, CULL_BACKFACES, WIREFRAME} from "../scene/Scene.sol";
import {Indices} from "./Indices.sol";
import {VertexShader} from "./VertexShader.sol";
import {PrimitiveAssembly} from "./PrimitiveAssembly.sol";
import {Clipper} from "./Clipper.sol";
import {Compositor} from "./Compositor.sol";
import "./Registers.sol";

// A picture from beginning to end. Memory holds, in this order: registers, vertices and listed triangles of all objects, the pixels, and
// the depths of a band of rows.

/// @dev Pixels of a band, so that the depth buffer stays small however large the picture is.
uint256 constant BAND_PIXELS = 16384;

/// @param pixels Address of the pixels: rows from the bottom without gaps, blue, green, red; before them are two free words.
/// @param size Their length in bytes, or that of the pixels and the depths behind them: see RETURNS_DEPTHS.
/// @param triangles How many faces were to be drawn: see PrimitiveAssembly.
/// @param litPixels How many pixels they cover, if that was asked for.
struct Picture {
    uint256 pixels;
    uint256 size;
    uint256 triangles;
    uint256 litPixels;
}

abstract contract Pipeline is PrimitiveAssembly {
    /// @notice Draws the edges of the triangles of a list, if this engine is one for wires.
    function drawWires(uint256 list, uint256 end) internal pure virtual;

    /// @notice Fills the pixels with the background, or with what was drawn before, and reserves the memory of the depths behind them.
    /// @param image Address of the pixels.
    /// @param bandRows How many rows of depths are kept at a time.
    /// @param lists Of each object the vertex records, the list of its triangles, the end of that.
    /// @return size Bytes from `image` on that are to be returned: see Picture.
    function openPicture(Rectangle memory tile, uint256 image, uint256 bandRows, uint256[3][] memory lists)
        internal
        pure
        virtual
        returns (uint256 size);

    /// @notice Makes the depths ready for the rows `top` to before `bottom` of the tile.
    function openBand(Rectangle memory tile, uint256 image, uint256 top, uint256 bottom) internal pure virtual;

    /// @notice Brings what was drawn in the band to its pixels.
    function closeBand() internal pure virtual;

    /// @notice How many pixels of the band are covered, which has so many rows.
    function litPixels(uint256 bandRows) internal pure virtual returns (uint256);

    /// @notice Draws a part of the canvas. The data behind the selector are those of `Uniforms.sol`.
    /// @return Two words without the ABI's offsets and lengths: how many triangles were left after culling and clipping, how many pixels
    /// they cover (0 if not counted); then the pixels, blue, green, red, rows from the bottom, and the depths, if they are asked for.
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
            reserveRegisters(REGISTERS, REGISTERS_END);
            copyCalldata(REGISTERS, 4, FRAME_SIZE);
            // once, since what is allocated later stands behind the depths, and makes memory grow over rows that nothing touches
            Rectangle memory tile;
            Mesh memory mesh;
            assembly ("memory-safe") {
                tile := TILE_X
                mesh := MESH_VERTICES
            }
            store(STRIDE_LANES, (8 * tile.width << EDGE_ADDRESS_FRACTION) * ONES_128);

            uint256 bandRows = BAND_PIXELS / tile.width;
            if (bandRows > tile.height) bandRows = tile.height;
            bool atOnce = bandRows == tile.height;
            // of each object the vertex records, the list of its triangles, the end of that
            uint256[3][] memory lists = new uint256[3][](load(OBJECT_COUNT));
            uint256 uniforms = load(OBJECTS);
            for (uint256 i; i != lists.length; ++i) {
                uniforms = readObject(uniforms);
                uint256 drawn;
                (lists[i][0], lists[i][1], lists[i][2], drawn) = assembleObject(mesh, load(OBJECT_FIRST) + i, atOnce);
                // what is not seen at all is checked only
                if (load(OPACITY) != 0) picture.triangles += drawn;
            }

            uint256 image = freeMemory() + 64;
            picture.pixels = image;
            if (load(ONLY_COUNTS) != 0) return picture;
            picture.size = openPicture(tile, image, bandRows, lists);

            for (uint256 bottom = tile.height; bottom != 0;) {
                // bands go up, as the rows of the file do
                uint256 top = bottom < bandRows ? 0 : bottom - bandRows;
                store(BAND_TOP, tile.y + PIXEL_BIAS + top);
                store(BAND_BOTTOM, tile.y + PIXEL_BIAS + bottom);
                openBand(tile, image, top, bottom);
                uniforms = load(OBJECTS);
                for (uint256 i; i != lists.length; ++i) {
                    // what a single object needs is still there
                    if (lists.length != 1) uniforms = readObject(uniforms);
                    uint256 mode = load(OBJECT_MODE);
                    if (load(OPACITY) == 0) continue;
                    if (mode & IS_BLENDED != 0) {
                        // first which of its surfaces is the nearest, then its colour
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
    /// @return next Where those of the next begin.
    function readObject(uint256 position) internal pure virtual returns (uint256 next) {
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

    /// @return drawn How many faces were drawn that were not listed before.
    function drawObject(Mesh memory mesh, uint256[3] memory list, bool atOnce, uint256 shift) private pure returns (uint256 drawn) {
        if (load(OBJECT_FLAGS) & WIREFRAME == 0) {
            if (atOnce) (, drawn) = assemble(mesh, list[0], shift, 0, load(OBJECT_FLAGS) & CULL_BACKFACES != 0);
            drawList(list[1], list[2]);
        } else {
            drawWires(list[1], list[2]);
        }
    }

    /// @dev Vertices and triangles of the object whose uniforms were read, after what memory holds already.
    /// @param atOnce Whether faces that need no clipping are drawn at once, and are not to be listed.
    function assembleObject(Mesh memory mesh, uint256 index, bool atOnce)
        private
        pure
        returns (uint256 records, uint256 list, uint256 end, uint256 drawn)
    {
        unchecked {
            uint256 mode = load(OBJECT_MODE);
            uint256 shift = recordShift(mode);
            records = freeMemory();
            store(HAS_CLIPPED, 0);
            VertexShader.run(mesh, records, 1 << shift, mode & IS_SMOOTH != 0);
            Indices.check(mesh, index);
            list = records + (mesh.vertexCount << shift);
            end = list;
            bool cull = load(OBJECT_FLAGS) & CULL_BACKFACES != 0;
            if (!atOnce || load(OBJECT_FLAGS) & WIREFRAME != 0) (end, drawn) = assemble(mesh, records, shift, list, cull);
            uint256 free = end;
            if (load(HAS_CLIPPED) != 0) {
                uint256 cut;
                (end, free, cut) = Clipper.run(mesh, records, shift, end, cull);
                drawn += cut;
            }
            setFreeMemory(free);
        }
    }

    /// @dev The size of a vertex record, as a power of two: position, colour, and what the fragment shader keeps there.
    function recordShift(uint256 mode) internal pure returns (uint256) {
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
