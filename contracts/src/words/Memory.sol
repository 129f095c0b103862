// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {RegisterErrors} from "./RegisterErrors.sol";

// Direct access to memory. The values used by every vertex, triangle and fragment are stored at fixed addresses, called registers: reading
// one costs 6 gas, half of the cost of a memory struct's field, and needs no stack slot. Registers that are constant for a frame or an
// object are uniforms: the Renderer fills them at the same addresses, and passes them to the engine as they are (see Uniforms.sol).

/// @dev A word that Solidity keeps zero. Loaded, it is a zero that is not a literal: for each set of literal arguments, the compiler makes
/// a copy of the function, and of those that it calls with them. Where such copies are wanted, a comment says so.
uint256 constant ZERO_SLOT = 0x60;

/// @notice Reserves the memory of the registers, so that nothing is allocated there.
/// @param begin The maximum end of the compiler's own variables in memory.
function reserveRegisters(uint256 begin, uint256 end) pure {
    if (freeMemory() > begin) revert RegisterErrors.RegistersOverlap();
    setFreeMemory(end);
}

function freeMemory() pure returns (uint256) {
    return load(0x40);
}

function setFreeMemory(uint256 free) pure {
    store(0x40, free);
}

function loadCalldata(uint256 position) pure returns (uint256 value) {
    assembly ("memory-safe") {
        value := calldataload(position)
    }
}

function load(uint256 pointer) pure returns (uint256 value) {
    assembly ("memory-safe") {
        value := mload(pointer)
    }
}

function loadSigned(uint256 pointer) pure returns (int256 value) {
    assembly ("memory-safe") {
        value := mload(pointer)
    }
}

function store(uint256 pointer, uint256 value) pure {
    assembly ("memory-safe") {
        mstore(pointer, value)
    }
}

function storeSigned(uint256 pointer, int256 value) pure {
    assembly ("memory-safe") {
        mstore(pointer, value)
    }
}
