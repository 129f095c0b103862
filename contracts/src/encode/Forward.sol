// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

/// @notice Ends the call with what a contract answers, or why it refuses, as it is: the compiler would copy a picture twice.
/// @param data Of the call. The answer takes its place.
function forward(address target, bytes memory data) view {
    assembly ("memory-safe") {
        let done := staticcall(gas(), target, add(data, 0x20), mload(data), 0, 0)
        returndatacopy(data, 0, returndatasize())
        if iszero(done) { revert(data, returndatasize()) }
        return(data, returndatasize())
    }
}
