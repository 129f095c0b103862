// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

/// @notice A model of the library.
/// @param scene Where the Studio keeps the scene that shows it: `IStudio.renderPNG`.
/// @param meshes Where it keeps the meshes, one for each material.
/// @param low The least coordinates of all meshes together, x, y and z.
/// @param high The greatest ones.
/// @param triangles How many all meshes have.
/// @param isIcon Whether it is an icon; the others are common objects.
struct Item {
    address scene;
    address[] meshes;
    int256[3] low;
    int256[3] high;
    uint256 triangles;
    bool isIcon;
}
