"""Registers, packed words and modes. Written by tools/layout.py from contracts/layout.toml."""


# ---- registers ----

#: Where registers begin: what the compiler keeps in memory must end before.
REGISTERS = 0x800
REGISTERS_END = 0x2EE0

# ---- frame ----
# The uniforms of the frame, which the Renderer fills. Pixel columns and rows are counted from -PIXEL_BIAS, so that
# everything inside the guard band is positive; sub-pixel coordinates are pixels with 8 more bits, and whole pixels are
# the centres of pixels.

#: Where these registers begin, and their bytes.
FRAME_BEGIN = 0x800
FRAME_SIZE = 0x920
#: 1 for an orthographic camera, else 0.
FRAME_IS_ORTHOGRAPHIC = 0x800
#: Distance of the near plane, Q32.
NEAR = 0x820
#: depth = DEPTH_SCALE / distance (perspective), DEPTH_SCALE - distance / 256 (orthographic): 2^54 at most, so that the
#: highest bit of the 64 of a depth in the buffer, which has 8 more, is free.
DEPTH_SCALE = 0x840
#: First pixel column of the tile, and the one after the last.
COLUMN_BEGIN = 0x860
COLUMN_END = 0x880
#: Bytes of a row of depths.
DEPTH_STRIDE = 0x8A0
#: The ray through a pixel, (x, y, 1) in camera space, Q24: x = RAY_LEFT + column * RAY_STEP, y = RAY_TOP + row *
#: RAY_STEP. For an orthographic camera, where all rays are parallel, the place beside the line of sight in world units,
#: Q32.
RAY_LEFT = 0x8C0
RAY_TOP = 0x8E0
RAY_STEP = 0x900
#: First guess at the length of a ray from its square: LENGTH_AT_0 + LENGTH_SLOPE * square >> 48; and how many steps of
#: Newton's method refine it besides the first.
LENGTH_AT_0 = 0x920
LENGTH_SLOPE = 0x940
LENGTH_STEPS = 0x960
#: The tile, in the order of a Rectangle.
TILE_X = 0x980
TILE_Y = 0x9A0
TILE_WIDTH = 0x9C0
TILE_HEIGHT = 0x9E0
#: The background of the lowest row of the tile, lanes of Q24 with half a level, and its change from row to row upwards.
BACKGROUND = 0xA00
BACKGROUND_STEP = 0xA20
#: 1 if all bytes are inverted in the end; 1 if covered pixels are counted; else 0.
INVERT = 0xA40
COUNT_PIXELS = 0xA60
#: How many objects are to be drawn, where in calldata the uniforms of the first begin, and its number in the scene.
OBJECT_COUNT = 0xA80
OBJECTS = 0xAA0
OBJECT_FIRST = 0xAC0
#: The same of all objects: see Runs.
OBJECT_TOTAL = 0xAE0
OBJECTS_BEGIN = 0xB00
#: Where in calldata the pixels and depths stand of what was drawn before; 0 if nothing was.
DRAWN_BEFORE = 0xB20
#: 1 if depths are returned as well; 1 if nothing is drawn, and triangles are counted; else 0.
RETURNS_DEPTHS = 0xB40
ONLY_COUNTS = 0xB60
#: The address after the last record of a light.
LIGHTS_END = 0xB80
#: Up to 4 records of LIGHT_SIZE bytes.
LIGHTS = 0xBA0

# ---- band ----

#: First row of the band that is being drawn, and the row after its last.
BAND_TOP = 0x1120
BAND_BOTTOM = 0x1140
#: Address that the depth of row 0, column 0 would have, which may be below 0. Rows go down in memory, as they do in a
#: bitmap.
DEPTH_ORIGIN = 0x1160
#: A pixel with its depth at p has its colour at IMAGE_ORIGIN + 3 * (p / 8).
IMAGE_ORIGIN = 0x1180

# ---- object ----
# The uniforms of an object, which the Renderer fills. They end where the last one is that the object needs: unlit ones
# at OBJECT_LIT, others behind their lights, and with SPECULAR_TABLE only where there is one.

