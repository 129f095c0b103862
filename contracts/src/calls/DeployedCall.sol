// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {answer} from "./Answer.sol";

/// @title DeployedCall: a read call that creates this contract, which calls a deployed one and measures the gas.
/// @notice Never deployed: the creation always reverts, and the revert data is the result. For nodes without state overrides.
contract DeployedCall {
    /// @param target The contract to call.
    /// @param limit The gas limit of the call; 0 for all available gas.
    constructor(address target, uint256 limit, bytes memory data) {
        uint256 begin;
        assembly ("memory-safe") {
            begin := add(data, 0x20)
        }
        answer(target, limit, begin, data.length, 0);
    }
}
