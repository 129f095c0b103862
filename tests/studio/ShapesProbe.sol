// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Lettering, Model, ModelMaker, Shapes} from "../../contracts/src/building/SceneBuilder.sol";

/// @notice Makes meshes of shapes and letters as it is told.
contract ShapesProbe {
    function box(int256[6] memory c) external pure returns (bytes memory packed) {
        Model memory m = ModelMaker.model();
        m.box(c[0], c[1], c[2], c[3], c[4], c[5], 0x102030);
        return m.pack();
    }

    /// @notice A sphere, a cylinder, a cone or a ring, flat and smooth.
    function round(uint256 which, int256 radius, int256 size, uint256 segments, uint256 rings)
        external
        pure
        returns (bytes memory, bytes memory)
    {
        Model memory m = ModelMaker.model();
        if (which == 0) m.sphere(10, 20, 30, radius, segments, rings, 0x102030);
        if (which == 1) m.cylinder(10, 20, 30, radius, size, segments, 0x102030);
        if (which == 2) m.cone(10, 20, 30, radius, size, segments, 0x102030);
        if (which == 3) m.torus(10, 20, 30, radius, size, segments, rings, 0x102030);
        return (m.pack(), m.packSmooth());
    }

    function lathe(string memory profile, uint256 segments) external pure returns (bytes memory) {
        Model memory m = ModelMaker.model();
        m.lathe(10, 20, 30, Shapes.points(profile), segments, 0x102030);
        return m.pack();
    }

    function extrusion(string memory outline, int256 z0, int256 z1) external pure returns (bytes memory) {
        Model memory m = ModelMaker.model();
        m.extrusion(Shapes.points(outline), z0, z1, 0x102030);
        return m.pack();
    }

    function star(int256 outer, int256 inner, uint256 count) external pure returns (int256[2][] memory, int256[2][] memory) {
        return (Shapes.star(outer, inner, count), Shapes.polygon(outer, count));
    }

    function text(string memory words, int256 height, int256 depth) external pure returns (bytes memory, int256) {
        Model memory m = ModelMaker.model();
        m.text(words, 10, 20, 30, height, depth, 0x102030);
        return (m.pack(), Lettering.textWidth(words, height));
    }
}
