// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

// Written by tools/layout.py from layout.toml.

// ------------------------------------------------------------------------------------------------------------- vertex of a smooth surface

/// @dev More words of its record: the normal; with one light, the normal with reversed lanes; the direction to the light with reversed
/// lanes, Q21 and even; the half vector, Q29; the half vector with reversed lanes, Q21 and even; and whether they can be used: see
/// SmoothVertex.
uint256 constant VERTEX_NORMAL = 64;
uint256 constant VERTEX_REVERSED = 96;
uint256 constant VERTEX_LIGHT = 128;
uint256 constant VERTEX_HALF = 160;
uint256 constant VERTEX_HALF_REVERSED = 192;
uint256 constant VERTEX_STATE = 224;
/// @dev Such a record has 2^8 bytes for each lamp.
uint256 constant SMOOTH_RECORD_BITS = 8;
uint256 constant SMOOTH_RECORD_SIZE = 0x100;
/// @dev In its last word, above the state: the numbers of neighbours, 16 bits each, with 1 and the highest bit in each; the positions of
/// the first and the last; a number. See OpenEdges.
uint256 constant NUMBERS = 0xffffffffffffffffffffffffffffffffffffffffffffffffffff000000000000;
uint256 constant NUMBER_ONES = 0x1000100010001000100010001000100010001000100010001000000000000;
uint256 constant NUMBER_TOPS = 0x8000800080008000800080008000800080008000800080008000000000000000;
uint256 constant NUMBER_BITS = 16;
uint256 constant VERTEX_NUMBER_MASK = 0xffff;
uint256 constant FIRST_NUMBER_AT = 48;
uint256 constant LAST_NUMBER_AT = 240;

// ----------------------------------------------------------------------------------------------------------------------------- guard band

/// @dev The guard band reaches from pixel -PIXEL_BIAS to GUARD_BAND - PIXEL_BIAS; the canvas lies at 0..2048 in it.
uint256 constant PIXEL_BIAS = 0x600;
uint256 constant GUARD_BAND = 0x1000;
/// @dev Bits of a sub-pixel coordinate inside the guard band.
uint256 constant GUARD_BITS = 20;

// ----------------------------------------------------------------------------------------------------------------------------- sub-pixels

/// @dev The fraction bits of a sub-pixel coordinate.
uint256 constant SUBPIXEL_BITS = 8;
/// @dev The mask of these bits; added before a right shift, it rounds up.
uint256 constant SUBPIXEL_MASK = 255;
uint256 constant HALF_PIXEL = 128;
uint256 constant ONE_PIXEL = 0x100;
/// @dev The same of one with 16 more bits.
uint256 constant SUBPIXEL_Q16_BITS = 24;
uint256 constant SUBPIXEL_Q16_MASK = 0xffffff;
/// @dev Shifted left by this, a quotient of sub-pixel lengths and twice an area is Q24 per pixel.
uint256 constant SUBPIXEL_TO_Q24 = 32;

// -------------------------------------------------------------------------------------------------------------------- fixed-point formats

/// @dev Fraction bits. Numbers are converted between formats by shifts by the difference.
uint256 constant Q10 = 10;
uint256 constant Q14 = 14;
uint256 constant Q16 = 16;
uint256 constant Q20 = 20;
uint256 constant Q24 = 24;
uint256 constant Q32 = 32;
uint256 constant Q34 = 34;
uint256 constant Q40 = 40;
uint256 constant Q48 = 48;
uint256 constant Q16_TO_Q10 = 6;
uint256 constant Q26_TO_Q58 = 32;
uint256 constant Q26_TO_Q34 = 8;
uint256 constant Q24_TO_Q16 = 8;
uint256 constant Q40_TO_Q16 = 24;
uint256 constant Q32_TO_Q24 = 8;
uint256 constant Q24_TO_Q58 = 34;
uint256 constant Q72_TO_Q24 = 48;
/// @dev The position of a word's sign; shifted to the right by this, with the sign, a word is -1 if it is negative, else 0.
uint256 constant SIGN_AT = 255;
/// @dev One in each.
uint256 constant ONE_10 = 0x400;
uint256 constant ONE_16 = 0x10000;
uint256 constant HALF_24 = 0x800000;
uint256 constant ONE_24 = 0x1000000;
uint256 constant ONE_32 = 0x100000000;
uint256 constant ONE_44 = 0x100000000000;
uint256 constant ONE_48 = 0x1000000000000;
/// @dev The maximum depth of a vertex is 2 to this power: see DEPTH_SCALE.
uint256 constant DEPTH_BITS = 54;

// ----------------------------------------------------------------------------------------------------------------------- mesh in calldata

/// @dev The colour of a vertex, 24 bits at the top of a word.
uint256 constant MESH_COLOR_AT = 232;
/// @dev A component of a normal, 10 bits at the top of a word; and the offsets of the others below it.
uint256 constant MESH_NORMAL_AT = 246;
uint256 constant MESH_NORMAL_Y = 10;
uint256 constant MESH_NORMAL_Z = 20;
/// @dev Bytes of a face.
uint256 constant FACE_SIZE = 6;
/// @dev The three vertex indices of a face at the top of a word; the positions of the first and the second in them; an index.
uint256 constant FACE_AT = 208;
uint256 constant FACE_FIRST_AT = 32;
/// @dev The first and the second in the word of calldata.
uint256 constant FACE_FIRST_IN_WORD = 240;
uint256 constant FACE_SECOND_IN_WORD = 224;
uint256 constant FACE_SECOND_AT = 16;
uint256 constant FACE_INDEX_MASK = 0xffff;

// ----------------------------------------------------------------------------------------------------- parts of colours of an accumulator

/// @dev Multiplier that collects BYTES_OF_LANES at the top of a word; the bits below are undefined.
uint256 constant LANES_TO_BYTES = 0x4000000000000000400000000000000040000000000000000000;
/// @dev The distance from the lowest bit of the next lane to that of a byte.
uint256 constant NEXT_LANE_TO_BYTE = 14;

