// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import "./Memory.sol";
import "./Words.sol";

// Written by tools/layout.py from layout.toml.

// --------------------------------------------------------------------------------------------------------------------------------- bounds

/// @dev The beginning of the registers: the maximum end of the compiler's variables in memory.
uint256 constant REGISTERS = 0x800;
uint256 constant REGISTERS_END = 0x3140;

// ---------------------------------------------------------------------------------------------------------------------------------- frame
// The uniforms of the frame, which the Renderer fills. Pixel columns and rows are counted from -PIXEL_BIAS, so that everything inside the
// guard band is positive; sub-pixel coordinates are pixels with 8 more bits; integers are pixel centres.

/// @dev The beginning of these registers, and their size in bytes.
uint256 constant FRAME_BEGIN = 0x800;
uint256 constant FRAME_SIZE = 0x9c0;
/// @dev 1 for an orthographic camera; 1 for four samples per pixel; otherwise 0.
uint256 constant FRAME_IS_ORTHOGRAPHIC = 0x800;
uint256 constant FRAME_IS_ANTIALIASED = 0x820;
/// @dev The calldata offset of the answer of the contract Effects; 0 if the scene has no effects.
uint256 constant EFFECTS_OFFSET = 0x840;
/// @dev Distance of the near plane, Q32.
uint256 constant NEAR = 0x860;
/// @dev depth = DEPTH_SCALE / distance (perspective), DEPTH_SCALE - distance / 256 (orthographic): at most 2^54, so that the highest bit of
/// the 64 of a depth in the buffer, which has 8 more, is free.
uint256 constant DEPTH_SCALE = 0x880;
/// @dev Depths of samples, scaled so that their highest bits distinguish the surfaces of the scene: the depth of an accumulator minus the
/// base, times 2^SAMPLE_SHIFT, which is in each lane of the scale. See SampleDepths.
uint256 constant SAMPLE_BASE = 0x8a0;
uint256 constant SAMPLE_SHIFT = 0x8c0;
uint256 constant SAMPLE_SCALE = 0x8e0;
/// @dev First pixel column of the tile, and the one after the last.
uint256 constant COLUMN_BEGIN = 0x900;
uint256 constant COLUMN_END = 0x920;
/// @dev Bytes of a row of depths.
uint256 constant DEPTH_STRIDE = 0x940;
/// @dev The ray through a pixel, (x, y, 1) in camera space, Q24: x = RAY_LEFT + column * RAY_STEP, y = RAY_TOP + row * RAY_STEP. For an
/// orthographic camera, where all rays are parallel, the position beside the line of sight in world units, Q32.
uint256 constant RAY_LEFT = 0x960;
uint256 constant RAY_TOP = 0x980;
uint256 constant RAY_STEP = 0x9a0;
/// @dev First approximation of the length of a ray from its square: LENGTH_AT_0 + LENGTH_SLOPE * square >> 48; and the number of further
/// steps of Newton's method after the first.
uint256 constant LENGTH_AT_0 = 0x9c0;
uint256 constant LENGTH_SLOPE = 0x9e0;
uint256 constant LENGTH_STEPS = 0xa00;
/// @dev The tile, in the order of a Rectangle.
uint256 constant TILE_X = 0xa20;
uint256 constant TILE_Y = 0xa40;
uint256 constant TILE_WIDTH = 0xa60;
uint256 constant TILE_HEIGHT = 0xa80;
/// @dev The background of the lowest row of the tile, lanes of Q24 with half a level, and its change from row to row upwards.
uint256 constant BACKGROUND = 0xaa0;
uint256 constant BACKGROUND_STEP = 0xac0;
/// @dev 1 if all bytes are inverted at the end; 1 if covered pixels are counted; otherwise 0.
uint256 constant INVERT = 0xae0;
uint256 constant COUNT_PIXELS = 0xb00;
/// @dev The number of objects to draw, the calldata offset of the first one's uniforms, and its number in the scene.
uint256 constant OBJECT_COUNT = 0xb20;
uint256 constant OBJECTS = 0xb40;
uint256 constant OBJECT_FIRST = 0xb60;
/// @dev The number of all objects, and the offset of their uniforms: see Runs.
uint256 constant OBJECT_TOTAL = 0xb80;
uint256 constant OBJECTS_BEGIN = 0xba0;
/// @dev The calldata offset of the pixels and depths drawn before; 0 if there are none.
uint256 constant DRAWN_BEFORE = 0xbc0;
/// @dev 1 if depths are returned too; 1 if triangles are counted and nothing is drawn; otherwise 0.
uint256 constant RETURNS_DEPTHS = 0xbe0;
uint256 constant ONLY_COUNTS = 0xc00;
/// @dev The address after the last record of a light.
uint256 constant LIGHTS_END = 0xc20;
/// @dev Up to 4 records of LIGHT_SIZE bytes.
uint256 constant LIGHTS = 0xc40;

