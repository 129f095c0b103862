// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {Quaternion} from "../math/Quaternion.sol";
import {Background, Canvas} from "../scene/Scene.sol";

uint256 constant TURN = 1;
uint256 constant PAINT = 2;
uint256 constant BACKGROUND = 4;
uint256 constant INVERT = 8;
uint256 constant CANVAS = 16;
uint256 constant ANTIALIAS = 32;

/// @notice How a picture differs from that of the scene that is kept.
/// @param fields Which of the following count: the sum of TURN, PAINT, BACKGROUND, INVERT, CANVAS; and of ANTIALIAS, which
/// has no field: it smooths the edges of the picture.
/// @param turn A rotation of all objects about their middle. Its length must not be zero, and is best 1.
/// @param color Of all vertices of all objects, 0xRRGGBB.
/// @param background As in a scene.
/// @param invert 1 or 0.
/// @param canvas The size of the picture.
struct Changes {
    uint256 fields;
    Quaternion turn;
    uint256 color;
    Background background;
    uint256 invert;
    Canvas canvas;
}