// ------------------------------------------------------------------------------------------------------------------------ words of memory

/// @dev A word has 2^5 bytes.
uint256 constant WORD_SHIFT = 5;

// ------------------------------------------------------------------------------------------------------------------- words of the buffers

/// @dev The first depth of a word, the next two, and everything after the first.
uint256 constant FIRST_DEPTH = 0xffffffffffffffff000000000000000000000000000000000000000000000000;
uint256 constant SECOND_DEPTH = 0xffffffffffffffff00000000000000000000000000000000;
uint256 constant THIRD_DEPTH = 0xffffffffffffffff0000000000000000;
uint256 constant BEHIND_DEPTH = 0xffffffffffffffffffffffffffffffffffffffffffffffff;

// ---------------------------------------------------------------------------------------------------------------------------------- light

/// @dev The positions of Q16 numbers in lanes of Q40.
uint256 constant BLUE_Q40_AT = 24;
uint256 constant GREEN_Q40_AT = 80;
uint256 constant RED_Q40_AT = 136;
/// @dev The bytes of the table of the highlight.
uint256 constant SPECULAR_SIZE = 0x820;
/// @dev The number of steps in the table of the highlight; the index of its last entry, Q40.
uint256 constant SPECULAR_ENTRIES = 64;
uint256 constant SPECULAR_LAST = 0x400000000000;
/// @dev The shift from an index into the table, Q40, to bytes; the mask of whole words; the position and mask of the fraction between two
/// entries, Q16.
uint256 constant SPECULAR_ENTRY_SHIFT = 35;
uint256 constant SPECULAR_ENTRY_MASK = 0xffffe0;
uint256 constant SPECULAR_REST_AT = 24;
uint256 constant SPECULAR_REST_MASK = 0xffff;
/// @dev SPECULAR_BEGIN of a material without a highlight.
uint256 constant NO_HIGHLIGHT = 0x7fffffffffffffffffffffffffffffffffffffffffffffffffffffffffffffff;
/// @dev The position of the light of a quadratic function, Q24, with its lane of 64 bits at the top of a word: see SmoothLight.
uint256 constant LIGHT_AT = 221;
/// @dev That of N * L if there is one lamp.
uint256 constant N_DOT_L_Q53_AT = 93;
/// @dev The shifts that move lanes of 64 bits to the top.
uint256 constant LANE_0_TO_TOP = 192;
uint256 constant LANE_1_TO_TOP = 128;
uint256 constant LANE_2_TO_TOP = 64;
/// @dev The position of the second lane, and of the third.
uint256 constant LANE_1_AT = 64;
uint256 constant LANE_2_AT = 128;
/// @dev From lanes of 56 bits to lanes of 85, the second and the third.
uint256 constant MIDDLE_56_TO_85 = 29;
uint256 constant UPPER_56_TO_85 = 58;
/// @dev The lanes of light times a highlight, Q16.
uint256 constant UPPER_LANE_24 = 0xffffff0000000000000000000000000000;
uint256 constant MIDDLE_LANE_24 = 0xffffff00000000000000;
/// @dev The position of an entry's value.
uint256 constant SPECULAR_VALUE_AT = 128;
/// @dev The same for an index in Q24; the mask of the fraction between two entries, at bit 128.
uint256 constant SPECULAR_ENTRY_SHIFT_24 = 19;
uint256 constant SPECULAR_ENTRY_MASK_24 = 0xfe0;
uint256 constant SPECULAR_REST_AT_128 = 0xffffff00000000000000000000000000000000;

// --------------------------------------------------------------------------------------------------------------------- quadratic products

/// @dev At fragments: twice the root of N * N, Q34, is approximated within 3 % by ROOT_AT_0 + (N * N) * ROOT_SLOPE >> ROOT_SHIFT.
uint256 constant ROOT_AT_0 = 0x15f3aeee1;
uint256 constant ROOT_SLOPE = 0x2be;
uint256 constant ROOT_SHIFT = 44;
/// @dev The positions of N * L as Q59 and N * H as Q46, with their lanes at the top of a word.
uint256 constant N_DOT_L_AT = 180;
uint256 constant N_DOT_H_AT = 193;

// ------------------------------------------------------------------------------------------------------------------- normals of fragments

/// @dev The positions of Q24 numbers in interpolated normals (Q36, lanes of 85 bits), their mask, and the bias that keeps them positive.
uint256 constant NORMAL_X_AT = 12;
uint256 constant NORMAL_Y_AT = 97;
uint256 constant NORMAL_Z_AT = 182;
uint256 constant NORMAL_MASK = 0x7ffffff;
uint256 constant NORMAL_HALF = 0x4000000;
/// @dev That bias in each lane.
uint256 constant NORMAL_BIAS = 0x10000000000000000000008000000000000000000004000000000;

// ---------------------------------------------------------------------------------------------------------------------------- screen word
// The position of a vertex on the screen. Comparing screen words as numbers compares rows. The bits below the column must stay below bit
// 41: see the area in PrimitiveAssembly, to whose error they contribute 2^149 times; half of the minimum area is 2^191.
// | 128..147 row | 64..83 column | 36 IS_BELOW | 35 IS_ABOVE | 34 IS_RIGHT | 33 IS_LEFT | 32 MUST_CLIP | 0..31 record

/// @dev Address of the vertex record.
uint256 constant SCREEN_RECORD_MASK = 0xffffffff;
/// @dev The triangle must be clipped.
uint256 constant MUST_CLIP = 0x100000000;
/// @dev The vertex lies left of the tile; right of it; above it; below it.
uint256 constant IS_LEFT = 0x200000000;
uint256 constant IS_RIGHT = 0x400000000;
uint256 constant IS_ABOVE = 0x800000000;
uint256 constant IS_BELOW = 0x1000000000;
/// @dev Sub-pixel column.
uint256 constant SCREEN_COLUMN_AT = 64;
uint256 constant SCREEN_COLUMN_MASK = 0xfffff;
/// @dev Sub-pixel row.
uint256 constant SCREEN_ROW_AT = 128;

