// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

/// @dev Calls a contract and measures the gas of its execution exactly: the same call is made first to address 0, which measures the
/// overhead. That address has no code, and no key can sign an authorization to give it any (EIP-7702).
/// @param target The contract to call. It is warm, like the recipient of a transaction.
/// @param limit The gas limit of the call; 0 for all available gas.
/// @param data The memory address of the calldata.
/// @param size The size of the calldata.
/// @return success Whether the call succeeded. Its result is the return data.
/// @return used The gas used.
/// @return exhausted Whether the call ran out of gas, without revert data.
function metered(address target, uint256 limit, uint256 data, uint256 size)
    view returns (bool success, uint256 used, bool exhausted)
{
    assembly ("memory-safe") {
        if iszero(limit) { limit := not(0) }
        // warms the accounts by calls without gas; the optimizer would remove balance reads
        pop(staticcall(0, 0, 0, 0, 0, 0))
        pop(staticcall(0, target, 0, 0, 0, 0))
        let after
        for { let account := 0 } 1 { account := target } {
            let before := gas()
            success := staticcall(limit, account, data, size, 0, 0)
            after := gas()
            used := sub(sub(before, after), used)
            if eq(account, target) { break }
        }
        if iszero(or(success, returndatasize())) { exhausted := or(lt(after, shr(5, add(after, used))), iszero(lt(used, limit))) }
    }
}
