// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {SceneErrors} from "../scene/SceneErrors.sol";
import {metered} from "./Metering.sol";

/// @dev Calls a contract and ends the creation call by reverting with the result, because the return data of a creation is limited to
/// 24,576 bytes. The result consists of a word, 1 if the call succeeded or 0 if not; a word, the gas used; then the return data of the
/// call.
/// @param saved Gas that the call saved because this creation made it.
function answer(address target, uint256 limit, uint256 data, uint256 size, uint256 saved) view {
    if (limit != 0) limit = limit > saved ? limit - saved : 1;
    (bool success, uint256 used, bool exhausted) = metered(target, limit, data, size);
    bytes4 outOfGas = SceneErrors.OutOfGas.selector;
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