// ------------------------------------------------------------------------------------------------------------------ parts of screen words

/// @dev All bits of the column.
uint256 constant SCREEN_COLUMNS = 0xfffff0000000000000000;
/// @dev Row in whole pixels.
uint256 constant SCREEN_PIXEL_ROW_AT = 136;

// --------------------------------------------------------------------------------------------------------- flags of screen words together

/// @dev Left or right; above or below; any of them; that or MUST_CLIP.
uint256 constant OUTSIDE_COLUMNS = 0x600000000;
uint256 constant OUTSIDE_ROWS = 0x1800000000;
uint256 constant IS_OUTSIDE = 0x1e00000000;
uint256 constant NEEDS_CARE = 0x1f00000000;

// ------------------------------------------------------------------------------------------------------------------------- attribute word
// Depth and colours of a vertex: colours as described below, Q10. For a vertex that must be clipped, the outcode instead.
// | 168..223 depth | 112..167 red | 56..111 green | 0..55 blue

/// @dev Depth: see DEPTH_SCALE.
uint256 constant ATTRIBUTE_DEPTH_AT = 168;

// ---------------------------------------------------------------------------------------------------------------------------- accumulator
// An attribute word with 32 more bits, incremented from pixel to pixel. It may contain barycentric coordinates in place of colours: s in
// the middle lane, t in the lowest.
// | 192..255 depth | 112..167 red | 56..111 green or s | 0..55 blue or t

/// @dev Depth with 8 more bits than in a vertex, as in the buffer.
uint256 constant ACCUMULATOR_DEPTH_AT = 192;

// ------------------------------------------------------------------------------------------------------------------ parts of accumulators

/// @dev The additional bits of a depth compared to a vertex.
uint256 constant DEPTH_FRACTION = 8;
/// @dev A depth of the buffer has 2^3 bytes.
uint256 constant DEPTH_SIZE_BITS = 3;
/// @dev The additional bits of an accumulator compared to an attribute word.
uint256 constant ACCUMULATOR_FRACTION = 32;
/// @dev Depth as in a vertex.
uint256 constant ACCUMULATOR_VERTEX_DEPTH_AT = 200;
/// @dev 1 in the lane of s.
uint256 constant ATTRIBUTE_S = 0x100000000000000;
/// @dev The positions of s and t as Q24 numbers, and the last bytes of their lanes.
uint256 constant ACCUMULATOR_S_AT = 64;
uint256 constant ACCUMULATOR_S_LAST_BYTE = 20;
uint256 constant ACCUMULATOR_T_AT = 8;
uint256 constant ACCUMULATOR_T_LAST_BYTE = 6;
/// @dev Bias of the lanes: half a level for colours.
uint256 constant COLOR_BIAS = 0x100000000000200000000000002000000000000020000000000;
/// @dev 2^-15 for barycentric coordinates, so that rounded gradients (see PixelRasterizer) leave none below zero; 2^-27 if they are fine.
uint256 constant WEIGHT_BIAS = 0x100000000000000000000000000000002000000000000020000;
/// @dev Fine barycentric coordinates, of scenes with effects, have 12 more bits: Q44. The lane of s is wider, so that t is still below it;
/// lanes of 56 bits hold -2048 to 2048.
uint256 constant FINE_BITS = 12;
/// @dev The factor minus 1; the position of s, and the last bytes of the lanes.
uint256 constant FINE_FACTOR_LESS_1 = 0xfff;
uint256 constant FINE_S_AT = 56;
uint256 constant FINE_S_LAST_BYTE = 18;
uint256 constant FINE_T_LAST_BYTE = 6;
/// @dev The shift from such a coordinate to Q24.
uint256 constant FINE_TO_24 = 20;
/// @dev The last byte of both lanes in an attribute word or an accumulator with coordinates that are not fine.
uint256 constant WEIGHTS_LAST_BYTE = 20;

// --------------------------------------------------------------------------------------------------------------------- triangle of a list
// The first vertex is the topmost, and the vertices are counter-clockwise on the screen.
// | 157 TURNED_AWAY_BIT | 147 CROSSING_BIT | 144..146 edges | 128..143 face | 112..127 bottom | 96..111 top | 64..95 a | 32..63 b | 0..31 c

/// @dev Addresses of the third, second and first vertex record.
uint256 constant TRIANGLE_C_MASK = 0xffffffff;
uint256 constant TRIANGLE_B_AT = 32;
uint256 constant TRIANGLE_B_MASK = 0xffffffff;
uint256 constant TRIANGLE_A_AT = 64;
uint256 constant TRIANGLE_A_MASK = 0xffffffff;
/// @dev The first pixel row that may be covered, and the row after the last.
uint256 constant TRIANGLE_TOP_AT = 96;
uint256 constant TRIANGLE_TOP_MASK = 0xffff;
uint256 constant TRIANGLE_BOTTOM_AT = 112;
uint256 constant TRIANGLE_BOTTOM_MASK = 0xffff;
/// @dev The number of the face.
uint256 constant TRIANGLE_FACE_AT = 128;
uint256 constant TRIANGLE_FACE_MASK = 0xffff;
/// @dev Which edges belong to the face: first to second vertex, second to third, third to first.
uint256 constant TRIANGLE_EDGES_AT = 144;
uint256 constant TRIANGLE_EDGES_MASK = 7;
/// @dev Whether it reaches beyond the left or right border of the tile.
uint256 constant CROSSING_BIT = 0x8000000000000000000000000000000000000;

// --------------------------------------------------------------------------------------------------------------------- parts of triangles

/// @dev The three edges.
uint256 constant EDGE_AB = 0x1000000000000000000000000000000000000;
uint256 constant EDGE_BC = 0x2000000000000000000000000000000000000;
uint256 constant EDGE_CA = 0x4000000000000000000000000000000000000;

