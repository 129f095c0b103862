"""Count what a scene covers, without its colours, in a fraction of the time of a picture."""

from __future__ import annotations

import numpy as np

from . import rasterizer, samples, wireframe
from .fragment_shader import Fragments, Span
from .layout import COLOR_BIAS, IS_CROSSING
from .pipeline import Geometry, assemble
from .primitive_assembly import Triangle
from .registers import Registers
from .structs import WIREFRAME, Rectangle, Scene
from .uniforms import opacity_of

#: Spans whose fragments are computed together.
AT_ONCE = 4096


def count(scene: Scene, tile: Rectangle) -> tuple[int, int]:
    """Return how many triangles of a scene are drawn, and how many pixels of a tile they cover."""
    registers, _, geometry, drawn = assemble(scene, tile)
    if registers.antialiased:
        return drawn, count_samples(geometry, registers)
    spans: list[Span] = []
    for index, part in enumerate(geometry):
        if opacity_of(index, registers) == 0:
            continue
        stage = wireframe if part.object.flags & WIREFRAME else rasterizer
        for triangle in part.triangles:
            set_depths(triangle, registers)
            for found in stage.spans_of(triangle, registers):
                spans += found
            if len(spans) >= AT_ONCE:
                cover(spans, registers)
                spans = []
    cover(spans, registers)
    return drawn, int(np.count_nonzero(registers.depth))


def count_samples(geometry: list[Geometry], registers: Registers) -> int:
    """Return how many pixels have a sample that is covered."""
    covered = np.zeros(registers.depth.shape, bool)
    for index, part in enumerate(geometry):
        if opacity_of(index, registers) == 0:
            continue
        for triangle in part.triangles:
            corners = [(triangle.a, triangle.b, triangle.c)]
            if part.object.flags & WIREFRAME:
                set_depths(triangle, registers)
                corners = [found for found, _ in samples.rectangles(triangle, registers)]
            for each in corners:
                for column, row, _ in samples.covered(*each, registers):
                    covered[row - registers.band_top, column - registers.column_begin] = True
    return int(np.count_nonzero(covered))


def set_depths(triangle: Triangle, registers: Registers) -> None:
    """Set what the spans of a triangle need, as if it were unlit."""
    r = registers
    r.mode = IS_CROSSING if triangle.outside else 0
    r.lane_bias = COLOR_BIAS
    r.attribute_0, r.attribute_1, r.attribute_2 = (v.attributes for v in (triangle.a, triangle.b, triangle.c))


def cover(spans: list[Span], registers: Registers) -> None:
    """Write the depths of fragments. Where several fragments cover a pixel, any of their depths may stay."""
    if spans:
        Fragments(spans, registers)
