// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {Background} from "../scene/Scene.sol";

/// @notice The traits of a piece.
/// @param structure The arrangement of its prisms.
/// @param chroma The colour scheme.
/// @param pseudosymmetry The mirror symmetries.
/// @param prisms The number of prisms.
/// @param wireframe Whether only the edges are drawn.
/// @param invert Whether the colours are inverted.
struct Traits {
    string structure;
    string chroma;
    string pseudosymmetry;
    uint256 prisms;
    bool wireframe;
    bool invert;
}

/// @notice The piece generated from a seed.
/// @param traits The traits.
/// @param background The background, as in a scene.
/// @param culling Whether back faces are culled.
/// @param mesh The mesh in the format of `Mesh.sol`: six vertices and seven faces for each prism.
struct Piece {
    Traits traits;
    Background background;
    bool culling;
    bytes mesh;
}
