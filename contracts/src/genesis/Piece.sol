// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {Background} from "../scene/Scene.sol";

/// @notice What a piece is called.
/// @param structure How its prisms are arranged.
/// @param chroma The scheme of its colours.
/// @param pseudosymmetry Its mirrors.
/// @param prisms How many it has.
/// @param wireframe Whether only edges are drawn.
/// @param invert Whether its colours are inverted.
struct Traits {
    string structure;
    string chroma;
    string pseudosymmetry;
    uint256 prisms;
    bool wireframe;
    bool invert;
}

/// @notice What a seed stands for.
/// @param traits What it is called.
/// @param background As in a scene.
/// @param culling Whether faces that turn away are left out.
/// @param mesh In the format of `Mesh.sol`: six vertices and seven faces a prism.
struct Piece {
    Traits traits;
    Background background;
    bool culling;
    bytes mesh;
}
