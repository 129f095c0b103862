// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

/// @title TokenErrors: the errors of minting, payments and royalties, common to all collections.
interface TokenErrors {
    /// @notice The quantity must be 1 to `perTransaction`; that of an artist's free copies may be 0.
    error Quantity(uint256 quantity, uint256 perTransaction);
    /// @notice The payment must be exactly `due`, in wei.
    error Payment(uint256 sent, uint256 due);
    /// @notice Transfers and approvals accept no ether.
    error PaymentForNothing(uint256 sent);
    /// @notice The quantity exceeds the number of tokens left.
    error NothingLeft(uint256 quantity, uint256 left);
    /// @notice The receiver did not accept the ether.
    error WithdrawalRefused(address to, uint256 amount);
    /// @notice The royalty exceeds the highest one, in basis points.
    error Royalty(uint256 royalty, uint256 highest);
}
