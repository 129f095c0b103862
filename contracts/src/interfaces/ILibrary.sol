// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {Fixed} from "../math/Fixed.sol";
import {Object} from "../scene/Scene.sol";
import {Item} from "../library/Item.sol";

/// @title ILibrary: meshes and scenes of the project by name. `Addresses.LIBRARY` is its address on every chain.
interface ILibrary {
    /// @notice There is nothing of that name: see `names`.
    error UnknownName(string name);
    /// @notice A part of it is not stored on this chain yet. Anyone can store it: `shackled library store NAME`.
    error NotStored(string name, address pointer);
    /// @notice A size is above 0, and below 2^20 units.
    error SizeOutOfRange(int256 size);

    /// @notice The names of all items, icons first.
    function names() external pure returns (string[] memory list);

    /// @notice An item by its name, whether it is stored on this chain or not.
    function find(string calldata name) external pure returns (Item memory);

    /// @notice Whether the meshes and the scene of an item are stored on this chain.
    function isStored(string calldata name) external view returns (bool);

    /// @notice The objects of an item, upright, around the origin: its longest side is `size` long. Add them to a scene, moved and turned
    /// as you like; their meshes are pointers, which the Studio opens.
    function objects(string calldata name, Fixed size) external view returns (Object[] memory list);
}
