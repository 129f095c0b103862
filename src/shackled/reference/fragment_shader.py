"""Turn fragments into pixels: depth test, perspective-correct attributes, Blinn-Phong.

The colour of a fragment depends on its triangle and its place only. Fragments of one triangle never overlap, so that
all of them are tested against the depths of the picture at once; those that need light are then shaded one by one.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from . import layout
from .fragment_light import ray_length, specular
from .registers import IS_IN_PASSES, Registers
from .vertex_shader import Vertex
from .words import MASK, divide, divide_signed, signed

#: 1 + 2^-21, Q24.
ABOVE_ONE = (1 << 24) + 8

#: A piece of a row: row, first column, column after the last, accumulator at the first column, change per pixel.
Span = tuple[int, int, int, int, int]


# ---- light ----


def modulated(color: int, factor: int) -> int:
    """Multiply lanes of Q10 by lanes of Q40."""
    factor = (factor >> 24) & layout.LANES_32
    blue = factor & 0xFFFFFFFF
    if factor == blue * layout.ONES:
        return (color * blue >> 16) & layout.LANES_24
    product = (blue * (color & 0xFFFFFF)) >> 16
    product |= (((factor >> 56) & 0xFFFFFFFF) * ((color >> 56) & 0xFFFFFF)) >> 16 << 56
    return product | ((factor >> 112) * (color >> 112)) >> 16 << 112


def shade_quadratic(attribute: int, light: int, registers: Registers, extra: int = 0) -> int:
    """Return the colour of a fragment, lanes of Q10, from the accumulator and the products, Q68 with `extra` bits
    more.
    """
    r = registers
    light &= MASK
    # N * N, Q68, and twice its root, Q34, by a line that is within 3 % of it and one step of Newton's method
    square = light >> (170 + extra)
    length = ((702 * square) >> 44) + 5892665057
    length += divide(square, length)
    factor = r.face_light_40
    highlight = 0
    diffuse = signed(light << 86) >> (180 + extra)
    if diffuse > 0:
        factor += r.lights[0].diffuse * divide(diffuse, length)
        # N * H, Q46
        n_dot_h = signed(light << 171) >> (193 + extra)
        if n_dot_h > 0:
            value = specular(divide(n_dot_h * n_dot_h, square), r)
            highlight = (r.lights[0].color * value >> 6) & layout.LANES_24
    color = (attribute >> 32) & layout.LANES_24
    if r.mode & layout.IS_STEEP:
        color = (color * divide(r.nearest, attribute >> 192) >> 16) & layout.LANES_24
    if r.mode & layout.IS_GREY:
        return ((color * ((factor >> 24) & 0xFFFFFFFF) >> 16) & layout.LANES_24) + highlight
    return modulated(color, factor) + highlight


# ---- pixels ----


def pack(color: int) -> tuple[int, int, int]:
    """Return lanes of Q10 as the bytes blue, green, red; lanes above 255 are 255."""
    color |= (((color + 0x3FFC0000 * layout.ONES) >> 30) & layout.ONES) * 0x3FC00
    return (color >> 10) & 0xFF, (color >> 66) & 0xFF, (color >> 122) & 0xFF


class Fragments:
    """The fragments of some spans that pass the depth test; their depths are written at once.

    rows, columns: (n,) places in the tile. limbs: (8, n) words of 32 bits of the accumulators, the lowest first.
    """

    def __init__(self, spans: list[Span], r: Registers) -> None:
        """Take spans that do not overlap."""
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
        """Return the accumulators."""
        data = self.limbs.T.astype("<u4").tobytes()
        for place in range(0, len(data), 32):
            yield int.from_bytes(data[place : place + 32], "little")

    def lanes(self) -> list[NDArray[np.uint64]]:
        """Return blue, green and red, Q10 in 24 bits, where the accumulators hold colours."""
        _, b, g0, g1, r0, r1, _, _ = self.limbs
        low, high = np.uint64(0xFFFFFF), np.uint64(0xFF)
        eight, sixteen, twenty_four = np.uint64(8), np.uint64(16), np.uint64(24)
        green = (g0 >> twenty_four) | ((g1 << eight) & low)
        red = (r0 >> sixteen) | ((r1 & high) << sixteen)
        return [b & low, green, red]


def _limbs(words: list[int]) -> NDArray[np.uint64]:
    """Return words as columns of 8 numbers of 32 bits, the lowest first."""
    data = b"".join((word & MASK).to_bytes(32, "little") for word in words)
    return np.frombuffer(data, "<u4").reshape(-1, 8).T.astype(np.uint64)


def spans_between(edges: int, slopes: int, start: int, row: int, last: int, r: Registers) -> list[Span]:
    """Return the fragments of the rows from `row` to before `last`, between two edges.

    edges, slopes: see `rasterizer.set_up`. start: the accumulator at column 0; DX and DY are its changes.
    """
    spans: list[Span] = []
    for line in range(row, last):
        first, end = (edges >> 48) & 0xFFFF, edges >> 176
        if first < end:
            span = (line, first, end, start + first * r.dx, r.dx)
            inside = clamped(span, r) if r.mode & (layout.IS_CROSSING | IS_IN_PASSES) else span
            if inside[1] < inside[2]:
                spans.append(inside)
        edges = (edges + slopes) & MASK
        start += r.dy
    return spans


def clamped(span: Span, r: Registers) -> Span:
    """Clamp a span to the tile."""
    row, first, end, attribute, step = span
    if first < r.column_begin:
        attribute += step * (r.column_begin - first)
        first = r.column_begin
    return row, first, min(end, r.column_end), attribute, step


def draw(spans: list[Span], r: Registers) -> None:
    """Draw fragments that do not overlap."""
    if not spans:
        return
    fragments = Fragments(spans, r)
    if r.mode & layout.IS_QUADRATIC == 0:
        # the accumulators hold the colours
        for channel, lane in enumerate(fragments.lanes()):
            value = lane >> np.uint64(10)
            if r.mode != 0:
                value = np.minimum(value, 255)
            r.image[fragments.rows, fragments.columns, channel] = value.astype(np.uint8)
        return
    colors = []
    for word, line, column in zip(fragments.words(), fragments.rows.tolist(), fragments.columns.tolist(), strict=True):
        light = r.quadratic.at(column + r.column_begin, line + r.band_top)
        colors.append(pack(shade_quadratic(word, light, r) + layout.HALF_LEVEL))
    if colors:
        r.image[fragments.rows, fragments.columns] = colors


# ---- vertices ----


def ray_of(vertex: Vertex, r: Registers) -> tuple[int, int]:
    """Return the ray through a vertex, Q24."""
    return r.ray_left + (vertex.x * r.ray_step >> 8), r.ray_top + (vertex.y * r.ray_step >> 8)


def vertex_highlights(word: int, vertex: Vertex, r: Registers) -> int:
    """Return the attribute word of a vertex, whose colour has the light of the face, with its highlights added."""
    if not vertex.halves:
        vertex.halves = half_vectors(vertex, r)
    for light, (half, square) in zip(r.lights, vertex.halves, strict=True):
        if light.n_dot_l > 0:
            # normal * half vector
            product = max(signed(r.face_normal * half) >> layout.UPPER_86_AT, 0)
            place = divide(product * product, r.face_square * square) - r.specular_offset
            if place > 0:
                entry = r.specular_table[place >> 24]
                value = (entry >> 128 << 24) + (entry & (1 << 128) - 1) * (place & 0xFFFFFF)
                word += (light.color * value >> 30) & layout.LANES_24
    return word


def half_vectors(vertex: Vertex, r: Registers) -> list[tuple[int, int]]:
    """Return for each light the half vector L - V and its square, of unit vectors L to the light and V along the ray.

    The vector is in the space of the mesh: signed lanes of 86 bits, Q32, z lowest. It is off by 2^-22 at most, as rays
    and directions are Q24. The unit of the square is such that (N.H)^2 / (N.N * square) is a place in the table of the
    highlight, Q24. It is taken 2^-20 too great, more than it may be off, so that rounding leads to no place behind the
    last entry: cos^n changes by at most n/2 * 2^-20 / H^2, or, with a shininess of 128 and H^2 = 1, by 0.016 levels.
    """
    x, y = (0, 0) if r.frame_is_orthographic else ray_of(vertex, r)
    length = ray_length(x, y, r)
    # Q80
    ray = (x * r.normal_x + y * r.normal_y + (r.normal_z << 24)) * ((1 << 56) // length)
    halves = []
    for light in r.lights:
        half = ((((light.mesh_lanes << 56) - ray + layout.HALF_86) & MASK) >> 48 & layout.Q32_86) - layout.HALF_Q32_86
        change = length * ABOVE_ONE - (light.x * x + light.y * y + (light.z << 24))
        halves.append((half, divide_signed(change << 33, length * r.specular_scale)))
    return halves