// ----------------------------------------------------------------------------------------------------------------------- clip coordinates
// Column * distance, row * distance and distance, all Q32. The first two are signed, and CLIP_BIAS adds half their range to them.
// | 192..255 w | 96..191 y | 0..95 x

uint256 constant CLIP_X_MASK = 0xffffffffffffffffffffffff;
uint256 constant CLIP_Y_AT = 96;
uint256 constant CLIP_Y_MASK = 0xffffffffffffffffffffffff;
uint256 constant CLIP_W_AT = 192;

// -------------------------------------------------------------------------------------------------------------- parts of clip coordinates

uint256 constant CLIP_BIAS = 0x800000000000000000000000800000000000000000000000;
/// @dev The addend of each.
uint256 constant CLIP_HALF = 0x800000000000000000000000;

// ---------------------------------------------------------------------------------------------------------------------------------- edges
// Two columns, Q48, in lanes of 128 bits: the integer part is the first pixel whose centre is not left of the edge. A Q48 column is a Q45
// offset of depths in bytes: with the address of a row added, edges are addresses of depths.
// | 176..191 right column | 128..175 fraction | 48..63 left column | 0..47 fraction

/// @dev Whole pixels of the left edge, and of the right one.
uint256 constant EDGES_LEFT_COLUMN_AT = 48;
uint256 constant EDGES_LEFT_COLUMN_MASK = 0xffff;
uint256 constant EDGES_RIGHT_COLUMN_AT = 176;

// ------------------------------------------------------------------------------------------------------------------------- parts of edges

/// @dev The fraction bits of a column; of an edge as an address of depths.
uint256 constant EDGE_FRACTION = 48;
uint256 constant EDGE_ADDRESS_FRACTION = 45;
/// @dev The position of the right edge's address; the mask of an address of a depth, a multiple of 8.
uint256 constant EDGE_RIGHT_ADDRESS_AT = 173;
uint256 constant ADDRESS = 0xfffffff8;
/// @dev The shift from sub-pixels to a column.
uint256 constant EDGE_SUBPIXEL_SHIFT = 40;
uint256 constant HALF_COLUMN = 0x800000000000;
uint256 constant RIGHT_EDGE_AT = 128;
/// @dev Added to a Q48 number, it rounds up to the next integer, within the precision of such numbers.
uint256 constant CEIL_48 = 0xffffffffc000;
/// @dev 1 in both lanes.
uint256 constant ONES_128 = 0x100000000000000000000000000000001;
/// @dev The lower lane, and its last byte.
uint256 constant LANE_128 = 0xffffffffffffffffffffffffffffffff;
uint256 constant LANE_128_LAST_BYTE = 15;
uint256 constant UPPER_LANE_128 = 0xffffffffffffffffffffffffffffffff00000000000000000000000000000000;
/// @dev Shifted left by this, a quotient of sub-pixel lengths and twice an area is Q29 per pixel.
uint256 constant GRADIENT_SHIFT = 37;
/// @dev The shift from such a gradient times sub-pixels to the fraction of an accumulator.
uint256 constant GRADIENT_TO_ACCUMULATOR = 5;

// -------------------------------------------------------------------------------------------------------------------- face in light space
// The first word of a face's record: see Faces.
// | 255 BESIDE | 128..191 box | 96 HAS_PLANES | 64..95 c | 32..63 b | 0..31 a

/// @dev The addresses of its vertices.
uint256 constant FACE_A_MASK = 0xffffffff;
uint256 constant FACE_B_AT = 32;
uint256 constant FACE_B_MASK = 0xffffffff;
uint256 constant FACE_C_AT = 64;
uint256 constant FACE_C_MASK = 0xffffffff;
/// @dev Its functions are written.
uint256 constant HAS_PLANES = 0x1000000000000000000000000;
/// @dev Its ranges.
uint256 constant FACE_BOX_AT = 128;
uint256 constant FACE_BOX_MASK = 0xffffffffffffffff;

// ------------------------------------------------------------------------------------------------------------------ ranges of coordinates
// Where a face lies among BUCKETS ranges of each coordinate in light space: the minimum in the lower byte of a lane, the maximum in the
// upper one. Of a vertex only lower bytes. See LightSpace.
// | 255 BESIDE | 63 HAS_BOX | 48..50 side | 32..47 z | 16..31 y | 0..15 x

/// @dev The side of the cube around a point light.
uint256 constant BOX_SIDE_AT = 48;
uint256 constant BOX_SIDE_MASK = 7;
/// @dev There are ranges.
uint256 constant HAS_BOX = 0x8000000000000000;
/// @dev The vertex is beside or behind a point light without a cube, or at the light. Of a face: one of its vertices is, or they are on
/// several sides of the cube; in its first word, too.
uint256 constant BESIDE = 0x8000000000000000000000000000000000000000000000000000000000000000;

// --------------------------------------------------------------------------------------------------------- parts of ranges of coordinates

/// @dev The positions of y and z.
uint256 constant BOX_Y_AT = 16;
uint256 constant BOX_Z_AT = 32;

// ----------------------------------------------------------------------------------------------------------------- position on the canvas
// Integers with POINT_BITS bits below the pixel, plus POINT_BIAS: see Clipping.
// | 64..127 row | 0..63 column

uint256 constant POINT_COLUMN_MASK = 0xffffffffffffffff;
uint256 constant POINT_ROW_AT = 64;

// ----------------------------------------------------------------------------------------------------------------------- edge of a shadow
// A position on the canvas, in eighths of a pixel, is to the right of the edge if its function is at least 0: VALUE + x * DX + y * DY,
// signed numbers. See Outlines.
// | 208..255 dx | 160..207 dy | 96..159 value | 80..95 top | 64..79 bottom | 8 LAST_EDGE | 0 ENDS_SHADOW

