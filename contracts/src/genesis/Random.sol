// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

/// @notice The seed from which a piece is generated.
type Seed is bytes32;

/// @notice The name of a random number: up to 31 letters, with their number in the last byte.
type Tag is bytes32;

/// @title Random: stateless random numbers from a seed.
/// @notice The same seed, tag and words always give the same number, independent of the order of the calls.
library Random {
    /// @notice Returns a number from `low` to `high`, inclusive; `low` if the range is empty.
    function draw(Seed seed, Tag tag, int256 low, int256 high) internal pure returns (int256) {
        return toRange(hash(seed, tag, 0, 0, 0), low, high);
    }

    function draw(Seed seed, Tag tag, uint256 i, int256 low, int256 high) internal pure returns (int256) {
        return toRange(hash(seed, tag, i, 0, 1), low, high);
    }

    function draw(Seed seed, Tag tag, uint256 i, uint256 j, int256 low, int256 high) internal pure returns (int256) {
        return toRange(hash(seed, tag, i, j, 2), low, high);
    }

    /// @notice Returns true in percent + 1 of 101 cases.
    function chance(Seed seed, Tag tag, uint256 i, uint256 j, uint256 percent) internal pure returns (bool) {
        unchecked {
            return percent == 100 || hash(seed, tag, i, j, 2) % 101 <= percent;
        }
    }

    function toRange(uint256 value, int256 low, int256 high) internal pure returns (int256) {
        unchecked {
            uint256 count = high < low ? 1 : uint256(high - low + 1);
            assembly ("memory-safe") {
                // the compiler would check for a zero count
                value := mod(value, count)
            }
            return low + int256(value);
        }
    }

    /// @notice Returns the hash of the seed, the letters of the tag, and the first `words` of the two words.
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
