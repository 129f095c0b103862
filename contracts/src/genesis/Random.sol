// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

/// @notice What a piece is made from.
type Seed is bytes32;

/// @notice The name of a random number: up to 31 letters, and how many in the last byte.
type Tag is bytes32;

/// @title Random: numbers from a seed, without state.
/// @notice The same seed, tag and words always give the same number, in whatever order they are asked for.
library Random {
    /// @notice A number from `low` to `high`, both included; `low` if there is none between.
    function draw(Seed seed, Tag tag, int256 low, int256 high) internal pure returns (int256) {
        return toRange(hash(seed, tag, 0, 0, 0), low, high);
    }

    function draw(Seed seed, Tag tag, uint256 i, int256 low, int256 high) internal pure returns (int256) {
        return toRange(hash(seed, tag, i, 0, 1), low, high);
    }

    function draw(Seed seed, Tag tag, uint256 i, uint256 j, int256 low, int256 high) internal pure returns (int256) {
        return toRange(hash(seed, tag, i, j, 2), low, high);
    }

    /// @notice Holds in percent + 1 of 101 cases.
    function chance(Seed seed, Tag tag, uint256 i, uint256 j, uint256 percent) internal pure returns (bool) {
        unchecked {
            return percent == 100 || hash(seed, tag, i, j, 2) % 101 <= percent;
        }
    }

    function toRange(uint256 value, int256 low, int256 high) internal pure returns (int256) {
        unchecked {
            uint256 count = high < low ? 1 : uint256(high - low + 1);
            assembly ("memory-safe") {
                // the compiler would ask whether the count is zero
                value := mod(value, count)
            }
            return low + int256(value);
        }
    }

    /// @notice The hash of the seed, the letters of the tag and so many of the two words.
    function hash(Seed seed, Tag tag, uint256 i, uint256 j, uint256 words) internal pure returns (uint256 value) {
        assembly ("memory-safe") {
            let data := mload(0x40)
            mstore(data, seed)
            mstore(add(data, 0x20), tag)
            let size := add(0x20, and(tag, 0xff))
            let tail := add(data, size)
            mstore(tail, i)
            mstore(add(tail, 0x20), j)
            value := keccak256(data, add(size, shl(5, words)))
        }
    }
}
