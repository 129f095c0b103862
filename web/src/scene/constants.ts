// Numbers by which scenes are prepared. Written by tools/scene_fields.py from contracts/scene_fields.toml.

/** The most lights of a scene. */
export const MAX_LIGHTS = 4;
/** The largest coordinate of an object: the coordinates of a camera that sees all objects are then finite, too. */
export const LARGEST = 1e305;
/** Limits of the contracts (contracts/src/scene/Checks.sol), in world units. */
export const MAX_COORDINATE = 2 ** 26;
export const MIN_HALF_HEIGHT = 2 ** -12;
export const STEP = 2 ** -32;
/** A mesh of 16 bits a coordinate must not be scaled by more; nor one of 24 bits by more than the next. */
export const MAX_SCALE_SHORT = 2 ** 12;
export const MAX_SCALE_WIDE = 2 ** 4;
/** The largest step of a mesh's grid, in pixels, before a finer grid is used. */
export const STEP_IN_PIXELS = 2 ** -5;
/** The sizes of scenes that are not scaled. A scene that was moved, with its eye at the origin, may reach farther. */
export const EXACT_SIZES = [2 ** -2, 2 ** 22] as const;
/** The exponents to which others are scaled: of their largest object, and of the farthest point at most. */
export const SIZE_EXPONENT = 12;
export const REACH_EXPONENT = 25;
/** The default near plane as a share of the farthest distance. */
export const NEAR_PART = 2 ** -10;
/** Directions of these lengths keep their precision in multiples of 2^-32. */
export const DIRECTION_LENGTHS = [2 ** -8, 2 ** 20] as const;
/**
 * The largest angle between faces, in degrees, at which the edge between them is smooth, and that up to which a crease
 * that ends within a surface is smooth. In solids of flat faces, chamfers and octagons, 45 degrees, stay hard; coarse
 * round shapes, such as a cylinder of 9 sides, do not.
 */
export const SOLID = [40, 60] as const;
/** In other shapes, such as figures and scans. */
export const FIGURE = [75, 75] as const;
/** In parts of few faces that are all corners, such as hulls, unless they belong to a figure. */
export const FACETS = [1, 1] as const;
/**
 * A part is a solid of flat faces if edges within these, of at most so many degrees, are this share of the length of
 * all its edges. It is 0.2 to 0.8 for constructed parts, at most 0.04 for figures.
 */
export const FLAT = 0.25;
export const FLAT_SHARE = 0.12;
/**
 * So is one with rounded coordinates, whose angles have a gap: edges above the second angle are so many times as long
 * as those between both, and at least this share of all.
 */
export const GAP = [35, 65] as const;
export const GAP_TIMES = 3;
export const GAP_SHARE = 0.05;
/**
 * Others of at most so many faces are all corners if they turn by more than these degrees at their edges on the
 * average: the first if unevenly, where the standard deviation of the angles is this part of the mean, else the second.
 */
export const FEW_FACES = 100;
export const COARSE = [15, 30] as const;
export const UNEVEN = 0.4;
/**
 * Faces of figures that are lower than this part of their longest edge, and less than half as large as the face on its
 * other side, are left by simplification: they have the direction of that face.
 */
export const NEEDLE = 0.1;
/** An edge of exactly the crease angle is smooth, however its cosine is rounded. */
export const ROUNDING = 1e-6;
/** Normals are rounded to so many digits, so that they are the same on all machines. */
export const DIGITS = 6;
/** The cosine of the angle, 1 degree, by which normals may differ from those of the faces in a mesh without curves. */
export const STRAIGHT = 0.99985;
/** An edge of more pairs of faces is a crease. */
export const MOST_PAIRS = 16;
/**
 * An object is divided into its closed parts and the others if there are so many faces of the former at least: what
 * culling saves, up to half of the gas, is then more than another object costs.
 */
export const SPLIT_FACES = 32;
/** Parts whose volume is a smaller share of that of the pyramids of their faces have no inside: doubled sheets. */
export const NO_VOLUME = 1e-6;
/** Hollows are looked for in so many parts, the largest ones. Elsewhere their walls are turned, which is not seen. */
export const MOST_OUTER = 1000;