#: How many bytes of the following the object has; the first word of them.
OBJECT_BYTES = 0x11A0
#: The bits of MODE that all faces of the object share, and its flags, as in the scene.
OBJECT_MODE = 0x11C0
OBJECT_FLAGS = 0x11E0
#: How much of what is behind it the object hides, Q24; 1 where it is opaque.
OPACITY = 0x1200
#: Columns of the matrix from mesh to screen, three lanes each: see VertexShader.
MATRIX_X = 0x1220
MATRIX_Y = 0x1240
MATRIX_Z = 0x1260
MATRIX_T = 0x1280
#: A sub-pixel column x is outside the tile if x - TILE_LEFT, as an unsigned number, is above TILE_SPAN, and a row y if
#: y - TILE_TOP is above TILE_ROWS.
TILE_LEFT = 0x12A0
TILE_SPAN = 0x12C0
TILE_TOP = 0x12E0
TILE_ROWS = 0x1300
#: What is added to screen words to round rows up, or, for lines, to the nearest: see PrimitiveAssembly.
ROUND_TOP = 0x1320
ROUND_BOTTOM = 0x1340
#: The mesh, in the order of the struct Mesh: offsets in the engine's calldata, counts, format.
MESH_VERTICES = 0x1360
MESH_VERTEX_COUNT = 0x1380
MESH_FACES = 0x13A0
MESH_FACE_COUNT = 0x13C0
MESH_BITS = 0x13E0
MESH_STRIDE = 0x1400
#: What follows is for objects that are lit.
OBJECT_LIT = 0x1420
#: Columns of the matrix that turns normals into camera space, three lanes each. Of a flat object: of the one that turns
#: rays into the space of the mesh, Q24, signed lanes of 86 bits, z lowest.
NORMAL_X = 0x1420
NORMAL_Y = 0x1440
NORMAL_Z = 0x1460
#: The eye in the space of the mesh, Q32; the line of sight there, Q24, for an orthographic camera.
EYE_X = 0x1480
EYE_Y = 0x14A0
EYE_Z = 0x14C0
#: Scale of the mesh, Q32, and scale / near, Q64.
SCALE = 0x14E0
SCALE_PER_NEAR = 0x1500
#: Ambient light times the ambient coefficient, lanes of Q16.
AMBIENT = 0x1520
#: The square of the distance, in sub-pixels, over which light is as good as linear.
REACH = 0x1540
#: Up to which sum of the squares of two edges the light of smooth triangles is bounded; and the square of how much unit
#: half vectors may differ, Q40.
SMOOTH_REACH = 0x1560
HALF_REACH = 0x1580
#: Light of a smooth object that does not depend on the fragment, lanes of Q40.
FACE_LIGHT_40 = 0x15A0
#: The square and the length of the normal of a fragment, Q48 and Q24: one, unless normals are interpolated.
FRAGMENT_SQUARE = 0x15C0
FRAGMENT_NORMAL_LENGTH = 0x15E0
#: Where the table of the highlight begins, cos^2 in Q24, and its entries per unit of it, Q16; their product, Q24.
SPECULAR_BEGIN = 0x1600
SPECULAR_SCALE = 0x1620
SPECULAR_OFFSET = 0x1640
#: The specular coefficient, Q16, if the shininess is 1, else 0.
SPECULAR_ROOT = 0x1660
#: The other halves of the records at LIGHTS.
OBJECT_LIGHTS = 0x1680
#: 65 entries: value of the highlight in the upper half, increase to the next entry in the lower, both Q16.
SPECULAR_TABLE = 0x1C00
SPECULAR_TABLE_END = 0x2420

# ---- triangle ----

#: How fragments are shaded: see the mode.
MODE = 0x2420
#: The accumulator at the first vertex, with the bias of its lanes; and the differences of the attribute words of the
#: others to that of the first.
ATTRIBUTE_0 = 0x2440
DELTA_1 = 0x2460
DELTA_2 = 0x2480
#: Where the face is in calldata.
FACE = 0x24A0
#: The accumulator at column 0 of the first row, and its change per pixel and per row.
START = 0x24C0
DX = 0x24E0
DY = 0x2500
#: Colour at the first vertex, and its differences to the others.
COLOR_0 = 0x2520
COLOR_1 = 0x2540
COLOR_2 = 0x2560
#: Depths at the second and third vertex.
DEPTH_1 = 0x2580
DEPTH_2 = 0x25A0
#: Pixels along a side of the cells over which colours are quadratic; 0 if they are over the whole triangle, 1 if each
#: is exact.
PATCH_SIZE = 0x25C0
#: Normal of a flat face, twice its area long, in units of the mesh: signed lanes of 86 bits.
FACE_NORMAL = 0x25E0
#: The square of its length, and its length, Q16.
FACE_SQUARE = 0x2600
FACE_LENGTH = 0x2620
#: Unit normal times ray, Q48: FACE_N_DOT_RAY + FACE_N_DOT_RAY_SLOPE * depth >> 94.
FACE_N_DOT_RAY = 0x2640
FACE_N_DOT_RAY_SLOPE = 0x2660
#: Normals of a smooth triangle of which each fragment is lit for itself: the normal at the first vertex (Q36), and the
#: differences to the others (Q20).
NORMALS_0 = 0x2680
NORMALS_1 = 0x26A0
NORMALS_2 = 0x26C0

