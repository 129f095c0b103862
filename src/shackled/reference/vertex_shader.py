"""From mesh to screen."""

from __future__ import annotations

from dataclasses import dataclass, field

from .mesh import Mesh
from .registers import GUARD_BITS, Registers
from .structs import Object
from .vector import Matrix, Vector, scale, subtract
from .view import View
from .words import MASK, divide, divide_signed, signed

#: Bit of a screen word: the triangle must be clipped. The next one: the vertex lies left or right of the tile.
MUST_CLIP = 1 << 40

#: Biases of the lanes of clip coordinates: x * distance and y * distance.
CLIP_BIAS = (1 << 95) | (1 << 191)
LANE_96 = (1 << 96) - 1


@dataclass(slots=True)
class Vertex:
    """The record of a vertex.

    word: the screen word, by which vertices are ordered: sub-pixel row in bits 128.., sub-pixel column in bits 64..83,
        flags in bits 40 and 41, number of the record.
    x, y: column and row. outside: whether the column is left or right of the tile.
    attributes: depth in bits 168.., red at 112, green at 56, blue at 0 (Q10); the outcode where `must_clip`.
    normal: in camera space, signed lanes of Q20 at bits 0, 85 and 170.
    The rest keeps what does not depend on the face.
    """

    word: int
    x: int
    y: int
    must_clip: bool
    outside: bool
    attributes: int
    normal: int = 0
    #: flat highlights: the length of the ray, Q24, and a denominator for each light
    ray_length: int = 0
    places: list[int] = field(default_factory=list)
    #: smooth shading with one light: normal and direction to the light, their lanes the other way round, the half
    #: vector, and that the other way round
    has_varyings: bool = False
    reversed: int = 0
    to_light: int = 0
    half: int = 0
    half_reversed: int = 0


def set_matrix(view: View, obj: Object, rotation: Matrix, registers: Registers) -> None:
    """Combines rotation, scale, position, camera and viewport into one affine map from the mesh to clip coordinates."""
    registers.matrix_x = clip_lanes(view, scale(view.to_camera(rotation[0]), obj.scale), 0)
    registers.matrix_y = clip_lanes(view, scale(view.to_camera(rotation[1]), obj.scale), 0)
    registers.matrix_z = clip_lanes(view, scale(view.to_camera(rotation[2]), obj.scale), 0)
    registers.matrix_t = clip_lanes(view, view.to_camera(subtract(obj.position, view.eye)), 1 << 32) + CLIP_BIAS


def clip_lanes(view: View, v: Vector, w: int) -> int:
    """One column of the map; `w` is its last coordinate."""
    if not view.orthographic:
        w = v[2]
    x = ((view.focal * v[0]) >> 32) + ((view.center_x * w) >> 1)
    y = ((view.focal * v[1]) >> 32) + ((view.center_y * w) >> 1)
    return x + (y << 96) + (v[2] << 192)


def set_normal_matrix(view: View, rotation: Matrix, registers: Registers) -> None:
    """The rotation of normals into camera space, divided by the 511 of the mesh format."""
    registers.normal_x = normal_lanes(view.to_camera(rotation[0]))
    registers.normal_y = normal_lanes(view.to_camera(rotation[1]))
    registers.normal_z = normal_lanes(view.to_camera(rotation[2]))


def normal_lanes(v: Vector) -> int:
    """A vector as lanes of Q20."""
    x, y, z = (divide_signed(component, 4096 * 511) for component in v)
    return x + (y << 85) + (z << 170)


def run(mesh: Mesh, smooth: bool, registers: Registers) -> list[Vertex]:
    """The records of all vertices of a mesh."""
    vertices = project(mesh, registers)
    if smooth and mesh.normals is not None:
        for vertex, (x, y, z) in zip(vertices, mesh.normals, strict=True):
            vertex.normal = (x * registers.normal_x + y * registers.normal_y + z * registers.normal_z) & MASK
    return vertices


def project(mesh: Mesh, registers: Registers) -> list[Vertex]:
    """The places of the vertices on the screen, their depths and colours."""
    vertices = []
    near, orthographic, depth_scale = registers.near, registers.frame_is_orthographic, registers.depth_scale
    for number, (position, (red, green, blue)) in enumerate(zip(mesh.positions, mesh.colors, strict=True)):
        clip = clip_of(position, registers)
        distance = signed(clip) >> 192
        if orthographic:
            divisor = 1 << 32
            depth = depth_scale - (distance >> 8)
        else:
            divisor = distance
            depth = divide(depth_scale, distance)
        clip_x = (clip & LANE_96) - (1 << 95)
        clip_y = ((clip >> 96) & LANE_96) - (1 << 95)
        x, y = divide(clip_x, divisor), divide(clip_y, divisor)
        if distance >= near and (x | y) >> GUARD_BITS == 0:
            color = (red << 122) | (green << 66) | (blue << 10)
            vertices.append(screen_vertex(x, y, number, (depth << 168) | color, registers))
        else:
            # outcode: nearer than the near plane, left, right, above, below the guard band
            divisor <<= GUARD_BITS
            outcode = (
                (distance < near)
                | (clip_x < 0) << 1
                | (clip_x >= divisor) << 2
                | (clip_y < 0) << 3
                | (clip_y >= divisor) << 4
            )
            vertices.append(Vertex(MUST_CLIP | number, 0, 0, True, False, outcode))
    return vertices


def screen_vertex(x: int, y: int, number: int, attributes: int, registers: Registers) -> Vertex:
    """The record of a vertex inside the guard band."""
    outside = (x - registers.tile_left) & MASK > registers.tile_span
    return Vertex((y << 128) | (x << 64) | (outside << 41) | number, x, y, False, outside, attributes)


def clip_coordinates(mesh: Mesh, number: int, registers: Registers) -> tuple[int, int, int, int]:
    """The clip coordinates and the colour of a vertex."""
    clip = clip_of(mesh.positions[number], registers)
    red, green, blue = mesh.colors[number]
    x, y = (clip & LANE_96) - (1 << 95), ((clip >> 96) & LANE_96) - (1 << 95)
    return x, y, signed(clip) >> 192, (red << 122) | (green << 66) | (blue << 10)


def clip_of(position: list[int], registers: Registers) -> int:
    """The clip coordinates of a vertex, Q32: x * distance and y * distance (96 bits each, biased), distance."""
    x, y, z = position
    clip = x * registers.matrix_x + y * registers.matrix_y + z * registers.matrix_z + registers.matrix_t
    return clip & MASK
