// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {SceneErrors} from "../scene/SceneErrors.sol";
import {metered} from "./Metering.sol";

/// @title Meter: calls a contract and measures the gas.
/// @notice Never deployed: read calls place it at an address by a state override. The calldata consists of two words, the contract and the
/// gas limit (0 for all available gas), then the calldata of the call. Returns a word, the gas of the execution, then the return data;
/// reverts with the revert data of the contract.
contract Meter {
    fallback() external {
        uint256 data;
        uint256 size;
        address target;
        uint256 limit;
        assembly ("memory-safe") {
            target := calldataload(0)
            limit := calldataload(0x20)
            data := mload(0x40)
            size := sub(calldatasize(), 0x40)
            calldatacopy(data, 0x40, size)
        }
        (bool success, uint256 used, bool exhausted) = metered(target, limit, data, size);
        if (exhausted) revert SceneErrors.OutOfGas();
        assembly ("memory-safe") {
            returndatacopy(add(data, 0x20), 0, returndatasize())
            if iszero(success) { revert(add(data, 0x20), returndatasize()) }
            mstore(data, used)
            return(data, add(returndatasize(), 0x20))
        }
    }
}
