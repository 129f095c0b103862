// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {Fixed} from "./Fixed.sol";
import {sqrt} from "./Roots.sol";

/// @notice A vector of three fixed-point numbers (Q32).
struct Vector {
    Fixed x;
    Fixed y;
    Fixed z;
}

using {add, sub, scale, dot, cross, normalize, isZero} for Vector global;

function add(Vector memory a, Vector memory b) pure returns (Vector memory) {
    return Vector(a.x + b.x, a.y + b.y, a.z + b.z);
}

function sub(Vector memory a, Vector memory b) pure returns (Vector memory) {
    return Vector(a.x - b.x, a.y - b.y, a.z - b.z);
}

function scale(Vector memory a, Fixed k) pure returns (Vector memory) {
    return Vector(a.x * k, a.y * k, a.z * k);
}

function dot(Vector memory a, Vector memory b) pure returns (Fixed) {
    unchecked {
        // one rounding for the sum of the three products
        return Fixed.wrap((a.x.raw() * b.x.raw() + a.y.raw() * b.y.raw() + a.z.raw() * b.z.raw()) >> 32);
    }
}

function cross(Vector memory a, Vector memory b) pure returns (Vector memory) {
    return Vector(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

function isZero(Vector memory a) pure returns (bool) {
    return a.x.raw() | a.y.raw() | a.z.raw() == 0;
}

/// @notice Returns the unit vector along `a`; zero for zero. Components of up to 2^62 keep the squares below 2^256.
function normalize(Vector memory a) pure returns (Vector memory) {
    unchecked {
        // 60 more bits, so that vectors of a few units in the last place keep their direction
        int256 x = a.x.raw() << 60;
        int256 y = a.y.raw() << 60;
        int256 z = a.z.raw() << 60;
        uint256 square = uint256(x * x + y * y + z * z);
        uint256 root = sqrt(square);
        if (root == 0) return a;
        // a third step of Newton's method, for 32 bits
        int256 length = int256((root + square / root) >> 1);
        // rounded to nearest, so that unit vectors along the axes remain exact
        return Vector(
            Fixed.wrap(((x << 36) / length + 8) >> 4),
            Fixed.wrap(((y << 36) / length + 8) >> 4),
            Fixed.wrap(((z << 36) / length + 8) >> 4)
        );
    }
}
