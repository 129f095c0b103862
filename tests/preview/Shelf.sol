// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

interface ILibrary {
    function isStored(string calldata name) external view returns (bool);
}

/// @notice Shows whether the items of the library are stored.
contract Shelf {
    ILibrary private immutable items;

    constructor(ILibrary items_) {
        items = items_;
    }

    function image() external view returns (string memory) {
        require(items.isStored("crown"), "not stored");
        return "<svg xmlns='http://www.w3.org/2000/svg'/>";
    }
}
