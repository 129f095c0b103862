"""Decide how finely a triangle has to be shaded."""

from __future__ import annotations

from . import layout, lighting, opacities, patches, texture
from .fragment_light import WEIGHTED_BIAS
from .fragment_shader import vertex_highlights
from .mesh import Mesh
from .primitive_assembly import Triangle
from .registers import IS_IN_PASSES, Normals, Registers
from .smooth_light import STEEP_LIGHT, UNBOUNDED_LIGHT, set_light
from .surface_light import set_albedo
from .vertex_shader import Vertex
from .words import divide

#: Keeps colours (Q42) from being rounded below zero: 1/32 of a level.
SMOOTH_BIAS = (1 << 200) + (layout.ONES << 37)
#: A bit above the numbers of each lane; and the limit of a pair: 4 times 3 levels, Q30.
GUARDS = 0x00400000000000004000000000000040000000000000
LIMITS = 0x00000003000000000000030000000000000300000000
#: Lifts every colour of which a fragment may come out above 255 into those bits: half a level, by which fragments are
#: rounded, and eight steps of Q10 more, since interpolation is off by one at most.
NEARLY_ABOVE = 0x208 * layout.ONES
#: A reach that is beyond every triangle.
NO_LIMIT = 1 << 60
#: Twice the area, in sub-pixels, of 10 pixels.
SMALL = 20 << 16


def prepare(triangle: Triangle, mesh: Mesh, registers: Registers) -> None:
    """Choose the way to shade a triangle, and set what it needs."""
    if registers.has_effects or registers.object_mode & (layout.IS_SPOT_LIT | IS_IN_PASSES):
        prepare_exact(triangle, mesh, registers)
    elif registers.object_mode & layout.IS_SMOOTH:
        prepare_smooth(triangle, mesh, registers)
    else:
        prepare_flat(triangle, mesh, registers)


def prepare_flat(triangle: Triangle, mesh: Mesh, registers: Registers) -> None:
    """Prepare a flat or unlit triangle."""
    r = registers
    a, b, c = triangle.a, triangle.b, triangle.c
    mode, attributes = set_face(triangle, mesh, r)
    if (
        mode & layout.IS_DIFFUSE == 0
        and is_affine(attributes, triangle)
        and (mode & layout.IS_LIT == 0 or square_size(a, b, c) < r.reach)
    ):
        if mode & layout.IS_LIT:
            attributes = [
                vertex_highlights(word, vertex, r) for word, vertex in zip(attributes, (a, b, c), strict=True)
            ]
        # colours above 255 need a loop that clamps them
        saturates = any((word + NEARLY_ABOVE) & layout.OVERFLOW for word in attributes)
        set_linear(attributes, saturates | crossing_of(triangle), r)
        return
    set_exact(triangle, attributes, mode | crossing_of(triangle), r)
    r.patch_weight = 0
    r.patch_size = patch_size(triangle, attributes, r)
    if r.patch_size == 0:
        patches.fit_whole(a, b, c, max(triangle.top, r.band_top), r)


def prepare_smooth(triangle: Triangle, mesh: Mesh, registers: Registers) -> None:
    """Prepare a smooth triangle."""
    r = registers
    a, b, c = triangle.a, triangle.b, triangle.c
    mode = r.object_mode
    light = set_light(triangle, square_size(a, b, c), r) if mode & layout.IS_QUADRATIC else UNBOUNDED_LIGHT
    if light == UNBOUNDED_LIGHT:
        prepare_exact(triangle, mesh, r)
        return
    attributes = [vertex.attributes for vertex in (a, b, c)]
    if light == STEEP_LIGHT and not is_affine(attributes, triangle):
        mode |= layout.IS_STEEP
        nearest = max(attributes) >> 168
        r.nearest = nearest << 24
        attributes = [weighted(word, nearest) for word in attributes]
    r.mode = mode | crossing_of(triangle)
    r.lane_bias = SMOOTH_BIAS
    r.attribute_0, r.attribute_1, r.attribute_2 = attributes


def prepare_exact(triangle: Triangle, mesh: Mesh, registers: Registers) -> None:
    """Prepare to light every fragment, unless only the colour changes, and that linearly."""
    r = registers
    if r.has_effects:
        prepare_effects(triangle, mesh, r)
        return
    mode, attributes = set_face(triangle, mesh, r)
    mode &= ~layout.IS_QUADRATIC
    if mode & layout.IS_SMOOTH:
        set_normals(triangle.a, triangle.b, triangle.c, r)
    elif mode & (layout.IS_LIT | IS_IN_PASSES) == 0 and not r.antialiased and is_affine(attributes, triangle):
        set_linear(attributes, layout.IS_LINEAR | crossing_of(triangle), r)
        return
    set_exact(triangle, attributes, mode | crossing_of(triangle), r)


