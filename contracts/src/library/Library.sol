// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {number} from "../mesh/Kinds.sol";
import {Meshes} from "../studio/Meshes.sol";
import {CULL_BACKFACES, Material, Object, Vector, Quaternion, Fixed, ZERO, ONE} from "../scene/Scene.sol";
import {ILibrary} from "../interfaces/ILibrary.sol";
import {Item} from "../interfaces/Item.sol";
import {ItemTable} from "./ItemTable.sol";

/// @title Library: the meshes and scenes of the project by name, the same on every chain.
/// @notice Has no storage and no owner. The table of items is part of the code (`ItemTable`). It contains the pointers at which the Studio
/// stores each item; anyone can store an item.
contract Library is ILibrary {
    /// @dev A row of the table: the length of the name, the name, IS_ICON and the number of meshes, the scene, bounds (six 16-bit numbers),
    /// and the number of triangles (16 bits); then, for each mesh, its address and its material: shading, three coefficients in hundredths,
    /// shininess.
    uint256 private constant IS_ICON = 0x80;
    uint256 private constant ADDRESS_SIZE = 20;
    uint256 private constant BOUNDS_SIZE = 12;
    uint256 private constant MESH_SIZE = 25;
    /// @dev The size of a row without the name and the meshes, in bytes.
    uint256 private constant FIXED_SIZE = 36;
    int256 private constant MAX_SIZE = 1 << 52;

    function names() external pure returns (string[] memory list) {
        bytes memory table = ItemTable.table();
        list = new string[](ItemTable.COUNT);
        uint256 row;
        for (uint256 k; k != list.length; ++k) {
            list[k] = nameOf(table, row);
            row = next(table, row);
        }
    }

    function find(string calldata name) public pure returns (Item memory item) {
        bytes memory table = ItemTable.table();
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

    function isStored(string calldata name) external view returns (bool) {
        return missing(find(name)) == address(0);
    }

    function objects(string calldata name, Fixed size) external view returns (Object[] memory list) {
        Item memory item = find(name);
        address absent = missing(item);
        if (absent != address(0)) revert NotStored(name, absent);
        if (size.raw() <= 0 || size.raw() >= MAX_SIZE) revert SizeOutOfRange(size.raw());
        bytes memory table = ItemTable.table();
        uint256 place = rowOf(table, name) + bytes(name).length + FIXED_SIZE;
        int256 longest = 1;
        for (uint256 k; k != 3; ++k) {
            if (item.high[k] - item.low[k] > longest) longest = item.high[k] - item.low[k];
        }
        Fixed scale = Fixed.wrap(size.raw() / longest);
        if (scale.raw() == 0) revert SizeOutOfRange(size.raw());
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

    /// @dev Returns the first mesh or scene of an item that is not stored on this chain; zero if there is none.
    function missing(Item memory item) private view returns (address) {
        for (uint256 k; k != item.meshes.length; ++k) {
            if (item.meshes[k].code.length == 0) return item.meshes[k];
        }
        return item.scene.code.length == 0 ? item.scene : address(0);
    }

    /// @dev Returns the position of an object that moves the centre of its bounds to the origin.
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

    /// @dev Returns the position of the row with a name.
    function rowOf(bytes memory table, string calldata name) private pure returns (uint256 row) {
        for (uint256 k; k != ItemTable.COUNT; ++k) {
            if (keccak256(bytes(nameOf(table, row))) == keccak256(bytes(name))) return row;
            row = next(table, row);
        }
        revert UnknownName(name);
    }

    /// @dev Returns the position of the next row.
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
}
