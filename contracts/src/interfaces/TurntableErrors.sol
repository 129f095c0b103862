// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

/// @title TurntableErrors: the errors of invalid animation parameters.
interface TurntableErrors {
    /// @notice The number of frames is out of range.
    error FramesOutOfRange(uint256 frames, uint256 least, uint256 most);
    /// @notice The delay of a frame is out of range, in milliseconds.
    error DelayOutOfRange(uint256 delay, uint256 least, uint256 most);
    /// @notice The axis is zero, or one of its coordinates is larger than 2^26.
    error AxisOutOfRange();
}
