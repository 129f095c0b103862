"""Numbers by which scenes are prepared. Written by tools/scene_fields.py from contracts/scene_fields.toml."""

#: The most lights of a scene.
MAX_LIGHTS = 4
#: The largest coordinate of an object: the coordinates of a camera that sees all objects are then finite, too.
LARGEST = 1e305
#: Limits of the contracts (contracts/src/scene/Checks.sol), in world units.
MAX_COORDINATE = 2.0**26
MIN_HALF_HEIGHT = 2.0**-12
STEP = 2.0**-32
#: A mesh of 16 bits a coordinate must not be scaled by more; nor one of 24 bits by more than the next.
MAX_SCALE_SHORT = 2.0**12
MAX_SCALE_WIDE = 2.0**4
#: The largest step of a mesh's grid, in pixels, before a finer grid is used.
STEP_IN_PIXELS = 2.0**-5
#: The sizes of scenes that are not scaled. A scene that was moved, with its eye at the origin, may reach farther.
EXACT_SIZES = (2.0**-2, 2.0**22)
#: The exponents to which others are scaled: of their largest object, and of the farthest point at most.
SIZE_EXPONENT = 12
REACH_EXPONENT = 25
#: The default near plane as a share of the farthest distance.
NEAR_PART = 2.0**-10
#: Directions of these lengths keep their precision in multiples of 2^-32.
DIRECTION_LENGTHS = (2.0**-8, 2.0**20)
#: The largest angle between faces, in degrees, at which the edge between them is smooth, and that up to which a crease
#: that ends within a surface is smooth. In solids of flat faces, chamfers and octagons, 45 degrees, stay hard; coarse
#: round shapes, such as a cylinder of 9 sides, do not.
SOLID = (40, 60)
#: In other shapes, such as figures and scans.
FIGURE = (75, 75)
#: In parts of few faces that are all corners, such as hulls, unless they belong to a figure.
FACETS = (1, 1)
#: A part is a solid of flat faces if edges within these, of at most so many degrees, are this share of the length of
#: all its edges. It is 0.2 to 0.8 for constructed parts, at most 0.04 for figures.
FLAT = 0.25
FLAT_SHARE = 0.12
#: So is one with rounded coordinates, whose angles have a gap: edges above the second angle are so many times as long
#: as those between both, and at least this share of all.
GAP = (35, 65)
GAP_TIMES = 3
GAP_SHARE = 0.05
#: Others of at most so many faces are all corners if they turn by more than these degrees at their edges on the
#: average: the first if unevenly, where the standard deviation of the angles is this part of the mean, else the second.
FEW_FACES = 100
COARSE = (15, 30)
UNEVEN = 0.4
#: Faces of figures that are lower than this part of their longest edge, and less than half as large as the face on its
#: other side, are left by simplification: they have the direction of that face.
NEEDLE = 0.1
#: An edge of exactly the crease angle is smooth, however its cosine is rounded.
ROUNDING = 1e-6
#: Normals are rounded to so many digits, so that they are the same on all machines.
DIGITS = 6
#: The cosine of the angle, 1 degree, by which normals may differ from those of the faces in a mesh without curves.
STRAIGHT = 0.99985
#: An edge of more pairs of faces is a crease.
MOST_PAIRS = 16
#: An object is divided into its closed parts and the others if there are so many faces of the former at least: what
#: culling saves, up to half of the gas, is then more than another object costs.
SPLIT_FACES = 32
#: Parts whose volume is a smaller share of that of the pyramids of their faces have no inside: doubled sheets.
NO_VOLUME = 1e-6
#: Hollows are looked for in so many parts, the largest ones. Elsewhere their walls are turned, which is not seen.
MOST_OUTER = 1000