/// @dev To the right of it, a shadow ends; otherwise one begins.
uint256 constant ENDS_SHADOW = 1;
/// @dev It is the last of its list.
uint256 constant LAST_EDGE = 0x100;
/// @dev The row of samples, four for each row of pixels, after the last that the edge crosses; and the first.
uint256 constant SHADOW_EDGE_BOTTOM_AT = 64;
uint256 constant SHADOW_EDGE_BOTTOM_MASK = 0xffff;
uint256 constant SHADOW_EDGE_TOP_AT = 80;
uint256 constant SHADOW_EDGE_TOP_MASK = 0xffff;
/// @dev The value at the centre of the canvas's first pixel; its change downward; and to the right.
uint256 constant SHADOW_EDGE_VALUE_AT = 96;
uint256 constant SHADOW_EDGE_VALUE_MASK = 0xffffffffffffffff;
uint256 constant SHADOW_EDGE_DY_AT = 160;
uint256 constant SHADOW_EDGE_DY_MASK = 0xffffffffffff;
uint256 constant SHADOW_EDGE_DX_AT = 208;

// ------------------------------------------------------------------------------------------------------------- flags of the mode together

/// @dev Light of all kinds for each fragment.
uint256 constant IS_LIT_AND_DIFFUSE = 6;
/// @dev The bits that select the loop for the rows of a smooth triangle.
uint256 constant IS_GREY_OR_STEEP = 0xc00;
uint256 constant CROSSES_COLUMNS_OR_ROWS = 0x2080;
/// @dev The modes of triangles of samples to which SPAN_BEGIN and SPAN_END are applied: see IS_CLAMPED.
uint256 constant IS_CLAMPED_MODE = 0x180;

// ----------------------------------------------------------------------------------------------------------------- flags that are shifted

/// @dev From a triangle of a list to its mode, for both of its bits there.
uint256 constant TRIANGLE_CROSSING_SHIFT = 140;
/// @dev To the mode of a face that a highlight may reach.
uint256 constant SPECULAR_TO_LIT = 2;

// -------------------------------------------------------------------------------------------------------------------- borders of the tile
// Four lanes of 28 bits for the left, right, upper and lower border: positive if a vertex lies beyond it. See TileCulling.
// | 84..111 lower border | 56..83 upper | 28..55 right | 0..27 left

/// @dev Set if the value is positive.
uint256 constant BORDER_SIGNS = 0x8000000800000080000008000000;

// -------------------------------------------------------------------------------------------------------------- borders of the guard band
// After these, five lanes for the left, right, upper and lower border of the guard band, and the near plane.
// | 224..255 near plane | 196..223 lower border | 168..195 upper | 140..167 right | 112..139 left

/// @dev Set if the value is positive.
uint256 constant GUARD_SIGNS = 0x800000080000008000000800000080000000000000000000000000000000000;

// ----------------------------------------------------------------------------------------------------------------------- parts of borders

/// @dev The bits of a lane; the number of lanes.
uint256 constant BORDER_BITS = 28;
uint256 constant BORDER_COUNT = 9;
/// @dev 2^27, which bounds values, minus 2^16 for the tile and plus 2^16 for the guard band, which is more than their rounding error.
uint256 constant BORDER_BIAS = 0x801000080100008010000801000080100007ff00007ff00007ff00007ff0000;

// -------------------------------------------------------------------------------------------------------------------------------- colours
// Three lanes of 56 bits: blue at bit 0, green at 56, red at 112. One ADD or MUL works on all of them. A negative number in a lane borrows
// from the lane above; the lanes are correct if the final sum is positive in every lane, which a bias ensures.
// | 112..167 red | 56..111 green | 0..55 blue

/// @dev 1 in each lane.
uint256 constant ONES = 0x10000000000000100000000000001;
/// @dev The lower bits of each lane: all bits that a colour of Q10 uses in the lanes of a triangle.
uint256 constant LANES_24 = 0xffffff00000000ffffff00000000ffffff;
uint256 constant LANES_32 = 0xffffffff000000ffffffff000000ffffffff;
/// @dev Half a level, Q10.
uint256 constant HALF_LEVEL = 0x2000000000000020000000000000200;
/// @dev The bits that are set in lanes of Q10 above 255; the addend that makes them carry into bit OVERFLOW_CARRY_AT.
uint256 constant OVERFLOW = 0xfc000000000000fc000000000000fc0000;
uint256 constant OVERFLOW_TO_CARRY = 0x3ffc00000000003ffc00000000003ffc0000;
/// @dev A byte in each lane; a byte as Q10.
uint256 constant BYTES_56 = 0xff000000000000ff000000000000ff;
uint256 constant BYTES_Q10 = 0x3fc000000000003fc000000000003fc00;

// ----------------------------------------------------------------------------------------------------------------------- parts of colours

/// @dev Masks of a colour 0xRRGGBB; their positions; and the distances from there to their lanes.
uint256 constant BLUE = 255;
uint256 constant GREEN = 0xff00;
uint256 constant RED = 0xff0000;
uint256 constant GREEN_AT = 8;
uint256 constant RED_AT = 16;
uint256 constant GREEN_TO_LANE = 48;
uint256 constant RED_TO_LANE = 96;
/// @dev Fraction bits of light; of a cosine, a direction, a ray.
uint256 constant LIGHT_FRACTION = 16;
uint256 constant COSINE_FRACTION = 24;
/// @dev The position of the bits above 255 in a lane of Q10, and the mask of these six bits.
uint256 constant OVERFLOW_AT = 18;
uint256 constant OVERFLOW_MASK = 63;
/// @dev The positions of green and red in lanes.
uint256 constant MIDDLE_AT = 56;
uint256 constant UPPER_AT = 112;
/// @dev A single lane.
uint256 constant LANE_24 = 0xffffff;
uint256 constant LANE_32 = 0xffffffff;
/// @dev Multiplier that copies the bytes of a colour 0xRRGGBB to BYTES_Q10, among others.
uint256 constant COLOR_SPREAD = 0x400000000000400000000000400;
/// @dev A byte as Q10, in a single lane.
uint256 constant BYTE_Q10 = 0x3fc00;
uint256 constant OVERFLOW_CARRY_AT = 30;
/// @dev Multiplier that collects BYTES_56 at the top of a word; the same for BYTES_Q10.
uint256 constant LANES_TO_PIXEL = 0x100000000000000010000000000000001000000000000000000000000000000;
uint256 constant Q10_TO_PIXEL = 0x400000000000000040000000000000004000000000000000000000000000;

