// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

// The values that every vertex, triangle and fragment needs live at fixed memory addresses: reading one costs 6 gas, half of what a
// field of a memory struct costs, and no stack slot. In the words of graphics interfaces they are uniforms.

/// @dev The compiler keeps variables that do not fit the stack between 0x80 and the first free address; `reserveRegisters` checks
/// that this is below the registers.
uint256 constant REGISTERS = 0x800;
uint256 constant REGISTERS_END = 0x2180;

error RegistersOverlap();

function reserveRegisters() pure {
    uint256 free;
    assembly ("memory-safe") {
        free := mload(0x40)
    }
    if (free > REGISTERS) revert RegistersOverlap();
    assembly ("memory-safe") {
        mstore(0x40, REGISTERS_END)
    }
}

function load(uint256 pointer) pure returns (uint256 value) {
    assembly ("memory-safe") {
        value := mload(pointer)
    }
}

function loadSigned(uint256 pointer) pure returns (int256 value) {
    assembly ("memory-safe") {
        value := mload(pointer)
    }
}

function store(uint256 pointer, uint256 value) pure {
    assembly ("memory-safe") {
        mstore(pointer, value)
    }
}

function storeSigned(uint256 pointer, int256 value) pure {
    assembly ("memory-safe") {
        mstore(pointer, value)
    }
}

// ---------------------------------------------------------------------------------------------------------------- lanes
// Several numbers share a word, each in a lane of its own, so that one ADD or MUL works on all of them. A signed number in a lane
// borrows from the lane above; as long as the sum in the end is positive in every lane (a bias sees to that), the lanes come out
// right.

/// @dev Three lanes of 56 bits: blue at bit 0, green at 56, red at 112.
uint256 constant ONES = 0x10000000000000100000000000001;

// ---------------------------------------------------------------------------------------------------------------- frame
// What holds for the whole picture. Pixel columns and rows are counted from -PIXEL_BIAS, so that everything inside the guard band is
// positive; sub-pixel coordinates are pixels with 8 more bits, and whole pixels are the centres of pixels.

/// @dev The guard band reaches from pixel -PIXEL_BIAS to GUARD_BAND - PIXEL_BIAS; the canvas lies at 0..2048 in it. Sub-pixel coordinates
/// inside it have GUARD_BITS bits.
uint256 constant PIXEL_BIAS = 1536;
uint256 constant GUARD_BAND = 4096;
uint256 constant GUARD_BITS = 20;
/// @dev 1 for an orthographic camera, else 0.
uint256 constant FRAME_IS_ORTHOGRAPHIC = 0x800;
/// @dev Distance of the near plane, Q32.
uint256 constant NEAR = 0x820;
/// @dev depth = DEPTH_SCALE / distance (perspective), DEPTH_SCALE - distance / 256 (orthographic).
uint256 constant DEPTH_SCALE = 0x840;
/// @dev A sub-pixel column x is outside the tile if x - TILE_LEFT, as an unsigned number, is above TILE_SPAN.
uint256 constant TILE_LEFT = 0x860;
uint256 constant TILE_SPAN = 0x880;
/// @dev First pixel column of the tile, and the one after the last.
uint256 constant COLUMN_BEGIN = 0x8a0;
uint256 constant COLUMN_END = 0x8c0;
/// @dev First row of the band that is being drawn, and the row after its last.
uint256 constant BAND_TOP = 0x8e0;
uint256 constant BAND_BOTTOM = 0x900;
/// @dev Address that the depth of row 0, column 0 would have, which may be below 0. Rows go down in memory, as they do in a
/// bitmap.
uint256 constant DEPTH_ORIGIN = 0x920;
/// @dev Bytes of a row of depths.
uint256 constant DEPTH_STRIDE = 0x940;
/// @dev A pixel with its depth at p has its colour at IMAGE_ORIGIN + 3 * (p / 8).
uint256 constant IMAGE_ORIGIN = 0x960;
/// @dev The ray through a pixel, (x, y, 1) in camera space, Q24: x = RAY_LEFT + column * RAY_STEP, y = RAY_TOP + row * RAY_STEP. For an
/// orthographic camera, where all rays are parallel, the place beside the line of sight in world units, Q32.
uint256 constant RAY_LEFT = 0x980;
uint256 constant RAY_TOP = 0x9a0;
uint256 constant RAY_STEP = 0x9c0;
/// @dev First guess at the length of a ray from its square: LENGTH_AT_0 + LENGTH_SLOPE * square >> 48; and how many steps of Newton's
/// method refine it besides the first.
uint256 constant LENGTH_AT_0 = 0x9e0;
uint256 constant LENGTH_SLOPE = 0xa00;
uint256 constant LENGTH_STEPS = 0xa20;

// ---------------------------------------------------------------------------------------------------------------- lights

