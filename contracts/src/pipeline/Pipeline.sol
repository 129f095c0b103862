// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Matrix} from "../math/Quaternion.sol";
import {Rectangle, Scene, Object, Light, SMOOTH, FLAT, CULL_BACKFACES} from "../scene/Scene.sol";
import {Mesh, openMesh} from "../scene/Mesh.sol";
import "../scene/Checks.sol";
import {View, lookAt} from "./View.sol";
import {VertexShader} from "./VertexShader.sol";
import {PrimitiveAssembly} from "./PrimitiveAssembly.sol";
import {Lighting} from "./Lighting.sol";
import {Rasterizer} from "./Rasterizer.sol";
import {Compositor} from "./Compositor.sol";
import "./Registers.sol";

function draw(Scene calldata scene, Rectangle memory tile) pure returns (uint256 image, uint256 triangles) {
    unchecked {
        reserveRegisters();
        checkRectangle(scene, tile);
        checkCamera(scene.camera);
        View memory view_ = lookAt(scene.camera, scene.canvas.width, scene.canvas.height);
        store(TILE_LEFT, ((tile.x + PIXEL_BIAS - 1) << 8) + 1);
        store(TILE_SPAN, ((tile.width + 1) << 8) - 1);
        store(COLUMN_BEGIN, tile.x + PIXEL_BIAS);
        store(COLUMN_END, tile.x + tile.width + PIXEL_BIAS);
        Lighting.setLights(view_, scene.lights);
        uint256[2][] memory lists = new uint256[2][](scene.objects.length);
        for (uint256 i; i != scene.objects.length; ++i) {
            Object calldata object = scene.objects[i];
            Mesh memory mesh = openMesh(object.mesh, i);
            checkObject(object, mesh, i);
            Matrix memory rotation = object.rotation.toMatrix();
            VertexShader.setMatrix(view_, object, rotation);
            VertexShader.setNormalMatrix(view_, rotation);
            uint256 shift = object.material.shading == SMOOTH ? (scene.lights.length > 1 ? 9 : 8) : object.material.shading == FLAT && object.material.specular.raw() != 0 ? (scene.lights.length > 1 ? 8 : 7) : 6;
            uint256 records;
            assembly ("memory-safe") { records := mload(0x40) }
            VertexShader.run(mesh, records, 1 << shift, object.material.shading == SMOOTH);
            uint256 list = records + (mesh.vertexCount << shift);
            (uint256 end, uint256 drawn) = PrimitiveAssembly.run(mesh, records, shift, list, object.flags & CULL_BACKFACES != 0, i);
            triangles += drawn;
            assembly ("memory-safe") { mstore(0x40, end) }
            lists[i] = [list, end];
        }
        uint256 depth;
        assembly ("memory-safe") { depth := mload(0x40) }
        uint256 pixels = tile.width * tile.height;
        uint256 bmp = depth + 8 * pixels + 32;
        image = bmp + 64 + 54;
        assembly ("memory-safe") { mstore(0x40, add(image, add(mul(3, pixels), 32))) }
        Compositor.background(image, scene.background.top, scene.background.bottom, scene.canvas.height, tile);
        store(BAND_TOP, tile.y + PIXEL_BIAS);
        store(BAND_BOTTOM, tile.y + tile.height + PIXEL_BIAS);
        store(DEPTH_STRIDE, 8 * tile.width);
        store(DEPTH_ORIGIN, depth + 8 * ((tile.y + tile.height + PIXEL_BIAS - 1) * tile.width - tile.x - PIXEL_BIAS));
        store(IMAGE_ORIGIN, image - 3 * (depth >> 3));
        for (uint256 i; i != lists.length; ++i) {
            Object calldata object = scene.objects[i];
            Lighting.setObject(view_, scene, object, object.rotation.toMatrix(), openMesh(object.mesh, i));
            Rasterizer.run(lists[i][0], lists[i][1]);
        }
    }
}
