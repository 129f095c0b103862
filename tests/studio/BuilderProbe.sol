// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Fixed} from "../../contracts/src/math/Fixed.sol";
import {Object, Scene} from "../../contracts/src/scene/Scene.sol";
import {Box, Framing, Model, ModelMaker, Stage, StageMaker} from "../../contracts/src/building/SceneBuilder.sol";

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

    /// @notice The bytes of a mesh, which do not change when more is added, and those of the larger mesh.
    function addAfterPacking() external pure returns (bytes memory, bytes memory) {
        Model memory m = ModelMaker.model(8, 12);
        m.box(-10, -20, -30, 40, 50, 60, 0x102030);
        bytes memory packed = m.pack();
        m.box(-10, -20, -30, 40, 50, 60, 0x102030);
        return (packed, m.pack());
    }

    /// @notice A mesh of as many vertices, and of faces all alike.
    function full(uint256 vertices, uint256 faces) external pure returns (bytes memory) {
        Model memory m = ModelMaker.model();
        for (uint256 k; k < vertices; ++k) m.vertex(1, 2, 3, 4);
        for (uint256 k; k < faces; ++k) m.face(0, 0, 0);
        return m.pack();
    }

    /// @notice Meshes as objects, each turned about y and moved along x, all seen from a direction: with a perspective camera, or with an
    /// orthographic one (0 degrees).
    function fitted(bytes[] memory meshes, int256 degrees_, int256[3] memory toward) external pure returns (Scene memory) {
        Stage memory stage = StageMaker.stage(60, 40);
        for (uint256 k; k < meshes.length; ++k) {
            Object memory object = stage.add(meshes[k], StageMaker.unlit());
            object.rotation = StageMaker.turned(0, int256(30 * k), 0);
            (object.position.x, object.scale) = (StageMaker.unit(int256(100 * k)), StageMaker.fraction(1, int256(k + 1)));
        }
        if (degrees_ == 0) stage.orthographic(1);
        else stage.fieldOfView(StageMaker.fraction(degrees_, 10));
        stage.fit(StageMaker.units(toward[0], toward[1], toward[2]));
        return stage.scene;
    }

    /// @notice A mesh of some scale, seen from a direction, white before black.
    function alone(bytes memory packed, int256 numerator, int256 denominator, int256[3] memory toward) external pure returns (Scene memory) {
        Stage memory stage = StageMaker.stage(64, 64);
        stage.background(0, 0);
        stage.add(packed, StageMaker.unlit()).scale = StageMaker.fraction(numerator, denominator);
        stage.paint(0xffffff);
        stage.fit(StageMaker.units(toward[0], toward[1], toward[2]));
        return stage.scene;
    }

    /// @notice A mesh placed in a box, and one of which only the bounds are known.
    function placed(bytes memory packed, int256[3][2] memory bounds, int256[6] memory room) external pure returns (Scene memory) {
        Stage memory stage = StageMaker.stage(60, 40);
        Box memory box_ = Framing.box(room[0], room[1], room[2], room[3], room[4], room[5]);
        stage.add(packed, StageMaker.unlit()).rotation = StageMaker.turned(0, 90, 0);
        stage.place(box_);
        bytes memory stored = abi.encodePacked(uint8(0x12), address(1));
        stage.add(stored, StageMaker.unlit(), Framing.box(bounds[0], bounds[1]));
        stage.place(box_);
        stage.fit(StageMaker.units(0, 0, 1));
        return stage.scene;
    }

    /// @notice Lights, objects and cameras in an order that is told: a letter for each step.
    function steps(string memory order) external pure returns (Scene memory) {
        Stage memory stage = StageMaker.stage(60, 40);
        Model memory m = ModelMaker.model();
        m.box(-1, -1, -1, 1, 1, 1, 0x102030);
        bytes memory cube = m.pack();
        for (uint256 k; k < bytes(order).length; ++k) {
            bytes1 step = bytes(order)[k];
            if (step == "a") {
                stage.add(cube, StageMaker.smooth(StageMaker.fraction(1, 3), StageMaker.percent(1), StageMaker.unit(2), 5));
            }
            if (step == "p") stage.add(hex"12", StageMaker.unlit());
            if (step == "P") stage.paint(0, 0xabcdef);
            if (step == "L") stage.paint(0x123456);
            if (step == "f") stage.opacity(StageMaker.fraction(1, 8));
            if (step == "s") stage.sun(StageMaker.units(1, 2, 3), 0xffffff);
            if (step == "t") stage.spot(StageMaker.units(1, 2, 3), StageMaker.units(0, 1, 0), 30, 50, 0xffffff);
            if (step == "d") stage.dark();
            if (step == "w") stage.shadow();
            if (step == "l") stage.look(StageMaker.units(400, 0, 0), StageMaker.units(0, 0, 0));
            if (step == "D") stage.look(StageMaker.units(7, 50, 9), StageMaker.units(7, 0, 9));
            if (step == "u") stage.look(StageMaker.units(7, -50, 9), StageMaker.units(7, 0, 9));
            if (step == "F") stage.fit(StageMaker.units(0, 0, 1));
            if (step == "n") stage.fit(StageMaker.units(0, 0, 0));
            if (step == "v") stage.fieldOfView(180);
            if (step == "o") stage.orthographic(0);
            if (step == "1") stage.spot(StageMaker.units(0, 0, 0), StageMaker.units(0, 1, 0), 50, 49, 0);
            if (step == "2") stage.spot(StageMaker.units(0, 0, 0), StageMaker.units(0, 1, 0), 0, 181, 0);
            if (step == "3") stage.spot(StageMaker.units(0, 0, 0), StageMaker.units(1 << 31, 0, 0), 0, 1, 0);
            if (step == "4") stage.hemisphere(0, 1 << 24);
            if (step == "5") stage.rim(1 << 24, 1);
            if (step == "e") stage.emission(1 << 24);
            if (step == "6") stage.rim(0, 257);
            if (step == "7") stage.fog(0, 0, 1 << 32);
            if (step == "8") stage.tone((1 << 24) + 100, true, true);
            if (step == "9") stage.opacity(StageMaker.unit(257));
            if (step == "g") stage.ground(0, StageMaker.units(0, 0, 0), 1 << 32);
            if (step == "O") stage.opacities(new bytes(7));
            if (step == "U") stage.texture(1, 1, 0, "", new bytes(3), new int256[2][](9));
            if (step == "i") stage.fieldOfView(Fixed.wrap(50));
            if (step == "x") stage.texture(1, 1, 4, "", new bytes(3), new int256[2][](8));
            if (step == "r") stage.place(Framing.box(0, 0, 0, 1, 0, 1));
        }
        return stage.scene;
    }

    /// @notice A scene that came from elsewhere, with an object and a light more.
    function continued(Scene memory scene_) external pure returns (Scene memory, bytes memory behind) {
        Stage memory stage = StageMaker.stage(1, 1, 9);
        stage.scene = scene_;
        behind = abi.encodePacked(uint256(0x1234567890abcdef), uint256(0xfedcba0987654321));
        stage.add(hex"0000000000", StageMaker.unlit());
        stage.sun(StageMaker.units(1, 2, 3), 0xffffff);
        return (stage.scene, behind);
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
        stage.opacity(99);
        stage.opacity(50);
        stage.sun(StageMaker.units(-1, 2, 3), 0xffffff);
        stage.spot(StageMaker.units(10, -20, 30), StageMaker.units(0, 1, -2), StageMaker.fraction(45, 2), StageMaker.unit(120), 0x808080);
        stage.add(hex"0000000000", StageMaker.unlit());
        stage.emission(0x0a0b0c);
        stage.add(hex"0000000000", StageMaker.unlit());
        stage.opacity(0);
        stage.spot(StageMaker.units(1, 2, 3), StageMaker.units(-1, 0, 0), 0, 180, 0x010203);
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
        Model memory m = ModelMaker.model();
        for (uint256 k; k != levels.length; ++k) m.vertex(int256(k), 0, 0, 0x102030);
        Stage memory stage = StageMaker.stage(20, 10, 2);
        stage.add(hex"0000000000", StageMaker.unlit());
        stage.opacities("");
        stage.add(m.pack(), StageMaker.unlit());
        stage.opacity(50);
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
