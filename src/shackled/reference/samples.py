"""Draw triangles and lines with four samples for each pixel.

A fragment is a pixel of which a triangle covers a sample. Its colour is computed once, or once in shadow and once
outside it: linear and quadratic colours for the centre of the pixel, others for the middle of the samples that are
covered.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import ground, layout, opacities, patches, shading
from .extensions import OPAQUE
from .fragment_light import color_at
from .fragment_shader import pack as pack_lanes
from .fragment_shader import shade_quadratic
from .mesh import Mesh
from .primitive_assembly import Triangle
from .quadratic import Differences
from .rasterizer import set_back
from .registers import IS_IN_PASSES, Registers
from .roots import sqrt
from .shadow_table import LIT
from .surface_light import parts, surface_color
from .vertex_shader import Vertex
from .words import MASK, divide, divide_signed, signed

#: Where the samples are from the centre of the pixel, in eighths of it.
OFFSETS = ((-1, -3), (3, -1), (-3, 1), (1, 3))
#: The bits of a sample that are its depth, and the two of objects that are not opaque: found, drawn.
DEPTH, FOUND, DRAWN = 0x7FFFFFFFF8000000, 1 << 24, 1 << 25
#: The lowest bit of each lane.
ONES = sum(1 << 64 * i for i in range(4))
#: By what depths may leave the range of those of the vertices.
SLACK = 1 << 20
#: A barycentric coordinate that changes by more than 16 from pixel to pixel, Q29.
STEEP = 16 << 29

Color = tuple[int, int, int]


class Gradients(NamedTuple):
    """The accumulator at column 0 of a row, and its changes.

    dx_8, dy_8: an eighth of the changes per pixel, without those of a deep triangle: deep_dx, deep_dy, Q32.
    """

    start: int
    row: int
    dx_8: int
    dy_8: int
    deep_dx: int
    deep_dy: int

    @property
    def dx(self) -> int:
        """Change per column."""
        return 8 * self.dx_8 + (self.deep_dx << layout.ATTRIBUTE_DEPTH_AT)

    @property
    def dy(self) -> int:
        """Change per row."""
        return 8 * self.dy_8 + (self.deep_dy << layout.ATTRIBUTE_DEPTH_AT)

    def at(self, column: int, row: int) -> int:
        """Return the accumulator at the centre of a pixel."""
        return (self.start + (row - self.row) * self.dy + column * self.dx) & MASK

    def moved(self, word: int, x: int, y: int) -> int:
        """Return the accumulator so many eighths of a pixel away."""
        deep = (x * self.deep_dx + y * self.deep_dy) >> 3
        return (word + x * self.dx_8 + y * self.dy_8 + (deep << layout.ATTRIBUTE_DEPTH_AT)) & MASK

    def depths(self, word: int, r: Registers) -> list[int]:
        """Return the depths of the samples of a pixel with this accumulator at its centre."""
        # an eighth of the changes of the depth, before they overflow, added in lanes that carry into each other
        dx, dy = (signed(eighth & MASK) >> 192 for eighth in (self.dx_8, self.dy_8))
        dx, dy = dx + _lane(self.deep_dx >> 27), dy + _lane(self.deep_dy >> 27)
        z = (word >> 192) - r.sample_base
        lanes = sum((z + x * dx + y * dy) << (64 * i + r.sample_shift) for i, (x, y) in enumerate(OFFSETS)) & MASK
        lanes = (lanes - r.set_back * ONES) & MASK
        return [(lanes >> 64 * i) & DEPTH for i in range(4)]


def _lane(value: int) -> int:
    """Return an integer modulo 2^64, signed."""
    return (value + (1 << 63)) % (1 << 64) - (1 << 63)


def run(triangles: list[Triangle], mesh: Mesh, wireframe: bool, r: Registers) -> None:
    """Draw the triangles of a list, or their edges."""
    for triangle in triangles:
        if max(triangle.top, r.band_top) >= min(triangle.bottom, r.band_bottom):
            continue
        if wireframe:
            shading.prepare_exact(triangle, mesh, r)
            set_shadow(triangle, r)
            for corners, attributes in rectangles(triangle, r):
                draw(*corners, attributes, False, r)
        else:
            shading.prepare(triangle, mesh, r)
            # the brightest saturate anyway
            r.mode &= ~layout.IS_LINEAR
            set_shadow(triangle, r)
            attributes = (r.attribute_0, r.attribute_1, r.attribute_2)
            draw(triangle.a, triangle.b, triangle.c, attributes, triangle.turned_away, r)


def set_shadow(triangle: Triangle, r: Registers) -> None:
    """Set what shades a triangle that is prepared."""
    r.shadow = r.shadow_faces[triangle.face] if r.shadow_faces and r.mode & layout.IS_LIT else LIT


def set_depths(distances: list[int], r: Registers) -> None:
    """Set how depths are told, from the distances of all vertices, Q32.

    The nearest needs the highest bit or the one below; depths of an orthographic camera begin at the farthest.
    """
    nearest = max(min(distances, default=r.near), r.near)
    base = 0
    if r.frame_is_orthographic:
        farthest = max(max(distances, default=nearest), nearest)
        # a sixteenth more, by part of which back faces may be moved
        most = ((farthest >> 8) - (nearest >> 8)) * 17 << 4
        base = ((r.depth_scale - (nearest >> 8)) << 8) - most - SLACK
    else:
        most = divide(r.depth_scale, nearest) << 8
    r.sample_shift = max(0, 62 - (most + 2 * SLACK).bit_length())
    # what is seen has the lowest bit, however far away it is
    r.sample_base = base - (1 << 28 >> r.sample_shift)


def resolve(r: Registers) -> None:
    """Set the pixels to the means of their samples."""
    sums = r.sample_colors.astype(np.int64).sum(axis=2)
    r.image = ((sums + 2) >> 2).astype(np.uint8)


# ---- coverage ----


def edge_column(u: Vertex, v: Vertex, y: int, x: int) -> int:
    """Return the first pixel whose sample is not left of an edge.

    y: the height of the sample. x: its place in the pixel. All in sub-pixels.
    """
    dx, dy = v.x - u.x, v.y - u.y
    return -((-(u.x - x) * dy - (y - u.y) * dx) // (256 * dy))


def spans(a: Vertex, b: Vertex, c: Vertex, row: int) -> Iterator[tuple[int, int]]:
    """Yield the pixels of a row whose samples a triangle covers, for each sample: the first, the one after the last."""
    for x, y in OFFSETS:
        height = 256 * row + 32 * y
        if not a.y <= height < max(b.y, c.y):
            yield 0, 0
            continue
        left = (a, b) if height < b.y else (b, c)
        right = (a, c) if height < c.y else (c, b)
        yield edge_column(*left, height, 32 * x), edge_column(*right, height, 32 * x)


def covered(a: Vertex, b: Vertex, c: Vertex, r: Registers) -> Iterator[tuple[int, int, list[int]]]:
    """Yield the fragments of a triangle: column, row, and the samples that it covers."""
    top, bottom = max((a.y + 159) >> 8, r.band_top), min((max(b.y, c.y) + 351) >> 8, r.band_bottom)
    for row in range(top, bottom):
        bounds = list(spans(a, b, c, row))
        used = [(first, end) for first, end in bounds if first < end]
        if not used:
            continue
        begin, last = min(first for first, _ in used), max(end for _, end in used)
        for column in range(max(begin, r.column_begin), min(last, r.column_end)):
            samples = [i for i, (first, end) in enumerate(bounds) if first <= column < end]
            if samples:
                yield column, row, samples


def centroid(samples: list[int]) -> tuple[int, int]:
    """Return the middle of samples, in eighths of a pixel."""
    x, y = (round(sum(OFFSETS[i][axis] for i in samples) / len(samples)) for axis in range(2))
    return x, y


# ---- fragments ----


def gradients(a: Vertex, b: Vertex, c: Vertex, attributes: tuple[int, int, int], r: Registers) -> Gradients:
    """Return what changes linearly over a triangle."""
    row = (a.y + 255) >> 8
    x, y = a.x, (row << 8) - a.y
    xb, yb, xc, yc = b.x - x, b.y - a.y, c.x - x, c.y - a.y
    area = xc * yb - xb * yc
    first, to_b, to_c = attributes[0], attributes[1] - attributes[0], attributes[2] - attributes[0]
    bits = layout.FINE_BITS if r.has_effects else 0
    start = deep_dx = deep_dy = 0
    if r.mode & layout.IS_DEEP:
        # depths in a separate word: see rasterizer.set_up
        z, zb, zc = first >> 168, (attributes[1] >> 168) - (first >> 168), (attributes[2] >> 168) - (first >> 168)
        deep_dx = divide_signed((zc * yb - zb * yc) << 40, area)
        deep_dy = divide_signed((zb * xc - zc * xb) << 40, area)
        start = ((z << 32) + ((y * deep_dy - x * deep_dx) >> 8)) << layout.ATTRIBUTE_DEPTH_AT
        first, to_b, to_c = 0, layout.ATTRIBUTE_S, 1
    first, to_b, to_c = (_fine(word, bits) for word in (first, to_b, to_c))
    xb, xc, yb, yc = (divide_signed(value << layout.GRADIENT_SHIFT + bits, area) for value in (xb, xc, yb, yc))
    if r.mode & (layout.IS_PATCHED | layout.IS_QUADRATIC) == 0 and not all(
        -STEEP <= value < STEEP for value in (xb, xc, yb, yc)
    ):
        # colours would leave their lanes outside so thin a triangle
        depths = [word >> 168 for word in attributes]
        to_b, to_c = (depths[1] - depths[0]) << 168, (depths[2] - depths[0]) << 168
    start += (first << 32 + bits) + r.lane_bias
    start += to_b * ((y * xc + x * yc) >> 5) - to_c * ((x * yb + y * xb) >> 5)
    return Gradients(start, row, to_c * yb - to_b * yc, to_b * xc - to_c * xb, deep_dx, deep_dy)


def _fine(word: int, bits: int) -> int:
    """Return an attribute word whose depth is so many bits lower: those that barycentric coordinates gain."""
    low = word & ((1 << 168) - 1)
    low -= low >> 167 << 168
    return (word - low >> bits) + low


def draw(a: Vertex, b: Vertex, c: Vertex, attributes: tuple[int, int, int], turned_away: bool, r: Registers) -> None:
    """Draw a triangle that is prepared. attributes: the attribute words at its vertices."""
    g = gradients(a, b, c, attributes, r)
    r.dx, r.dy = g.dx, g.dy
    r.set_back = 0
    if turned_away:
        dx, dy = signed(g.dx) >> 6, signed(g.dy) >> 6
        r.set_back = (set_back(attributes, dx, dy, r.sample_base, r) << r.sample_shift) + (1 << 27)
    farthest = min(word >> 168 for word in attributes) << 8
    cells: dict[tuple[int, int], Differences] = {}
    for column, row, samples in covered(a, b, c, r):
        word = g.at(column, row)
        place = row - r.band_top, column - r.column_begin
        depths = g.depths(word, r)
        old = r.sample_depths[place]
        if r.mode & IS_IN_PASSES:
            blend(word, depths, samples, place, g, r)
            continue
        seen = [i for i in samples if depths[i] > int(old[i])]
        if not seen:
            continue
        for part in parts(seen, column - layout.PIXEL_BIAS, row - layout.PIXEL_BIAS, r):
            if r.mode & layout.IS_QUADRATIC:
                color = smooth(word, samples, column, row, g, r)
            elif r.mode & layout.IS_PATCHED == 0:
                color = linear(word)
            elif r.patch_size == 1:
                color = exact(word, samples, place, g, r)
            else:
                if r.patch_size:
                    cell = column // r.patch_size, row // r.patch_size
                    if cell not in cells:
                        top = cell[1] * r.patch_size
                        patches.fit(cell[0] * r.patch_size, top, g.at(0, top), r.patch_size, r)
                        cells[cell] = r.patch
                    r.patch, r.patch_row = cells[cell], cell[1] * r.patch_size
                color = quadratic(word, column, row, farthest, r)
            for i in part:
                r.sample_depths[place][i] = depths[i]
                r.sample_colors[place][i] = over(color, r.sample_colors[place][i], r) if r.fade_range else color
            if r.fade_range:
                r.opacity = OPAQUE


def linear(word: int) -> Color:
    """Return the colour in an accumulator, which may be below 0 or above 255."""
    lanes = ((word >> (56 * i + 42)) & 0x3FFF for i in range(3))
    blue, green, red = (patches.clamp(value, 14) for value in lanes)
    return blue, green, red


def quadratic(word: int, column: int, row: int, farthest: int, r: Registers) -> Color:
    """Return the colour of a quadratic function."""
    f = r.patch.at(column, row - r.patch_row)
    if r.patch_weight:
        # the depth may be anything beside the triangle
        depth = word >> 192
        depth -= depth >> 63 << 64
        f = patches.unweighted(f, max(depth, farthest), r)
    return patches.pack(f & MASK)


def exact(word: int, samples: list[int], place: tuple[int, int], g: Gradients, r: Registers) -> Color:
    """Return the colour in the middle of the samples that are covered."""
    x, y = centroid(samples)
    word = g.moved(word, x, y)
    # Q44 in scenes with effects, otherwise Q24
    end, drop = (152, 0) if r.has_effects else (168, 8)
    low, lowest = word & ((1 << end) - 1), word & ((1 << 56) - 1)
    s, t = (low - (low >> end - 1 << end)) >> 56 + drop, (lowest - (lowest >> 55 << 56)) >> drop
    row, column = place[0] + r.band_top, place[1] + r.column_begin
    x = r.ray_left + column * r.ray_step + (x * r.ray_step >> 3)
    y = r.ray_top + row * r.ray_step + (y * r.ray_step >> 3)
    if r.fade_range:
        r.opacity = ground.opacity_at(word >> 192, x, y, r)
    if r.opacities is not None:
        r.opacity = opacities.opacity_at(word >> 192, s, t, r)
    color = (surface_color if r.has_effects else color_at)(word >> 192, s, t, x, y, r)
    return patches.pack(((color << 48) + patches.HALF_85) & MASK)


def smooth(word: int, samples: list[int], column: int, row: int, g: Gradients, r: Registers) -> Color:
    """Return the colour of a smooth surface in the light of one lamp, in the middle of the samples that are covered."""
    q = r.quadratic
    light = 128 * q.at(column, row)
    if len(samples) < 4:
        x, y = centroid(samples)
        word = g.moved(word, x, y)
        dx, dy = q.dx + row * q.dxy + column * q.dxx, q.dy + row * q.dyy + column * q.dxy
        light += 16 * (x * dx + y * dy) + x * (x - 8) * q.dxx + 2 * x * y * q.dxy + y * (y - 8) * q.dyy
    return pack_lanes(shade_quadratic(word, light, r, 7) + layout.HALF_LEVEL)


def blend(word: int, depths: list[int], samples: list[int], place: tuple[int, int], g: Gradients, r: Registers) -> None:
    """Make either pass of an object that is not opaque: see `blended_spans`."""
    old = r.sample_depths[place]
    if r.mode & layout.IS_BLENDED == 0:
        for i in samples:
            if depths[i] > int(old[i]) & DEPTH:
                old[i] = depths[i] | FOUND
        return
    seen = [i for i in samples if int(old[i]) == depths[i] | FOUND]
    if not seen:
        return
    column, row = place[1] + r.column_begin, place[0] + r.band_top
    for part in parts(seen, column - layout.PIXEL_BIAS, row - layout.PIXEL_BIAS, r):
        color = exact(word, samples, place, g, r)
        for i in part:
            old[i] = depths[i] | DRAWN
            r.sample_colors[place][i] = over(color, r.sample_colors[place][i], r)


def over(color: Color, behind: NDArray[np.uint8], r: Registers) -> Color:
    """Return a colour over what is behind it."""
    blue, green, red = (
        (value * r.opacity + int(byte) * ((1 << 24) - r.opacity) + (1 << 23)) >> 24
        for value, byte in zip(color, behind, strict=True)
    )
    return blue, green, red


# ---- lines ----

#: Corners of a triangle, the topmost first, counter-clockwise, and their attribute words.
LineHalf = tuple[tuple[Vertex, Vertex, Vertex], tuple[int, int, int]]


def rectangles(triangle: Triangle, r: Registers) -> Iterator[LineHalf]:
    """Yield the edges of a triangle that is prepared: rectangles, a pixel wide, as two triangles each."""
    words = r.attribute_0, r.attribute_1, r.attribute_2
    # the depths of lines are in their accumulators
    r.mode &= ~layout.IS_DEEP
    ends = (triangle.a, triangle.b, triangle.c)
    for edge in range(3):
        if triangle.edges >> edge & 1:
            following = (edge + 1) % 3
            yield from rectangle(ends[edge], ends[following], words[edge], words[following])


def rectangle(p: Vertex, q: Vertex, word_p: int, word_q: int) -> Iterator[LineHalf]:
    """Yield the two triangles of a line."""
    if q.word < p.word:
        p, q, word_p, word_q = q, p, word_q, word_p
    dx, dy = q.x - p.x, q.y - p.y
    length = sqrt(dx * dx + dy * dy)
    if length == 0:
        return
    # half a pixel to the right of the line
    x, y = divide_signed(dy * 128, length), divide_signed(-dx * 128, length)
    a, b = corner(p.x + x, p.y + y), corner(p.x - x, p.y - y)
    c, d = corner(q.x - x, q.y - y), corner(q.x + x, q.y + y)
    yield from ordered((a, b, c), (word_p, word_p, word_q))
    yield from ordered((a, c, d), (word_p, word_q, word_q))


def corner(x: int, y: int) -> Vertex:
    """Return a corner of a line, within the guard band."""
    x, y = (min(max(value, 0), (1 << layout.GUARD_BITS) - 1) for value in (x, y))
    return Vertex(y << 128 | x << 64, x, y, False, False, 0, 0)


def ordered(corners: tuple[Vertex, Vertex, Vertex], words: tuple[int, int, int]) -> Iterator[LineHalf]:
    """Yield a triangle with the topmost vertex first, counter-clockwise."""
    (a, b, c), (word_a, word_b, word_c) = corners, words
    area = (c.x - a.x) * (b.y - a.y) - (b.x - a.x) * (c.y - a.y)
    if area == 0:
        return
    if area < 0:
        b, c, word_b, word_c = c, b, word_c, word_b
    while a.word > b.word or a.word > c.word:
        a, b, c, word_a, word_b, word_c = b, c, a, word_b, word_c, word_a
    yield (a, b, c), (word_a, word_b, word_c)