// ----------------------------------------------------------------------------------------------------------------------------------- band

/// @dev First row of the band that is being drawn, and the row after its last.
uint256 constant BAND_TOP = 0x11c0;
uint256 constant BAND_BOTTOM = 0x11e0;
/// @dev The address of the depth at row 0, column 0, extrapolated, which may be negative. Rows go down in memory, as in a bitmap.
uint256 constant DEPTH_ORIGIN = 0x1200;
/// @dev The address of the depths, or of the samples.
uint256 constant DEPTHS = 0x1220;
/// @dev The colour of a pixel with its depth at p is at IMAGE_ORIGIN + 3 * (p / 8).
uint256 constant IMAGE_ORIGIN = 0x1240;

// --------------------------------------------------------------------------------------------------------------------------------- object
// The uniforms of an object, which the Renderer fills. They end with the last one that the object needs: for unlit objects at OBJECT_LIT,
// for others after their lights, and with SPECULAR_TABLE only if they have a highlight.

/// @dev The size of the object's uniforms in bytes; their first word.
uint256 constant OBJECT_BYTES = 0x1260;
/// @dev The bits of MODE shared by all faces of the object, and its flags, as in the scene.
uint256 constant OBJECT_MODE = 0x1280;
uint256 constant OBJECT_FLAGS = 0x12a0;
/// @dev The number of vertices if each has a second record with the opposite normal, for faces that are turned away, otherwise 0: see
/// VertexShader.
uint256 constant BACK_COUNT = 0x12c0;
/// @dev The opacity of the object, Q24; 1 if it is opaque.
uint256 constant OPACITY = 0x12e0;
/// @dev Columns of the matrix from mesh to screen, three lanes each: see VertexShader.
uint256 constant MATRIX_X = 0x1300;
uint256 constant MATRIX_Y = 0x1320;
uint256 constant MATRIX_Z = 0x1340;
uint256 constant MATRIX_T = 0x1360;
/// @dev A sub-pixel column x is outside the tile if x - TILE_LEFT, as an unsigned number, exceeds TILE_SPAN, and a row y if y - TILE_TOP
/// exceeds TILE_ROWS.
uint256 constant TILE_LEFT = 0x1380;
uint256 constant TILE_SPAN = 0x13a0;
uint256 constant TILE_TOP = 0x13c0;
uint256 constant TILE_ROWS = 0x13e0;
/// @dev Added to screen words to round rows up, or, for lines, to the nearest: see PrimitiveAssembly.
uint256 constant ROUND_TOP = 0x1400;
uint256 constant ROUND_BOTTOM = 0x1420;
/// @dev The mesh, in the order of the struct Mesh: offsets in the engine's calldata, counts, format.
uint256 constant MESH_VERTICES = 0x1440;
uint256 constant MESH_VERTEX_COUNT = 0x1460;
uint256 constant MESH_FACES = 0x1480;
uint256 constant MESH_FACE_COUNT = 0x14a0;
uint256 constant MESH_BITS = 0x14c0;
uint256 constant MESH_STRIDE = 0x14e0;
/// @dev The following uniforms are for lit objects.
uint256 constant OBJECT_LIT = 0x1500;
/// @dev Columns of the matrix that rotates normals into camera space, three lanes each. For a flat object: of the matrix that transforms
/// rays to mesh space, Q24, signed lanes of 86 bits, z lowest.
uint256 constant NORMAL_X = 0x1500;
uint256 constant NORMAL_Y = 0x1520;
uint256 constant NORMAL_Z = 0x1540;
/// @dev The eye in mesh space, Q32; for an orthographic camera, the line of sight in mesh space, Q24.
uint256 constant EYE_X = 0x1560;
uint256 constant EYE_Y = 0x1580;
uint256 constant EYE_Z = 0x15a0;
/// @dev Scale of the mesh, Q32, and scale / near, Q64.
uint256 constant SCALE = 0x15c0;
uint256 constant SCALE_PER_NEAR = 0x15e0;
/// @dev Ambient light times the ambient coefficient, lanes of Q16.
uint256 constant AMBIENT = 0x1600;
/// @dev The square of the distance, in sub-pixels, over which light is approximately linear.
uint256 constant REACH = 0x1620;
/// @dev The maximum sums of the squares of two edges for which directions can be interpolated in smooth triangles: linearly, and with
/// errors of third order.
uint256 constant SMOOTH_REACH = 0x1640;
uint256 constant SMOOTH_REACH_3 = 0x1660;
/// @dev The slope of the highlight at its maximum, in 84ths of a level of 255, Q10; and a cos^2, Q20, below which it is at most half of
/// that.
uint256 constant HALF_SLOPE = 0x1680;
uint256 constant FAR_FROM_HIGHLIGHT = 0x16a0;
/// @dev The root of SPECULAR_BEGIN, Q24.
uint256 constant COSINE_BEGIN = 0x16c0;
/// @dev A cosine, Q19: smooth triangles with a node above it may have a highlight; the greatest square of a turn of their normals along an
/// edge, Q20: see SmoothLight.
uint256 constant COSINE_FAR = 0x16e0;
uint256 constant SHINY_TURN = 0x1700;
/// @dev The light of a smooth object that does not depend on the fragment, lanes of Q40.
uint256 constant FACE_LIGHT_40 = 0x1720;
/// @dev The square and the length of a fragment's normal, Q48 and Q24: one, unless normals are interpolated.
uint256 constant FRAGMENT_SQUARE = 0x1740;
uint256 constant FRAGMENT_NORMAL_LENGTH = 0x1760;
/// @dev The beginning of the highlight's table, as cos^2 in Q24; its entries per unit, Q16; their product, Q24.
uint256 constant SPECULAR_BEGIN = 0x1780;
uint256 constant SPECULAR_SCALE = 0x17a0;
uint256 constant SPECULAR_OFFSET = 0x17c0;
/// @dev The specular coefficient, Q16, if the shininess is 1, otherwise 0.
uint256 constant SPECULAR_ROOT = 0x17e0;
/// @dev The other halves of the records at LIGHTS.
uint256 constant OBJECT_LIGHTS = 0x1800;
/// @dev 65 entries: the value of the highlight in the upper half, the increase to the next entry in the lower half, both Q16.
uint256 constant SPECULAR_TABLE = 0x1d80;
/// @dev The following uniform is for scenes with effects.
uint256 constant SPECULAR_TABLE_END = 0x25a0;
/// @dev The number of the object in the scene.
uint256 constant OBJECT_NUMBER = 0x25a0;
uint256 constant OBJECT_END = 0x25c0;

