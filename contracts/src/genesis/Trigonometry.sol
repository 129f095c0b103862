// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

// Fixed-point 1.
int256 constant ONE = 1e18;

// The sines of 0, 30, .. 420 degrees, 8 bytes each. They are those of the generator's own table, including its errors; so are all constants
// of this file. A cosine is exactly the sine of an angle 90 degrees larger.
bytes constant SINES =
    hex"000000000000000006f0596beb2ba8490c04ba31ae0b30640de0b6b3a76400000c04ba3ca15b5a3c06f0597ee465720e"
    hex"0000000000000000f90fa69414d457b7f3fb45ce51f4cf9cf21f494c589c0000f3fb45c35ea4a5c4f90fa6811b9a8df2"
    hex"000000000000000006f0596beb2ba8490c04ba31ae0b3064";

/// @title Trigonometry: rotations by multiples of 30 degrees, and tilts by 12 degrees.
library Trigonometry {
    int256 internal constant SINE_30 = 499997878680004681;
    int256 internal constant COSINE_30 = 866021797929900604;
    int256 internal constant SINE_12 = 207911222804296399;
    int256 internal constant COSINE_12 = 978145476420477720;
    /// @dev The sine and cosine of -12 degrees: not quite those of 12 degrees.
    int256 internal constant SINE_348 = -207911314539570042;
    int256 internal constant COSINE_348 = 978145456397042356;

    /// @notice Returns the point rotated about the origin, by an angle given by its cosine and sine.
    function rotate(int256 x, int256 y, int256 cosine, int256 sine) internal pure returns (int256, int256) {
        unchecked {
            return ((x * cosine - y * sine) / ONE, (x * sine + y * cosine) / ONE);
        }
    }

    /// @notice Returns the cosine and sine of `turn` times 30 degrees.
    /// @param sines SINES in memory.
    /// @param turn Any number from 0.
    function ofTurn(bytes memory sines, uint256 turn) internal pure returns (int256 cosine, int256 sine) {
        assembly ("memory-safe") {
            let place := add(sines, shl(3, mod(turn, 12)))
            // sines[turn % 12], sines[turn % 12 + 3]
            sine := sar(192, mload(add(place, 0x20)))
            cosine := sar(192, mload(add(place, 0x38)))
        }
    }

    /// @notice Returns the square root of `square`, truncated. The closer the guess, which must not be 0, the cheaper.
    function root(uint256 square, uint256 guess) internal pure returns (uint256 r) {
        unchecked {
            // never below the root, by the inequality of arithmetic and geometric means
            r = (guess + square / guess) >> 1;
            while (r * r > square) r = (r + square / r) >> 1;
        }
    }
}
