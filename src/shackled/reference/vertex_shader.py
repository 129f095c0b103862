"""Transform the vertices of a mesh to the screen."""

from __future__ import annotations

from dataclasses import dataclass, field

from . import layout
from .mesh import Mesh
from .registers import Registers
from .words import MASK, divide, signed

#: Bits of a screen word: the vertex lies left of the tile, right of it, above it, below it.
OUTSIDE_SHIFT = layout.IS_LEFT.bit_length() - 1
#: Of those, shifted down: left or right.
BESIDE = layout.IS_BESIDE >> OUTSIDE_SHIFT


@dataclass(frozen=True, slots=True)
class SmoothVertex:
    """The values of a vertex for smooth shading with one light: see `smooth_light`.

    Normal and direction to the light with reversed lanes, the half vector, and the same reversed. is_open: whether the
    square of the sum of the directions to light and eye is at least 3.
    """

    is_bounded: bool
    is_open: bool
    reversed: int
    light: int
    half: int
    half_reversed: int


@dataclass(slots=True)
class Vertex:
    """The record of a vertex.

    word: the screen word, by which vertices are ordered: sub-pixel row in bits 128.., sub-pixel column in bits 64..83,
        flags in bits 40 to 44, number of the record.
    x, y: column and row. outside: whether it is left (1), right (2) of, above (4), below (8) the tile.
    attributes: depth in bits 168.., red at 112, green at 56, blue at 0 (Q10); the outcode where `must_clip`.
    normal: in camera space, signed lanes of Q20 at bits 0, 85 and 170.
    The rest keeps what does not depend on the face.
    """

    word: int
    x: int
    y: int
    must_clip: bool
    outside: int
    attributes: int
    normal: int = 0
    #: flat highlights: half vector in the space of the mesh, Q32, and its square, Q40, for each light
    halves: list[tuple[int, int]] = field(default_factory=list)
    smooth: SmoothVertex | None = None


def run(mesh: Mesh, registers: Registers) -> list[Vertex]:
    """Return the records of all vertices of a mesh."""
    vertices = project(mesh, registers)
    if registers.object_mode & layout.IS_SMOOTH and mesh.normals is not None:
        for vertex, (x, y, z) in zip(vertices, mesh.normals, strict=True):
            vertex.normal = (x * registers.normal_x + y * registers.normal_y + z * registers.normal_z) & MASK
    return vertices


def project(mesh: Mesh, registers: Registers) -> list[Vertex]:
    """Return the vertices with their positions on the screen, depths and colours."""
    vertices = []
    near, orthographic, depth_scale = registers.near, registers.frame_is_orthographic, registers.depth_scale
    for number, (position, (red, green, blue)) in enumerate(zip(mesh.positions, mesh.colors, strict=True)):
        clip = clip_of(position, registers)
        distance = signed(clip) >> layout.CLIP_W_AT
        if orthographic:
            divisor = 1 << 32
            depth = depth_scale - (distance >> 8)
        else:
            divisor = distance
            depth = divide(depth_scale, distance)
        clip_x = (clip & layout.CLIP_X_MASK) - layout.CLIP_HALF
        clip_y = ((clip >> layout.CLIP_Y_AT) & layout.CLIP_Y_MASK) - layout.CLIP_HALF
        x, y = divide(clip_x, divisor), divide(clip_y, divisor)
        if distance >= near and (x | y) >> layout.GUARD_BITS == 0:
            color = (red << 122) | (green << 66) | (blue << 10)
            vertices.append(screen_vertex(x, y, number, (depth << layout.ATTRIBUTE_DEPTH_AT) | color, registers))
        else:
            # outcode: nearer than the near plane, left, right, above, below the guard band
            divisor <<= layout.GUARD_BITS
            outcode = (
                (distance < near)
                | (clip_x < 0) << 1
                | (clip_x >= divisor) << 2
                | (clip_y < 0) << 3
                | (clip_y >= divisor) << 4
            )
            vertices.append(Vertex(layout.MUST_CLIP | number, 0, 0, True, 0, outcode))
    return vertices


def screen_vertex(x: int, y: int, number: int, attributes: int, registers: Registers) -> Vertex:
    """Return the record of a vertex inside the guard band."""
    left, top = registers.tile_left, registers.tile_top
    outside = (x < left) | (x > left + registers.tile_span) << 1
    outside |= (y < top) << 2 | (y > top + registers.tile_rows) << 3
    return Vertex(
        (y << layout.SCREEN_ROW_AT) | (x << layout.SCREEN_COLUMN_AT) | (outside << OUTSIDE_SHIFT) | number,
        x,
        y,
        False,
        outside,
        attributes,
    )


def clip_coordinates(mesh: Mesh, number: int, registers: Registers) -> tuple[int, int, int, int]:
    """Return the clip coordinates and the colour of a vertex."""
    clip = clip_of(mesh.positions[number], registers)
    red, green, blue = mesh.colors[number]
    x, y = (
        (clip & layout.CLIP_X_MASK) - layout.CLIP_HALF,
        ((clip >> layout.CLIP_Y_AT) & layout.CLIP_Y_MASK) - layout.CLIP_HALF,
    )
    return x, y, signed(clip) >> layout.CLIP_W_AT, (red << 122) | (green << 66) | (blue << 10)


def distances(mesh: Mesh, registers: Registers) -> list[int]:
    """Return how far each vertex is before the camera, Q32."""
    return [signed(clip_of(position, registers)) >> layout.CLIP_W_AT for position in mesh.positions]


def clip_of(position: list[int], registers: Registers) -> int:
    """Return the clip coordinates of a vertex, Q32: x * distance and y * distance (96 bits each, biased), distance."""
    x, y, z = position
    clip = x * registers.matrix_x + y * registers.matrix_y + z * registers.matrix_z + registers.matrix_t
    return clip & MASK
