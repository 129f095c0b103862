// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

/// @notice Ends the call with the return or revert data of another call, unchanged. The compiler would copy a picture twice.
/// @param data The calldata of the call. The result overwrites it.
function forward(address target, bytes memory data) view {
    assembly ("memory-safe") {
        let done := staticcall(gas(), target, add(data, 0x20), mload(data), 0, 0)
        returndatacopy(data, 0, returndatasize())
        if iszero(done) { revert(data, returndatasize()) }
        return(data, returndatasize())
    }
}

/// @notice Returns bytes from their place in memory and ends the call. The compiler would copy them.
function answer(bytes memory data) pure {
    assembly ("memory-safe") {
        let begin := sub(data, 0x20)
        let size := mload(data)
        mstore(begin, 0x20)
        mstore(add(add(data, 0x20), size), 0)
        return(begin, add(0x40, and(add(size, 0x1f), not(0x1f))))
    }
}
