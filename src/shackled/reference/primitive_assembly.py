"""Assemble the triangles to draw from vertices and faces: those that face the viewer (or all), clipped at the guard
band.
"""

from __future__ import annotations

from typing import NamedTuple

from . import clipper
from .layout import SCREEN_PIXEL_ROW_AT
from .mesh import Mesh
from .registers import Registers
from .scene_errors import Reverted
from .vertex_shader import BESIDE, Vertex

ALL_EDGES = 7


class Triangle(NamedTuple):
    """A triangle on the screen.

    a, b, c: counter-clockwise on the screen, the topmost first.
    top, bottom: the first row that may be covered, and the row after the last.
    face: number of the face in its mesh.
    edges: which edges belong to the face, the sum of 1 (a to b), 2 (b to c) and 4 (c to a).
    outside: whether it reaches beyond the left or right border of the tile.
    turned_away: whether its back is seen.
    """

    a: Vertex
    b: Vertex
    c: Vertex
    top: int
    bottom: int
    face: int
    edges: int
    outside: bool
    turned_away: bool


def run(mesh: Mesh, vertices: list[Vertex], cull: bool, index: int, registers: Registers) -> tuple[list[Triangle], int]:
    """Return the triangles to draw, and the number of faces to draw.

    A face is to be drawn if a triangle that clipping leaves of it faces the viewer, or both sides are drawn, and does
    not lie beyond one border of the tile.
    """
    triangles: list[Triangle] = []
    clipped = []
    drawn = 0
    for face, numbers in enumerate(mesh.faces):
        if max(numbers) >= len(vertices):
            raise Reverted("IndexOutOfRange", object=index, face=face, vertexCount=len(vertices))
        a, b, c = (vertices[number] for number in numbers)
        if a.must_clip or b.must_clip or c.must_clip:
            clipped.append(face)
            continue
        drawn += append(triangles, a, b, c, ALL_EDGES, face, cull, registers)
    for face in clipped:
        corners, is_outside = clipper.read_face(mesh, vertices, face, registers)
        if is_outside:
            continue
        corners = clipper.cut(corners, registers)
        if len(corners) < 3:
            continue
        # numbers only order vertices at the same place, so they may continue in later polygons
        fan = [clipper.project(corner, len(vertices) + i, registers) for i, corner in enumerate(corners)]
        is_drawn = False
        for i in range(1, len(fan) - 1):
            edges = corners[i].is_edge << 1
            if i == 1:
                edges |= corners[0].is_edge
            if i == len(fan) - 2:
                edges |= corners[i + 1].is_edge << 2
            is_drawn |= append(triangles, fan[0], fan[i], fan[i + 1], edges, face, cull, registers)
        drawn += is_drawn
    return triangles, drawn


def append(
    triangles: list[Triangle], a: Vertex, b: Vertex, c: Vertex, edges: int, face: int, cull: bool, registers: Registers
) -> bool:
    """Append a triangle to the list, if it is to be drawn and may cover a row; return whether it is to be drawn."""
    area = area_of(a, b, c)
    if area == 0 or (cull and area < 0) or a.outside & b.outside & c.outside:
        return False
    if area < 0:
        b, c = c, b
        edges = (edges >> 2) | (edges & 2) | ((edges & 1) << 2)
    # the topmost first, without changing the sense of rotation
    while a.word > b.word or a.word > c.word:
        a, b, c = b, c, a
        edges = (edges >> 1) | ((edges & 1) << 2)
    top = (a.word + registers.round_top) >> SCREEN_PIXEL_ROW_AT
    bottom = (max(b.word, c.word) + registers.round_bottom) >> SCREEN_PIXEL_ROW_AT
    if top < bottom:
        beside = (a.outside | b.outside | c.outside) & BESIDE != 0
        triangles.append(Triangle(a, b, c, top, bottom, face, edges, beside, area < 0))
    return True


def area_of(a: Vertex, b: Vertex, c: Vertex) -> int:
    """Return twice the area of a triangle on the screen, positive if it faces the viewer."""
    return (c.x - a.x) * (b.y - a.y) - (b.x - a.x) * (c.y - a.y)
