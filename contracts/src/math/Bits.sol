// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

/// @notice Returns the absolute value.
function magnitude(int256 value) pure returns (int256) {
    unchecked {
        return value < 0 ? -value : value;
    }
}

/// @notice Returns the number of bits by which `value` exceeds `bits` bits.
function excess(uint256 value, uint256 bits) pure returns (uint256 shift) {
    assembly ("memory-safe") {
        value := shr(bits, value)
        shift := gt(value, 0)
        for { let step := mul(128, shift) } step { step := shr(1, step) } { // 128, 64 .. 1, or none
            let part := mul(step, gt(shr(step, value), 0)) // if a higher bit is set, the search goes on there
            value := shr(part, value)
            shift := add(shift, part)
        }
    }
}
