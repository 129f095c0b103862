// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Fixed, ZERO, ONE} from "../math/Fixed.sol";
import {Vector} from "../math/Vector.sol";
import {Quaternion} from "../math/Quaternion.sol";
import {Meshes} from "../mesh/Meshes.sol";
import {CULL_BACKFACES, Material, Object} from "../scene/Scene.sol";
import {Item} from "./Item.sol";
import {Shelf} from "./Shelf.sol";

/// @title Library: meshes and scenes of the project by name, the same on every chain.
/// @notice Without storage and without an owner. The table is part of the code (`Shelf`): where the Studio keeps each item, once anybody
/// has stored it.
contract Library {
    /// @dev A row of the table: how many bytes the name has, the name, IS_ICON and the number of meshes, scene, bounds (six numbers of 16
    /// bits), triangles (16 bits); then of each mesh its address and its material: shading, three coefficients in hundredths, shininess.
    uint256 private constant IS_ICON = 0x80;
    uint256 private constant ADDRESS_SIZE = 20;
    uint256 private constant BOUNDS_SIZE = 12;
    uint256 private constant MESH_SIZE = 25;
    /// @dev Bytes of a row without the name and the meshes.
    uint256 private constant FIXED_SIZE = 36;
    int256 private constant MAX_SIZE = 1 << 52;

    /// @notice There is nothing of that name: see `names`.
    error UnknownName(string name);
    /// @notice A part of it is not stored on this chain yet. Anyone can store it: `shackled library store NAME`.
    error NotStored(string name, address pointer);
    /// @notice A size is above 0, and below 2^20 units.
    error SizeOutOfRange(int256 size);

    /// @notice The names of all items, icons first.
    function names() external pure returns (string[] memory list) {
        bytes memory table = Shelf.table();
        list = new string[](Shelf.COUNT);
        uint256 row;
        for (uint256 k; k != list.length; ++k) {
            list[k] = nameOf(table, row);
            row = next(table, row);
        }
    }

    /// @notice An item by its name, whether it is stored on this chain or not.
    function find(string calldata name) public pure returns (Item memory item) {
        bytes memory table = Shelf.table();
        uint256 place = rowOf(table, name) + 1 + bytes(name).length;
        uint256 flags = number(table, place++, 1);
        item.isIcon = flags & IS_ICON != 0;
        item.meshes = new address[](flags & ~IS_ICON);
        item.scene = address(uint160(number(table, place, ADDRESS_SIZE)));
        place += ADDRESS_SIZE;
        for (uint256 k; k != 3; ++k) {
            item.low[k] = int16(uint16(number(table, place + 2 * k, 2)));
            item.high[k] = int16(uint16(number(table, place + 6 + 2 * k, 2)));
        }
        place += BOUNDS_SIZE;
        item.triangles = number(table, place, 2);
        place += 2;
        for (uint256 k; k != item.meshes.length; ++k) {
            item.meshes[k] = address(uint160(number(table, place + k * MESH_SIZE, ADDRESS_SIZE)));
        }
    }

    /// @notice Whether the meshes and the scene of an item are stored on this chain.
    function isStored(string calldata name) external view returns (bool) {
        return missing(find(name)) == address(0);
    }

    /// @notice The objects of an item, upright, around the origin: its longest side is `size` long. Add them to a scene, moved and turned
    /// as you like; their meshes are pointers, which the Studio opens.
    function objects(string calldata name, Fixed size) external view returns (Object[] memory list) {
        Item memory item = find(name);
        address absent = missing(item);
        if (absent != address(0)) revert NotStored(name, absent);
        if (size.raw() <= 0 || size.raw() >= MAX_SIZE) revert SizeOutOfRange(size.raw());
        bytes memory table = Shelf.table();
        uint256 place = rowOf(table, name) + bytes(name).length + FIXED_SIZE;
        int256 longest = 1;
        for (uint256 k; k != 3; ++k) {
            if (item.high[k] - item.low[k] > longest) longest = item.high[k] - item.low[k];
        }
        Fixed scale = Fixed.wrap(size.raw() / longest);
        list = new Object[](item.meshes.length);
        for (uint256 k; k != list.length; ++k) {
            Object memory object = list[k];
            object.mesh = Meshes.pointed(item.meshes[k]);
            object.position = Vector(middle(item, 0, scale), middle(item, 1, scale), middle(item, 2, scale));
            object.rotation = Quaternion(ZERO, ZERO, ZERO, ONE);
            object.scale = scale;
            object.material = material(table, place + k * MESH_SIZE + ADDRESS_SIZE);
            object.flags = CULL_BACKFACES;
        }
    }

    /// @dev The first part of an item that is not stored on this chain; zero if there is none.
    function missing(Item memory item) private view returns (address) {
        for (uint256 k; k != item.meshes.length; ++k) {
            if (item.meshes[k].code.length == 0) return item.meshes[k];
        }
        return item.scene.code.length == 0 ? item.scene : address(0);
    }

    /// @dev Where an object lies so that the middle of its bounds is at the origin.
    function middle(Item memory item, uint256 k, Fixed scale) private pure returns (Fixed) {
        return Fixed.wrap(-(item.low[k] + item.high[k]) * scale.raw() / 2);
    }

    function material(bytes memory table, uint256 place) private pure returns (Material memory) {
        return Material(
            number(table, place, 1),
            percent(number(table, place + 1, 1)),
            percent(number(table, place + 2, 1)),
            percent(number(table, place + 3, 1)),
            number(table, place + 4, 1)
        );
    }

    function percent(uint256 value) private pure returns (Fixed) {
        return Fixed.wrap(int256(value << 32) / 100);
    }

    /// @dev The place of the row of a name.
    function rowOf(bytes memory table, string calldata name) private pure returns (uint256 row) {
        for (uint256 k; k != Shelf.COUNT; ++k) {
            if (keccak256(bytes(nameOf(table, row))) == keccak256(bytes(name))) return row;
            row = next(table, row);
        }
        revert UnknownName(name);
    }

    /// @dev The place of the row behind a row.
    function next(bytes memory table, uint256 row) private pure returns (uint256) {
        uint256 size = number(table, row, 1);
        return row + size + FIXED_SIZE + (number(table, row + 1 + size, 1) & ~IS_ICON) * MESH_SIZE;
    }

    function nameOf(bytes memory table, uint256 row) private pure returns (string memory name) {
        uint256 size = number(table, row, 1);
        name = new string(size);
        assembly ("memory-safe") {
            mcopy(add(name, 32), add(add(table, 33), row), size)
        }
    }

    /// @dev A number of so many bytes.
    function number(bytes memory table, uint256 place, uint256 size) private pure returns (uint256 value) {
        assembly ("memory-safe") {
            value := shr(sub(256, shl(3, size)), mload(add(add(table, 32), place)))
        }
    }
}
