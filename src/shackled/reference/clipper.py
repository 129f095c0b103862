"""Cut triangles that leave the guard band or reach behind the near plane, in homogeneous coordinates.

Source: I. Sutherland, G. Hodgman, "Reentrant polygon clipping", Communications of the ACM 17 (1974).

An edge is always cut from its inner end, and each end is put on the same side of a plane in all faces, so that faces
that share an edge share the cut as well.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from .layout import GUARD_BITS, LANES_24, SCREEN_RECORD_MASK
from .mesh import Mesh
from .registers import Registers
from .vertex_shader import Vertex, clip_coordinates, screen_vertex
from .words import MASK, divide_signed

#: Near, left, right, top, bottom.
PLANES = 5
#: Each plane adds one corner at most to the three of a face.
MAX_CORNERS = 8

#: A bias that keeps the lanes of a normal positive, and the lanes that remain when 32 bits are dropped.
NORMAL_LANES_BIAS = 0x40000000000000000000020000000000000000000010000000000
NORMAL_LANES = 0xFFFFFFFFFFFFFC00000003FFFFFFFFFFFFE00000001FFFFFFFFFFFFF


@dataclass(slots=True)
class Corner:
    """A corner of a polygon.

    x, y, w: clip coordinates, Q32. color: lanes of Q10. normal: as in a vertex. is_edge: whether the edge to the next
    corner is an edge of the face, not of a cut.
    """

    x: int
    y: int
    w: int
    color: int
    normal: int
    is_edge: bool


def read_face(mesh: Mesh, vertices: list[Vertex], face: int, registers: Registers) -> tuple[list[Corner], bool]:
    """Return the three corners of a face, and whether the whole face lies beyond one plane."""
    outcodes = 0b11111
    corners = []
    for number in mesh.faces[face]:
        vertex = vertices[number]
        outcodes &= vertex.attributes if vertex.must_clip else 0
        corners.append(Corner(*clip_coordinates(mesh, number, registers), vertex.normal, True))
    return corners, outcodes != 0


def cut(corners: list[Corner], registers: Registers) -> list[Corner]:
    """Return the polygon of a triangle within all planes."""
    for plane in range(PLANES):
        kept = []
        distances = [distance_inside(corner, plane, registers) for corner in corners]
        for i, corner in enumerate(corners):
            following = (i + 1) % len(corners)
            distance, next_distance = distances[i], distances[following]
            if distance >= 0:
                kept.append(replace(corner))
            if (distance < 0) != (next_distance < 0):
                if distance < 0:
                    new = intersect(corners[following], corner, next_distance, distance)
                else:
                    new = intersect(corner, corners[following], distance, next_distance)
                # after an entry the rest of the edge follows, after an exit the edge of the cut
                new.is_edge = corner.is_edge if distance < 0 else False
                if plane == 0:
                    new.w = registers.near
                kept.append(new)
        corners = kept[:MAX_CORNERS]
    return corners


def distance_inside(corner: Corner, plane: int, registers: Registers) -> int:
    """Return a measure of the distance from a plane, which is not negative inside."""
    if plane == 0:
        return corner.w - registers.near
    value = corner.x if plane < 3 else corner.y
    if plane & 1:
        return value
    return (divisor(corner.w, registers) << GUARD_BITS) - value - 1


def divisor(w: int, registers: Registers) -> int:
    """Return the divisor of clip coordinates."""
    return 1 << 32 if registers.frame_is_orthographic else w


def intersect(inside: Corner, outside: Corner, inner: int, outer: int) -> Corner:
    """Return the point between two corners where the distance is zero."""
    whole = inner - outer

    def between(a: int, b: int) -> int:
        return a + divide_signed((b - a) * inner, whole)

    # colours and normals keep 32 more bits until the sum is made
    part = (inner << 32) // whole
    color = (inside.color << 32) + (outside.color - inside.color) * part
    normal = (inside.normal << 32) + (outside.normal - inside.normal) * part + (NORMAL_LANES_BIAS << 32)
    return Corner(
        between(inside.x, outside.x),
        between(inside.y, outside.y),
        between(inside.w, outside.w),
        (color >> 32) & LANES_24,
        ((((normal & MASK) >> 32) & NORMAL_LANES) - NORMAL_LANES_BIAS) & MASK,
        False,
    )


def project(corner: Corner, number: int, registers: Registers) -> Vertex:
    """Return the vertex of a corner."""
    w = corner.w
    x = in_guard_band(divide_signed(corner.x, divisor(w, registers)))
    y = in_guard_band(divide_signed(corner.y, divisor(w, registers)))
    depth = registers.depth_scale - (w >> 8) if registers.frame_is_orthographic else registers.depth_scale // w
    vertex = screen_vertex(x, y, number, (depth << 168) | corner.color, registers)
    vertex.normal = corner.normal
    return vertex


def value_of(
    vertex: Vertex, face: int, mesh: Mesh, read: Callable[[int], tuple[int, ...]], registers: Registers
) -> tuple[int, ...]:
    """Return what a vertex has, in whole numbers: what is read of it, or where it is new, since its face was clipped,
    what that place of the face has.

    With the clip coordinates P of the vertices of the face, (x, y, 1) of the place is a multiple of their sum with the
    weights e0 = det((x, y, 1), P1, P2), e1 = det((x, y, 1), P2, P0), e2 = det((x, y, 1), P0, P1).
    """
    number = vertex.word & SCREEN_RECORD_MASK
    if number < len(mesh.positions):
        return read(number)
    corners = []
    for each in mesh.faces[face]:
        x, y, w, _ = clip_coordinates(mesh, each, registers)
        corners.append((x, y, divisor(w, registers)))
    weights = [determinant(vertex.x, vertex.y, corners[(i + 1) % 3], corners[(i + 2) % 3]) for i in range(3)]
    total = sum(weights)
    places = zip(*(read(each) for each in mesh.faces[face]), strict=True)
    sums = (sum(w * value for w, value in zip(weights, values, strict=True)) for values in places)
    return tuple(divide_signed(each, total) if total else 0 for each in sums)


def determinant(x: int, y: int, p: tuple[int, int, int], q: tuple[int, int, int]) -> int:
    """Return det((x, y, 1), p, q)."""
    (px, py, pw), (qx, qy, qw) = p, q
    return x * (py * qw - pw * qy) - y * (px * qw - pw * qx) + px * qy - py * qx


def in_guard_band(value: int) -> int:
    """Clamp a coordinate to the guard band, since rounding may put a point on the border a little outside."""
    return min(max(value, 0), (1 << GUARD_BITS) - 1)
