// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

/// @notice Writes text to memory, piece by piece.
library Text {
    function write(uint256 target, string memory text) internal pure returns (uint256) {
        unchecked {
            uint256 length = bytes(text).length;
            assembly ("memory-safe") {
                mcopy(target, add(text, 32), length)
            }
            return target + length;
        }
    }

    /// @notice Writes a number below 10,000 in decimal.
    function writeNumber(uint256 target, uint256 number) internal pure returns (uint256) {
        unchecked {
            for (uint256 power = 1000; power != 0; power /= 10) {
                if (number < power && power != 1) continue;
                uint256 digit = 48 + (number / power) % 10;
                assembly ("memory-safe") {
                    mstore8(target, digit)
                }
                ++target;
            }
            return target;
        }
    }
}
