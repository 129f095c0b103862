"""Turn triangles into fragments by a digital differential analyzer."""

from __future__ import annotations

from collections.abc import Iterator

from . import blended_spans, fragment_shader, layout, patches, shading
from .mesh import Mesh
from .primitive_assembly import Triangle
from .registers import IS_IN_PASSES, Registers
from .vertex_shader import Vertex
from .words import MASK, divide_signed, signed


def run(triangles: list[Triangle], mesh: Mesh, registers: Registers) -> None:
    """Draw the triangles of a list."""
    for triangle in triangles:
        if max(triangle.top, registers.band_top) < min(triangle.bottom, registers.band_bottom):
            shading.prepare(triangle, mesh, registers)
            if registers.mode & IS_IN_PASSES:
                for spans in spans_of(triangle, registers):
                    blended_spans.draw(spans, registers)
                continue
            if registers.mode & layout.IS_PATCHED:
                for half in halves_of(triangle, registers):
                    patches.fill(*half, registers)
                continue
            for spans in spans_of(triangle, registers):
                fragment_shader.draw(spans, registers)


def spans_of(triangle: Triangle, registers: Registers) -> Iterator[list[fragment_shader.Span]]:
    """Yield the fragments of a triangle that is prepared."""
    spans = []
    for half in halves_of(triangle, registers):
        spans += fragment_shader.spans_between(*half, registers)
    yield spans


def halves_of(triangle: Triangle, registers: Registers) -> Iterator[tuple[int, int, int, int, int]]:
    """Yield the parts of a triangle above and below its middle vertex.

    As their edges and slopes (see `set_up`), the accumulator, the first row, and the one after the last.
    """
    r = registers
    top, bottom = max(triangle.top, r.band_top), min(triangle.bottom, r.band_bottom)
    if top >= bottom:
        return
    edges, slopes, middle = set_up(triangle, top, r)
    middle = min(middle, bottom)
    if top < middle:
        yield edges, slopes, r.start, top, middle
    else:
        middle = top
    if middle < bottom:
        edges, slopes = lower_edges(edges, slopes, triangle.b, triangle.c, top, middle)
        yield edges, slopes, r.start + r.dy * (middle - top), middle, bottom