// -------------------------------------------------------------------------------------------------------------- colours of an accumulator
// The lanes of colours in an accumulator, 32 bits further up.

/// @dev The bytes; the bits above them, and the lowest bits of the lanes above these.
uint256 constant BYTES_OF_LANES = 0x03fc000000000003fc000000000003fc0000000000;
uint256 constant ABOVE_BYTES = 0xfc000000000000fc000000000000fc000000000000;
uint256 constant NEXT_LANES = 0x1000000000000010000000000000100000000000000;

// --------------------------------------------------------------------------------------------------------------------------------- depths
// Four depths in a word, the leftmost uppermost.
// | 192..255 first | 128..191 second | 64..127 third | 0..63 fourth

/// @dev The highest bit of each lane; and the bits below it.
uint256 constant TOPS_64 = 0x8000000000000000800000000000000080000000000000008000000000000000;
uint256 constant BELOW_TOPS_64 = 0x7fffffffffffffff7fffffffffffffff7fffffffffffffff7fffffffffffffff;

// --------------------------------------------------------------------------------------------------------------------------------- pixels
// Colours of eight pixels in a word, or a channel of eight (Q9), the leftmost uppermost.

uint256 constant ONES_24 = 0x1000001000001000001000001000001000001000001;
/// @dev The distance of each pixel to the left of the last; the squares of the distances.
uint256 constant STEPS_24 = 0x7000006000005000004000003000002000001000000;
uint256 constant SQUARES_24 = 0x31000024000019000010000009000004000001000000;
/// @dev The bits set below 0 or above 255; the bit set below 0; the addend that makes values above 255 carry; the byte.
uint256 constant BEYOND_BYTES_24 = 0xfe0000fe0000fe0000fe0000fe0000fe0000fe0000fe0000;
uint256 constant TOPS_24 = 0x800000800000800000800000800000800000800000800000;
uint256 constant CARRY_24 = 0x7e00007e00007e00007e00007e00007e00007e00007e0000;
uint256 constant BYTES_24 = 0x1fe0001fe0001fe0001fe0001fe0001fe0001fe0001fe00;

// ------------------------------------------------------------------------------------------------------------------------ parts of pixels

/// @dev 1 in each of ten pixels.
uint256 constant TEN_PIXELS = 0x1000001000001000001000001000001000001000001000001000001;
/// @dev Multiplier that copies bits 0, 64, 128, 192 to bits 120, 144, 168, 192, among others; and the mask of these.
uint256 constant TOPS_64_TO_24 = 0x1000000000100000000010000000001;
uint256 constant PIXELS_AT_120 = 0x1000001000001000001000000000000000000000000000000;

// -------------------------------------------------------------------------------------------------------------------------------- samples
// Four samples of a pixel in a word. Each lane contains the colour of the nearest surface, blue uppermost; three status bits; and above
// them the highest 36 bits of its depth, 0 if there is none. The highest bit stays free. The sample positions are those of Direct3D and of
// most OpenGL drivers.
// Each lane: | 27..62 depth | 26 IS_LISTED | 25 DRAWN_SAMPLES | 24 FOUND_SAMPLES | 16..23 blue | 8..15 green | 0..7 red

uint256 constant ONES_64 = 0x1000000000000000100000000000000010000000000000001;
/// @dev For the light of quadratic functions: half the range of each lane; 57 bits of each.
uint256 constant LANES_BIAS_64 = 0x4000000000000000400000000000000040000000000000004000000000000000;
uint256 constant LANES_LESS_64 = 0x1ffffffffffffff01ffffffffffffff01ffffffffffffff01ffffffffffffff;
/// @dev The depths.
uint256 constant SAMPLE_DEPTHS = 0x7ffffffff80000007ffffffff80000007ffffffff80000007ffffffff8000000;
/// @dev Their unit.
uint256 constant SAMPLE_DEPTH_UNIT = 0x8000000000000000800000000000000080000000000000008000000;
/// @dev Below the depth, for translucent objects: found by the first pass; drawn by the second pass; and the mask of all bits that
/// distinguish them: see BlendedSamples.
uint256 constant FOUND_SAMPLES = 0x1000000000000000100000000000000010000000000000001000000;
uint256 constant DRAWN_SAMPLES = 0x2000000000000000200000000000000020000000000000002000000;
uint256 constant PASSES_OF_SAMPLES = 0x7ffffffffb0000007ffffffffb0000007ffffffffb0000007ffffffffb000000;
/// @dev The colours.
uint256 constant SAMPLE_COLORS = 0xffffff0000000000ffffff0000000000ffffff0000000000ffffff;
/// @dev The offsets of the samples from the pixel centre, in eighths of a pixel: columns, and rows.
uint256 constant SAMPLE_X_8 = 0xfffffffffffffffd0000000000000002ffffffffffffffff;
uint256 constant SAMPLE_Y_8 = 0x30000000000000000fffffffffffffffefffffffffffffffd;
/// @dev A left side at column 0: its bias, the offsets of the samples in the pixel, and 2^-29, which puts samples that lie exactly on an
/// edge to the right of it. Edges have errors below 2^-30, and samples that do not lie on an edge are at least 2^-28 away from it.
uint256 constant LEFT_AT_0 = 0x80000080000020007ffffe800000200080000180000020007fffff8000002000;
/// @dev In the second lane: the pixel is touched by an open edge: see OpenEdges.
uint256 constant IS_EDGE = 0x40000000000000000000000;
/// @dev A byte of samples, Q37, of which a column has 32.
uint256 constant ADDRESS_64 = 0x2000000000000000200000000000000020000000000000002000000000;
/// @dev Red and blue, green.
uint256 constant RED_BLUE_64 = 0xff00ff0000000000ff00ff0000000000ff00ff0000000000ff00ff;
uint256 constant GREEN_64 = 0xff00000000000000ff00000000000000ff00000000000000ff00;

