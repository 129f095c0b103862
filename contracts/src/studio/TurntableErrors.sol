// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

/// @title TurntableErrors: what can be wrong with how a scene is to be turned.
interface TurntableErrors {
    error FramesOutOfRange(uint256 frames, uint256 least, uint256 most);
    /// @notice How long a frame is shown, in milliseconds.
    error DelayOutOfRange(uint256 delay, uint256 least, uint256 most);
    /// @notice The axis is zero, or a coordinate of it is larger than 2^26.
    error AxisOutOfRange();
}