# ---- fragment ----

#: The place of the fragment beside the line of sight of an orthographic camera, Q16.
FRAGMENT_PLACE_X = 0x26E0
FRAGMENT_PLACE_Y = 0x2700
#: Its normal, Q24, and the product of that with the ray.
FRAGMENT_NORMAL_X = 0x2720
FRAGMENT_NORMAL_Y = 0x2740
FRAGMENT_NORMAL_Z = 0x2760
FRAGMENT_NORMAL_RAY = 0x2780
#: Half the magnitude of the last square of a normal; of that of a face, a multiple of 3.
NORMAL_HINT = 0x27A0
FACE_HINT = 0x27C0
#: What of a light's strength reaches it through its cone, Q16.
FRAGMENT_CONE = 0x27E0
#: The light that modulates its colour, lanes of Q40.
FRAGMENT_LIGHT = 0x2800
#: If colours are times their depths, the nearest depth of the triangle, with 8 more bits than in a vertex; else 0.
PATCH_WEIGHT = 0x2820
#: The first column of the cell that is drawn, and the one after its last.
PATCH_BEGIN = 0x2840
PATCH_END = 0x2860

# ---- edges ----

#: Not zero if a vertex of the object lies outside the guard band or nearer than the near plane.
HAS_CLIPPED = 0x2880
#: DEPTH_STRIDE in both lanes of edges: see Rasterizer.
STRIDE_LANES = 0x28A0
#: The change of the accumulator per byte of depths, an eighth of DX; and what START changes per row if it is told by
#: addresses.
DX_8 = 0x28C0
ROW_STEP = 0x28E0
#: The lower part of a triangle, where the edge from the second to the third vertex takes the place of the one that has
#: ended: the number of its rows, its edges = the edges of the upper part & LOWER_KEPT | LOWER_EDGE, their changes per
#: row.
LOWER_ROWS = 0x2900
LOWER_KEPT = 0x2920
LOWER_EDGE = 0x2940
LOWER_SLOPES = 0x2960
#: Depths of a triangle that is IS_DEEP: what START, DX and DY get besides.
DEEP_START = 0x2980
DEEP_DX = 0x29A0
DEEP_DY = 0x29C0
#: Where the next triangle is listed; 0 if faces are drawn at once.
LIST = 0x29E0
#: How many faces of the object were drawn or listed.
DRAWN = 0x2A00
#: Faces of which twice the area, Q192, is not above this are not drawn: they face away.
LEAST_AREA = 0x2A20
#: What edges change per row.
SLOPES = 0x2A40
#: The end of the faces in calldata.
FACES_END = 0x2A60

# ---- quadratic functions ----

#: Coefficients of values that are quadratic over a triangle, signed lanes of 85 bits: see Quadratic.
QUADRATIC_1 = 0x2A80
QUADRATIC_S = 0x2AA0
QUADRATIC_T = 0x2AC0
QUADRATIC_SS = 0x2AE0
QUADRATIC_ST = 0x2B00
QUADRATIC_TT = 0x2B20
#: The values at column 0 of the first row, and their first and second differences to the next column and row.
QUADRATIC_START = 0x2B40
QUADRATIC_DX = 0x2B60
QUADRATIC_DY = 0x2B80
QUADRATIC_DXX = 0x2BA0
QUADRATIC_DXY = 0x2BC0
QUADRATIC_DYY = 0x2BE0
#: Changes over a word of eight colours: the quadratic part of each channel.
BEND_BLUE = 0x2C00
BEND_GREEN = 0x2C20
BEND_RED = 0x2C40

# ---- smooth triangles ----

