// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

/// @title RegisterErrors: the error of registers.
interface RegisterErrors {
    /// @notice Internal error: no scene causes it.
    error RegistersOverlap();
}
