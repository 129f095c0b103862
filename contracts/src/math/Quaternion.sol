// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {Fixed} from "./Fixed.sol";
import {Vector} from "./Vector.sol";

/// @notice A rotation as x*i + y*j + z*k + w; it need not have unit length. The identity is (0, 0, 0, 1).
struct Quaternion {
    Fixed x;
    Fixed y;
    Fixed z;
    Fixed w;
}

/// @notice The columns of a 3 by 3 matrix: the images of the three axes.
struct Matrix {
    Vector x;
    Vector y;
    Vector z;
}

using {toMatrix} for Quaternion global;
using {times, transposedTimes} for Matrix global;

/// @notice Returns the rotation matrix of `q`, which must not be zero.
/// @dev Source: K. Shoemake, "Animating rotation with quaternion curves", SIGGRAPH 1985. Dividing by the squared norm avoids a square root.
function toMatrix(Quaternion memory q) pure returns (Matrix memory m) {
    unchecked {
        (int256 x, int256 y, int256 z, int256 w) = (q.x.raw(), q.y.raw(), q.z.raw(), q.w.raw());
        int256 n = x * x + y * y + z * z + w * w;
        m.x = Vector(part(n - 2 * (y * y + z * z), n), part(2 * (x * y + z * w), n), part(2 * (x * z - y * w), n));
        m.y = Vector(part(2 * (x * y - z * w), n), part(n - 2 * (x * x + z * z), n), part(2 * (y * z + x * w), n));
        m.z = Vector(part(2 * (x * z + y * w), n), part(2 * (y * z - x * w), n), part(n - 2 * (x * x + y * y), n));
    }
}

/// @dev Returns numerator / denominator as a fixed-point number.
function part(int256 numerator, int256 denominator) pure returns (Fixed) {
    unchecked {
        return Fixed.wrap((numerator << 32) / denominator);
    }
}

/// @notice Returns m * v.
function times(Matrix memory m, Vector memory v) pure returns (Vector memory) {
    return m.x.scale(v.x).add(m.y.scale(v.y)).add(m.z.scale(v.z));
}

/// @notice Returns the transposed matrix times v; for a rotation, the inverse rotation of v.
function transposedTimes(Matrix memory m, Vector memory v) pure returns (Vector memory) {
    return Vector(m.x.dot(v), m.y.dot(v), m.z.dot(v));
}