def prepare_effects(triangle: Triangle, mesh: Mesh, r: Registers) -> None:
    """Prepare a triangle of a scene with effects."""
    a, b, c = triangle.a, triangle.b, triangle.c
    mode = r.object_mode & ~layout.IS_QUADRATIC
    if mode & layout.IS_SMOOTH:
        set_normals(a, b, c, r)
    elif mode & layout.IS_FLAT:
        lighting.set_face(mesh, triangle.face, r)
        lighting.set_face_up(r)
        mode |= layout.IS_LIT | layout.IS_DIFFUSE
    set_exact(triangle, [vertex.attributes for vertex in (a, b, c)], mode | crossing_of(triangle), r)
    set_albedo(r)
    texture.set_triangle(triangle, mesh, r)
    opacities.set_triangle(triangle, mesh, r)


def set_normals(a: Vertex, b: Vertex, c: Vertex, r: Registers) -> None:
    """Set the normals of a smooth triangle."""
    r.normals = Normals(a.normal << 16, b.normal - a.normal, c.normal - a.normal)


def crossing_of(triangle: Triangle) -> int:
    """Return the bit of the mode for triangles that reach beyond the left or right border of the tile."""
    return layout.IS_CROSSING if triangle.outside else 0


def set_face(triangle: Triangle, mesh: Mesh, registers: Registers) -> tuple[int, list[int]]:
    """Set how the fragments of a triangle are lit, and the attribute words.

    Those of a flat face that is lit by highlights only have the rest of the light on them.
    """
    attributes = [vertex.attributes for vertex in (triangle.a, triangle.b, triangle.c)]
    if registers.object_mode & layout.IS_FLAT == 0:
        return registers.object_mode, attributes
    mode, light = lighting.set_face(mesh, triangle.face, registers)
    if mode & layout.IS_DIFFUSE == 0:
        attributes = [lit(word, light) for word in attributes]
    return mode, attributes


def set_linear(attributes: list[int], mode: int, registers: Registers) -> None:
    """Set the registers of a triangle whose colours change linearly."""
    r = registers
    r.mode, r.lane_bias = mode, layout.COLOR_BIAS
    r.attribute_0, r.attribute_1, r.attribute_2 = attributes


def set_exact(triangle: Triangle, attributes: list[int], mode: int, registers: Registers) -> None:
    """Set the registers of a triangle of which every fragment is lit."""
    r = registers
    nearest, farthest = max(attributes) >> 168, min(attributes) >> 168
    mode |= layout.IS_PATCHED
    if nearest >= 64 * farthest:
        mode |= layout.IS_STEEP
    if nearest >= farthest << 12:
        mode |= layout.IS_DEEP
    r.mode, r.lane_bias, r.patch_size = mode, layout.WEIGHT_BIAS, 1
    color, color_b, color_c = (word & layout.LANES_24 for word in attributes)
    r.color_0 = (color << 24) + WEIGHTED_BIAS
    r.color_1, r.color_2 = color_b - color, color_c - color
    depth_a, depth_b, depth_c = (word >> 168 for word in attributes)
    r.depth_1, r.depth_2 = depth_b << 8, depth_c << 8
    r.attribute_0, r.attribute_1, r.attribute_2 = depth_a << 168, depth_b << 168 | 1 << 56, depth_c << 168 | 1


def weighted(word: int, nearest: int) -> int:
    """Return the attribute word with its colour multiplied by its depth, as a part (Q10) of the nearest."""
    return (word >> 168 << 168) | (
        (word & layout.LANES_24) * divide(word >> 168 << 10, nearest) >> 10 & layout.LANES_24
    )


def square_size(a: Vertex, b: Vertex, c: Vertex) -> int:
    """Return the sum of the squares of two edges, in sub-pixels."""
    return (b.x - a.x) ** 2 + (c.x - a.x) ** 2 + (b.y - a.y) ** 2 + (c.y - a.y) ** 2


def double_area(a: Vertex, b: Vertex, c: Vertex) -> int:
    """Return twice the area, in sub-pixels."""
    return (c.x - a.x) * (b.y - a.y) - (b.x - a.x) * (c.y - a.y)


