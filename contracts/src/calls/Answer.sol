// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {metered, OutOfGas} from "./Metering.sol";

/// @dev Calls a contract and ends the creation call with what came of it, by reverting: what a creation returns may have 24,576 bytes
/// only. The answer is a word, 1 if the call succeeded, 0 if not; a word, the gas that it used; then what it returned or reverted with.
/// @param saved Gas that the call would have used had it not been made by this creation.
function answer(address target, uint256 limit, uint256 data, uint256 size, uint256 saved) view {
    if (limit != 0) limit = limit > saved ? limit - saved : 1;
    (bool success, uint256 used, bool exhausted) = metered(target, limit, data, size);
    bytes4 outOfGas = OutOfGas.selector;
    assembly ("memory-safe") {
        mstore(data, success)
        mstore(add(data, 0x20), add(used, saved))
        let rest := add(data, 0x40)
        let length := returndatasize()
        returndatacopy(rest, 0, length)
        if exhausted {
            mstore(rest, outOfGas)
            length := 4
        }
        revert(data, add(length, 0x40))
    }
}
