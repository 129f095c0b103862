// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Scene} from "../../contracts/src/scene/Scene.sol";
import {Model, ModelMaker, Stage, StageMaker} from "../../contracts/src/studio/SceneBuilder.sol";

/// @notice Builds meshes and scenes as it is told.
contract BuilderProbe {
    struct V {
        int256 x;
        int256 y;
        int256 z;
        uint256 color;
    }

    function mesh(uint256 maxVertices, uint256 maxFaces, V[] memory vertices, uint256[3][] memory faces)
        external
        pure
        returns (bytes memory packed, bytes memory behind)
    {
        Model memory m = ModelMaker.model(maxVertices, maxFaces);
        // what is set aside is not what others get
        behind = abi.encodePacked(uint256(0x1234567890abcdef), uint256(0xfedcba0987654321));
        for (uint256 k; k < vertices.length; ++k) {
            uint256 index = m.vertex(vertices[k].x, vertices[k].y, vertices[k].z, vertices[k].color);
            assert(index == k);
        }
        for (uint256 k; k < faces.length; ++k) m.face(faces[k][0], faces[k][1], faces[k][2]);
        packed = m.pack();
    }

    function addAfterPacking() external pure {
        Model memory m = ModelMaker.model(4, 4);
        m.vertex(1, 2, 3, 4);
        m.pack();
        m.vertex(1, 2, 3, 4);
    }

    function box() external pure returns (bytes memory packed) {
        Model memory m = ModelMaker.model(8, 12);
        m.box(-10, -20, -30, 40, 50, 60, 0x102030);
        return m.pack();
    }

    /// @notice A scene of two objects of one model, which has room for more.
    function twoOfOne(uint256 spareVertices, uint256 spareFaces) external pure returns (Scene memory) {
        Model memory m = ModelMaker.model(8 + spareVertices, 12 + spareFaces);
        m.box(-10, -20, -30, 40, 50, 60, 0x102030);
        Stage memory stage = StageMaker.stage(20, 10, 2);
        stage.add(m.pack(), StageMaker.unlit());
        stage.add(m.pack(), StageMaker.unlit());
        return stage.scene;
    }

    function extended() external pure returns (Scene memory) {
        Stage memory stage = StageMaker.stage(20, 10, 3);
        stage.antialias();
        stage.add(hex"0000000000", StageMaker.unlit());
        stage.fade(99);
        stage.fade(50);
        stage.sun(StageMaker.units(-1, 2, 3), 0xffffff);
        stage.spot(StageMaker.units(10, -20, 30), StageMaker.units(0, 1, -2), 90, -50, 0x808080);
        stage.add(hex"0000000000", StageMaker.unlit());
        stage.add(hex"0000000000", StageMaker.unlit());
        stage.fade(0);
        stage.spot(StageMaker.units(1, 2, 3), StageMaker.units(-1, 0, 0), 100, 100, 0x010203);
        stage.antialias();
        stage.tone(150, true, false);
        stage.fog(0xc0ffee, 2, 5);
        stage.hemisphere(0x010203, 0x040506);
        stage.rim(0x070809, 4);
        stage.tone(50, false, true);
        return stage.scene;
    }

    function textured(uint256 flags, bytes memory palette, bytes memory texels, int256[2][] memory uvs) external pure returns (Scene memory) {
        Model memory m = ModelMaker.model(4, 2);
        m.vertex(-300, -300, 0, 0xffffff);
        m.vertex(300, -300, 0, 0xffffff);
        m.vertex(300, 300, 0, 0xffffff);
        m.vertex(-300, 300, 0, 0xffffff);
        m.quad(0, 1, 2, 3);
        Stage memory stage = StageMaker.stage(20, 10, 2);
        stage.add(hex"0000000000", StageMaker.unlit());
        stage.add(m.pack(), StageMaker.unlit());
        stage.texture(5, 3, flags, palette, texels, uvs);
        stage.tone(50, false, true);
        return stage.scene;
    }

    function seeThrough(bytes memory levels) external pure returns (Scene memory) {
        Model memory m = ModelMaker.model(8, 12);
        m.box(-100, -100, -100, 100, 100, 100, 0x102030);
        Stage memory stage = StageMaker.stage(20, 10, 2);
        stage.add(hex"0000000000", StageMaker.unlit());
        stage.opacities("");
        stage.add(m.pack(), StageMaker.unlit());
        stage.fade(50);
        stage.opacities(levels);
        stage.antialias();
        return stage.scene;
    }

    function scene(uint256 objects, uint256 added, uint256 lights) external pure returns (Scene memory) {
        Stage memory stage = StageMaker.stage(20, 10, objects);
        for (uint256 k; k < added; ++k) {
            stage.add(hex"0000000000", k % 2 == 0 ? StageMaker.flat(25, 50, 100, 7) : StageMaker.unlit()).rotation =
                StageMaker.turned(0, 90, 0);
        }
        for (uint256 k; k < lights; ++k) {
            if (k % 2 == 0) stage.sun(StageMaker.units(-1, 2, 3), 0xffffff);
            else stage.lamp(StageMaker.units(10, -20, 30), 0x808080);
        }
        return stage.scene;
    }
}
