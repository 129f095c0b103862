"""How finely a triangle has to be shaded."""

from __future__ import annotations

from . import lighting
from .fragment_shader import WEIGHTED_BIAS, product, set_varyings, vertex_highlights
from .mesh import Mesh
from .primitive_assembly import Triangle
from .registers import (
    IS_BARYCENTRIC,
    IS_BLOCKED,
    IS_CROSSING,
    IS_DEEP,
    IS_DIFFUSE,
    IS_FLAT,
    IS_LIT,
    IS_ORTHOGRAPHIC,
    IS_SMOOTH,
    IS_STEEP,
    IS_VARYING,
    Registers,
    Varying,
)
from .roots import sqrt
from .vertex_shader import Vertex
from .words import LANES_24, ONES, divide

#: Biases of the lanes: half a level for colours.
COLOR_BIAS = 0x100000000000200000000000002000000000000020000000000
WEIGHT_BIAS = 0x100000000000000000000000000000000400000000000004000
#: Keeps colours between interpolated vectors (Q26) from being rounded below zero: 1/32 of a level.
VARYING_BIAS = ONES << 21
#: A bit above the numbers of each lane; and the limit of a pair: 4 times 3 levels, Q30.
GUARDS = 0x00400000000000004000000000000040000000000000
LIMITS = 0x00000003000000000000030000000000000300000000
#: Bits of a lane that only a colour above 255 has.
ABOVE_255 = 0xFC000000000000FC000000000000FC0000
#: Lifts every colour of which a fragment may come out above 255 into those bits: half a level, by which fragments are
#: rounded, and eight steps of Q10 more, since interpolation is off by one at most.
NEARLY_ABOVE = 0x208 * ONES


def prepare(triangle: Triangle, mesh: Mesh, registers: Registers) -> None:
    """Chooses the way to shade a triangle, and sets what that way needs."""
    r = registers
    a, b, c = triangle.a, triangle.b, triangle.c
    attributes_a, attributes_b, attributes_c = a.attributes, b.attributes, c.attributes
    mode = r.object_mode
    crossing = IS_CROSSING if triangle.outside else 0
    if mode & IS_FLAT:
        mode = lighting.set_face(mesh, triangle.face, r)
        if mode & IS_DIFFUSE == 0 and r.face_light != ONES << 16:
            attributes_a = lit(attributes_a, r.face_light)
            attributes_b = lit(attributes_b, r.face_light)
            attributes_c = lit(attributes_c, r.face_light)
    if (
        mode & IS_DIFFUSE == 0
        and is_affine(attributes_a, attributes_b, attributes_c, triangle)
        and (mode & IS_LIT == 0 or square_size(a, b, c) < r.reach)
    ):
        r.lane_bias = COLOR_BIAS
        if mode & IS_LIT:
            attributes_a = vertex_highlights(attributes_a, a, r)
            attributes_b = vertex_highlights(attributes_b, b, r)
            attributes_c = vertex_highlights(attributes_c, c, r)
        # colours above 255 need a loop that keeps them there
        saturates = any((word + NEARLY_ABOVE) & ABOVE_255 for word in (attributes_a, attributes_b, attributes_c))
        r.mode = saturates | crossing
    else:
        barycentric(a, b, c, attributes_a, attributes_b, attributes_c, mode | crossing, r)
        attributes_a = attributes_a >> 168 << 168
        attributes_b = (attributes_b >> 168 << 168) | (1 << 56)
        attributes_c = (attributes_c >> 168 << 168) | 1
    r.attribute_0, r.attribute_1, r.attribute_2 = attributes_a, attributes_b, attributes_c


def square_size(a: Vertex, b: Vertex, c: Vertex) -> int:
    """The sum of the squares of two edges, in sub-pixels."""
    return (b.x - a.x) ** 2 + (c.x - a.x) ** 2 + (b.y - a.y) ** 2 + (c.y - a.y) ** 2


def double_area(a: Vertex, b: Vertex, c: Vertex) -> int:
    """Twice the area, in sub-pixels."""
    return (c.x - a.x) * (b.y - a.y) - (b.x - a.x) * (c.y - a.y)


def square_height(a: Vertex, b: Vertex, c: Vertex) -> int:
    """The square of about the least height of a triangle, in sub-pixels.

    The square of twice its area by that of a longest edge, for which the sum of the squares of two edges stands.
    """
    return divide(double_area(a, b, c) ** 2, square_size(a, b, c))


def barycentric(
    a: Vertex,
    b: Vertex,
    c: Vertex,
    attributes_a: int,
    attributes_b: int,
    attributes_c: int,
    mode: int,
    registers: Registers,
) -> None:
    """The registers of a triangle whose fragments are shaded from their barycentric coordinates."""
    r = registers
    color = attributes_a & LANES_24
    nearest = max(attributes_a, attributes_b, attributes_c) >> 168
    farthest = min(attributes_a, attributes_b, attributes_c) >> 168
    if mode & IS_SMOOTH:
        r.normals = spread(a.normal, b.normal, c.normal)
    # weights of 16 bits bear a division by depths that differ by a factor of two
    if mode & IS_SMOOTH and nearest < 2 * farthest and set_vectors(a, b, c, r):
        mode |= IS_VARYING
        # else the weights of linear interpolation are right to 1/128
        if 32 * (nearest - farthest) >= farthest and mode & IS_ORTHOGRAPHIC == 0:
            mode |= IS_STEEP
        r.color_0 = (color << 16) + VARYING_BIAS
    else:
        mode |= IS_BARYCENTRIC
        if nearest >= 64 * farthest:
            mode |= IS_STEEP
        if nearest >= farthest << 12:
            mode |= IS_DEEP
        r.color_0 = (color << 24) + WEIGHTED_BIAS
        if mode & IS_SMOOTH == 0:
            r.block = block_size(square_height(a, b, c), mode, nearest, farthest, r)
            if r.block > 1:
                mode |= IS_BLOCKED
    r.mode = mode
    r.lane_bias = WEIGHT_BIAS
    r.color_1 = (attributes_b & LANES_24) - color
    r.color_2 = (attributes_c & LANES_24) - color
    r.depth_1 = attributes_b >> 168 << 8
    r.depth_2 = attributes_c >> 168 << 8


