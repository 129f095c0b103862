// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

// Written by tools/layout.py from layout.toml.

// ------------------------------------------------------------------------------------------------------------ records of Scene.extensions

/// @dev The cone of a point light.
uint256 constant SPOT = 1;
/// @dev The opacity of an object.
uint256 constant OPACITY_OF = 2;
/// @dev Edges are smoothed. The kinds above are effects.
uint256 constant ANTIALIAS = 3;
/// @dev Light from above and from below.
uint256 constant HEMISPHERE = 4;
/// @dev Light at silhouettes.
uint256 constant RIM = 5;
uint256 constant FOG = 6;
/// @dev Exposure and tone curve.
uint256 constant TONE = 7;
/// @dev A texture, with the coordinates of vertices.
uint256 constant TEXTURE_OF = 8;
/// @dev Opacities of vertices.
uint256 constant OPACITIES_OF = 9;
/// @dev The light casts shadows.
uint256 constant SHADOW = 10;
/// @dev The object fades into the background, and casts no shadow.
uint256 constant GROUND = 11;
/// @dev The object emits light.
uint256 constant EMISSION_OF = 12;
/// @dev The opacities of the texels of a texture.
uint256 constant ALPHA_OF = 13;
/// @dev Flags of a TONE: the filmic curve; lighting in linear light, with colours decoded from and encoded as sRGB.
uint256 constant TONE_FILMIC = 1;
uint256 constant TONE_GAMMA = 2;
/// @dev Flags of a TEXTURE_OF: bilinear interpolation; clamping to the edge.
uint256 constant TEXTURE_BILINEAR = 1;
uint256 constant TEXTURE_CLAMP = 2;
/// @dev The faces of culled objects that cast shadows: all; those that face away from the light, which suffice if all such objects together
/// are closed; those that face the light.
uint256 constant SHADOWS_ALL = 1;
uint256 constant SHADOWS_BACK_FACES = 2;
uint256 constant SHADOWS_FRONT_FACES = 3;
/// @dev The first kind whose size is given in words, not in bytes.
uint256 constant LONG_KINDS = 8;
/// @dev Bytes of a record before its content.
uint256 constant RECORD_HEADER = 5;
/// @dev What a kind belongs to: two bits at twice its number, 0 if it is unknown.
uint256 constant RECORD_OWNERS = 0xfef5578;
uint256 constant OF_SCENE = 1;
uint256 constant OF_LIGHT = 2;
uint256 constant OF_OBJECT = 3;
/// @dev Bytes of the content: a byte at 8 times its number; ANY_WORDS for any words.
uint256 constant RECORD_SIZES = 0xff202020ffff0513040600042800;
uint256 constant ANY_WORDS = 255;
