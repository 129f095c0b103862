"""Draw flat and unlit triangles whose colours are not linear on the screen.

Their colours are quadratic functions of the place, fitted to exact ones, over the whole triangle or over square cells
of it. The cells are those of the canvas, not of the tile, so that tiles equal the whole.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from .fragment_light import color_at
from .fragment_shader import Span
from .layout import ACCUMULATOR_DEPTH_AT, BIAS_36, BIAS_84, LANES_37, ONES_24, SQUARES_24, STEPS_24
from .quadratic import Differences, differences, from_nodes
from .registers import Registers
from .vertex_shader import Vertex
from .words import MASK, divide, signed

#: Lanes of 85 bits.
ONES_85 = 1 + (1 << 85) + (1 << 170)
#: Half a level, Q58.
HALF_85 = ONES_85 << 57
#: Spans of more pixels are drawn eight at a time.
SHORT_SPAN = 5


@dataclass
class Pixels:
    """Pixels to draw: places, depths, and colours (blue, green, red)."""

    rows: list[int] = field(default_factory=list)
    columns: list[int] = field(default_factory=list)
    depths: list[int] = field(default_factory=list)
    colors: list[tuple[int, int, int]] = field(default_factory=list)

    def draw(self, r: Registers) -> None:
        """Draw the pixels that are nearer than what is there. No two are at one place."""
        rows, columns = np.array(self.rows, np.int64) - r.band_top, np.array(self.columns, np.int64) - r.column_begin
        depths = np.array(self.depths, np.uint64)
        seen = np.flatnonzero(depths > r.depth[rows, columns])
        rows, columns = rows[seen], columns[seen]
        r.depth[rows, columns] = depths[seen]
        r.image[rows, columns] = np.array(self.colors, np.uint8).reshape(-1, 3)[seen]

    def add(self, row: int, column: int, depth: int, color: tuple[int, int, int]) -> None:
        """Add a pixel."""
        self.rows.append(row)
        self.columns.append(column)
        self.depths.append(depth)
        self.colors.append(color)


def fill(edges: int, slopes: int, start: int, row: int, last: int, r: Registers) -> None:
    """Draw the rows from `row` to before `last`, between two edges."""
    pixels = Pixels()
    size = r.patch_size
    if size == 1:
        exact_rows(edges, slopes, start, row, last, pixels, r)
    elif size == 0:
        rows(edges, slopes, start, row, last, 0, 1 << 16, pixels, r)
    else:
        while row < last:
            following = min(row // size * size + size, last)
            cells(edges, slopes, start, row, following, pixels, r)
            edges = (edges + slopes * (following - row)) & MASK
            start += r.dy * (following - row)
            row = following
    if pixels.rows:
        pixels.draw(r)


def cells(edges: int, slopes: int, start: int, row: int, last: int, pixels: Pixels, r: Registers) -> None:
    """Draw a row of cells."""
    size = r.patch_size
    last_edges = (edges + slopes * (last - row - 1)) & MASK
    # edges are straight: their ends bound them
    first = max(min((edges >> 48) & 0xFFFF, (last_edges >> 48) & 0xFFFF), r.column_begin) // size * size
    end = min(max(edges >> 176, last_edges >> 176), r.column_end)
    for column in range(first, end, size):
        fit(column, row, start, size, r)
        rows(edges, slopes, start, row, last, column, column + size, pixels, r)


def fit(column: int, row: int, start: int, size: int, r: Registers) -> None:
    """Fit a quadratic function to nine exact colours of a cell. All depths there are positive."""
    half = size // 2
    middle_x, middle_y = column + half, row // size * size + half

    def sample(i: int, j: int) -> int:
        word = (start + (middle_x + i * half) * r.dx + (middle_y + j * half - row) * r.dy) & MASK
        return weighted(sampled(word, middle_x + i * half, middle_y + j * half, r), word >> ACCUMULATOR_DEPTH_AT, r)

    middle = sample(0, 0)
    right_below, left_above, right_above, left_below = sample(1, 1), sample(-1, -1), sample(1, -1), sample(-1, 1)
    # Changes per pixel, Q58, where the half of the size is 2^shift. The first derivatives are the means of those along
    # the middles and along the borders: where the third are not zero, either is off by twice as much on one of both.
    shift = half.bit_length() - 1
    down, up = right_below - left_above, right_above - left_below
    a = (2 * (sample(1, 0) - sample(-1, 0)) + down + up) << (48 - 3 - shift)
    b = (2 * (sample(0, 1) - sample(0, -1)) + down - up) << (48 - 3 - shift)
    xx = (sample(1, 0) + sample(-1, 0) - 2 * middle) << (48 - 1 - 2 * shift)
    yy = (sample(0, 1) + sample(0, -1) - 2 * middle) << (48 - 1 - 2 * shift)
    xy = (right_below + left_above - right_above - left_below) << (48 - 2 - 2 * shift)
    # from the middle to column 0 of the row
    x, y = -middle_x, row - middle_y
    r.patch_row = row
    r.patch = Differences(
        (middle << 48) + bias(r) + x * (a + x * xx + y * xy) + y * (b + y * yy),
        a + (2 * x + 1) * xx + y * xy,
        b + (2 * y + 1) * yy + x * xy,
        2 * xx,
        xy,
        2 * yy,
    )


def sampled(attribute: int, column: int, row: int, r: Registers) -> int:
    """Return the colour at a value of the accumulator."""
    low = attribute & ((1 << 168) - 1)
    s = (low - (low >> 167 << 168)) >> 64
    low = attribute & ((1 << 56) - 1)
    t = (low - (low >> 55 << 56)) >> 8
    x, y = r.ray_left + column * r.ray_step, r.ray_top + row * r.ray_step
    return color_at((attribute & MASK) >> ACCUMULATOR_DEPTH_AT, s, t, x, y, r)


def weighted(color: int, depth: int, r: Registers) -> int:
    """Multiply a colour by its depth as a part, Q14, of the nearest, if depths differ much."""
    return color * ((depth << 14) // r.patch_weight) if r.patch_weight else color


def unweighted(f: int, depth: int, r: Registers) -> int:
    """Return a colour, Q58, from one times its depth, Q72, whose lanes BIAS_84 keeps positive."""
    f = ((f & MASK) >> 48 & LANES_37) - BIAS_36
    return f * divide(r.patch_weight << 34, depth) + HALF_85


def bias(r: Registers) -> int:
    """Return the bias of a quadratic function.

    It rounds the colour, or keeps it positive until it is divided by the depth.
    """
    return BIAS_84 if r.patch_weight else HALF_85


def fit_whole(a: Vertex, b: Vertex, c: Vertex, top: int, r: Registers) -> None:
    """Fit a quadratic function to six exact colours of the triangle."""
    za, zb, zc = (vertex.attributes >> 168 for vertex in (a, b, c))
    one, half = 1 << 24, 1 << 23

    def between(u: Vertex, v: Vertex, depth: int, s: int, t: int) -> int:
        """Return the colour in the middle between two vertices on the screen."""
        x = r.ray_left + ((u.x + v.x) * r.ray_step >> 9)
        y = r.ray_top + ((u.y + v.y) * r.ray_step >> 9)
        return weighted(color_at(depth, s, t, x, y, r), depth, r)

    coefficients = from_nodes(
        between(a, a, za << 8, 0, 0),
        between(b, b, zb << 8, one, 0),
        between(c, c, zc << 8, 0, one),
        between(a, b, (za + zb) << 7, half, 0),
        between(a, c, (za + zc) << 7, 0, half),
        between(b, c, (zb + zc) << 7, half, half),
    )
    found = differences(a, b, c, top, coefficients)
    r.patch = found._replace(start=found.start + bias(r))
    r.patch_row = top


def exact_rows(edges: int, slopes: int, start: int, row: int, last: int, pixels: Pixels, r: Registers) -> None:
    """Shade every fragment exactly."""
    for line in range(row, last):
        first = max((edges >> 48) & 0xFFFF, r.column_begin)
        exact_span(line, first, min(edges >> 176, r.column_end), start + first * r.dx, r.dx, pixels, r)
        edges = (edges + slopes) & MASK
        start += r.dy


def exact_span(row: int, first: int, end: int, attribute: int, step: int, pixels: Pixels, r: Registers) -> None:
    """Shade every fragment of a part of a row exactly."""
    for column in range(first, end):
        depth = (attribute & MASK) >> ACCUMULATOR_DEPTH_AT
        if depth > int(r.depth[row - r.band_top, column - r.column_begin]):
            color = (sampled(attribute, column, row, r) << 48) + HALF_85
            pixels.add(row, column, depth, pack(color & MASK))
        attribute += step


def draw_exact(spans: list[Span], r: Registers) -> None:
    """Draw spans that do not overlap."""
    pixels = Pixels()
    for span in spans:
        exact_span(*span, pixels, r)
    if pixels.rows:
        pixels.draw(r)


def pack(f: int) -> tuple[int, int, int]:
    """Return lanes of 85 bits, Q58, as the bytes blue, green, red."""
    blue, green, red = (clamp(((f >> (85 * i + 58)) & ((1 << 27) - 1)), 27) for i in range(3))
    return blue, green, red


def clamp(value: int, bits: int) -> int:
    """Clamp a signed number of so many bits to 0..255."""
    return 0 if value >> (bits - 1) else min(value, 255)


def rows(
    edges: int, slopes: int, start: int, row: int, last: int, begin: int, end: int, pixels: Pixels, r: Registers
) -> None:
    """Draw quadratic colours row by row."""
    for line in range(row, last):
        y = line - r.patch_row

        def depth_at(column: int, start: int = start) -> int:
            return ((start + column * r.dx) & MASK) >> ACCUMULATOR_DEPTH_AT

        def color_of(column: int, y: int = y) -> int:
            f = r.patch.at(column, y)
            return unweighted(f, depth_at(column), r) if r.patch_weight else f

        first, to = max((edges >> 48) & 0xFFFF, begin), min(edges >> 176, end)
        if first < to <= first + SHORT_SPAN:
            for column in range(max(first, r.column_begin), min(to, r.column_end)):
                pixels.add(line, column, depth_at(column), pack(color_of(column) & MASK))
        elif first < to:
            for anchor in range(to - 1, first - 1, -8):
                columns = range(max(anchor - 7, first, r.column_begin), min(anchor + 1, r.column_end))
                if not columns:
                    continue
                color = color_of(anchor)
                if r.patch_weight:
                    # a parabola through the quotients at pixels 0, 4 and 8
                    fourth, eighth = color_of(anchor - 4), color_of(anchor - 8)
                    bend = ((color + eighth - 2 * fourth) & MASK) >> 5
                    slope = ((3 * color + eighth - 4 * fourth) & MASK) >> 3
                else:
                    bend = signed(r.patch.dxx) >> 1
                    # the derivative there
                    slope = r.patch.dx + y * r.patch.dxy + anchor * r.patch.dxx - bend
                bend += ONES_85 << 48
                words = [
                    ((color >> (85 * i + 49)) & 0xFFFFFF) * ONES_24
                    + lane_24(bend, i) * SQUARES_24
                    - lane_24(slope, i) * STEPS_24
                    for i in range(3)
                ]
                for column in columns:
                    k = anchor - column
                    blue, green, red = (clamp(((word >> (24 * k)) & 0xFFFFFF) >> 9, 15) for word in words)
                    pixels.add(line, column, depth_at(column), (blue, green, red))
        edges = (edges + slopes) & MASK
        start += r.dy


def lane_24(word: int, channel: int) -> int:
    """Return a lane of 85 bits, Q58, as a signed number of 24 bits, Q9."""
    value = (word >> (85 * channel + 49)) & 0xFFFFFF
    return value - (value >> 23 << 24)
