"""Turn the edges of triangles into fragments.

A line has one pixel in each column, or in each row if it is steeper than 45 degrees: the pixel that is nearest to it,
with the depth and the colour of the line at the centre of that column or row.
"""

from __future__ import annotations

from collections.abc import Iterator

from . import blended_spans, fragment_shader, patches, shading
from .layout import CEIL_48, EDGE_FRACTION, IS_PATCHED, RIGHT_EDGE_AT
from .mesh import Mesh
from .primitive_assembly import Triangle
from .registers import IS_IN_PASSES, Registers
from .vertex_shader import Vertex
from .words import divide_signed


def run(triangles: list[Triangle], mesh: Mesh, registers: Registers) -> None:
    """Draw the edges of the triangles of a list."""
    for triangle in triangles:
        if triangle.bottom > registers.band_top and triangle.top < registers.band_bottom:
            shading.prepare_exact(triangle, mesh, registers)
            for spans in spans_of(triangle, registers):
                if registers.mode & IS_IN_PASSES:
                    blended_spans.draw(spans, registers)
                elif registers.mode & IS_PATCHED:
                    patches.draw_exact(spans, registers)
                else:
                    fragment_shader.draw(spans, registers)


def spans_of(triangle: Triangle, registers: Registers) -> Iterator[list[fragment_shader.Span]]:
    """Yield the fragments of each edge of a triangle that is prepared."""
    r = registers
    if triangle.bottom <= r.band_top or triangle.top >= r.band_bottom:
        return
    a, b, c = triangle.a, triangle.b, triangle.c
    if triangle.edges & 1:
        yield line_between(a, b, r.attribute_0, r.attribute_1, r)
    if triangle.edges & 2:
        yield line_between(b, c, r.attribute_1, r.attribute_2, r)
    if triangle.edges & 4:
        yield line_between(c, a, r.attribute_2, r.attribute_0, r)


def line_between(
    p: Vertex, q: Vertex, attribute_p: int, attribute_q: int, registers: Registers
) -> list[fragment_shader.Span]:
    """Return the fragments of the edge between two vertices with these attribute words."""
    dx, dy = q.x - p.x, q.y - p.y
    steep = dy * dy >= dx * dx
    # the same pixels for both faces of the line
    if (dy if steep else dx) < 0:
        p, q, attribute_p, attribute_q = q, p, attribute_q, attribute_p
        dx, dy = -dx, -dy
    change = attribute_q - attribute_p
    attribute = (attribute_p << 32) + registers.lane_bias
    line = steep_line if steep else flat_line
    return line(p, q, dx, dy, attribute, change, registers)


def steep_line(
    p: Vertex, q: Vertex, dx: int, dy: int, attribute: int, change: int, registers: Registers
) -> list[fragment_shader.Span]:
    """Return one pixel in each row.

    attribute: the accumulator at the upper end. change: what its attribute word changes along the line.
    """
    r = registers
    top = max(r.band_top, (p.y + 255) >> 8)
    bottom = min(r.band_bottom, (q.y + 255) >> 8)
    if top >= bottom:
        return []
    below = (top << 8) - p.y
    slope = divide_signed(dx << EDGE_FRACTION, dy)
    step = (1 << 40) // dy
    # the pixel whose centre is nearest
    left = (p.x << 40) + ((below * slope) >> 8) + (1 << 47)
    r.dx = 0
    r.dy = change * step
    attribute += change * ((below * step) >> 8)
    edges, slopes = left + ((left + (1 << EDGE_FRACTION)) << RIGHT_EDGE_AT), slope + (slope << RIGHT_EDGE_AT)
    return fragment_shader.spans_between(edges, slopes, attribute, top, bottom, r)


def flat_line(
    p: Vertex, q: Vertex, dx: int, dy: int, attribute: int, change: int, registers: Registers
) -> list[fragment_shader.Span]:
    """Return one pixel in each column; p is the left end."""
    r = registers
    begin, end = (p.x + 255) >> 8, (q.x + 255) >> 8
    if begin >= end:
        return []
    top = max(r.band_top, (min(p.y, q.y) + 128) >> 8)
    bottom = min(r.band_bottom, ((max(p.y, q.y) + 128) >> 8) + 1)
    step = (1 << 40) // dx
    r.dx = change * step
    r.dy = 0
    attribute += change * ((-p.x * step) >> 8)
    slope = divide_signed(dx << EDGE_FRACTION, dy)
    spans: list[fragment_shader.Span] = []
    for row in range(top, bottom):
        left, right = begin, end
        if dy != 0:
            # where the line enters and leaves the row
            enter = (p.x << 40) + ((((row << 8) - 128 - p.y) * slope) >> 8) + CEIL_48
            leave = (enter + slope) >> EDGE_FRACTION
            enter >>= 48
            if dy < 0:
                enter, leave = leave, enter
            left, right = max(left, enter), min(right, leave)
        if left < right:
            edges = (left << EDGE_FRACTION) | (right << 176)
            spans += fragment_shader.spans_between(edges, 0, attribute, row, row + 1, r)
    return spans
