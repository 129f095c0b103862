// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {Vector} from "../math/Vector.sol";

/// @notice A full turn of all objects of a scene about their middle, in equal steps; camera and lights stay.
/// @param frames How many pictures, 2..360.
/// @param delay How long each is shown, in milliseconds: 20..10,000.
/// @param scale How many pixels each pixel becomes in both directions, 1..8.
/// @param axis Seen from where it points, objects turn counter-clockwise. Of any length but zero; (0, 1, 0) is upright.
/// @param hold Whether the camera is moved back until nothing leaves the picture, at whatever angle.
struct Spin {
    uint256 frames;
    uint256 delay;
    uint256 scale;
    Vector axis;
    bool hold;
}
