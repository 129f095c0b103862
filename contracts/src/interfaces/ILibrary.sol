// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {Object, Fixed} from "../scene/Scene.sol";
import {Item} from "./Item.sol";

/// @title ILibrary: the meshes and scenes of the project by name. `Addresses.LIBRARY` is its address on every chain.
interface ILibrary {
    /// @notice No item has this name. `names` lists all items.
    error UnknownName(string name);
    /// @notice A mesh or the scene of the item is not stored on this chain yet. Anyone can store it: `shackled library store NAME`.
    error NotStored(string name, address pointer);
    /// @notice The size must be above 0 and below 2^20 units.
    error SizeOutOfRange(int256 size);

    /// @notice Returns the names of all items, icons first.
    function names() external pure returns (string[] memory list);

    /// @notice Returns an item by its name, whether it is stored on this chain or not.
    function find(string calldata name) external pure returns (Item memory);

    /// @notice Returns whether the meshes and the scene of an item are stored on this chain.
    function isStored(string calldata name) external view returns (bool);

    /// @notice Returns the objects of an item, upright, centred at the origin, scaled so that the longest side is `size`. They can be moved
    /// and rotated, and added to a scene. Their meshes are pointers, which the Studio resolves.
    function objects(string calldata name, Fixed size) external view returns (Object[] memory list);
}
