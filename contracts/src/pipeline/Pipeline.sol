// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Matrix} from "../math/Quaternion.sol";
import {Rectangle, Scene, Object, SMOOTH, FLAT, CULL_BACKFACES, WIREFRAME} from "../scene/Scene.sol";
import {Mesh, openMesh} from "../scene/Mesh.sol";
import {View, lookAt} from "./View.sol";
import {VertexShader} from "./VertexShader.sol";
import {PrimitiveAssembly} from "./PrimitiveAssembly.sol";
import {Lighting} from "./Lighting.sol";
import {Rasterizer} from "./Rasterizer.sol";
import {Wireframe} from "./Wireframe.sol";
import {Compositor} from "./Compositor.sol";
import "./Registers.sol";

// A picture from beginning to end. Memory holds, in this order: registers, vertices and triangles of all objects, the depths of a band
// of rows, and the pixels.

/// @dev Pixels of a band, so that the depth buffer stays small however large the picture is.
uint256 constant BAND_PIXELS = 16384;
/// @dev The background writes too much: less than one more row, or 96 bytes.
uint256 constant OVERHANG = 96;

/// @param pixels Address of the pixels: rows from the bottom without gaps, blue, green, red; before them are two free words.
/// @param size Their length in bytes.
/// @param triangles How many faces were to be drawn: see PrimitiveAssembly.
/// @param litPixels How many pixels they cover, if that was asked for.
struct Picture {
    uint256 pixels;
    uint256 size;
    uint256 triangles;
    uint256 litPixels;
}

/// @notice Draws a part of the canvas. The scene must have passed the checks.
function draw(Scene calldata scene, Rectangle memory tile, bool count) pure returns (Picture memory picture) {
    unchecked {
        reserveRegisters();
        View memory view_ = lookAt(scene.camera, scene.canvas.width, scene.canvas.height);
        store(COLUMN_BEGIN, tile.x + PIXEL_BIAS);
        store(COLUMN_END, tile.x + tile.width + PIXEL_BIAS);
        store(DEPTH_STRIDE, 8 * tile.width);
        Lighting.setLights(view_, scene.lights);

        uint256[2][] memory lists = new uint256[2][](scene.objects.length);
        for (uint256 i; i != lists.length; ++i) {
            uint256 drawn;
            (lists[i][0], lists[i][1], drawn) = assembleObject(scene, i, view_, tile);
            picture.triangles += drawn;
        }

        uint256 depth = freeMemory();
        uint256 bandRows = BAND_PIXELS / tile.width;
        if (bandRows > tile.height) bandRows = tile.height;
        // depths are read as whole words, of which 8 bytes count
        uint256 image = depth + 8 * bandRows * tile.width + 32 + 64;
        setFreeMemory(image + 3 * tile.width * (tile.height + 1) + OVERHANG);
        Compositor.background(image, scene.background.top, scene.background.bottom, scene.canvas.height, tile);

        for (uint256 bottom = tile.height; bottom != 0;) {
            // bands go up, as the rows of the file do
            uint256 top = bottom < bandRows ? 0 : bottom - bandRows;
            setBand(tile, depth, image, top, bottom);
            for (uint256 i; i != lists.length; ++i) {
                Object calldata object = scene.objects[i];
                // what a single object needs is still there from the band before
                if (lists.length != 1 || bottom == tile.height) {
                    Lighting.setObject(view_, scene, object, object.rotation.toMatrix(), openMesh(object.mesh));
                }
                if (object.flags & WIREFRAME == 0) Rasterizer.run(lists[i][0], lists[i][1]);
                else Wireframe.run(lists[i][0], lists[i][1]);
            }
            if (count) picture.litPixels += Compositor.litPixels(depth, depth + 8 * (bottom - top) * tile.width);
            bottom = top;
        }

        picture.pixels = image;
        picture.size = 3 * tile.width * tile.height;
        if (scene.invert != 0) Compositor.invert(image, picture.size);
    }
}

/// @dev Vertices and triangles of one object, after what memory holds already.
function assembleObject(Scene calldata scene, uint256 index, View memory view_, Rectangle memory tile)
    pure
    returns (uint256 list, uint256 end, uint256 drawn)
{
    unchecked {
        Object calldata object = scene.objects[index];
        Mesh memory mesh = openMesh(object.mesh);
        Matrix memory rotation = object.rotation.toMatrix();
        VertexShader.setMatrix(view_, object, rotation);
        VertexShader.setNormalMatrix(view_, rotation);
        setRounding(tile, object.flags & WIREFRAME != 0);
        uint256 shift = recordShift(object.material.shading, object.material.specular.raw() != 0, scene.lights.length > 1);
        uint256 records = freeMemory();
        VertexShader.run(mesh, records, 1 << shift, object.material.shading == SMOOTH);
        list = records + (mesh.vertexCount << shift);
        uint256 free;
        (end, free, drawn) = PrimitiveAssembly.run(mesh, records, shift, list, object.flags & CULL_BACKFACES != 0, index);
        setFreeMemory(free);
    }
}

/// @dev The size of a vertex record, as a power of two: position, colour, and what the fragment shader keeps there.
function recordShift(uint256 shading, bool hasSpecular, bool hasManyLights) pure returns (uint256) {
    unchecked {
        if (shading == SMOOTH) return 8;
        if (shading == FLAT && hasSpecular) return hasManyLights ? 8 : 7;
        return 6;
    }
}

/// @dev Which rows and columns a vertex touches: for a face the pixel centres from it on, for a line the pixels nearest to it.
function setRounding(Rectangle memory tile, bool wireframe) pure {
    unchecked {
        uint256 wider = wireframe ? 0 : 127;
        store(TILE_LEFT, ((tile.x + PIXEL_BIAS) << 8) - 128 - wider);
        store(TILE_SPAN, (tile.width << 8) - 1 + 2 * wider + (wider & 2));
        store(ROUND_TOP, (128 + wider) << 128);
        store(ROUND_BOTTOM, uint256(wireframe ? 128 + 256 : 255) << 128);
    }
}

/// @dev Rows `top` to before `bottom` of the tile, and where their depths and colours are.
function setBand(Rectangle memory tile, uint256 depth, uint256 image, uint256 top, uint256 bottom) pure {
    unchecked {
        uint256 first = tile.y + PIXEL_BIAS;
        store(BAND_TOP, first + top);
        store(BAND_BOTTOM, first + bottom);
        store(DEPTH_ORIGIN, depth + 8 * ((first + bottom - 1) * tile.width - tile.x - PIXEL_BIAS));
        store(IMAGE_ORIGIN, image + 3 * (tile.height - bottom) * tile.width - 3 * (depth >> 3));
        // and the word behind them, since depths are read as whole words
        uint256 size = 8 * (bottom - top) * tile.width + 32;
        assembly ("memory-safe") {
            // beyond its end calldata is zero
            calldatacopy(depth, calldatasize(), size)
        }
    }
}

function freeMemory() pure returns (uint256) {
    return load(0x40);
}

function setFreeMemory(uint256 free) pure {
    store(0x40, free);
}
