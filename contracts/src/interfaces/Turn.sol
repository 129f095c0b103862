// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {Vector} from "../math/Vector.sol";

/// @notice A full rotation of all objects of a scene about their centre, in equal steps; camera and lights do not move.
/// @param frames The number of frames, 2..360.
/// @param delay The duration of a frame in milliseconds, 20..10,000.
/// @param scale The enlargement of the picture, 1..8: each pixel becomes a square of `scale` x `scale` pixels.
/// @param axis The axis of rotation, of any length but zero; seen from its tip, objects rotate counter-clockwise. (0, 1, 0) is upright.
/// @param hold Whether to move the camera back so that nothing leaves the picture at any angle.
struct Turn {
    uint256 frames;
    uint256 delay;
    uint256 scale;
    Vector axis;
    bool hold;
}
