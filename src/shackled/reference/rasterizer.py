"""From triangles to fragments, by a digital differential analyzer."""

from __future__ import annotations

from collections.abc import Iterator

from . import fragment_shader, shading
from .mesh import Mesh
from .primitive_assembly import Triangle
from .registers import IS_DEEP, Registers
from .vertex_shader import Vertex
from .words import MASK, divide_signed

LANE_128 = (1 << 128) - 1


def run(triangles: list[Triangle], mesh: Mesh, registers: Registers) -> None:
    """Draws the triangles of a list."""
    for triangle in triangles:
        if max(triangle.top, registers.band_top) < min(triangle.bottom, registers.band_bottom):
            shading.prepare(triangle, mesh, registers)
            for spans in spans_of(triangle, registers):
                fragment_shader.draw(spans, registers)


def spans_of(triangle: Triangle, registers: Registers) -> Iterator[list[fragment_shader.Span]]:
    """The fragments of a triangle that is prepared."""
    r = registers
    top, bottom = max(triangle.top, r.band_top), min(triangle.bottom, r.band_bottom)
    if top >= bottom:
        return
    edges, slopes, middle = set_up(triangle.a, triangle.b, triangle.c, top, r)
    middle = min(middle, bottom)
    spans = []
    if top < middle:
        spans = fragment_shader.spans_between(edges, slopes, r.start, top, middle, r)
    else:
        middle = top
    if middle < bottom:
        edges, slopes = lower_edges(edges, slopes, triangle.b, triangle.c, top, middle)
        start = r.start + r.dy * (middle - top)
        spans += fragment_shader.spans_between(edges, slopes, start, middle, bottom, r)
    yield spans


def set_up(a: Vertex, b: Vertex, c: Vertex, top: int, registers: Registers) -> tuple[int, int, int]:
    """What changes linearly over a triangle, at row `top`; sets the accumulator at column 0 and its changes.

    Returns the left edge, from a to b, and the right one, from a to c, in lanes of 128 bits: columns, Q48, such that
    the integer part is the first pixel whose centre is not left of the edge; their change per row; and the first row
    below the upper of b and c, where one edge ends and another begins.
    """
    r = registers
    x = a.x
    xb, yb, xc, yc = b.x - x, b.y - a.y, c.x - x, c.y - a.y
    middle = (min(b.y, c.y) + 255) >> 8
    # from the first vertex to the centres of the row
    y = (top << 8) - a.y

    left, right = divide_signed(xb << 48, yb), divide_signed(xc << 48, yc)
    column = (x << 40) + 0xFFFFFFFFC000
    edges = column + (y * left >> 8) + ((column + (y * right >> 8)) << 128)
    slopes = left + (right << 128)

    # change of the barycentric coordinates per pixel, Q32
    area = xc * yb - xb * yc
    start, dx, dy = r.lane_bias, 0, 0
    if r.mode & IS_DEEP:
        # depths by themselves, Q32, for which barycentric coordinates are too coarse
        z = r.attribute_0 >> 168
        zb, zc = (r.attribute_1 >> 168) - z, (r.attribute_2 >> 168) - z
        dx = divide_signed((zc * yb - zb * yc) << 40, area)
        dy = divide_signed((zb * xc - zc * xb) << 40, area)
        start += ((z << 32) + ((y * dy - x * dx) >> 8)) << 168
        r.attribute_0, r.attribute_1, r.attribute_2 = 0, 1 << 56, 1
    xb, xc = divide_signed(xb << 40, area), divide_signed(xc << 40, area)
    yb, yc = divide_signed(yb << 40, area), divide_signed(yc << 40, area)
    delta_b, delta_c = r.attribute_1 - r.attribute_0, r.attribute_2 - r.attribute_0
    # from the first vertex to the centre of pixel 0 in row `top`
    start += r.attribute_0 << 32
    start += delta_b * ((y * xc + x * yc) >> 8) - delta_c * ((x * yb + y * xb) >> 8)
    r.start = start & MASK
    r.dx = (delta_c * yb - delta_b * yc + (dx << 168)) & MASK
    r.dy = (delta_b * xc - delta_c * xb + (dy << 168)) & MASK
    return edges & MASK, slopes & MASK, middle


def lower_edges(upper: int, upper_slopes: int, b: Vertex, c: Vertex, top: int, middle: int) -> tuple[int, int]:
    """The same at row `middle`, where the edge between b and c takes the place of the one that has ended."""
    edges = (upper + upper_slopes * (middle - top)) & MASK
    is_right = c.word < b.word
    if is_right:
        b, c = c, b
    slope = divide_signed((c.x - b.x) << 48, c.y - b.y)
    column = ((b.x << 40) + 0xFFFFFFFFC000 + (((middle << 8) - b.y) * slope >> 8)) & MASK
    left_slope = upper_slopes & LANE_128
    left_slope -= left_slope >> 127 << 128
    # keep the lane of the other edge
    if is_right:
        edges = (edges & LANE_128) | (column << 128)
        slopes = left_slope + (slope << 128)
    else:
        edges = (edges >> 128 << 128) | column
        slopes = upper_slopes - left_slope + slope
    return edges & MASK, slopes & MASK