def set_vectors(a: Vertex, b: Vertex, c: Vertex, registers: Registers) -> bool:
    """Prepares the vectors of a smooth triangle, of which the normals are there.

    Returns whether they turn so little that light and half vectors may be interpolated as well.
    """
    r = registers
    # with several lights most of the work would be done for each of them all the same
    if len(r.lights) != 1 or square_size(a, b, c) >= r.varying_reach:
        return False
    for vertex in (a, b, c):
        if not vertex.has_varyings:
            set_varyings(vertex, r)
    r.reversed = spread(a.reversed, b.reversed, c.reversed)
    r.half = spread(a.half, b.half, c.half)
    r.half_reversed = spread(a.half_reversed, b.half_reversed, c.half_reversed)
    # at most 60 degrees between normals: the square of a change is 1, Q40
    if changes(r.normals, r.reversed) > 1 << 40 or changes(r.half, r.half_reversed) > r.half_reach:
        return False
    r.to_light = spread(a.to_light, b.to_light, c.to_light)
    return True


def changes(vectors: Varying, reversed_vectors: Varying) -> int:
    """At least the larger of the squares of the changes of a vector to the second and to the third vertex, Q40."""
    return product(vectors.to_1, reversed_vectors.to_1) | product(vectors.to_2, reversed_vectors.to_2)


def spread(a: int, b: int, c: int) -> Varying:
    """A value of the three vertices as the value at the first, Q36, and the differences to the others, Q20."""
    return Varying(a << 16, b - a, c - a)


def block_size(square: int, mode: int, nearest: int, farthest: int, registers: Registers) -> int:
    """Pixels over which interpolation between exact colours does little harm.

    Over n pixels of a triangle of height h perspective bends them by dc * dz / 4z * (n / h)^2, times the factor by
    which colours change faster where it is far: by 6 levels of 255, or 4.5 without light, where black and white, the
    least height and the farthest end come together. `reach` is the square of the n for one and a half levels of light.
    """
    bend = (10 if mode & IS_LIT else 14) * (nearest - farthest) + 1
    reach = square * farthest // bend * farthest // (nearest + 1)
    if mode & IS_LIT:
        reach = min(reach, 2 * (lighting.point_reach(farthest, registers) if mode & IS_DIFFUSE else registers.reach))
    return min(max(sqrt(reach) >> 8, 1), 16)


def lit(word: int, factor: int) -> int:
    """The attribute word with the light of the face, lanes of Q16, on its colour."""
    color = word & LANES_24
    blue = factor & 0xFFFFFFFF
    if factor == blue * ONES:
        lanes = ((color * blue) >> 16) & LANES_24
    else:
        lanes = (blue * (color & 0xFFFFFF)) >> 16
        lanes |= (((factor >> 56) & 0xFFFFFFFF) * ((color >> 56) & 0xFFFFFF)) >> 16 << 56
        lanes |= ((factor >> 112) * (color >> 112)) >> 16 << 112
    return lanes | (word ^ color)


def is_affine(a: int, b: int, c: int, triangle: Triangle) -> bool:
    """Whether colours interpolated linearly on the screen are within four levels of the perspective-correct ones.

    Or within two in triangles that are large, on which the mean error of a picture depends. With weights w, depths z
    and colours c the two part by the sum of w_i w_j (z_i - z_j) (c_i - c_j) / z over the three pairs of vertices, where
    w_i w_j is 1/4 at most, and their sum 1/3: three levels, or one and a half, are allowed to each pair alone.
    """
    least, most = min(a, b, c) >> 168, max(a, b, c) >> 168
    # colours of up to 255 may differ as they like where depths do not by more than 8 / 255, in small triangles 12 / 255
    bright = (a | b | c) & ABOVE_255
    if 33 * (most - least) <= least and not bright:
        return True
    large = is_large(triangle)
    if not large and 22 * (most - least) <= least and not bright:
        return True
    limits = LIMITS >> large | GUARDS
    inverse = divide(1 << 84, least)
    guards = GUARDS
    for change in (b - a, c - a, c - b):
        dz = change >> 168
        # |z_i - z_j| / z, Q20
        ratio = (dz if dz >= 0 else ~dz) * inverse >> 64
        # more would not fit the lanes where colours are up to 20 times 255
        if ratio >= 1 << 32:
            return False
        # its product with the difference of the colours (Q10): above the limit, it clears a bit
        guards &= (limits + change * ratio) & (limits - change * ratio)
    return guards == GUARDS


def is_large(triangle: Triangle) -> bool:
    """Whether a triangle has more than 8 rows, of more than 3 pixels in the mean.

    To shade others in blocks would be dear, and change little.
    """
    rows = triangle.bottom - triangle.top
    return rows > 8 and double_area(triangle.a, triangle.b, triangle.c) > rows * (3 << 17)
