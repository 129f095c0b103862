// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import "./Registers.sol";

// Written by tools/layout.py from layout.toml.

// --------------------------------------------------------------------------------------------------------------------------------- bounds

uint256 constant SAMPLE_REGISTERS_END = 0x3c60;

// -------------------------------------------------------------------------------------------------------------------------------- samples
// For the engines that take four samples per pixel: see Samples and SampleRasterizer.

/// @dev The columns and rows that have samples in memory: the first, and the one after the last.
uint256 constant SAMPLE_BEGIN = 0x3140;
uint256 constant SAMPLE_END = 0x3160;
uint256 constant SAMPLE_TOP = 0x3180;
uint256 constant SAMPLE_BOTTOM = 0x31a0;
/// @dev The size of a row of samples in bytes; the address of the samples of row 0, column 0, extrapolated, which may be negative. Rows go
/// down in memory, as in a bitmap.
uint256 constant SAMPLE_STRIDE = 0x31c0;
uint256 constant SAMPLE_ORIGIN = 0x31e0;
/// @dev The address of the colour of row 0, column 0, extrapolated; rows of TILE_WIDTH pixels go down.
uint256 constant SAMPLE_IMAGE = 0x3200;
/// @dev The colour of a pixel of the current row with its samples at p is at ROW_IMAGE + 3 * (p / 32); the decrease of that to the next
/// row.
uint256 constant ROW_IMAGE = 0x3220;
uint256 constant ROW_IMAGE_STEP = 0x3240;
/// @dev ROW_IMAGE of row 0, extrapolated.
uint256 constant ROW_IMAGE_0 = 0x3260;
/// @dev The list of the pixels whose samples may differ: the address of the samples, and of the colour.
uint256 constant MIXED = 0x3280;
uint256 constant MIXED_END = 0x32a0;
/// @dev The row to which START refers; an eighth of DY.
uint256 constant START_ROW = 0x32c0;
uint256 constant DY_8 = 0x32e0;
/// @dev The differences of the samples' depths from SAMPLE_SCALE times the depth of the pixel centre, signed lanes; the depth relative to
/// SAMPLE_BASE that they refer to.
uint256 constant DEPTH_OFFSETS = 0x3300;
uint256 constant DEPTH_BASE = 0x3320;
/// @dev The row to which sides and bounds refer: the first with a sample of the triangle in the band.
uint256 constant SIDE_ROW = 0x3340;
/// @dev The sides of the triangle at that row: see SampleRasterizer; and their changes per row.
uint256 constant SIDE_LEFT = 0x3360;
uint256 constant SIDE_RIGHT = 0x3380;
uint256 constant SIDE_LEFT_STEP = 0x33a0;
uint256 constant SIDE_RIGHT_STEP = 0x33c0;
/// @dev The addresses of the first pixel that may be covered, and of the one after the last, Q37 in lanes of 128 bits; their changes per
/// row; the insets, which added to them bound the pixels whose samples are all covered.
uint256 constant BOUNDS = 0x33e0;
uint256 constant BOUND_STEPS = 0x3400;
uint256 constant INSETS = 0x3420;
/// @dev The row in which one side continues with the edge from the second to the third vertex; that side: the address of SIDE_LEFT or
/// SIDE_RIGHT.
uint256 constant KINK_ROW = 0x3440;
uint256 constant KINK_SIDE = 0x3460;
/// @dev The lanes of its samples that lie on that edge; that edge at that row, and its change per row.
uint256 constant KINK_MASK = 0x3480;
uint256 constant KINK_EDGE = 0x34a0;
uint256 constant KINK_STEP = 0x34c0;
/// @dev From that row on: the mask of the bounds that remain, and the replacement of the others; their changes, and INSETS.
uint256 constant KINK_KEPT = 0x34e0;
uint256 constant KINK_BOUND = 0x3500;
uint256 constant KINK_BOUND_STEPS = 0x3520;
uint256 constant KINK_INSETS = 0x3540;
/// @dev Whether SPAN_BEGIN and SPAN_END must be applied in each row: the bounds may be far outside.
uint256 constant IS_CLAMPED = 0x3560;
/// @dev The columns between which fragments may lie: of the triangle, of the tile, and of the cell that is drawn.
uint256 constant SPAN_BEGIN = 0x3580;
uint256 constant SPAN_END = 0x35a0;
/// @dev SAMPLE_STRIDE in the format of sample addresses, Q37.
uint256 constant STRIDE_37 = 0x35c0;
/// @dev The change of START per row, if it refers to address 0.
uint256 constant ROW_STEP_32 = 0x35e0;
/// @dev The bounds of the row that drawSpans draws, and their changes.
uint256 constant ROW_BOUNDS = 0x3600;
uint256 constant ROW_BOUND_STEPS = 0x3620;
/// @dev The changes of its sides.
uint256 constant ROW_LEFT_STEP = 0x3640;
uint256 constant ROW_RIGHT_STEP = 0x3660;
/// @dev The addresses of the first pixel of the row whose samples are all covered, and of the one after the last.
uint256 constant INNER_BEGIN = 0x3680;
uint256 constant INNER_END = 0x36a0;
/// @dev The accumulator at address 0 of the row that QuadraticSamples draws.
uint256 constant ROW_START = 0x36c0;
/// @dev The columns of a row of samples.
uint256 constant ROW_COLUMNS = 0x36e0;
/// @dev DEPTH_OFFSETS for whole pixels: in steep triangles those of the first sample for all.
uint256 constant WHOLE_OFFSETS = 0x3700;
/// @dev The bounds of the row: of the left one, plus the lowest lane of the side, of the right one, minus that; they are the same for all
/// rows of an edge.
uint256 constant OUTER_LEFT = 0x3720;
uint256 constant OUTER_RIGHT = 0x3740;
/// @dev The bound of the lower edge in the row below that of the kink.
uint256 constant KINK_OUTER = 0x3760;
/// @dev The colour of all vertices to which these refer, plus one bit; its part that all light reaches, Q58 with half a level, and what the
/// first and the second lamp add per unit of N * L, Q34: lanes of 85 bits. For vertices of several colours VARIED_COLORS, and the light
/// alone, lanes of 56 bits, Q40 and Q16. See SmoothSamples.
uint256 constant SAME_COLOR = 0x3780;
uint256 constant SAME_AMBIENT = 0x37a0;
uint256 constant SAME_DIFFUSE = 0x37c0;
uint256 constant SAME_DIFFUSE_2 = 0x37e0;
/// @dev The coefficients of the light of the first of two lamps.
uint256 constant FIRST_LIGHT = 0x3800;
/// @dev The sides of the row that is drawn, and the address of the pixel after its last one.
uint256 constant ROW_LEFT = 0x38c0;
uint256 constant ROW_RIGHT = 0x38e0;
uint256 constant ROW_END = 0x3900;
/// @dev The row to which the quadratic functions refer.
uint256 constant QUADRATIC_ROW = 0x3920;
/// @dev The least depth of the vertices, with 8 more bits than in a vertex.
uint256 constant FARTHEST = 0x3940;
/// @dev A line: from its upper end to its lower one, and from it to the right side of its rectangle, in sub-pixels.
uint256 constant LINE_DX = 0x3960;
uint256 constant LINE_DY = 0x3980;
uint256 constant LINE_ASIDE_X = 0x39a0;
uint256 constant LINE_ASIDE_Y = 0x39c0;
/// @dev Half the magnitude of the last square of a length.
uint256 constant LINE_HINT = 0x39e0;
/// @dev The area between the line and that side: see SampleWires.
uint256 constant LINE_AREA = 0x3a00;
/// @dev The square of the distance, in sub-pixels, over which light is linear: see LinearWires.
uint256 constant LINE_REACH = 0x3a20;
/// @dev The screen word of the upper end of a line that is lit; the accumulator there, without its bias; the change of the attribute word
/// to the lower end.
uint256 constant LINE_UPPER = 0x3a40;
uint256 constant LINE_ATTRIBUTE = 0x3a60;
uint256 constant LINE_CHANGE = 0x3a80;
/// @dev The rows and columns of the part of the line that is drawn: the first, the one after the last.
uint256 constant LINE_TOP = 0x3aa0;
uint256 constant LINE_BOTTOM = 0x3ac0;
uint256 constant LINE_LEFT = 0x3ae0;
uint256 constant LINE_RIGHT = 0x3b00;
/// @dev The products of the four samples of the first column in the current row; their changes per column and row.
uint256 constant LINE_ACROSS = 0x3b20;
uint256 constant LINE_ALONG = 0x3b40;
uint256 constant LINE_ACROSS_RIGHT = 0x3b60;
uint256 constant LINE_ALONG_RIGHT = 0x3b80;
uint256 constant LINE_ACROSS_DOWN = 0x3ba0;
uint256 constant LINE_ALONG_DOWN = 0x3bc0;
/// @dev These minus the products have the highest bits of samples before the end.
uint256 constant LINE_ACROSS_END = 0x3be0;
uint256 constant LINE_ALONG_END = 0x3c00;
/// @dev The product at which the line enters the current row, relative to that of the first column; the one at which it leaves the row,
/// relative to that.
uint256 constant LINE_ENTER = 0x3c20;
uint256 constant LINE_STAY = 0x3c40;
/// @dev For the AntialiasedSmoothEngine: the tables of the highlight times the colours of the first and the second lamp: lanes of 85 bits,
/// Q42.
uint256 constant SHINE_TABLE = 0x3c60;