// ------------------------------------------------------------------------------------------------------------------------------- triangle

/// @dev The shading of fragments: see the mode.
uint256 constant MODE = 0x25c0;
/// @dev The accumulator at the first vertex, with the bias of its lanes; and the differences of the other attribute words to the first.
uint256 constant ATTRIBUTE_0 = 0x25e0;
uint256 constant DELTA_1 = 0x2600;
uint256 constant DELTA_2 = 0x2620;
/// @dev The calldata offset of the face.
uint256 constant FACE = 0x2640;
/// @dev The accumulator at column 0 of the first row, and its change per pixel and per row.
uint256 constant START = 0x2660;
uint256 constant DX = 0x2680;
uint256 constant DY = 0x26a0;
/// @dev Colour at the first vertex, and its differences to the others.
uint256 constant COLOR_0 = 0x26c0;
uint256 constant COLOR_1 = 0x26e0;
uint256 constant COLOR_2 = 0x2700;
/// @dev Depths at the second and third vertex.
uint256 constant DEPTH_1 = 0x2720;
uint256 constant DEPTH_2 = 0x2740;
/// @dev The side in pixels of the cells over which colours are quadratic; 0 if they are quadratic over the whole triangle, 1 if each is
/// exact.
uint256 constant PATCH_SIZE = 0x2760;
/// @dev The normal of a flat face, with a length of twice its area, in units of the mesh: signed lanes of 86 bits.
uint256 constant FACE_NORMAL = 0x2780;
/// @dev The square of its length, and its length, Q16.
uint256 constant FACE_SQUARE = 0x27a0;
uint256 constant FACE_LENGTH = 0x27c0;
/// @dev Unit normal times ray, Q48: FACE_N_DOT_RAY + FACE_N_DOT_RAY_SLOPE * depth >> 94.
uint256 constant FACE_N_DOT_RAY = 0x27e0;
uint256 constant FACE_N_DOT_RAY_SLOPE = 0x2800;
/// @dev Normals of a smooth triangle whose fragments are shaded individually: the normal at the first vertex (Q36), and the differences to
/// the others (Q20).
uint256 constant NORMALS_0 = 0x2820;
uint256 constant NORMALS_1 = 0x2840;
uint256 constant NORMALS_2 = 0x2860;

