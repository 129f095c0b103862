// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import "./SampleRegisters.sol";

// Written by tools/layout.py from layout.toml.

// --------------------------------------------------------------------------------------------------------------------------------- bounds

uint256 constant EFFECT_REGISTERS_END = 0x46e0;

// ------------------------------------------------------------------------------------------------------------------- effects of the frame
// The uniforms of the frame that the contract Effects computes: see EffectUniforms.

/// @dev The beginning of these registers, and their size in bytes.
uint256 constant EFFECT_FRAME_BEGIN = 0x3c60;
uint256 constant EFFECT_FRAME_SIZE = 0x360;
/// @dev The y axis of the world in camera space, Q24.
uint256 constant UP_X = 0x3c60;
uint256 constant UP_Y = 0x3c80;
uint256 constant UP_Z = 0x3ca0;
/// @dev The light at the silhouettes of objects, lanes of Q10, and the exponent of its falloff.
uint256 constant RIM_COLOR = 0x3cc0;
uint256 constant RIM_POWER = 0x3ce0;
/// @dev The colour of the fog, lanes of Q10; the distance at which it begins, and the additional distance at which it is opaque, Q32: 0
/// without fog.
uint256 constant FOG_COLOR = 0x3d00;
uint256 constant FOG_NEAR = 0x3d20;
uint256 constant FOG_RANGE = 0x3d40;
/// @dev 1 if there is a TONE with an effect; the exposure, Q16, and its flags.
uint256 constant IS_TONED = 0x3d60;
uint256 constant EXPOSURE = 0x3d80;
uint256 constant TONE_FLAGS = 0x3da0;
/// @dev The offset of the shadows in the answer of Effects, 0 if no light casts any: see Shadows.
uint256 constant SHADOWS_OFFSET = 0x3dc0;
/// @dev The record of the light that casts shadows, 0 if none does.
uint256 constant SHADOW_LIGHT = 0x3de0;
/// @dev LIGHT_COLOR of each light, with effects in lanes of Q10.
uint256 constant LIGHT_COLORS = 0x3e00;
/// @dev 16 bits each: the linear level of every fourth level of sRGB, Q7: see Gamma.
uint256 constant DECODE_TABLE = 0x3e80;
/// @dev 16 bits each: the level of a linear value, eight for each power of two from 2^7 in Q16 on, Q8.
uint256 constant ENCODE_TABLE = 0x3f20;

// ------------------------------------------------------------------------------------------------------------------- effects of an object
// The uniforms of an object that the contract Effects computes.

/// @dev The beginning of these registers, and their size in bytes.
uint256 constant EFFECT_OBJECT_BEGIN = 0x3fc0;
uint256 constant EFFECT_OBJECT_SIZE = 0x2c0;
/// @dev The light from above and from below times the ambient coefficient, lanes of Q16.
uint256 constant HEMISPHERE_SKY = 0x3fc0;
uint256 constant HEMISPHERE_GROUND = 0x3fe0;
/// @dev The light that it emits, lanes of Q10.
uint256 constant EMISSION = 0x4000;
/// @dev 1 if it emits light, or there is a rim, a tone or fog.
uint256 constant IS_CHANGED = 0x4020;
/// @dev AMBIENT of the object.
uint256 constant OBJECT_AMBIENT = 0x4040;
/// @dev LIGHT_DIFFUSE of each light.
uint256 constant LIGHT_DIFFUSES = 0x4060;
/// @dev The y axis of the world in mesh space, Q24, signed lanes of 86 bits, z lowest.
uint256 constant UP_IN_MESH = 0x40e0;
/// @dev The calldata offset of its texture, 0 if it has none; and of the texture coordinates of its vertices.
uint256 constant TEXTURE = 0x4100;
uint256 constant TEXTURE_UVS = 0x4120;
/// @dev The calldata offset of the image of the opacities of its texels, 0 if it has none; the least of those that are drawn, Q16: opaque;
/// if it is 1, they are blended.
uint256 constant ALPHA = 0x4140;
uint256 constant ALPHA_LEAST = 0x4160;
/// @dev The calldata offset of the opacities of its vertices, 0 if they have none.
uint256 constant OPACITIES = 0x4180;
/// @dev 1 if it has a texture or opacities, or colours are decoded from sRGB.
uint256 constant HAS_DETAILS = 0x41a0;
/// @dev Not zero if something besides shadows may change the colour across a flat face of one colour without highlights: a texture,
/// opacities, fog, a rim, a point light. A new term that does so is added in EffectUniforms.setObject.
uint256 constant VARIES = 0x41c0;
/// @dev The fading of an object: the square of its outer radius, minus that of the inner one (0 if it does not fade); and its position in
/// camera space, Q32. See Ground.
uint256 constant FADE_SQUARE = 0x41e0;
uint256 constant FADE_RANGE = 0x4200;
uint256 constant FADE_X = 0x4220;
uint256 constant FADE_Y = 0x4240;
uint256 constant FADE_Z = 0x4260;

// ------------------------------------------------------------------------------------------------------------------------------- textures
// For the EffectsEngine: see Texture.

/// @dev The address of the object's vertex records, of 2^RECORD_SHIFT bytes each.
uint256 constant RECORDS = 0x4280;
uint256 constant RECORD_SHIFT = 0x42a0;
/// @dev Texture coordinates at the first vertex, Q40, and their differences to the others, Q16: two lanes of 128 bits, u below.
uint256 constant UV_0 = 0x42c0;
uint256 constant UV_1 = 0x42e0;
uint256 constant UV_2 = 0x4300;
/// @dev The three corners of a clipped face, with coordinates in place of colours.
uint256 constant TEXTURE_CORNERS = 0x4320;

// -------------------------------------------------------------------------------------------------- shadows, uniform triangles, opacities
// For the EffectsEngine: see ShadowRows and EffectSamples.

/// @dev The calldata offset of the shadows; 0 if no light casts any.
uint256 constant SHADOWS = 0x4560;
/// @dev OPACITY of the object, from which that of a fragment may differ while it is drawn.
uint256 constant OBJECT_OPACITY = 0x4580;
/// @dev LIGHT_COLOR and LIGHT_DIFFUSE of the light that casts shadows, outside shadows.
uint256 constant SHADOW_COLOR = 0x45a0;
uint256 constant SHADOW_DIFFUSE = 0x45c0;
/// @dev UNIFORM_DARK - UNIFORM_LIT while this light is off, for samples that it does not reach; otherwise 0.
uint256 constant IS_DARK = 0x45e0;
/// @dev The calldata offset of the first edge of the list of the face that is not above the row.
uint256 constant SHADOW_BEGIN = 0x4600;
/// @dev The calldata offset of the entries of the object's faces.
uint256 constant SHADOW_FACES = 0x4620;
/// @dev The address of a word for each column: the samples of the row that are in shadow.
uint256 constant SHADOW_ROW = 0x4640;
/// @dev 1 if all fragments of the triangle have one colour except for shadows; that colour, and that in shadow, plus ONE_24; 0 if it is not
/// computed yet.
uint256 constant IS_UNIFORM = 0x4660;
uint256 constant UNIFORM_LIT = 0x4680;
uint256 constant UNIFORM_DARK = 0x46a0;

// ------------------------------------------------------------------------------------------------------- triangle of a scene with effects

/// @dev The y component of a flat face's unit normal in world space, Q24, -1..1.
uint256 constant FACE_UP = 0x46c0;
