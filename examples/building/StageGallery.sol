// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {Scene} from "shackled-contracts/scene/Scene.sol";
import {Framing, Model, ModelMaker, Shapes, Stage, StageMaker} from "shackled-contracts/building/SceneBuilder.sol";

/// @title StageGallery: the scenes of docs/building.md that show cameras, lights and objects.
contract StageGallery {
    uint256 private constant CLAY = 0xd98e5f;
    uint256 private constant SAGE = 0x8fb08c;
    uint256 private constant SKY = 0x7ea6c9;
    uint256 private constant STRAW = 0xe3c878;
    uint256 private constant ROSE = 0xd0797c;

    /// @notice Returns the same mesh with flat and with smooth shading.
    function shading() external pure returns (Scene memory) {
        Model memory m = ModelMaker.model();
        m.sphere(0, 0, 0, 100, 16, 10, SKY);
        Stage memory stage = StageMaker.stage(320, 160);
        stage.add(m.pack(), StageMaker.flat(30, 70, 30, 30)).position = StageMaker.units(-115, 0, 0);
        stage.add(m.packSmooth(), StageMaker.smooth(30, 70, 30, 30)).position = StageMaker.units(115, 0, 0);
        stage.fit(StageMaker.units(0, 1, 6));
        stage.antialias();
        return stage.scene;
    }

    /// @notice Returns three objects with the same mesh, one of them painted.
    function painted() external pure returns (Scene memory) {
        Model memory m = ModelMaker.model();
        m.cylinder(0, 0, 0, 30, 70, 20, SAGE);
        m.sphere(0, 110, 0, 45, 20, 10, SAGE);
        bytes memory pawn = m.packSmooth();
        Stage memory stage = StageMaker.stage(320, 160);
        for (int256 k = -1; k <= 1; ++k) {
            stage.add(pawn, StageMaker.smooth(30, 70, 30, 30)).position = StageMaker.units(130 * k, 0, 0);
        }
        stage.paint(1, ROSE);
        stage.fieldOfView(25);
        stage.fit(StageMaker.units(1, 2, 5));
        stage.antialias();
        return stage.scene;
    }

    /// @notice Returns a shape that is ten times as large as the box into which it is placed.
    function placed() external pure returns (Scene memory) {
        Model memory m = ModelMaker.model();
        m.extrusion(Shapes.star(1000, 450, 5), -250, 250, STRAW);
        Model memory table = ModelMaker.model();
        table.box(-100, -20, -100, 100, 0, 100, SKY);
        Stage memory stage = StageMaker.stage(160, 160);
        stage.add(table.pack(), StageMaker.flat(35, 70, 20, 20));
        stage.add(m.pack(), StageMaker.flat(35, 70, 20, 20)).rotation = StageMaker.turned(0, 45, 0);
        stage.place(Framing.box(-80, 0, -80, 80, 120, 80));
        stage.fieldOfView(30);
        stage.fit(StageMaker.units(2, 3, 6));
        stage.antialias();
        return stage.scene;
    }

    /// @notice Returns blocks, seen with this field of view in degrees, or by an orthographic camera (0), at the distance at which all fit.
    function lens(int256 degrees_) external pure returns (Scene memory) {
        Stage memory stage = blocks();
        if (degrees_ == 0) stage.orthographic(1);
        else stage.fieldOfView(degrees_);
        stage.fit(StageMaker.units(3, 3, 3));
        return stage.scene;
    }

    /// @notice Returns blocks without any light, with the default sun, or with a sun from the right.
    function lit(uint256 which) external pure returns (Scene memory) {
        Stage memory stage = blocks();
        if (which == 0) stage.dark();
        if (which == 2) stage.sun(StageMaker.units(6, 4, 1), 0xffd9a0);
        stage.fit(StageMaker.units(3, 3, 3));
        return stage.scene;
    }

    function blocks() private pure returns (Stage memory stage) {
        Model memory m = ModelMaker.model();
        for (int256 k; k < 9; ++k) {
            (int256 x, int256 z) = (k % 3 * 100, k / 3 * 100);
            m.box(x, 0, z, x + 60, 60 + 40 * (k * k % 4), z + 60, CLAY);
        }
        stage = StageMaker.stage(160, 160);
        stage.add(m.pack(), StageMaker.flat(35, 70, 0, 1));
        stage.antialias();
    }
}
