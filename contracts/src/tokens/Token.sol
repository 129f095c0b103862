// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {ERC721A, IERC721A} from "erc721a/contracts/ERC721A.sol";
import {ERC721AQueryable} from "erc721a/contracts/extensions/ERC721AQueryable.sol";
import {TokenErrors} from "../interfaces/TokenErrors.sol";

/// @title Token: the common part of all collections. Each token keeps a number of 24 bits next to its owner.
abstract contract Token is ERC721AQueryable, TokenErrors {
    uint256 internal constant HIGHEST_ROYALTY = 1000;

    /// @dev The number of the tokens that are being minted.
    uint24 private transient minting;

    /// @dev Mints tokens.
    /// @param number What the tokens keep: their edition, icon or round.
    function hand(address to, uint256 quantity, uint24 number) internal {
        minting = number;
        _safeMint(to, quantity);
    }

    /// @dev Returns the number that a token keeps.
    function numberOf(uint256 tokenId) internal view returns (uint256) {
        return _ownershipOf(tokenId).extraData;
    }

    /// @dev Keeps the number of a token across transfers.
    function _extraData(address from, address, uint24 previous) internal view virtual override returns (uint24) {
        return from == address(0) ? minting : previous;
    }

    /// @dev Sends ether.
    function pay(address to, uint256 amount) internal {
        bool done = to != address(0);
        // copies no return data, so a receiver cannot make the call expensive
        assembly ("memory-safe") {
            if done { done := call(gas(), to, amount, 0, 0, 0, 0) }
        }
        if (!done) revert WithdrawalRefused(to, amount);
    }

    // ---- ERC-721A's payable functions ----

    function approve(address to, uint256 tokenId) public payable override(ERC721A, IERC721A) {
        if (msg.value != 0) revert PaymentForNothing(msg.value);
        super.approve(to, tokenId);
    }

    function _beforeTokenTransfers(address from, address, uint256, uint256) internal view override {
        if (from != address(0) && msg.value != 0) revert PaymentForNothing(msg.value);
    }
}
