// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

// Memory by its addresses. The values that every vertex, triangle and fragment needs live at fixed ones, the registers: reading one costs
// 6 gas, half of what a field of a memory struct costs, and no stack slot. Those that are the same for a whole frame or object are
// uniforms, in the words of graphics interfaces: the Renderer fills them at the same addresses, and hands them to the engine as they
// stand (see Uniforms.sol).

error RegistersOverlap();

/// @notice Keeps the memory of the registers free of everything that is allocated.
/// @param begin What the compiler keeps in memory must end before.
function reserveRegisters(uint256 begin, uint256 end) pure {
    if (freeMemory() > begin) revert RegistersOverlap();
    setFreeMemory(end);
}

function freeMemory() pure returns (uint256) {
    return load(0x40);
}

function setFreeMemory(uint256 free) pure {
    store(0x40, free);
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
