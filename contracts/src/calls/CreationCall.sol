// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {answer} from "./Answer.sol";
import {inflate} from "./Inflate.sol";

/// @title CreationCall: a read call that creates the contracts it needs, and calls the last of them.
/// @notice Never deployed: the creation always reverts, and the revert data is the result. For nodes without state overrides, on chains
/// where the contracts are not deployed.
contract CreationCall {
    /// @dev The cost of the first access to an account in a transaction, less that of a later one: accounts that were just created are
    /// warm, others are cold.
    uint256 private constant FIRST_ACCESS = 2500;

    error NotCreated(uint256 index);

    /// @param limit The gas limit of the call; 0 for all available gas.
    /// @param count The number of contracts to create. The constructor of each receives the addresses of the two created before it, the
    /// last one first, three times: the Renderer takes two engines for plain pictures, two for antialiased ones, and one for effects
    /// together with Effects. It calls one of the pairs, or the one for effects. If only one contract was created before, its address is
    /// used for both.
    /// @param packed Compressed by DEFLATE: for each contract its creation code, preceded by its size in four bytes; then the calldata.
    constructor(uint256 limit, uint256 count, bytes memory packed) {
        bytes memory data = inflate(packed);
        address target;
        address before;
        uint256 next;
        uint256 end;
        assembly ("memory-safe") {
            next := add(data, 0x20)
            end := add(next, mload(data))
        }
        for (uint256 i; i != count; ++i) {
            assembly ("memory-safe") {
                let size := shr(224, mload(next))
                next := add(next, 4)
                let code := next
                next := add(next, size)
                // the addresses temporarily overwrite the following data
                let kept := add(mload(0x40), 0xc0)
                mcopy(kept, next, 0xc0)
                mstore(next, target)
                mstore(add(next, 0x20), or(before, mul(iszero(before), target)))
                mcopy(add(next, 0x40), next, 0x40)
                mcopy(add(next, 0x80), next, 0x40)
                before := target
                target := create(0, code, add(size, 0xc0))
                mcopy(next, kept, 0xc0)
            }
            if (target == address(0)) revert NotCreated(i);
        }
        // each contract but the first one called is assumed to be accessed by the next: one too many if a single engine draws
        answer(target, limit, next, end - next, (count - 1) * FIRST_ACCESS);
    }
}
