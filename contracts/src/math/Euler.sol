// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {Fixed} from "./Fixed.sol";
import {Quaternion} from "./Quaternion.sol";

/// @dev Pi / 180, Q60.
int256 constant RADIANS = 20122276272436452;
int256 constant QUARTER_TURN = 90 << 32;

/// @title AngleErrors: the error of angles.
interface AngleErrors {
    /// @notice The angle must be at most 2^26 degrees in either direction.
    error AngleOutOfRange(int256 degrees_);
}

/// @notice Returns the rotation about the x axis, then y, then z, by angles in degrees (Q32).
/// @dev The product z * y * x of three quaternions, each computed from half the angle.
function fromEuler(Fixed x, Fixed y, Fixed z) pure returns (Quaternion memory) {
    (Fixed sx, Fixed cx) = sinCosOfHalf(x.raw());
    (Fixed sy, Fixed cy) = sinCosOfHalf(y.raw());
    (Fixed sz, Fixed cz) = sinCosOfHalf(z.raw());
    return Quaternion(sx * cy * cz - cx * sy * sz, cx * sy * cz + sx * cy * sz, cx * cy * sz - sx * sy * cz, cx * cy * cz + sx * sy * sz);
}

/// @notice Returns the sine and cosine of half an angle in degrees (Q32), with an error of at most 2^-31.
function sinCosOfHalf(int256 degrees_) pure returns (Fixed sine, Fixed cosine) {
    unchecked {
        if (degrees_ > 1 << 58 || degrees_ < -(1 << 58)) revert AngleErrors.AngleOutOfRange(degrees_);
        int256 angle = degrees_ >> 1;
        // quarter turns, and the remainder between -45 and 45 degrees, in radians (Q60)
        int256 quarters = (angle + QUARTER_TURN / 2) / QUARTER_TURN;
        if (angle + QUARTER_TURN / 2 < 0) --quarters;
        int256 x = ((angle - quarters * QUARTER_TURN) * RADIANS) >> 32;
        int256 square = (x * x) >> 60;
        // Taylor series to x^12 by Horner's rule: each factor divides by the next two numbers of the factorial
        int256 s = 1 << 60;
        int256 c = 1 << 60;
        for (int256 n = 12; n != 0; n -= 2) {
            s = (1 << 60) - (square * s >> 60) / (n * (n + 1));
            c = (1 << 60) - (square * c >> 60) / (n * (n - 1));
        }
        s = (x * s) >> 60;
        (s, c) = ((s + (1 << 27)) >> 28, (c + (1 << 27)) >> 28);
        if (quarters & 1 == 1) (s, c) = (c, -s);
        if (quarters & 2 == 2) (s, c) = (-s, -c);
        return (Fixed.wrap(s), Fixed.wrap(c));
    }
}
