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
    /// @param count The number of contracts to create.
    /// @param packed Compressed by DEFLATE: for each contract the size of its creation code in four bytes, eight bytes, and the code; then
    /// the calldata. The eight bytes are the numbers, from 0, of the contracts whose addresses its constructor receives.
    constructor(uint256 limit, uint256 count, bytes memory packed) {
        // before the data, whose end is overwritten below
        uint256[] memory created = new uint256[](count);
        bytes memory data = inflate(packed);
        address target;
        uint256 next;
        uint256 end;
        assembly ("memory-safe") {
            next := add(data, 0x20)
            end := add(next, mload(data))
        }
        for (uint256 i; i != count; ++i) {
            assembly ("memory-safe") {
                let size := shr(224, mload(next))
                let numbers := shl(32, mload(next))
                let code := add(next, 12)
                next := add(code, size)
                // the addresses temporarily overwrite the following data
                let kept := add(mload(0x40), 0x100)
                mcopy(kept, next, 0x100)
                let addresses := add(created, 0x20)
                for { let place := 0 } lt(place, 8) { place := add(place, 1) } {
                    mstore(add(next, shl(5, place)), mload(add(addresses, shl(5, byte(place, numbers)))))
                }
                target := create(0, code, add(size, 0x100))
                mcopy(next, kept, 0x100)
                mstore(add(addresses, shl(5, i)), target)
            }
            if (target == address(0)) revert NotCreated(i);
        }
        // each contract but the first one called is assumed to be accessed by another: too many if some engines draw nothing
        answer(target, limit, next, end - next, (count - 1) * FIRST_ACCESS);
    }
}
