// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

// Written by tools/presets.py from the table of src/shackled/scene/presets.toml.

import {Background, DIRECTIONAL, Light, Fixed, Vector} from "../scene/Scene.sol";
import {OWN_COLORS, Preset, StageMaker} from "./StageMaker.sol";

/// @title Presets: looks for `stage.preset`, the same as in Python and on the command line.
library Presets {
    /// @notice Studio. Its own colours under one soft white light.
    function studio() internal pure returns (Preset memory look) {
        look.material = StageMaker.smooth(32, 72, 25, 24);
        look.color = OWN_COLORS;
        look.background = Background(0xe9edf2, 0x9aa5b4);
        look.ambientLight = 0xffffff;
        look.lights = new Light[](1);
        look.lights[0] = light(-1595891361, 2873894071, 2764164920, 0xffffff);
    }

    /// @notice Clay. Terracotta on warm paper.
    function clay() internal pure returns (Preset memory look) {
        look.material = StageMaker.smooth(30, 80, 12, 8);
        look.color = 0xc8674a;
        look.background = Background(0xf6ecdf, 0xd8c3a9);
        look.ambientLight = 0xffeadb;
        look.lights = new Light[](1);
        look.lights[0] = light(-1699688503, 3290135830, 2175502076, 0xffffff);
    }

    /// @notice Gold. Polished metal in the dark.
    function gold() internal pure returns (Preset memory look) {
        look.material = StageMaker.smooth(22, 62, 95, 34);
        look.color = 0xe0a52e;
        look.background = Background(0x1c130a, 0x4a3212);
        look.ambientLight = 0xffd98a;
        look.lights = new Light[](2);
        look.lights[0] = light(-1741951924, 3037000500, 2487765168, 0xfff3d6);
        look.lights[1] = light(3663042453, 745813244, 2114858546, 0xff9a3c);
    }

    /// @notice Neon. Cyan from the left, magenta from the right.
    function neon() internal pure returns (Preset memory look) {
        look.material = StageMaker.smooth(12, 85, 80, 40);
        look.color = 0xd8dcff;
        look.background = Background(0x070312, 0x1d0b3a);
        look.ambientLight = 0x5a4bff;
        look.lights = new Light[](2);
        look.lights[0] = light(-3898427445, 1111619334, 1418911550, 0x00e5ff);
        look.lights[1] = light(3974633939, 745813244, 1446648446, 0xff2bd6);
    }

    /// @notice Noir. One hard light from the side on black.
    function noir() internal pure returns (Preset memory look) {
        look.material = StageMaker.smooth(3, 100, 60, 30);
        look.color = 0xdddddd;
        look.background = Background(0x000000, 0x1b1b1b);
        look.ambientLight = 0xffffff;
        look.lights = new Light[](1);
        look.lights[0] = light(-3759926461, 1815131613, 1007469259, 0xffffff);
    }

    /// @notice Sunset. A low orange sun against a violet sky.
    function sunset() internal pure returns (Preset memory look) {
        look.material = StageMaker.flat(34, 90, 35, 16);
        look.color = OWN_COLORS;
        look.background = Background(0x2b1b52, 0xff8f5a);
        look.ambientLight = 0xb9a4ff;
        look.lights = new Light[](2);
        look.lights[0] = light(-3638269678, 892973913, 2100555978, 0xff9b54);
        look.lights[1] = light(3240151274, 2760751762, 571326091, 0x5a63c8);
    }

    /// @notice Facets. Every triangle is visible, as in a cut gem.
    function facets() internal pure returns (Preset memory look) {
        look.material = StageMaker.flat(20, 75, 85, 12);
        look.color = 0x5fc7c1;
        look.background = Background(0x0f2027, 0x2c5364);
        look.ambientLight = 0xffffff;
        look.lights = new Light[](2);
        look.lights[0] = light(-1774577026, 3290135830, 2114858546, 0xffffff);
        look.lights[1] = light(3877749931, -374331065, 1808224489, 0x7d8cff);
    }

    /// @notice Blueprint. White lines on blue.
    function blueprint() internal pure returns (Preset memory look) {
        look.material = StageMaker.unlit();
        look.color = 0xe8f1ff;
        look.background = Background(0x0b3d91, 0x072a66);
        look.ambientLight = 0xffffff;
        look.wireframe = true;
    }

    /// @notice X-ray. Light and dark are swapped.
    function xray() internal pure returns (Preset memory look) {
        look.material = StageMaker.smooth(10, 90, 20, 10);
        look.color = 0xf2e6dc;
        look.background = Background(0xf4f1ea, 0xffffff);
        look.ambientLight = 0xffffff;
        look.invert = true;
        look.lights = new Light[](1);
        look.lights[0] = light(0, 0, 4294967296, 0xffffff);
    }

    /// @notice Unlit. Unlit colours; lowest gas.
    function flat() internal pure returns (Preset memory look) {
        look.material = StageMaker.unlit();
        look.color = OWN_COLORS;
        look.background = Background(0xf4f1ea, 0xf4f1ea);
        look.ambientLight = 0xffffff;
    }

    /// @dev Returns a light in a direction, Q32: to the right, up, and toward the camera.
    function light(int256 right, int256 up, int256 toward, uint256 color) private pure returns (Light memory) {
        return Light(DIRECTIONAL, Vector(Fixed.wrap(right), Fixed.wrap(up), Fixed.wrap(toward)), color);
    }
}