/// @dev The address after the last record of a light.
uint256 constant LIGHTS_END = 0xa40;
/// @dev Up to 4 records of LIGHT_SIZE bytes.
uint256 constant LIGHTS = 0xa60;
uint256 constant LIGHT_SIZE = 0x160;
/// @dev Offsets in a record: 1 if it is a point light;
uint256 constant LIGHT_IS_POINT = 0x00;
/// @dev direction (unit vector, Q24) or position (Q16) in camera space,
uint256 constant LIGHT_X = 0x20;
uint256 constant LIGHT_Y = 0x40;
uint256 constant LIGHT_Z = 0x60;
/// @dev the same in the space of the mesh, the position as Q32;
uint256 constant LIGHT_MESH_X = 0x80;
uint256 constant LIGHT_MESH_Y = 0xa0;
uint256 constant LIGHT_MESH_Z = 0xc0;
/// @dev colour, lanes of bytes; colour times the diffuse coefficient, lanes of Q16;
uint256 constant LIGHT_COLOR = 0xe0;
uint256 constant LIGHT_DIFFUSE = 0x100;
/// @dev normal of the face times the vector to the light: Q24 for a direction, Q16 for a position;
uint256 constant LIGHT_FACING = 0x120;
/// @dev half the magnitude of the last distance: see `root` in FragmentShader.
uint256 constant LIGHT_HINT = 0x140;

// ---------------------------------------------------------------------------------------------------------------- object

/// @dev Columns of the matrix from mesh to screen, three lanes each: see VertexShader.
uint256 constant MATRIX_X = 0xfe0;
uint256 constant MATRIX_Y = 0x1000;
uint256 constant MATRIX_Z = 0x1020;
uint256 constant MATRIX_T = 0x1040;
/// @dev Columns of the matrix that turns normals into camera space, three lanes each.
uint256 constant NORMAL_X = 0x1060;
uint256 constant NORMAL_Y = 0x1080;
uint256 constant NORMAL_Z = 0x10a0;
/// @dev What is added to screen words to round rows up, or, for lines, to the nearest: see PrimitiveAssembly.
uint256 constant ROUND_TOP = 0x10c0;
uint256 constant ROUND_BOTTOM = 0x10e0;
/// @dev The eye in the space of the mesh, Q32; the line of sight there, Q24, for an orthographic camera.
uint256 constant EYE_X = 0x1100;
uint256 constant EYE_Y = 0x1120;
uint256 constant EYE_Z = 0x1140;
/// @dev Scale of the mesh, Q32, and scale / near, Q64.
uint256 constant SCALE = 0x1160;
uint256 constant SCALE_PER_NEAR = 0x1180;
/// @dev Ambient light times the ambient coefficient, lanes of Q16.
uint256 constant AMBIENT = 0x11a0;
/// @dev Where the table of the highlight begins, cos^2 in Q24, and its entries per unit of it, Q16.
uint256 constant SPECULAR_BEGIN = 0x11c0;
uint256 constant SPECULAR_SCALE = 0x11e0;
/// @dev The specular coefficient, Q16, if the shininess is 1, else 0.
uint256 constant SPECULAR_ROOT = 0x1200;
/// @dev 65 entries: value of the highlight in the upper half, increase to the next entry in the lower, both Q16.
uint256 constant SPECULAR_TABLE = 0x1220;
/// @dev The square of the distance, in sub-pixels, over which light is as good as linear; and over which the ray turns by a quarter of
/// its length; and the square of how much half vectors may differ, Q40.
uint256 constant REACH = 0x1a40;
uint256 constant VARYING_REACH = 0x1a60;
uint256 constant HALF_REACH = 0x1a80;
/// @dev Calldata offsets and format of the mesh: see Mesh.
uint256 constant MESH_VERTICES = 0x1aa0;
uint256 constant MESH_FACES = 0x1ac0;
uint256 constant MESH_STRIDE = 0x1ae0;
uint256 constant MESH_BITS = 0x1b00;
/// @dev The bits of MODE that all faces of the object share.
uint256 constant OBJECT_MODE = 0x1b20;

// ---------------------------------------------------------------------------------------------------------------- triangle

