"""Constants of packed words and modes. Written by tools/layout.py from contracts/layout.toml."""


# ---- mode ----
# How fragments are shaded: the sum of these is in MODE; 0 is the plain loop. IS_CROSSING stands where a shift brings
# the bit of a triangle.

#: The accumulator holds the lit colour itself, and it may be above 255.
IS_LINEAR = 1
#: Light is added for each fragment. There is at least one light then, on which the loops over lights rely: they ask at
#: their end.
IS_LIT = 2
#: More than highlights.
IS_DIFFUSE = 4
#: The material has highlights.
HAS_SPECULAR = 8
#: Normals of the vertices, or of the face.
IS_SMOOTH = 16
IS_ORTHOGRAPHIC = 32
#: The accumulator holds barycentric coordinates, and each fragment is shaded for itself.
IS_BARYCENTRIC = 64
IS_FLAT = 128
#: The triangle reaches beyond the left or right border of the tile.
IS_CROSSING = 0x100
#: The accumulator holds barycentric coordinates, and colours are found as PATCH_SIZE says: see Patches.
IS_PATCHED = 0x200
#: Light is made of products that are quadratic over the triangle: see SmoothLight.
IS_QUADRATIC = 0x400
#: Perspective shows: depths differ by more than a factor of 64, or, with IS_QUADRATIC, colours are multiplied by them.
IS_STEEP = 0x800
#: All light is grey.
IS_GREY = 0x1000
#: Depths differ by more than a factor of 2^12, and are interpolated by themselves.
IS_DEEP = 0x2000
#: The triangle reaches above or below the band.
IS_CUT = 0x4000
#: A light of the scene is a spot light.
IS_SPOT_LIT = 0x8000
#: The object is not opaque: the nearest fragment of each pixel is mixed with what is behind it.
IS_BLENDED = 0x10000
#: The first of its two passes, which finds those fragments.
IS_DEPTH_PASS = 0x20000

# ---- guard band ----

#: The guard band reaches from pixel -PIXEL_BIAS to GUARD_BAND - PIXEL_BIAS; the canvas lies at 0..2048 in it.
PIXEL_BIAS = 0x600
GUARD_BAND = 0x1000
#: Bits of a sub-pixel coordinate inside the guard band.
GUARD_BITS = 20

# ---- sub-pixels ----

#: Bits of a coordinate below the pixel.
SUBPIXEL_BITS = 8
#: These bits; added before they are shifted away, it rounds up.
SUBPIXEL_MASK = 255
HALF_PIXEL = 128

# ---- fixed-point ones ----

ONE_16 = 0x10000
HALF_24 = 0x800000
ONE_24 = 0x1000000
ONE_32 = 0x100000000
ONE_48 = 0x1000000000000

# ---- mesh in calldata ----

#: The colour of a vertex, 24 bits at the top of a word.
MESH_COLOR_AT = 232
#: A component of a normal, 10 bits at the top of a word; and where the others are below it.
MESH_NORMAL_AT = 246
MESH_NORMAL_Y = 10
MESH_NORMAL_Z = 20
#: Bytes of a face.
FACE_SIZE = 6
#: Its three vertex numbers at the top of a word; where the first and the second are in them; a number.
FACE_AT = 208
FACE_FIRST_AT = 32
#: The first and the second in the word of calldata.
FACE_FIRST_IN_WORD = 240
FACE_SECOND_IN_WORD = 224
FACE_SECOND_AT = 16
FACE_INDEX_MASK = 0xFFFF

# ---- parts of screen words ----

#: Left or right; above or below; any of them; that or MUST_CLIP.
IS_BESIDE = 0x60000000000
IS_OVER = 0x180000000000
IS_OUTSIDE = 0x1E0000000000
IS_NOT_PLAIN = 0x1F0000000000
#: All bits of the column.
SCREEN_COLUMNS = 0xFFFFF0000000000000000
#: Row in whole pixels.
SCREEN_PIXEL_ROW_AT = 136

# ---- parts of accumulators ----

#: The bits that a depth has more than in a vertex.
DEPTH_FRACTION = 8
#: A depth of the buffer has 2^3 bytes.
DEPTH_SIZE_BITS = 3
#: The bits that it has more than an attribute word.
ACCUMULATOR_FRACTION = 32
#: Depth as in a vertex.
ACCUMULATOR_VERTEX_DEPTH_AT = 200
#: 1 in the lane of s.
ATTRIBUTE_S = 0x100000000000000
#: Bias of the lanes: half a level for colours.
COLOR_BIAS = 0x100000000000200000000000002000000000000020000000000
#: 2^-15 for barycentric coordinates, so that gradients that are rounded (see Rasterizer) leave none below zero.
WEIGHT_BIAS = 0x100000000000000000000000000000002000000000000020000