def patch_size(triangle: Triangle, attributes: list[int], registers: Registers) -> int:
    """Return the side of the cells over which colours are quadratic functions: 0 for the whole triangle, 1 for exact
    colours.

    Where third derivatives are D at most, such a function is off by D * d^3 / 125 at most in a triangle of longest edge
    d with exact colours at vertices and middles of edges, and by D * d^3 / 96 in a square of side d with nine of them.

    Perspective: along an edge with depths that differ by k of their mean, the error is
    k^2/2 * (u - u^3) / (1 + ku) * dc for u from -1 to 1 and colours dc apart: 1.5 levels of 255 for k = 1/6. With
    greater k, colours times depths are quadratic, which without highlights are even linear, and eight pixels at a time
    are divided by depths (`patch_weight` is set). There k may be 1/5: 2.2 levels.

    Light: a highlight cos^n of strength m has a third derivative of at most 1.4 * n^1.5 * m by the angle of H, which
    turns by d / 2f over d pixels. Where linear functions are off by 1.5 levels, d^2 = REACH, it is
    0.03 / sqrt(m) * (d^2 / REACH)^1.5 levels: with d^2 = 16 * REACH it is 2 / sqrt(m), in squares of 11 * REACH as
    much; and for m below 1/4 it is far from that, since m is 64 levels then. Times the depth z, it has a third
    derivative of 3 * z' / z times its second one more: at most 4 levels, where depths in the triangle differ by a
    factor of 2.

    Cells reach beyond the triangle by up to their size. Over one, depths change by at most 7/8 of the farthest in the
    triangle, so that they are positive, and k is that of the cell.
    """
    r = registers
    a, b, c = triangle.a, triangle.b, triangle.c
    area = double_area(a, b, c)
    # where a few pixels are covered, these are the fewest colours
    if area < SMALL or r.mode & layout.IS_STEEP:
        return 1
    nearest, farthest = max(attributes) >> 168, min(attributes) >> 168
    reach = NO_LIMIT
    if r.mode & layout.IS_LIT:
        reach = lighting.point_reach(farthest, r) if r.mode & layout.IS_DIFFUSE else r.reach
    is_orthographic = r.mode & layout.IS_ORTHOGRAPHIC
    along, down = (0, 0) if is_orthographic else depth_slopes(a, b, c)
    change, mean = nearest - farthest, nearest + farthest
    longest = max((p.x - q.x) ** 2 + (p.y - q.y) ** 2 for p, q in ((a, b), (a, c), (b, c)))
    size = 0
    if longest >= 16 * reach or (reach != NO_LIMIT and nearest > 2 * farthest):
        size = 64
        while size * size << 16 >= 11 * reach or 2048 * (along + down) * size > 7 * farthest * area:
            size >>= 1
            if size == 4:
                return 1
        change, mean = 512 * (along + down) * size, 2 * farthest * area
    if not is_orthographic:
        bright = brightness(attributes[0] | attributes[1] | attributes[2], r)
        if 6 * change * bright > mean:
            # so that colours times depths, Q72, fit their lanes; and the change of the depth over eight pixels of a row
            if bright > 8 or 5120 * along > farthest * area:
                return 1
            r.patch_weight = nearest << 8
    return size


def depth_slopes(a: Vertex, b: Vertex, c: Vertex) -> tuple[int, int]:
    """Return the change of the depth along a row and along a column, times twice the area."""
    za, zb, zc = (vertex.attributes >> 168 for vertex in (a, b, c))
    along = (zc - za) * (b.y - a.y) - (zb - za) * (c.y - a.y)
    down = (zb - za) * (c.x - a.x) - (zc - za) * (b.x - a.x)
    return along ^ along >> 255, down ^ down >> 255


def brightness(colors: int, registers: Registers) -> int:
    """Return how many times 255 colours may be at most."""
    if registers.mode & layout.IS_DIFFUSE == 0:
        return 1 + ((colors >> 18 | colors >> 74 | colors >> 130) & 63)
    light = registers.ambient + sum(record.diffuse for record in registers.lights)
    return 1 + ((light >> 16 | light >> 72 | light >> 128) & 0xFFFF)


def lit(word: int, factor: int) -> int:
    """Return the attribute word with its colour multiplied by the light of the face, lanes of Q16."""
    color = word & layout.LANES_24
    blue = factor & 0xFFFFFFFF
    if factor == blue * layout.ONES:
        lanes = ((color * blue) >> 16) & layout.LANES_24
    else:
        lanes = (blue * (color & 0xFFFFFF)) >> 16
        lanes |= (((factor >> 56) & 0xFFFFFFFF) * ((color >> 56) & 0xFFFFFF)) >> 16 << 56
        lanes |= ((factor >> 112) * (color >> 112)) >> 16 << 112
    return lanes | (word ^ color)


def is_affine(attributes: list[int], triangle: Triangle) -> bool:
    """Return whether colours interpolated linearly on the screen are within four levels of the perspective-correct
    ones.

    Or within two in triangles that are large, on which the mean error of a picture depends. With weights w, depths z
    and colours c the two part by the sum of w_i w_j (z_i - z_j) (c_i - c_j) / z over the three pairs of vertices, where
    w_i w_j is 1/4 at most, and their sum 1/3: three levels, or one and a half, are allowed to each pair alone.
    """
    a, b, c = attributes
    least, most = min(attributes) >> 168, max(attributes) >> 168
    # colours of up to 255 may differ without limit where depths differ by at most 8 / 255, in small triangles 12 / 255
    bright = (a | b | c) & layout.OVERFLOW
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
    """Return whether a triangle is higher than 8 pixels, and its rows have more than 3 pixels on average.

    Shading others in blocks would be expensive, and change little.
    """
    a, b, c = triangle.a, triangle.b, triangle.c
    rows = triangle.bottom - triangle.top
    is_high = rows > 8 and max(b.word, c.word) > a.word + (8 << layout.SCREEN_PIXEL_ROW_AT)
    return is_high and double_area(a, b, c) > rows * (3 << 17)