// ------------------------------------------------------------------------------------------------------------------------------- fragment

/// @dev The position of the fragment beside the line of sight of an orthographic camera, Q16.
uint256 constant FRAGMENT_PLACE_X = 0x2880;
uint256 constant FRAGMENT_PLACE_Y = 0x28a0;
/// @dev The normal of the fragment, Q24, and its product with the ray.
uint256 constant FRAGMENT_NORMAL_X = 0x28c0;
uint256 constant FRAGMENT_NORMAL_Y = 0x28e0;
uint256 constant FRAGMENT_NORMAL_Z = 0x2900;
uint256 constant FRAGMENT_NORMAL_RAY = 0x2920;
/// @dev Half the magnitude of the last square of a normal; of that of a face, a multiple of 3.
uint256 constant NORMAL_HINT = 0x2940;
uint256 constant FACE_HINT = 0x2960;
/// @dev The fraction of a light's intensity that its cone lets through, Q16.
uint256 constant FRAGMENT_CONE = 0x2980;
/// @dev The light that modulates the fragment's colour, lanes of Q40.
uint256 constant FRAGMENT_LIGHT = 0x29a0;
/// @dev The length of the fragment's ray, Q24.
uint256 constant FRAGMENT_RAY_LENGTH = 0x29c0;
/// @dev If colours are multiplied by their depths, the nearest depth of the triangle, with 8 more bits than in a vertex; otherwise 0.
uint256 constant PATCH_WEIGHT = 0x29e0;
/// @dev The colour at the next fragment of PatchSpans.wide, if colours are multiplied by their depths.
uint256 constant PATCH_COLOR = 0x2a00;
/// @dev The first column of the cell that is drawn, and the one after its last.
uint256 constant PATCH_BEGIN = 0x2a20;
uint256 constant PATCH_END = 0x2a40;