# ---- parts of triangles ----

#: Brings CROSSING_BIT to IS_CROSSING.
TRIANGLE_CROSSING_SHIFT = 139
#: The three edges.
EDGE_AB = 0x1000000000000000000000000000000000000
EDGE_BC = 0x2000000000000000000000000000000000000
EDGE_CA = 0x4000000000000000000000000000000000000

# ---- parts of clip coordinates ----

CLIP_BIAS = 0x800000000000000000000000800000000000000000000000
#: What it adds to each.
CLIP_HALF = 0x800000000000000000000000

# ---- parts of edges ----

#: Bits of a column behind the point; where it stands for an address of a depth.
EDGE_FRACTION = 48
EDGE_ADDRESS_FRACTION = 45
#: Where the right edge has the address.
RIGHT_ADDRESS_AT = 173
#: Brings sub-pixels to a column.
EDGE_SUBPIXEL_SHIFT = 40
HALF_COLUMN = 0x800000000000
RIGHT_EDGE_AT = 128
#: Makes the integer part of a Q48 number the next integer, as far as such numbers are exact.
CEIL_48 = 0xFFFFFFFFC000
#: 1 in both lanes.
ONES_128 = 0x100000000000000000000000000000001
LANE_128 = 0xFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFF
UPPER_LANE_128 = 0xFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFF00000000000000000000000000000000
#: A quotient of sub-pixel lengths by twice an area, shifted so, is Q29 per pixel.
GRADIENT_SHIFT = 37
#: Brings such a gradient times sub-pixels to the fraction of an accumulator.
GRADIENT_TO_ACCUMULATOR = 5

# ---- parts of colours ----

#: Bits behind the point of light; of light while it is summed; of a cosine, a direction, a ray.
LIGHT_FRACTION = 16
LIGHT_SUM_FRACTION = 40
COSINE_FRACTION = 24
#: Where a lane of Q10 has what is above 255, and the six bits of it.
OVERFLOW_AT = 18
OVERFLOW_MASK = 63
#: Where green and red are.
MIDDLE_AT = 56
UPPER_AT = 112
#: A lane by itself.
LANE_24 = 0xFFFFFF
LANE_32 = 0xFFFFFFFF
#: Brings the bytes of a colour 0xRRGGBB to BYTES_Q10, besides others.
COLOR_SPREAD = 0x400000000000400000000000400
#: Brings BYTES_56 together at the top of a word.
LANES_TO_PIXEL = 0x100000000000000010000000000000001000000000000000000000000000000

# ---- parts of pixels ----

#: 1 in each of ten pixels.
TEN_PIXELS = 0x1000001000001000001000001000001000001000001000001000001
#: Brings bits 0, 64, 128, 192 to bits 120, 144, 168, 192, besides others; and these.
TOPS_64_TO_24 = 0x1000000000100000000010000000001
PIXELS_AT_120 = 0x1000001000001000001000000000000000000000000000000

# ---- parts of vectors in the space of a mesh ----

MIDDLE_86_AT = 86
UPPER_86_AT = 172
#: Half of what the middle lane counts in, and half of what the upper one does: they round to the nearest.
HALF_MIDDLE_86 = 0x2000000000000000000000
HALF_UPPER_86 = 0x8000000000000000000000000000000000000000000

# ---- parts of signed colours ----

MIDDLE_85_AT = 85
UPPER_85_AT = 170
#: Where each lane of Q58 has a Q9 number.
BLUE_Q9_AT = 49
GREEN_Q9_AT = 134
RED_Q9_AT = 219
#: The byte of the lowest lane.
BYTE_Q58 = 0x3FC00000000000000
#: Shifts that bring BYTES_Q58 to the top of a word: blue, green, red.
BLUE_TO_TOP = 190
GREEN_TO_TOP = 97
RED_TO_TOP = 4
SECOND_BYTE = 0xFF000000000000000000000000000000000000000000000000000000000000
THIRD_BYTE = 0xFF0000000000000000000000000000000000000000000000000000000000

# ---- words of the buffers ----

#: The depth that a word begins with, the next two, and what follows the first.
FIRST_DEPTH = 0xFFFFFFFFFFFFFFFF000000000000000000000000000000000000000000000000
SECOND_DEPTH = 0xFFFFFFFFFFFFFFFF00000000000000000000000000000000
THIRD_DEPTH = 0xFFFFFFFFFFFFFFFF0000000000000000
BEHIND_DEPTH = 0xFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFF
#: The pixel that a word begins with, and what follows.
FIRST_PIXEL = 0xFFFFFF0000000000000000000000000000000000000000000000000000000000
BEHIND_PIXEL = 0xFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFF

