// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {answer} from "./Answer.sol";
import {inflate} from "./Inflate.sol";

/// @title CreationCall: a read call that brings contracts along, creates them and calls the last of them.
/// @notice Never deployed: the creation always ends by a revert, whose data are the answer. For nodes without state overrides, where
/// nothing is deployed.
contract CreationCall {
    /// @dev What the first access to an account costs in a transaction, less what a later one does: accounts that were just created count
    /// as accessed, others do not.
    uint256 private constant FIRST_ACCESS = 2500;

    error NotCreated(uint256 index);

    /// @param limit The gas that the call gets; 0 for all there is.
    /// @param count How many contracts are to be created. The constructor of each is handed the addresses of the two before, the last one
    /// first, three times: the Renderer takes two engines for plain pictures, two for those that are antialiased, and one for effects with
    /// the one for their shadows. It calls one pair, or the one for effects. If only one was created before, it takes the place of both.
    /// @param packed Deflated: for each contract four bytes, the size of its creation code, and this code; then the data of the call.
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
                // the addresses take the place of what comes next for a moment
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
        // each but the first to be called is taken to be accessed by one after it: where a single engine draws that is one too many
        answer(target, limit, next, end - next, (count - 1) * FIRST_ACCESS);
    }
}