#: Normals at the vertices, times their weights, Q30; behind each the same with its lanes the other way round.
NORMAL_0 = 0x2C60
NORMAL_1 = 0x2CA0
NORMAL_2 = 0x2CE0
#: The largest of the squares of the changes of the half vector from vertex to vertex, Q40.
HALF_CHANGE = 0x2D20
#: Half the magnitudes of the last squares of a ray, and of a half vector.
RAY_HINT = 0x2D40
HALF_HINT = 0x2D60
#: The record of a vertex in the middle of an edge.
MIDDLE = 0x2D80
#: 1 if a depth of its vertices is less than 7/8 of the greatest, 2 if less than 3/4; else 0.
DEPTHS_DIFFER = 0x2E80
#: Half of QUADRATIC_DXX, by which QUADRATIC_DX is less while rows are drawn.
QUADRATIC_HALF_DXX = 0x2EA0
#: The greatest depth of its vertices, Q24 of what is above bit 192 of an accumulator.
NEAREST = 0x2EC0

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
IS_FLAT = 64
#: The triangle reaches beyond the left or right border of the tile.
IS_CROSSING = 128
#: The accumulator holds barycentric coordinates, and colours are found as PATCH_SIZE says: see Patches.
IS_PATCHED = 0x100
#: Light is made of products that are quadratic over the triangle: see SmoothLight.
IS_QUADRATIC = 0x200
#: Perspective shows: depths differ by more than a factor of 64, or, with IS_QUADRATIC, colours are multiplied by them.
IS_STEEP = 0x400
#: All light is grey.
IS_GREY = 0x800
#: Depths differ by more than a factor of 2^12, and are interpolated by themselves.
IS_DEEP = 0x1000
#: The triangle reaches above or below the band.
IS_CUT = 0x2000
#: A light of the scene is a spot light.
IS_SPOT_LIT = 0x4000
#: The object is not opaque: the nearest fragment of each pixel is mixed with what is behind it.
IS_BLENDED = 0x8000
#: The first of its two passes, which finds those fragments.
IS_DEPTH_PASS = 0x10000

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
#: A quotient of sub-pixel lengths by twice an area, shifted so, is Q24 per pixel.
SUBPIXEL_TO_Q24 = 32

# ---- fixed-point formats ----

#: Bits behind the point. A number is brought from one format to another by their difference.
Q10 = 10
Q16 = 16
Q20 = 20
Q24 = 24
Q32 = 32
Q40 = 40
Q48 = 48
Q16_TO_Q10 = 6
Q40_TO_Q16 = 24
#: One in each.
ONE_10 = 0x400
ONE_16 = 0x10000
HALF_24 = 0x800000
ONE_24 = 0x1000000
ONE_32 = 0x100000000
ONE_44 = 0x100000000000
ONE_48 = 0x1000000000000
#: The greatest depth of a vertex is 2 to this power: see DEPTH_SCALE.
DEPTH_BITS = 54

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

#: All bits of the column.
SCREEN_COLUMNS = 0xFFFFF0000000000000000
#: Row in whole pixels.
SCREEN_PIXEL_ROW_AT = 136
#: The bits of the column that are whole pixels.
SCREEN_PIXEL_COLUMNS = 0xFFF000000000000000000
#: Added, it rounds row and column up to whole pixels.
SCREEN_ROUND_UP = 0xFF00000000000000FF0000000000000000

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
#: Where s and t have Q24 numbers, and the last bytes of their lanes.
ACCUMULATOR_S_AT = 64
ACCUMULATOR_S_LAST_BYTE = 20
ACCUMULATOR_T_AT = 8
ACCUMULATOR_T_LAST_BYTE = 6
#: Bias of the lanes: half a level for colours.
COLOR_BIAS = 0x100000000000200000000000002000000000000020000000000
#: 2^-15 for barycentric coordinates, so that gradients that are rounded (see Rasterizer) leave none below zero.
WEIGHT_BIAS = 0x100000000000000000000000000000002000000000000020000

# ---- parts of triangles ----

#: The three edges.
EDGE_AB = 0x1000000000000000000000000000000000000
EDGE_BC = 0x2000000000000000000000000000000000000
EDGE_CA = 0x4000000000000000000000000000000000000

# ---- parts of clip coordinates ----

CLIP_BIAS = 0x800000000000000000000000800000000000000000000000
#: What it adds to each.
CLIP_HALF = 0x800000000000000000000000

# ---- parts of borders ----

#: Bits of a lane; how many there are.
BORDER_BITS = 28
BORDER_COUNT = 9
#: 2^27, below which values are, less 2^16 for the tile and more 2^16 for the guard band, which is more than their
#: rounding.
BORDER_BIAS = 0x801000080100008010000801000080100007FF00007FF00007FF00007FF0000

# ---- parts of edges ----

