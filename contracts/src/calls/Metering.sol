// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

/// @notice The call has used up its gas; the error of the same name of the Renderer.
error OutOfGas();

/// @dev Calls a contract and measures the gas of its execution, exactly: the same call is made twice, first of the address 0, which tells
/// what the call itself and the counting cost. There is no code, and nobody can sign that there is to be any (EIP-7702).
/// @param target The contract. It becomes warm, as the receiver of a transaction is.
/// @param limit The gas that it gets; 0 for all there is.
/// @param data The address of the data of the call in memory.
/// @param size The size of this data.
/// @return success Whether it succeeded. What it returned, or reverted with, is the return data.
/// @return used The gas that it used.
/// @return exhausted Whether it failed because its gas did not suffice, without a word.
function metered(address target, uint256 limit, uint256 data, uint256 size)
    view
    returns (bool success, uint256 used, bool exhausted)
{
    assembly ("memory-safe") {
        if iszero(limit) { limit := not(0) }
        // without gas: it comes to nothing, but makes the accounts warm; to read their balances would be optimized away
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