// ----------------------------------------------------------------------------------------------------------------------- parts of samples

/// @dev The lowest lane.
uint256 constant LANE_64 = 0xffffffffffffffff;
/// @dev Minus the lowest lane of a left side, and subtracted from that of a right one, these yield the address of the first pixel whose
/// first sample is not left of the side, Q37, with the bits below whole pixels undefined.
uint256 constant FIRST_SAMPLE_LEFT = 0x800003ffffffffff;
uint256 constant FIRST_SAMPLE_RIGHT = 0x7ffffc0000000000;
/// @dev The last byte of the lowest lane, and the position of its highest bit.
uint256 constant LANE_64_LAST_BYTE = 7;
uint256 constant TOP_64_AT = 63;
uint256 constant TOP_64 = 0x8000000000000000;
/// @dev In the lowest lane: the pixel is on the list of those whose samples may differ.
uint256 constant IS_LISTED = 0x4000000;
/// @dev The position of the samples' address in an entry of that list; the position of the colour's address, and its mask; the size of an
/// entry in bytes.
uint256 constant MIXED_AT = 224;
uint256 constant MIXED_PIXEL_AT = 192;
uint256 constant MIXED_PIXEL_MASK = 0xffffffff;
uint256 constant MIXED_SIZE = 8;
/// @dev The samples of a pixel have 2^5 bytes; an eighth of a pixel, in which their positions are, is 2^-3; 1/64 is 2^-6.
uint256 constant SAMPLE_SIZE_BITS = 5;
uint256 constant SAMPLE_SIZE = 32;
uint256 constant EIGHTH_BITS = 3;
uint256 constant PIXEL_64_BITS = 6;
/// @dev The fraction bits of a column.
uint256 constant COLUMN_FRACTION = 42;
uint256 constant SUBPIXEL_TO_COLUMN = 34;
/// @dev The fraction bits of a sample address; the mask of whole pixels.
uint256 constant ADDRESS_FRACTION = 37;
uint256 constant WHOLE_SAMPLES = 0xffffffffffffffffffffffffffffffffffffffffffffffffffffffffffffffe0;
/// @dev The mask of whole pixels for a non-negative address; the position of the upper bound's address.
uint256 constant ADDRESS_32 = 0xffffffe0;
uint256 constant UPPER_ADDRESS_AT = 165;
/// @dev The lane of the upper bound.
uint256 constant UPPER_BOUND_AT = 128;
/// @dev The position of a screen word's column in whole pixels; the addends that yield the first column with a sample, and the last.
uint256 constant SCREEN_PIXEL_COLUMN_AT = 72;
uint256 constant FROM_FIRST_SAMPLE = 0x9f0000000000000000;
uint256 constant TO_LAST_SAMPLE = 0x600000000000000000;
/// @dev An eighth of a column, and three, Q42.
uint256 constant EIGHTH_42 = 0x8000000000;
uint256 constant THREE_EIGHTHS_42 = 0x18000000000;
/// @dev Added to a side's outermost sample, without the addend of LEFT_AT_0, it rounds up to the next integer.
uint256 constant CEIL_42 = 0x3ffffffdfff;
/// @dev An inset of the left side that leaves nothing inside.
uint256 constant NO_INSIDE = 0x1000000000000000;
/// @dev Sides whose outermost samples are less than 4 columns away, which change by less than 11 columns per row, have bounds that are
/// never far outside the triangle.
uint256 constant FAR_42 = 0xfffffffffffffffffffffffffffffffffffffffffffffffffffff00000000000;
/// @dev Sub-pixels from the centre of a pixel to the outermost of its samples.
uint256 constant OUTERMOST_SAMPLE = 96;
/// @dev Added to the row of a vertex, in sub-pixels, it yields the row of the first pixel with a sample below; then these bits are 64 times
/// the number of samples above.
uint256 constant TO_FIRST_ROW = 159;
uint256 constant SAMPLES_ABOVE = 192;
/// @dev 16 as a gradient, Q29 per pixel; the bits set above twice that; half a depth in an attribute word.
uint256 constant LEAST_WIDTH = 0x200000000;
uint256 constant ABOVE_LEAST_WIDTH = 0xfffffffffffffffffffffffffffffffffffffffffffffffffffffffc00000000;
uint256 constant HALF_DEPTH = 0x800000000000000000000000000000000000000000;
/// @dev An eighth of a change of DEEP_DX or DEEP_DY, in the unit of depths in an accumulator.
uint256 constant DEEP_8_AT = 27;
/// @dev Multiplier that collects bits 0, 64, 128, 192 as the number of a set, times 16; the bits of it.
uint256 constant COVERED_TO_SET = 0x1000000000000000200000000000000040000000000000008;
uint256 constant SET_AT = 188;
uint256 constant SET_MASK = 240;
/// @dev The centroid of each set of samples, in eighths of a pixel: signed bytes of the column and, below it, of the row.
uint256 constant CENTROIDS = 0x1ff00ff02010002010000010300ff0000fefffd0101fe03fffffd0000;
uint256 constant GREEN_OF_SUM = 24;
/// @dev A colour at the top of a word.
uint256 constant PIXEL_AT = 232;
/// @dev In the sums of four colours in the upper lane, red lowest, blue at bit 16, green at bit 32: half a level of their mean; the bits of
/// the mean; the multiplier that moves them to the top.
uint256 constant ROUND_SUM = 0x200020002000000000000000000000000000000000000000000000000;
uint256 constant MEAN_OF_SUM = 0x3fc03fc03fc000000000000000000000000000000000000000000000000;
uint256 constant SUM_TO_TOP = 0x4000004000;