// ---------------------------------------------------------------------------------------------------------------------------------- edges

/// @dev Not zero if a vertex of the object lies outside the guard band or nearer than the near plane.
uint256 constant HAS_CLIPPED = 0x2a60;
/// @dev DEPTH_STRIDE in both lanes of edges: see PixelRasterizer.
uint256 constant STRIDE_LANES = 0x2a80;
/// @dev The change of the accumulator per byte of depths, an eighth of DX; and the change of START per row, if it refers to address 0.
uint256 constant DX_8 = 0x2aa0;
uint256 constant ROW_STEP = 0x2ac0;
/// @dev The lower part of a triangle, in which the edge from the second to the third vertex replaces the one that has ended: the number of
/// its rows; its edges = the edges of the upper part & LOWER_KEPT | LOWER_EDGE; their changes per row.
uint256 constant LOWER_ROWS = 0x2ae0;
uint256 constant LOWER_KEPT = 0x2b00;
uint256 constant LOWER_EDGE = 0x2b20;
uint256 constant LOWER_SLOPES = 0x2b40;
/// @dev Depths of a triangle that is IS_DEEP: an addend of START; changes of the depth for DX and DY, Q32.
uint256 constant DEEP_START = 0x2b60;
uint256 constant DEEP_DX = 0x2b80;
uint256 constant DEEP_DY = 0x2ba0;
/// @dev The address for the next triangle of the list; 0 if faces are drawn immediately.
uint256 constant LIST = 0x2bc0;
/// @dev The number of the object's faces that were drawn or listed.
uint256 constant DRAWN = 0x2be0;
/// @dev The offset from a vertex record to the second one: see BACK_COUNT.
uint256 constant BACK_OFFSET = 0x2c00;
/// @dev Faces with twice an area, Q192, not above this are not drawn: they are back faces.
uint256 constant LEAST_AREA = 0x2c20;
/// @dev The changes of edges per row.
uint256 constant SLOPES = 0x2c40;
/// @dev The end of the faces in calldata.
uint256 constant FACES_END = 0x2c60;

// -------------------------------------------------------------------------------------------------------------------- quadratic functions

/// @dev The coefficients of quadratic functions over a triangle, signed lanes of 85 bits: see Quadratic.
uint256 constant QUADRATIC_1 = 0x2c80;
uint256 constant QUADRATIC_S = 0x2ca0;
uint256 constant QUADRATIC_T = 0x2cc0;
uint256 constant QUADRATIC_SS = 0x2ce0;
uint256 constant QUADRATIC_ST = 0x2d00;
uint256 constant QUADRATIC_TT = 0x2d20;
/// @dev The values at column 0 of the first row, and their first and second differences to the next column and row.
uint256 constant QUADRATIC_START = 0x2d40;
uint256 constant QUADRATIC_DX = 0x2d60;
uint256 constant QUADRATIC_DY = 0x2d80;
uint256 constant QUADRATIC_DXX = 0x2da0;
uint256 constant QUADRATIC_DXY = 0x2dc0;
uint256 constant QUADRATIC_DYY = 0x2de0;
/// @dev Changes over a word of eight colours: the quadratic part of each channel.
uint256 constant BEND_BLUE = 0x2e00;
uint256 constant BEND_GREEN = 0x2e20;
uint256 constant BEND_RED = 0x2e40;

// ----------------------------------------------------------------------------------------------------------------------- smooth triangles