# ---- light ----

#: Where lanes of Q40 have Q16 numbers.
BLUE_Q40_AT = 24
GREEN_Q40_AT = 80
RED_Q40_AT = 136
#: Steps of the table of the highlight; where its last entry is, Q40.
SPECULAR_ENTRIES = 64
SPECULAR_LAST = 0x400000000000
#: Brings a place in the table, Q40, to bytes; those of whole words; what is between two entries, Q16.
SPECULAR_ENTRY_SHIFT = 35
SPECULAR_ENTRY_MASK = 0xFFFFE0
SPECULAR_REST_MASK = 0xFFFF
#: Where an entry has its value.
SPECULAR_VALUE_AT = 128
#: The same for a place in Q24; what is between two entries, at bit 128.
SPECULAR_ENTRY_SHIFT_24 = 19
SPECULAR_ENTRY_MASK_24 = 0xFE0
SPECULAR_REST_AT_128 = 0xFFFFFF00000000000000000000000000000000

# ---- normals of fragments ----

#: Where interpolated normals (Q36, lanes of 85 bits) have Q24 numbers, the bits of these, and what keeps them positive.
NORMAL_X_AT = 12
NORMAL_Y_AT = 97
NORMAL_Z_AT = 182
NORMAL_MASK = 0x7FFFFFF
NORMAL_HALF = 0x4000000
#: That in each lane.
NORMAL_BIAS = 0x10000000000000000000008000000000000000000004000000000

# ---- screen word ----
# Where a vertex is on the screen. Comparing screen words as numbers compares rows.

#: Address of the vertex record.
SCREEN_RECORD_AT = 0
SCREEN_RECORD_MASK = 0xFFFFFFFF
#: The triangle must be clipped.
MUST_CLIP = 0x10000000000
#: The vertex lies left of the tile; right of it; above it; below it.
IS_LEFT = 0x20000000000
IS_RIGHT = 0x40000000000
IS_ABOVE = 0x80000000000
IS_BELOW = 0x100000000000
#: Sub-pixel column.
SCREEN_COLUMN_AT = 64
SCREEN_COLUMN_MASK = 0xFFFFF
#: Sub-pixel row.
SCREEN_ROW_AT = 128
SCREEN_ROW_MASK = 0xFFFFF

# ---- attribute word ----
# Depth and colours of a vertex: colours as told below, Q10. Of a vertex that has to be clipped it holds the outcode
# instead.

#: Depth: see DEPTH_SCALE.
ATTRIBUTE_DEPTH_AT = 168
ATTRIBUTE_DEPTH_MASK = 0xFFFFFFFFFFFFFF

# ---- accumulator ----
# An attribute word with 32 more bits, as it is stepped from pixel to pixel. In place of colours there may be
# barycentric coordinates: s in the middle lane, t in the lowest.

#: Depth with 8 more bits than in a vertex, as it is in the buffer.
ACCUMULATOR_DEPTH_AT = 192
ACCUMULATOR_DEPTH_MASK = 0xFFFFFFFFFFFFFFFF

# ---- triangle of a list ----
# The first vertex is the topmost, and the three run counter-clockwise on the screen.

#: Addresses of the third, second and first vertex record.
TRIANGLE_C_AT = 0
TRIANGLE_C_MASK = 0xFFFFFFFF
TRIANGLE_B_AT = 32
TRIANGLE_B_MASK = 0xFFFFFFFF
TRIANGLE_A_AT = 64
TRIANGLE_A_MASK = 0xFFFFFFFF
#: The first pixel row that may be covered, and the row after the last.
TRIANGLE_TOP_AT = 96
TRIANGLE_TOP_MASK = 0xFFFF
TRIANGLE_BOTTOM_AT = 112
TRIANGLE_BOTTOM_MASK = 0xFFFF
#: The number of the face.
TRIANGLE_FACE_AT = 128
TRIANGLE_FACE_MASK = 0xFFFF
#: Which edges belong to the face: first to second vertex, second to third, third to first.
TRIANGLE_EDGES_AT = 144
TRIANGLE_EDGES_MASK = 7
#: Whether it reaches beyond the left or right border of the tile.
CROSSING_BIT = 0x8000000000000000000000000000000000000

# ---- clip coordinates ----
# Column * distance, row * distance and distance, all Q32. The first two are signed, and CLIP_BIAS adds half their range
# to them.

CLIP_X_AT = 0
CLIP_X_MASK = 0xFFFFFFFFFFFFFFFFFFFFFFFF
CLIP_Y_AT = 96
CLIP_Y_MASK = 0xFFFFFFFFFFFFFFFFFFFFFFFF
CLIP_W_AT = 192
CLIP_W_MASK = 0xFFFFFFFFFFFFFFFF