def set_up(triangle: Triangle, top: int, registers: Registers) -> tuple[int, int, int]:
    """Set up what changes linearly over a triangle, at row `top`; set the accumulator at column 0 and its changes.

    Returns the left edge, from a to b, and the right one, from a to c, in lanes of 128 bits: columns, Q48, such that
    the integer part is the first pixel whose centre is not left of the edge; their change per row; and the first row
    below the upper of b and c, where one edge ends and another begins.
    """
    r = registers
    a, b, c = triangle.a, triangle.b, triangle.c
    x = a.x
    xb, yb, xc, yc = b.x - x, b.y - a.y, c.x - x, c.y - a.y
    middle = (min(b.y, c.y) + 255) >> 8
    # from the first vertex to the centres of the row
    y = (top << 8) - a.y

    left, right = divide_signed(xb << layout.EDGE_FRACTION, yb), divide_signed(xc << layout.EDGE_FRACTION, yc)
    column = (x << layout.EDGE_SUBPIXEL_SHIFT) + layout.CEIL_48
    edges = column + (y * left >> 8) + ((column + (y * right >> 8)) << layout.RIGHT_EDGE_AT)
    slopes = left + (right << layout.RIGHT_EDGE_AT)

    area = xc * yb - xb * yc
    start, dx, dy = r.lane_bias, 0, 0
    if r.mode & layout.IS_DEEP:
        # depths in a separate word, Q32, since barycentric coordinates are too coarse for them
        z = r.attribute_0 >> layout.ATTRIBUTE_DEPTH_AT
        zb, zc = (r.attribute_1 >> layout.ATTRIBUTE_DEPTH_AT) - z, (r.attribute_2 >> layout.ATTRIBUTE_DEPTH_AT) - z
        dx = divide_signed((zc * yb - zb * yc) << 40, area)
        dy = divide_signed((zb * xc - zc * xb) << 40, area)
        start += ((z << 32) + ((y * dy - x * dx) >> 8)) << layout.ATTRIBUTE_DEPTH_AT
        r.attribute_0, r.attribute_1, r.attribute_2 = 0, layout.ATTRIBUTE_S, 1
    # change of the barycentric coordinates per pixel, Q29
    xb, xc = divide_signed(xb << layout.GRADIENT_SHIFT, area), divide_signed(xc << layout.GRADIENT_SHIFT, area)
    yb, yc = divide_signed(yb << layout.GRADIENT_SHIFT, area), divide_signed(yc << layout.GRADIENT_SHIFT, area)
    delta_b, delta_c = r.attribute_1 - r.attribute_0, r.attribute_2 - r.attribute_0
    # from the first vertex to the centre of pixel 0 in row `top`
    start += r.attribute_0 << layout.ACCUMULATOR_FRACTION
    start += delta_b * ((y * xc + x * yc) >> 5) - delta_c * ((x * yb + y * xb) >> 5)
    r.start = start & MASK
    r.dx = (8 * (delta_c * yb - delta_b * yc) + (dx << layout.ATTRIBUTE_DEPTH_AT)) & MASK
    r.dy = (8 * (delta_b * xc - delta_c * xb) + (dy << layout.ATTRIBUTE_DEPTH_AT)) & MASK
    if triangle.turned_away:
        dx, dy = signed(delta_c * yb - delta_b * yc) >> 3, signed(r.dy) >> 6
        attributes = r.attribute_0, r.attribute_1, r.attribute_2
        r.start = (r.start - (set_back(attributes, dx, dy, 0, r) << layout.ACCUMULATOR_DEPTH_AT)) & MASK
    return edges & MASK, slopes & MASK, middle


def set_back(attributes: tuple[int, int, int], dx: int, dy: int, base: int, r: Registers) -> int:
    """Return by how much the depth of a triangle is reduced that is turned away from the eye: see the contract.

    dx, dy: changes of the accumulator over 1/64 of a pixel.
    """
    if r.mode & layout.IS_DEEP:
        return 0
    first = attributes[0]
    least = min(0, *(word - first >> layout.ATTRIBUTE_DEPTH_AT for word in attributes[1:]))
    depth = (least + (first >> layout.ATTRIBUTE_DEPTH_AT) - (signed(base) >> 8) << 7) & MASK
    return min(((dx ^ dx >> 255 | dy ^ dy >> 255) >> layout.ACCUMULATOR_DEPTH_AT) + 512, depth)


def lower_edges(upper: int, upper_slopes: int, b: Vertex, c: Vertex, top: int, middle: int) -> tuple[int, int]:
    """Return the edges at row `middle`, where the edge between b and c takes the place of the one that has ended."""
    edges = (upper + upper_slopes * (middle - top)) & MASK
    is_right = c.word < b.word
    if is_right:
        b, c = c, b
    slope = divide_signed((c.x - b.x) << layout.EDGE_FRACTION, c.y - b.y)
    column = ((b.x << layout.EDGE_SUBPIXEL_SHIFT) + layout.CEIL_48 + (((middle << 8) - b.y) * slope >> 8)) & MASK
    left_slope = upper_slopes & layout.LANE_128
    left_slope -= left_slope >> 127 << layout.RIGHT_EDGE_AT
    # keep the lane of the other edge
    if is_right:
        edges = (edges & layout.LANE_128) | (column << layout.RIGHT_EDGE_AT)
        slopes = left_slope + (slope << layout.RIGHT_EDGE_AT)
    else:
        edges = (edges >> layout.RIGHT_EDGE_AT << layout.RIGHT_EDGE_AT) | column
        slopes = upper_slopes - left_slope + slope
    return edges & MASK, slopes & MASK