/// @dev The normals at the vertices, times their weights, Q30; each followed by the same with reversed lanes.
uint256 constant NORMAL_0 = 0x2e60;
uint256 constant NORMAL_1 = 0x2ea0;
uint256 constant NORMAL_2 = 0x2ee0;
/// @dev The largest square of the changes of the half vector from vertex to vertex, Q40.
uint256 constant HALF_CHANGE = 0x2f20;
/// @dev Half the magnitudes of the last squares of a ray, and of a half vector.
uint256 constant RAY_HINT = 0x2f40;
uint256 constant HALF_HINT = 0x2f60;
/// @dev The record of a vertex at the midpoint of an edge.
uint256 constant MIDDLE = 0x2f80;
/// @dev Twice the largest skew of a product N * H along an edge, Q20: see SmoothTriangle.correction.
uint256 constant HALF_SKEW = 0x3080;
/// @dev Half of QUADRATIC_DXX, by which QUADRATIC_DX is reduced while rows are drawn.
uint256 constant QUADRATIC_HALF_DXX = 0x30a0;
/// @dev The greatest depth of the vertices, Q24 relative to bit 192 of an accumulator.
uint256 constant NEAREST = 0x30c0;
/// @dev The distance of the record of the lamp for which setLight computes the light from LIGHTS.
uint256 constant LIGHT_OFFSET = 0x30e0;

// ---------------------------------------------------------------------------------------------------------------------- answer of Effects
// For the Renderer and for Effects: in memory, before the engine is called.

/// @dev The memory address of the answer of the contract Effects, and its size: 0 if the scene has no effects.
uint256 constant EFFECTS_AT = 0x3100;
uint256 constant EFFECTS_SIZE = 0x3120;

// ---------------------------------------------------------------------------------------------------------------------------------- light
// The properties of a light for the frame, at LIGHTS.

/// @dev 1 if it is a point light.
uint256 constant LIGHT_IS_POINT = 0;
/// @dev Direction (unit vector, Q24) or position (Q16) in camera space.
uint256 constant LIGHT_X = 32;
uint256 constant LIGHT_Y = 64;
uint256 constant LIGHT_Z = 96;
/// @dev Lanes of bytes.
uint256 constant LIGHT_COLOR = 128;
/// @dev The direction of a spot light in camera space (unit vector, Q24).
uint256 constant LIGHT_AXIS_X = 160;
uint256 constant LIGHT_AXIS_Y = 192;
uint256 constant LIGHT_AXIS_Z = 224;
/// @dev The cosine at which the light vanishes, Q24; and the difference to the cosine at which it begins to fade: 0 for other lights.
uint256 constant LIGHT_COS_OUTER = 0x100;
uint256 constant LIGHT_CONE = 0x120;
/// @dev Half the magnitude of the last distance, 0 at first: see `root` in FragmentLight.
uint256 constant LIGHT_HINT = 0x140;
uint256 constant LIGHT_SIZE = 0x160;

// --------------------------------------------------------------------------------------------------------------------- light of an object
// The properties of a light for the object, at OBJECT_LIGHTS, in records of the same size: offsets from the record at LIGHTS.

/// @dev The position in mesh space, Q32; or the direction in MESH_X, Q24, signed lanes of 86 bits, z lowest.
uint256 constant LIGHT_MESH_X = 0xbc0;
uint256 constant LIGHT_MESH_Y = 0xbe0;
uint256 constant LIGHT_MESH_Z = 0xc00;
/// @dev Colour times the diffuse coefficient, lanes of Q16.
uint256 constant LIGHT_DIFFUSE = 0xc20;
/// @dev Normal of the face times the vector to the light: Q24 for a direction, Q16 for a position.
uint256 constant LIGHT_N_DOT_L = 0xc40;

// --------------------------------------------------------------------------------------------------------------------------------- vertex
// The beginning of every vertex record; for the rest see VertexShader and SmoothVertex.

/// @dev The screen word.
uint256 constant VERTEX_SCREEN = 0;
/// @dev The attribute word, or the outcode of a vertex that must be clipped.
uint256 constant VERTEX_ATTRIBUTES = 32;
uint256 constant VERTEX_SIZE = 64;

// ---------------------------------------------------------------------------------------------------------------------------- half vector
// The data of each light in the vertex record of a flat surface, after VERTEX_SIZE: see VertexHighlights.