# ---- edges ----
# Two columns, Q48, in lanes of 128 bits: the integer part is the first pixel whose centre is not left of the edge. Q48
# columns are Q45 numbers of bytes of depths: with the address of a row added, edges are the addresses of depths.

#: Whole pixels of the left edge, and of the right one.
EDGES_LEFT_COLUMN_AT = 48
EDGES_LEFT_COLUMN_MASK = 0xFFFF
EDGES_RIGHT_COLUMN_AT = 176
EDGES_RIGHT_COLUMN_MASK = 0xFFFF

# ---- colours ----
# Three lanes of 56 bits: blue at bit 0, green at 56, red at 112. One ADD or MUL works on all of them. A signed number
# in a lane borrows from the lane above; as long as the sum in the end is positive in every lane (a bias sees to that),
# the lanes come out right.

#: 1 in each lane.
ONES = 0x10000000000000100000000000001
#: The lower bits of each: all that a colour of Q10 has in the lanes of a triangle.
LANES_24 = 0xFFFFFF00000000FFFFFF00000000FFFFFF
LANES_32 = 0xFFFFFFFF000000FFFFFFFF000000FFFFFFFF
#: Half a level, Q10.
HALF_LEVEL = 0x2000000000000020000000000000200
#: What is set in lanes of Q10 above 255.
OVERFLOW = 0xFC000000000000FC000000000000FC0000
#: A byte in each lane; a byte as Q10.
BYTES_56 = 0xFF000000000000FF000000000000FF
BYTES_Q10 = 0x3FC000000000003FC000000000003FC00

# ---- depths ----
# Four depths in a word, the leftmost uppermost.

#: The bit above each; and what is below it.
TOPS_64 = 0x8000000000000000800000000000000080000000000000008000000000000000
BELOW_TOPS_64 = 0x7FFFFFFFFFFFFFFF7FFFFFFFFFFFFFFF7FFFFFFFFFFFFFFF7FFFFFFFFFFFFFFF

# ---- pixels ----
# Colours of eight pixels in a word, or a channel of eight (Q9), the leftmost uppermost.

ONES_24 = 0x1000001000001000001000001000001000001000001
#: How many pixels each is to the left of the last; the squares of that.
STEPS_24 = 0x7000006000005000004000003000002000001000000
SQUARES_24 = 0x31000024000019000010000009000004000001000000
#: What is set below 0 and above 255: that below 0; what makes it carry above 255; the byte.
BEYOND_BYTES_24 = 0xFE0000FE0000FE0000FE0000FE0000FE0000FE0000FE0000
TOPS_24 = 0x800000800000800000800000800000800000800000800000
CARRY_24 = 0x7E00007E00007E00007E00007E00007E00007E00007E0000
BYTES_24 = 0x1FE0001FE0001FE0001FE0001FE0001FE0001FE0001FE00

# ---- signed colours ----
# Three signed lanes of 85 bits, of quadratic functions. A colour that is stepped is Q58, and one times its depth Q72
# (Q24 without the last 48 bits).

#: Half the range of a lane, which keeps it positive; the same without the last 48 bits, with all bits of that.
BIAS_84 = 0x4000000000000000000002000000000000000000001000000000000000000000
BIAS_36 = 0x4000000000000000000002000000000000000000001000000000
LANES_37 = 0x7FFFFFFFFC000000000003FFFFFFFFE000000000001FFFFFFFFF
#: Half of the last bit that a second difference keeps.
BEND_ROUNDING = 0x4000000000000000000002000000000000000000001000000000000
#: The byte of each lane, Q58; what is above; what it carries into if it is added to itself; the sign.
BYTES_Q58 = 0xFF00000000000000000007F80000000000000000003FC00000000000000
ABOVE_Q58 = 0x7FFFF00000000000000003FFFF80000000000000001FFFFC0000000000000000
CARRIES_85 = 0x8000000000000000000004000000000000000000002000000000000000000000
SIGNS_85 = 0x4000000000000000000002000000000000000000001000000000000000000000

# ---- vectors in the space of a mesh ----
# Three signed lanes of 86 bits. The middle coefficient of the product of two vectors, one of them with its lanes the
# other way round, is their dot product, and has all bits from UPPER_86_AT on: what is above is beyond the word.

#: Half the range of each lane; the bits that are left of a lane of Q80 as Q32; half of them.
HALF_86 = 0x8000000000000000000008000000000000000000002000000000000000000000
Q32_86 = 0xFFFFFFFFF000000000000FFFFFFFFFC000000000003FFFFFFFFF
HALF_Q32_86 = 0x8000000000000000000008000000000000000000002000000000
