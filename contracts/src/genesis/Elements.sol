// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

/// @title Elements: accesses to memory arrays without bounds checks, for loops that end with the array.
library Elements {
    function get(int256[] memory values, uint256 index) internal pure returns (int256 value) {
        assembly ("memory-safe") {
            value := mload(add(add(values, 0x20), shl(5, index)))
        }
    }

    function put(int256[] memory values, uint256 index, int256 value) internal pure {
        assembly ("memory-safe") {
            mstore(add(add(values, 0x20), shl(5, index)), value)
        }
    }

    function put(int256[6] memory values, uint256 index, int256 value) internal pure {
        assembly ("memory-safe") {
            mstore(add(values, shl(5, index)), value)
        }
    }
}