// ------------------------------------------------------------------------------------------------------------------------- signed colours
// Three signed lanes of 85 bits, for quadratic functions. An incremented colour is Q58, and a colour times its depth Q72 (Q24 without the
// last 48 bits).
// | 170..255 red | 85..169 green | 0..84 blue

/// @dev Half the range of a lane, which keeps it positive; the same without the last 48 bits; all bits of that.
uint256 constant BIAS_84 = 0x4000000000000000000002000000000000000000001000000000000000000000;
uint256 constant BIAS_36 = 0x4000000000000000000002000000000000000000001000000000;
uint256 constant LANES_37 = 0x7ffffffffc000000000003ffffffffe000000000001fffffffff;
/// @dev Half of the last bit that a second difference retains.
uint256 constant BEND_ROUNDING = 0x4000000000000000000002000000000000000000001000000000000;
/// @dev The byte of each lane, Q58; the bits above; the bit into which they carry if they are added to themselves; the sign.
uint256 constant BYTES_Q58 = 0xff00000000000000000007f80000000000000000003fc00000000000000;
uint256 constant ABOVE_Q58 = 0x7ffff00000000000000003ffff80000000000000001ffffc0000000000000000;
uint256 constant CARRIES_85 = 0x8000000000000000000004000000000000000000002000000000000000000000;
uint256 constant SIGNS_85 = 0x4000000000000000000002000000000000000000001000000000000000000000;
/// @dev 1 in each lane.
uint256 constant ONES_85 = 0x4000000000000000000002000000000000000000001;
/// @dev Half the range of each lane; 78 bits of each.
uint256 constant LANES_BIAS_85 = 0x2000000000000000000001000000000000000000000800000000000000000000;
uint256 constant LANES_LESS_85 = 0xfffffffffffffffffffc07ffffffffffffffffffe03fffffffffffffffffff;
/// @dev Half a level, Q58 and Q10.
uint256 constant HALF_85 = 0x800000000000000000000400000000000000000000200000000000000;
uint256 constant HALF_85_Q10 = 0x800000000000000000000400000000000000000000200;
/// @dev Bits 18 to 36, which are zero for a colour of 0 to 255, Q10. Adding the mask to the masked lane carries into bit BEYOND_CARRY
/// unless these bits are zero; bit BEYOND_SIGN is the sign.
uint256 constant BEYOND_BYTE_85 = 0x7ffff00000000000000003ffff80000000000000001ffffc0000;

// ---------------------------------------------------------------------------------------------------------------- parts of signed colours

uint256 constant MIDDLE_85_AT = 85;
uint256 constant UPPER_85_AT = 170;
/// @dev The lowest lane, the middle one, the uppermost, and the upper two.
uint256 constant LANE_85 = 0x1fffffffffffffffffffff;
uint256 constant MIDDLE_LANE_85 = 0x3ffffffffffffffffffffe00000000000000000000;
uint256 constant UPPER_LANE_85 = 0xfffffffffffffffffffffc000000000000000000000000000000000000000000;
uint256 constant UPPER_LANES_85 = 0xffffffffffffffffffffffffffffffffffffffffffe000000000000000000000;
/// @dev The shifts that move the sign of the lowest lane, and of the middle one, to the top of a word.
uint256 constant LOWER_85_TO_TOP = 171;
uint256 constant MIDDLE_85_TO_TOP = 86;
/// @dev The sign of the lowest lane, and the bit into which it carries.
uint256 constant SIGN_85 = 84;
uint256 constant CARRY_85 = 85;
/// @dev See BEYOND_BYTE_85.
uint256 constant BEYOND_CARRY = 37;
uint256 constant BEYOND_SIGN = 36;
/// @dev The lowest bit of the byte of each channel, Q10.
uint256 constant BLUE_Q10_AT = 10;
uint256 constant GREEN_Q10_AT = 95;
uint256 constant RED_Q10_AT = 180;
uint256 constant Q10_TO_Q58 = 48;
/// @dev The positions of Q9 numbers in lanes of Q58.
uint256 constant BLUE_Q9_AT = 49;
uint256 constant GREEN_Q9_AT = 134;
uint256 constant RED_Q9_AT = 219;
/// @dev The byte of the lowest lane.
uint256 constant BYTE_Q58 = 0x3fc00000000000000;
/// @dev Multiplier that collects BYTES_Q58 at the top of a word, among others below.
uint256 constant Q58_TO_TOP = 0x400000000000000000000002000000000000000000000010;

// --------------------------------------------------------------------------------------------------------- vectors in the space of a mesh
// Three signed lanes of 86 bits. The middle coefficient of the product of two vectors, one of them with reversed lanes, is their dot
// product, which occupies all bits from UPPER_86_AT on: the higher coefficients are beyond the word.
// | 172..255 x | 86..171 y | 0..85 z

/// @dev Half the range of each lane; the bits of a lane of Q80 that remain as Q32; half of their range.
uint256 constant HALF_86 = 0x8000000000000000000008000000000000000000002000000000000000000000;
uint256 constant Q32_86 = 0xfffffffff000000000000fffffffffc000000000003fffffffff;
uint256 constant HALF_Q32_86 = 0x8000000000000000000008000000000000000000002000000000;

// ------------------------------------------------------------------------------------------------ parts of vectors in the space of a mesh

uint256 constant MIDDLE_86_AT = 86;
uint256 constant UPPER_86_AT = 172;
/// @dev Half the unit of the middle lane, and half the unit of the upper one: they round to nearest.
uint256 constant HALF_MIDDLE_86 = 0x2000000000000000000000;
uint256 constant HALF_UPPER_86 = 0x8000000000000000000000000000000000000000000;
