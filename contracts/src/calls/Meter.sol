// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {metered, OutOfGas} from "./Metering.sol";

/// @title Meter: calls a contract, and says how much gas that took.
/// @notice Never deployed: read calls place it at an address of their own by a state override. Its data are two words, the contract and the
/// gas that it gets (0 for all), then the data of the call. It returns a word, the gas of the execution, then what the contract returned;
/// what the contract reverts with, it reverts with too.
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
        if (exhausted) revert OutOfGas();
        assembly ("memory-safe") {
            returndatacopy(add(data, 0x20), 0, returndatasize())
            if iszero(success) { revert(add(data, 0x20), returndatasize()) }
            mstore(data, used)
            return(data, add(returndatasize(), 0x20))
        }
    }
}
