"""From fragments to pixels: depth test, perspective-correct attributes, Blinn-Phong.

The colour of a fragment depends on its triangle and its place only. Fragments of one triangle never overlap, so that
all of them are tested against the depths of the picture at once; those that need light are then shaded one by one.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from .registers import (
    IS_BARYCENTRIC,
    IS_BLOCKED,
    IS_CROSSING,
    IS_DIFFUSE,
    IS_GREY,
    IS_LIT,
    IS_ORTHOGRAPHIC,
    IS_SMOOTH,
    IS_STEEP,
    IS_VARYING,
    Registers,
)
from .roots import sqrt
from .vertex_shader import Vertex
from .words import LANES_24, LANES_32, MASK, ONES, divide, divide_signed, signed

HALF_LEVEL = 0x200 * ONES
LINE_BIAS = 0x000002000000000002000000000000020000000000

#: Keeps colours (Q34) positive, whatever the weights are, by a bit that is looked at and taken away. It stands above
#: the brightest that a flat face may have before its highlights, 20 * 255 levels, at three corners.
WEIGHTED_BIAS = ((1 << 48) + (1 << 18)) * ONES

#: Half the range of a lane of 85 bits, for vectors of Q20 and their sums of Q36.
VECTOR_BIAS = 0x100000000000000000000080000000000000000000040000000
NORMAL_BIAS = 0x10000000000000000000008000000000000000000004000000000

LANE_85 = (1 << 85) - 1

#: A piece of a row: row, first column, column after the last, accumulator at the first column, change per pixel.
Span = tuple[int, int, int, int, int]


# ---- vectors ----


def product(a: int, b: int) -> int:
    """The scalar product of two vectors in lanes, one of them the other way round."""
    return signed((a * b) << 1) >> 171


# ---- light ----


def ray_length(x: int, y: int, r: Registers) -> int:
    """Length of the ray (x, y, 1), Q24."""
    square = x * x + y * y + (1 << 48)
    length = r.length_at_0 + (square * r.length_slope >> 48)
    for _ in range(r.length_steps + 1):
        length = (length + square // length) >> 1
    return length


def gloss(square: int, r: Registers) -> int:
    """The highlight, Q16, from the square of its cosine, Q24."""
    if r.specular_root:
        return (r.specular_root * sqrt(min(square, 1 << 24) << 24)) >> 24
    if square <= r.specular_begin:
        return 0
    square = min(((square - r.specular_begin) * r.specular_scale) & MASK, 1 << 46)
    entry = r.specular_table[square >> 40]
    return (entry >> 128) + ((entry & 0xFFFFFFFF) * ((square >> 24) & 0xFFFF) >> 16)


def highlights(depth: int, x: int, y: int, r: Registers) -> int:
    """The highlights of directional lights on a flat face, lanes of Q10."""
    length = ray_length(x, y, r)
    normal_ray = r.face_facing + (signed(r.face_facing_slope * depth) >> 95)
    total = 0
    for light in r.lights:
        if light.facing > 0:
            half = light.facing * length - normal_ray
            if half > 0:
                light_ray = light.x * x + light.y * y + (light.z << 24)
                square = divide(half * half, (length << 1) * ((length << 24) - light_ray))
                total += light.color * gloss(square, r)
    return (total >> 6) & LANES_24


def light_of(depth: int, x: int, y: int, r: Registers) -> int:
    """Adds up the light on a fragment; returns the highlights, lanes of Q10."""
    length = ray_length(x, y, r)
    r.fragment_light = r.face_light << 24
    is_smooth = r.mode & IS_SMOOTH
    total = 0
    for light in r.lights:
        lx, ly, lz = light.x, light.y, light.z
        distance = 1 << 24
        if light.is_point:
            # from the fragment to the light, Q16
            if r.mode & IS_ORTHOGRAPHIC == 0:
                distance = divide(r.depth_scale << 8, depth)
                lx -= x * distance >> 40
                ly -= y * distance >> 40
                lz -= distance >> 16
            else:
                lx -= r.fragment_place_x
                ly -= r.fragment_place_y
                lz -= ((r.depth_scale << 8) - depth) >> 16
            distance = sqrt(lx * lx + ly * ly + lz * lz)
        if is_smooth:
            facing = r.fragment_normal_x * lx + r.fragment_normal_y * ly + r.fragment_normal_z * lz
        else:
            facing = light.facing << 24
        if facing > 0:
            r.fragment_light += light.diffuse * divide(facing << 24, distance * r.fragment_normal_length)
            facing = facing * length - distance * r.fragment_normal_ray
            if facing > 0:
                light_ray = lx * x + ly * y + (lz << 24)
                divisor = distance * (length << 1) * (distance * length - light_ray)
                total += light.color * gloss(divide((facing * facing) << 24, r.fragment_square * divisor), r)
    return (total >> 6) & LANES_24


def modulated(color: int, factor: int) -> int:
    """Lanes of Q10 times lanes of Q40."""
    factor = (factor >> 24) & LANES_32
    blue = factor & 0xFFFFFFFF
    if factor == blue * ONES:
        return (color * blue >> 16) & LANES_24
    product = (blue * (color & 0xFFFFFF)) >> 16
    product |= (((factor >> 56) & 0xFFFFFFFF) * ((color >> 56) & 0xFFFFFF)) >> 16 << 56
    return product | ((factor >> 112) * (color >> 112)) >> 16 << 112


def shade(attribute: int, x: int, y: int, r: Registers) -> int:
    """The colour of a fragment of known barycentric coordinates, lanes of Q10."""
    second = (attribute >> 64) & 0xFFFFFFFFFFFF
    third = (attribute >> 8) & 0xFFFFFFFFFFFF
    depth = attribute >> 192
    if r.mode & IS_ORTHOGRAPHIC == 0:
        second = divide(second * r.depth_1, depth)
        third = divide(third * r.depth_2, depth)
        if r.mode & IS_STEEP:
            # rounding counts much where a near vertex meets a far fragment
            second, third = min(second, 1 << 24), min(third, 1 << 24)
    else:
        r.fragment_place_x, r.fragment_place_y = x >> 16, y >> 16
        x = y = 0
    color = ((r.color_0 + r.color_1 * second + r.color_2 * third) >> 24) & LANES_32
    # lanes that were rounded below zero have lost the bit of the bias
    color &= ((color >> 24) & ONES) * 0xFFFFFF
    if r.mode & IS_LIT == 0:
        return color
    if r.mode & IS_DIFFUSE == 0:
        return color + highlights(depth, x, y, r)
    if r.mode & IS_SMOOTH == 0:
        r.fragment_normal_ray = r.face_facing + (signed(r.face_facing_slope * depth) >> 95)
    else:
        # the interpolated normal, Q24
        second >>= 8
        third >>= 8
        lanes = r.normals.at_0 + r.normals.to_1 * second + r.normals.to_2 * third + NORMAL_BIAS
        r.fragment_normal_x = nx = ((lanes >> 12) & 0x7FFFFFF) - 0x4000000
        r.fragment_normal_y = ny = ((lanes >> 97) & 0x7FFFFFF) - 0x4000000
        r.fragment_normal_z = nz = ((lanes & MASK) >> 182) - 0x4000000
        r.fragment_square = nx * nx + ny * ny + nz * nz
        r.fragment_normal_ray = nx * x + ny * y + (nz << 24)
        r.fragment_normal_length = sqrt(r.fragment_square)
    highlight = light_of(depth, x, y, r)
    return modulated(color, r.fragment_light) + highlight


def shade_varying(attribute: int, r: Registers) -> int:
    """The colour of a fragment whose vectors to light and eye are interpolated from the vertices, lanes of Q10."""
    # barycentric coordinates, Q16
    s = (attribute >> 72) & 0xFFFFFFFFFF
    t = (attribute >> 16) & 0xFFFFFFFFFF
    if r.mode & IS_STEEP:
        depth = attribute >> 192
        s = divide(s * r.depth_1, depth)
        t = divide(t * r.depth_2, depth)
    n = r.normals.at_0 + r.normals.to_1 * s + r.normals.to_2 * t
    square = product(n, r.reversed.at_0 + r.reversed.to_1 * s + r.reversed.to_2 * t)
    # twice the root, by a line that is within 3 % of it from 1/4 to 1, and one step of Newton's method
    length = (((702 * square) & MASK) >> 46) + 23570660229
    length += divide(square, length)
    factor = r.face_light_40
    highlight = 0
    light = r.lights[0]
    # normal * light
    cosine = product(n, r.to_light.at_0 + r.to_light.to_1 * s + r.to_light.to_2 * t)
    if cosine > 0:
        factor += light.diffuse * divide(cosine, length << 11)
        half_reversed = r.half_reversed.at_0 + r.half_reversed.to_1 * s + r.half_reversed.to_2 * t
        cosine = product(n, half_reversed)
        if cosine > 0:
            half_square = product(half_reversed, r.half.at_0 + r.half.to_1 * s + r.half.to_2 * t)
            value = gloss(divide((cosine * cosine) << 24, square * half_square), r)
            highlight = (light.color * value >> 6) & LANES_24
    color = ((r.color_0 + r.color_1 * s + r.color_2 * t) >> 16) & LANES_24
    if r.mode & IS_GREY:
        return ((color * ((factor >> 24) & 0xFFFFFFFF) >> 16) & LANES_24) + highlight
    return modulated(color, factor) + highlight


# ---- pixels ----


def pack(color: int) -> tuple[int, int, int]:
    """Lanes of Q10 as the bytes blue, green, red; lanes above 255 are 255."""
    color |= (((color + 0x3FFC0000 * ONES) >> 30) & ONES) * 0x3FC00
    return (color >> 10) & 0xFF, (color >> 66) & 0xFF, (color >> 122) & 0xFF


class Fragments:
    """The fragments of some spans that pass the depth test; their depths are written at once.

    rows, columns: (n,) places in the tile. limbs: (8, n) words of 32 bits of the accumulators, the lowest first.
    """

    def __init__(self, spans: list[Span], r: Registers) -> None:
        """None of the spans lies over another."""
        table = np.array([span[:3] for span in spans], np.int64).reshape(-1, 3)
        starts = _limbs([span[3] for span in spans])
        steps = _limbs([span[4] for span in spans])
        counts = table[:, 2] - table[:, 1]
        span = np.repeat(np.arange(len(spans)), counts)
        offset = np.arange(len(span)) - np.repeat(np.cumsum(counts) - counts, counts)
        self.rows = table[span, 0] - r.band_top
        self.columns = table[span, 1] + offset - r.column_begin
        # products of 32 by 16 bits, so that nothing overflows
        limbs = starts[:, span] + steps[:, span] * offset.astype(np.uint64)
        for i in range(7):
            limbs[i + 1] += limbs[i] >> np.uint64(32)
        limbs &= np.uint64(0xFFFFFFFF)
        depth = (limbs[7] << np.uint64(32)) | limbs[6]
        seen = np.flatnonzero(depth > r.depth[self.rows, self.columns])
        self.rows, self.columns, self.limbs = self.rows[seen], self.columns[seen], limbs[:, seen]
        r.depth[self.rows, self.columns] = depth[seen]

    def words(self) -> Iterator[int]:
        """The accumulators."""
        data = self.limbs.T.astype("<u4").tobytes()
        for place in range(0, len(data), 32):
            yield int.from_bytes(data[place : place + 32], "little")

    def lanes(self) -> list[NDArray[np.uint64]]:
        """Blue, green and red, Q10 in 24 bits, where the accumulators hold colours."""
        _, b, g0, g1, r0, r1, _, _ = self.limbs
        low, high = np.uint64(0xFFFFFF), np.uint64(0xFF)
        eight, sixteen, twenty_four = np.uint64(8), np.uint64(16), np.uint64(24)
        green = (g0 >> twenty_four) | ((g1 << eight) & low)
        red = (r0 >> sixteen) | ((r1 & high) << sixteen)
        return [b & low, green, red]


def _limbs(words: list[int]) -> NDArray[np.uint64]:
    """Words as columns of 8 numbers of 32 bits, the lowest first."""
    data = b"".join((word & MASK).to_bytes(32, "little") for word in words)
    return np.frombuffer(data, "<u4").reshape(-1, 8).T.astype(np.uint64)


def spans_between(edges: int, slopes: int, start: int, row: int, last: int, r: Registers) -> list[Span]:
    """The fragments of the rows from `row` to before `last`, between two edges.

    edges, slopes: see `rasterizer.set_up`. start: the accumulator at column 0; DX and DY are its changes.
    """
    spans: list[Span] = []
    is_blocked = r.mode & IS_BLOCKED != 0
    for line in range(row, last):
        first, end = (edges >> 48) & 0xFFFF, edges >> 176
        if first < end:
            span = (line, first, end, start + first * r.dx, r.dx)
            inside = clamped(span, r) if r.mode & IS_CROSSING else span
            if inside[1] < inside[2]:
                # blocks begin with the row, wherever the tile does
                spans += blocks(span, r) if is_blocked else [inside]
        edges = (edges + slopes) & MASK
        start += r.dy
    return spans


def clamped(span: Span, r: Registers) -> Span:
    """The part of a span that lies in the tile."""
    row, first, end, attribute, step = span
    if first < r.column_begin:
        attribute += step * (r.column_begin - first)
        first = r.column_begin
    return row, first, min(end, r.column_end), attribute, step


def draw(spans: list[Span], r: Registers) -> None:
    """Draws fragments none of which is over another."""
    if not spans:
        return
    fragments = Fragments(spans, r)
    if r.mode & IS_BLOCKED or r.mode & (IS_VARYING | IS_BARYCENTRIC) == 0:
        # the accumulators hold the colours
        for channel, lane in enumerate(fragments.lanes()):
            value = lane >> np.uint64(10)
            if r.mode != 0:
                value = np.minimum(value, 255)
            r.image[fragments.rows, fragments.columns, channel] = value.astype(np.uint8)
        return
    colors = []
    for word, line, column in zip(fragments.words(), fragments.rows.tolist(), fragments.columns.tolist(), strict=True):
        if r.mode & IS_VARYING:
            color = shade_varying(word, r)
        else:
            x = r.ray_left + (column + r.column_begin) * r.ray_step
            y = r.ray_top + (line + r.band_top) * r.ray_step
            color = shade(word, x, y, r)
        colors.append(pack(color + HALF_LEVEL))
    if colors:
        r.image[fragments.rows, fragments.columns] = colors


def blocks(span: Span, r: Registers) -> list[Span]:
    """Shades at the ends of the row and where the columns are multiples of the block size, and linearly between."""
    row, first, end, attribute, _ = span
    attribute &= MASK
    x, y = r.ray_left + first * r.ray_step, r.ray_top + row * r.ray_step
    depth_step = r.dx >> 168 << 168
    color = shade(attribute, x, y, r)
    pieces = []
    while True:
        following = min(first + r.block - first % r.block, end - 1)
        length = following - first
        # the depth of the accumulator with the colour
        colored = (attribute >> 168 << 168) | ((color << 32) + LINE_BIAS)
        if length == 0:
            pieces.append(clamped((row, first, end, colored, 0), r))
            break
        attribute = (attribute + length * r.dx) & MASK
        x += length * r.ray_step
        next_color = shade(attribute, x, y, r)
        step = depth_step + (next_color - color) * (0x100000000 // length)
        pieces.append(clamped((row, first, following, colored, step), r))
        color, first = next_color, following
    return [piece for piece in pieces if piece[1] < piece[2]]


# ---- vertices ----


def ray_of(vertex: Vertex, r: Registers) -> tuple[int, int]:
    """The ray through a vertex, Q24."""
    return r.ray_left + (vertex.x * r.ray_step >> 8), r.ray_top + (vertex.y * r.ray_step >> 8)


def vertex_highlights(word: int, vertex: Vertex, r: Registers) -> int:
    """The attribute word of a vertex, with the light of the face on its colour, and now with its highlights."""
    if vertex.ray_length == 0:
        x, y = (0, 0) if r.frame_is_orthographic else ray_of(vertex, r)
        vertex.ray_length = length = ray_length(x, y, r)
        vertex.places = [
            (length << 1) * ((length << 24) - (light.x * x + light.y * y + (light.z << 24))) for light in r.lights
        ]
    length = vertex.ray_length
    normal_ray = r.face_facing + (signed(r.face_facing_slope * (word >> 168 << 8)) >> 95)
    total = 0
    for light, place in zip(r.lights, vertex.places, strict=True):
        if light.facing > 0:
            half = light.facing * length - normal_ray
            if half > 0:
                total += light.color * gloss(divide(half * half, place), r)
    return word + ((total >> 6) & LANES_24)


def set_varyings(vertex: Vertex, r: Registers) -> None:
    """Fills the record of a vertex with the vectors that fragments of smooth triangles interpolate: Q20, in lanes."""
    depth = vertex.attributes >> 168 << 8
    x, y = ray_of(vertex, r)
    lanes = (vertex.normal + VECTOR_BIAS) & MASK
    vertex.reversed = (((lanes & LANE_85) << 170 | lanes >> 170 | (lanes & (LANE_85 << 85))) - VECTOR_BIAS) & MASK
    light = r.lights[0]
    lx, ly, lz = light.x, light.y, light.z
    if light.is_point and r.frame_is_orthographic:
        lx -= x >> 16
        ly -= y >> 16
        lz -= ((r.depth_scale << 8) - depth) >> 16
    elif light.is_point:
        distance = divide(r.depth_scale << 8, depth)
        lx -= (x * distance) >> 40
        ly -= (y * distance) >> 40
        lz -= distance >> 16
    if r.frame_is_orthographic:
        x = y = 0
    length = sqrt(x * x + y * y + (1 << 48))
    distance_to_light = sqrt(lx * lx + ly * ly + lz * lz)
    lx, ly, lz = (divide_signed(component << 20, distance_to_light) for component in (lx, ly, lz))
    # H = L + V
    hx, hy, hz = (component - divide_signed(ray << 20, length) for component, ray in ((lx, x), (ly, y), (lz, 1 << 24)))
    vertex.to_light = lz + (ly << 85) + (lx << 170)
    vertex.half = hx + (hy << 85) + (hz << 170)
    vertex.half_reversed = hz + (hy << 85) + (hx << 170)
    vertex.has_varyings = True
