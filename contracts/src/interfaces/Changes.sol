// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {Background, Canvas, Quaternion} from "../scene/Scene.sol";

uint256 constant TURN = 1;
uint256 constant PAINT = 2;
uint256 constant BACKGROUND = 4;
uint256 constant INVERT = 8;
uint256 constant CANVAS = 16;
uint256 constant ANTIALIAS = 32;

/// @notice Changes to a scene before it is drawn.
/// @param fields The changes to apply: the sum of TURN, PAINT, BACKGROUND, INVERT and CANVAS, which select the following fields, and
/// ANTIALIAS, which has no field and smooths the edges.
/// @param turn A rotation of all objects about their centre. Its length must not be zero, and should be 1.
/// @param color The colour of all vertices of all objects, 0xRRGGBB.
/// @param background The background, as in a scene.
/// @param invert 1 or 0, as in a scene.
/// @param canvas The size of the picture.
struct Changes {
    uint256 fields;
    Quaternion turn;
    uint256 color;
    Background background;
    uint256 invert;
    Canvas canvas;
}