/// @dev How fragments are shaded, a sum of the following; 0 for the plain loop. The code moves some of these bits by shifts: HAS_SPECULAR
/// is four times IS_LIT, 0x240 is IS_BLOCKED | IS_BARYCENTRIC, and IS_CROSSING stands 139 bits below bit 147 of a triangle.
uint256 constant MODE = 0x1b40;
/// @dev The accumulator holds the lit colour itself, and it may be above 255.
uint256 constant IS_LINEAR = 1;
/// @dev Light is added for each fragment. There is at least one light then, on which the loops over lights rely: they ask at their end.
uint256 constant IS_LIT = 2;
/// @dev More than highlights.
uint256 constant IS_DIFFUSE = 4;
/// @dev The material has highlights.
uint256 constant HAS_SPECULAR = 8;
/// @dev Normals of the vertices, or of the face.
uint256 constant IS_SMOOTH = 16;
uint256 constant IS_ORTHOGRAPHIC = 32;
/// @dev The accumulator holds barycentric coordinates, and each fragment is shaded for itself.
uint256 constant IS_BARYCENTRIC = 64;
uint256 constant IS_FLAT = 128;
/// @dev The triangle reaches beyond the left or right border of the tile.
uint256 constant IS_CROSSING = 0x100;
/// @dev Colours are exact only every BLOCK pixels.
uint256 constant IS_BLOCKED = 0x200;
/// @dev The vectors to light and eye are interpolated from the vertices.
uint256 constant IS_VARYING = 0x400;
/// @dev Perspective shows within the triangle.
uint256 constant IS_STEEP = 0x800;
/// @dev All light is grey.
uint256 constant IS_GREY = 0x1000;
/// @dev Depths differ by more than a factor of 2^12, and are interpolated by themselves.
uint256 constant IS_DEEP = 0x2000;
/// @dev Attribute words of the three vertices, and the bias of their lanes.
uint256 constant ATTRIBUTE_0 = 0x1b60;
uint256 constant ATTRIBUTE_1 = 0x1b80;
uint256 constant ATTRIBUTE_2 = 0x1ba0;
uint256 constant LANE_BIAS = 0x1bc0;
/// @dev The accumulator at column 0 of the first row, and its change per pixel and per row.
uint256 constant START = 0x1be0;
uint256 constant DX = 0x1c00;
uint256 constant DY = 0x1c20;
/// @dev Colour at the first vertex, and its differences to the others.
uint256 constant COLOR_0 = 0x1c40;
uint256 constant COLOR_1 = 0x1c60;
uint256 constant COLOR_2 = 0x1c80;
/// @dev Depths at the second and third vertex.
uint256 constant DEPTH_1 = 0x1ca0;
uint256 constant DEPTH_2 = 0x1cc0;
/// @dev Pixels from one exact colour to the next.
uint256 constant BLOCK = 0x1ce0;
/// @dev Normal (twice the area long, in units of the mesh) and first corner (Q32) of a flat face.
uint256 constant FACE_NORMAL_X = 0x1d00;
uint256 constant FACE_NORMAL_Y = 0x1d20;
uint256 constant FACE_NORMAL_Z = 0x1d40;
uint256 constant FACE_CORNER_X = 0x1d60;
uint256 constant FACE_CORNER_Y = 0x1d80;
uint256 constant FACE_CORNER_Z = 0x1da0;
/// @dev Light that does not depend on the fragment, lanes of Q16, and of Q40.
uint256 constant FACE_LIGHT = 0x1dc0;
uint256 constant FACE_LIGHT_40 = 0x1de0;
/// @dev Unit normal times ray, Q48: FACE_FACING + FACE_FACING_SLOPE * depth >> 95.
uint256 constant FACE_FACING = 0x1e00;
uint256 constant FACE_FACING_SLOPE = 0x1e20;
/// @dev Vectors of a smooth triangle: at the first vertex (Q36), and the differences to the others (Q20); see FragmentShader.setVaryings.
/// Normals, and normals with their lanes the other way round;
uint256 constant NORMALS_0 = 0x1e40;
uint256 constant NORMALS_1 = 0x1e60;
uint256 constant NORMALS_2 = 0x1e80;
uint256 constant REVERSED_0 = 0x1ea0;
uint256 constant REVERSED_1 = 0x1ec0;
uint256 constant REVERSED_2 = 0x1ee0;
/// @dev directions to the light, the other way round;
uint256 constant TO_LIGHT_0 = 0x1f00;
uint256 constant TO_LIGHT_1 = 0x1f20;
uint256 constant TO_LIGHT_2 = 0x1f40;
/// @dev half vectors, and those the other way round.
uint256 constant HALF_0 = 0x1f60;
uint256 constant HALF_1 = 0x1f80;
uint256 constant HALF_2 = 0x1fa0;
uint256 constant HALF_REVERSED_0 = 0x1fc0;
uint256 constant HALF_REVERSED_1 = 0x1fe0;
uint256 constant HALF_REVERSED_2 = 0x2000;

// ---------------------------------------------------------------------------------------------------------------- fragment

/// @dev The place of the fragment beside the line of sight of an orthographic camera, Q16.
uint256 constant FRAGMENT_PLACE_X = 0x2020;
uint256 constant FRAGMENT_PLACE_Y = 0x2040;
/// @dev Its normal, Q24, the square and the length of that, and its product with the ray.
uint256 constant FRAGMENT_NORMAL_X = 0x2060;
uint256 constant FRAGMENT_NORMAL_Y = 0x2080;
uint256 constant FRAGMENT_NORMAL_Z = 0x20a0;
uint256 constant FRAGMENT_SQUARE = 0x20c0;
uint256 constant FRAGMENT_NORMAL_LENGTH = 0x20e0;
uint256 constant FRAGMENT_NORMAL_RAY = 0x2100;
/// @dev Half the magnitude of the last square of a normal.
uint256 constant NORMAL_HINT = 0x2120;
/// @dev The light that modulates its colour, lanes of Q40.
uint256 constant FRAGMENT_LIGHT = 0x2140;
/// @dev The first column of the block in which the tile begins.
uint256 constant BLOCK_BEGIN = 0x2160;
