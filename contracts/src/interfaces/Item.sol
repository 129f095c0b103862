// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

/// @notice An item of the library.
/// @param scene The pointer to the scene that shows the item, for `IStudio.renderPNG`.
/// @param meshes The pointers to the meshes, one for each material.
/// @param low The minimum x, y and z coordinates of all meshes.
/// @param high The maximum coordinates.
/// @param triangles The total number of triangles.
/// @param isIcon Whether the item is an icon; the others are common objects.
struct Item {
    address scene;
    address[] meshes;
    int256[3] low;
    int256[3] high;
    uint256 triangles;
    bool isIcon;
}
