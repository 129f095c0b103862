// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {Scene} from "shackled-contracts/scene/Scene.sol";
import {Model, ModelMaker, Shapes, Stage, StageMaker} from "shackled-contracts/building/SceneBuilder.sol";

/// @title ShapeGallery: the shapes and letters of docs/building.md, one scene each.
contract ShapeGallery {
    uint256 private constant CLAY = 0xd98e5f;
    uint256 private constant SAGE = 0x8fb08c;
    uint256 private constant SKY = 0x7ea6c9;
    uint256 private constant STRAW = 0xe3c878;
    uint256 private constant ROSE = 0xd0797c;

    function box() external pure returns (Scene memory) {
        Model memory m = ModelMaker.model();
        m.box(-100, 0, -60, 100, 120, 60, CLAY);
        return shown(m.pack(), false);
    }

    function sphere() external pure returns (Scene memory) {
        Model memory m = ModelMaker.model();
        m.sphere(0, 0, 0, 100, 24, 12, SKY);
        return shown(m.packSmooth(), true);
    }

    function cylinder() external pure returns (Scene memory) {
        Model memory m = ModelMaker.model();
        m.cylinder(0, 0, 0, 80, 160, 24, SAGE);
        return shown(m.packSmooth(), true);
    }

    function cone() external pure returns (Scene memory) {
        Model memory m = ModelMaker.model();
        m.cone(0, 0, 0, 90, 180, 24, STRAW);
        return shown(m.packSmooth(), true);
    }

    function lathe() external pure returns (Scene memory) {
        Model memory m = ModelMaker.model();
        // radius and height, from the foot along the outside to the inside
        string memory vase = "0,0 50,0 50,0 48,8 60,25 75,50 80,80 74,108 58,132 42,150 36,170 40,188 50,200 44,200 30,170 0,150";
        m.lathe(0, 0, 0, Shapes.points(vase), 24, ROSE);
        return shown(m.packSmooth(), true);
    }

    function torus() external pure returns (Scene memory) {
        Model memory m = ModelMaker.model();
        m.torus(0, 0, 0, 100, 30, 32, 16, STRAW);
        return shown(m.packSmooth(), true);
    }

    function extrusion() external pure returns (Scene memory) {
        Model memory m = ModelMaker.model();
        m.extrusion(Shapes.star(100, 45, 5), -25, 25, STRAW);
        return shown(m.pack(), false);
    }

    function text() external pure returns (Scene memory) {
        Model memory m = ModelMaker.model();
        m.text("Hello,\n#1234", 0, 0, 0, 100, 30, CLAY);
        Stage memory stage = StageMaker.stage(320, 200);
        stage.add(m.pack(), StageMaker.flat(35, 70, 20, 20));
        stage.fieldOfView(30);
        stage.fit(StageMaker.units(-2, 2, 6));
        stage.antialias();
        return stage.scene;
    }

    function alphabet() external pure returns (Scene memory) {
        Model memory m = ModelMaker.model();
        string memory all =
            "ABCDEFGHIJKLM\nNOPQRSTUVWXYZ\nabcdefghijklmn\nopqrstuvwxyz\n0123456789\n!\"#$%&'()*+,-./:;\n<=>?@[\\]^_`{|}~";
        m.text(all, 0, 0, 0, 80, 20, 0xe8e2d0);
        Stage memory stage = StageMaker.stage(480, 440);
        stage.orthographic(1);
        stage.add(m.pack(), StageMaker.flat(35, 70, 20, 20));
        stage.fit(StageMaker.units(-1, 1, 8));
        stage.antialias();
        return stage.scene;
    }

    /// @dev Returns the scene of one mesh that fills the picture.
    function shown(bytes memory mesh, bool smooth) private pure returns (Scene memory) {
        Stage memory stage = StageMaker.stage(160, 160);
        stage.add(mesh, smooth ? StageMaker.smooth(30, 70, 30, 30) : StageMaker.flat(30, 70, 30, 30));
        stage.fieldOfView(30);
        stage.fit(StageMaker.units(2, 3, 6));
        stage.antialias();
        return stage.scene;
    }
}