/// @dev The half vector in mesh space, Q32, signed lanes of 86 bits, z lowest.
uint256 constant HALF_VECTOR = 0;
/// @dev Its square, in the unit that makes the square of a product, divided by it, an index into the table of the highlight.
uint256 constant HALF_SQUARE = 32;
uint256 constant HALF_SIZE = 64;

// ---------------------------------------------------------------------------------------------------- corner of a polygon that is clipped

/// @dev Clip coordinates, Q32.
uint256 constant CORNER_X = 0;
uint256 constant CORNER_Y = 32;
uint256 constant CORNER_W = 64;
/// @dev Lanes of Q10.
uint256 constant CORNER_COLOR = 96;
/// @dev As in a vertex record.
uint256 constant CORNER_NORMAL = 128;
/// @dev 1 if the edge to the next corner belongs to the face, 0 if clipping made it.
uint256 constant CORNER_IS_EDGE = 160;
uint256 constant CORNER_SIZE = 192;

// ----------------------------------------------------------------------------------------------------------------------------------- mode
// The shading of fragments: the sum of these is in MODE; 0 selects the plain loop. CROSSES_COLUMNS is at the position to which a shift
// moves the bit of a triangle.

/// @dev The accumulator contains the lit colour, which may exceed 255.
uint256 constant IS_LINEAR = 1;
/// @dev Light is computed for each fragment. There is at least one light, on which the loops over lights rely: they test their condition at
/// the end.
uint256 constant IS_LIT = 2;
/// @dev More than highlights.
uint256 constant IS_DIFFUSE = 4;
/// @dev The material has highlights.
uint256 constant HAS_SPECULAR = 8;
/// @dev Normals of the vertices, or of the face.
uint256 constant IS_SMOOTH = 16;
uint256 constant IS_ORTHOGRAPHIC = 32;
uint256 constant IS_FLAT = 64;
/// @dev The triangle reaches beyond the left or right border of the tile.
uint256 constant CROSSES_COLUMNS = 128;
/// @dev The accumulator contains barycentric coordinates, and PATCH_SIZE selects how colours are computed: see PatchSpans.
uint256 constant IS_PATCHED = 0x100;
/// @dev Light is computed from products that are quadratic over the triangle: see SmoothTriangle.
uint256 constant IS_QUADRATIC = 0x200;
/// @dev The effect of perspective is not negligible: depths differ by more than a factor of 64, or, with IS_QUADRATIC, colours are
/// multiplied by them.
uint256 constant IS_STEEP = 0x400;
/// @dev All light is grey.
uint256 constant IS_GREY = 0x800;
/// @dev Depths differ by more than a factor of 2^12, and are interpolated separately.
uint256 constant IS_DEEP = 0x1000;
/// @dev The triangle reaches above or below the band.
uint256 constant CROSSES_ROWS = 0x2000;
/// @dev A light of the scene is a spot light.
uint256 constant IS_SPOT_LIT = 0x4000;
/// @dev The object is translucent: the nearest fragment of each pixel is blended with what is behind it.
uint256 constant IS_BLENDED = 0x8000;
/// @dev The first of its two passes, which finds those fragments.
uint256 constant IS_DEPTH_PASS = 0x10000;
/// @dev The face is turned away from the eye: it is moved back a little.
uint256 constant IS_TURNED_AWAY = 0x20000;
/// @dev Parts of the triangle are in shadow: see ShadowRows.
uint256 constant IS_PARTLY_DARK = 0x40000;
/// @dev With IS_QUADRATIC: the function is the light itself: see SmoothLight.
uint256 constant IS_NORMALISED = 0x80000;
/// @dev With IS_QUADRATIC: the vertices have several colours.
uint256 constant IS_VARIED = 0x100000;
/// @dev With IS_NORMALISED: there are two lamps.
uint256 constant IS_PAIR = 0x200000;