#: Bits of a column behind the point; where it stands for an address of a depth.
EDGE_FRACTION = 48
EDGE_ADDRESS_FRACTION = 45
#: Where the address of the right edge is.
EDGE_RIGHT_ADDRESS_AT = 173
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

#: Bits of a colour 0xRRGGBB; where they are; and how far from there their lanes are.
BLUE = 255
GREEN = 0xFF00
RED = 0xFF0000
GREEN_AT = 8
RED_AT = 16
GREEN_TO_LANE = 48
RED_TO_LANE = 96
#: Bits behind the point of light; of light while it is summed; of a cosine, a direction, a ray.
LIGHT_FRACTION = 16
LIGHT_SUM_FRACTION = 40
COSINE_FRACTION = 24
#: Where a lane of Q10 has what is above 255, and the six bits of it.
OVERFLOW_AT = 18
OVERFLOW_MASK = 63
#: Where green and red are in lanes.
MIDDLE_AT = 56
UPPER_AT = 112
#: A lane by itself.
LANE_24 = 0xFFFFFF
LANE_32 = 0xFFFFFFFF
#: Brings the bytes of a colour 0xRRGGBB to BYTES_Q10, besides others.
COLOR_SPREAD = 0x400000000000400000000000400
#: A byte as Q10, in a lane by itself.
BYTE_Q10 = 0x3FC00
OVERFLOW_CARRY_AT = 30
#: Brings BYTES_56 together at the top of a word; BYTES_Q10.
LANES_TO_PIXEL = 0x100000000000000010000000000000001000000000000000000000000000000
Q10_TO_PIXEL = 0x400000000000000040000000000000004000000000000000000000000000

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
#: The lowest lane, the middle one, the uppermost, and the upper two.
LANE_85 = 0x1FFFFFFFFFFFFFFFFFFFFF
MIDDLE_LANE_85 = 0x3FFFFFFFFFFFFFFFFFFFFE00000000000000000000
UPPER_LANE_85 = 0xFFFFFFFFFFFFFFFFFFFFFC000000000000000000000000000000000000000000
UPPER_LANES_85 = 0xFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFE000000000000000000000
#: Shifts that bring the sign of the lowest lane to the top of a word, and that of the middle one.
LOWER_85_TO_TOP = 171
MIDDLE_85_TO_TOP = 86
#: The sign of the lowest lane, and what that carries into.
SIGN_85 = 84
CARRY_85 = 85
Q10_TO_Q58 = 48
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
SPECULAR_REST_AT = 24
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
# Where a vertex is on the screen. Comparing screen words as numbers compares rows. What is below the column must stay
# below bit 41: see the area in PrimitiveAssembly, of which it is the error, 2^149 times as large, and half of the least
# area is 2^191.

#: Address of the vertex record.
SCREEN_RECORD_AT = 0
SCREEN_RECORD_MASK = 0xFFFFFFFF
#: The triangle must be clipped.
MUST_CLIP = 0x100000000
#: The vertex lies left of the tile; right of it; above it; below it.
IS_LEFT = 0x200000000
IS_RIGHT = 0x400000000
IS_ABOVE = 0x800000000
IS_BELOW = 0x1000000000
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

# ---- flags together ----

#: Left or right; above or below; any of them; that or MUST_CLIP.
IS_BESIDE = 0x600000000
IS_OVER = 0x1800000000
IS_OUTSIDE = 0x1E00000000
IS_NOT_PLAIN = 0x1F00000000
#: What tells how the rows of a smooth triangle are drawn.
IS_GREY_OR_STEEP = 0xC00
IS_CUT_OR_CROSSING = 0x2080

# ---- flags that are shifted ----

#: From a triangle of a list to its mode.
TRIANGLE_CROSSING_SHIFT = 140

# ---- borders of the tile ----
# Four lanes of 28 bits for the left, right, upper and lower border: positive where a vertex lies beyond. See
# TileCulling.

#: Set where the value is positive.
BORDER_SIGNS = 0x8000000800000080000008000000

# ---- borders of the guard band ----
# Behind these five for the left, right, upper and lower border of the guard band, and the near plane.

#: Set where the value is positive.
GUARD_SIGNS = 0x800000080000008000000800000080000000000000000000000000000000000

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
#: What is set in lanes of Q10 above 255; what makes it carry into bit OVERFLOW_CARRY_AT.
OVERFLOW = 0xFC000000000000FC000000000000FC0000
OVERFLOW_TO_CARRY = 0x3FFC00000000003FFC00000000003FFC0000
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
