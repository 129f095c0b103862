// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Base64} from "./Base64.sol";
import {Text} from "./Text.sol";

/// @notice Encodes files as text.
library DataUri {
    /// @notice Returns the Base64 encoding of a file between two pieces of text.
    /// @param file The file, which must be the last allocation: up to 32 bytes behind it are cleared.
    function wrap(string memory head, bytes memory file, string memory tail) internal pure returns (string memory text) {
        unchecked {
            uint256 data;
            uint256 begin;
            assembly ("memory-safe") {
                data := add(file, 32)
                // the encoder requires zeros behind the file
                mstore(add(data, mload(file)), 0)
                text := add(mload(0x40), 32)
                begin := add(text, 32)
            }
            uint256 end = Text.write(Base64.encode(data, file.length, Text.write(begin, head)), tail);
            assembly ("memory-safe") {
                mstore(text, sub(end, begin))
                mstore(end, 0)
                mstore(0x40, and(add(end, 63), not(31)))
            }
        }
    }
}
