// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {answer} from "./Answer.sol";

/// @title DeployedCall: a read call that creates this contract, which calls another that is there, and says how much gas that took.
/// @notice Never deployed: the creation always ends by a revert, whose data are the answer. For nodes without state overrides.
contract DeployedCall {
    /// @param target The contract.
    /// @param limit The gas that it gets; 0 for all there is.
    constructor(address target, uint256 limit, bytes memory data) {
        uint256 begin;
        assembly ("memory-safe") {
            begin := add(data, 0x20)
        }
        answer(target, limit, begin, data.length, 0);
    }
}
