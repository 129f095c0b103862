// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

/// @title Fixed: signed binary fixed-point numbers with 32 fraction bits (Q32).
/// @notice One is `1 << 32`. The operators do not check for overflow: `Checks` bounds the scenes before any computation, and within those
/// bounds nothing here can overflow.
type Fixed is int256;

using {add as +, sub as -, neg as -, mul as *, div as /, lessThan as <, greaterThan as >, raw} for Fixed global;

Fixed constant ZERO = Fixed.wrap(0);
Fixed constant ONE = Fixed.wrap(1 << 32);

function raw(Fixed a) pure returns (int256) {
    return Fixed.unwrap(a);
}

function add(Fixed a, Fixed b) pure returns (Fixed) {
    unchecked {
        return Fixed.wrap(a.raw() + b.raw());
    }
}

function sub(Fixed a, Fixed b) pure returns (Fixed) {
    unchecked {
        return Fixed.wrap(a.raw() - b.raw());
    }
}

function neg(Fixed a) pure returns (Fixed) {
    unchecked {
        return Fixed.wrap(-a.raw());
    }
}

/// @dev Rounds toward minus infinity.
function mul(Fixed a, Fixed b) pure returns (Fixed) {
    unchecked {
        return Fixed.wrap((a.raw() * b.raw()) >> 32);
    }
}

/// @dev Rounds toward zero. `b` must not be zero.
function div(Fixed a, Fixed b) pure returns (Fixed) {
    unchecked {
        return Fixed.wrap((a.raw() << 32) / b.raw());
    }
}

function lessThan(Fixed a, Fixed b) pure returns (bool) {
    return a.raw() < b.raw();
}

function greaterThan(Fixed a, Fixed b) pure returns (bool) {
    return a.raw() > b.raw();
}
