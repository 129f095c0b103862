"""A picture from a scene, stage by stage."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from . import lighting, primitive_assembly, rasterizer, vertex_shader, wireframe
from .checks import check_scene
from .compositor import background
from .mesh import Mesh, open_mesh
from .primitive_assembly import Triangle
from .registers import PIXEL_BIAS, Registers
from .structs import CULL_BACKFACES, SMOOTH, WIREFRAME, Object, Rectangle, Scene
from .vector import to_matrix
from .vertex_shader import Vertex
from .view import View, look_at


@dataclass(frozen=True)
class Picture:
    """What was drawn.

    pixels: (height, width, 3) bytes, red, green, blue, rows from the top.
    triangles: how many survived culling and clipping. lit_pixels: how many pixels are covered by any.
    """

    pixels: NDArray[np.uint8]
    triangles: int
    lit_pixels: int


@dataclass(frozen=True)
class Geometry:
    """What vertex shader and primitive assembly make of an object.

    vertices: the records of all vertices of the mesh. triangles: those to draw.
    """

    object: Object
    mesh: Mesh
    vertices: list[Vertex]
    triangles: list[Triangle]


def draw(scene: Scene, tile: Rectangle) -> Picture:
    """Draws a part of the canvas. Raises Reverted where the contract refuses."""
    registers, view, geometry, triangles = assemble(scene, tile)
    for part in geometry:
        lighting.set_object(view, scene, part.object, to_matrix(part.object.rotation), registers)
        stage = wireframe if part.object.flags & WIREFRAME else rasterizer
        stage.run(part.triangles, part.mesh, registers)
    pixels = registers.image[:, :, ::-1]
    return Picture(~pixels if scene.invert else pixels, triangles, int(np.count_nonzero(registers.depth)))


def assemble(scene: Scene, tile: Rectangle) -> tuple[Registers, View, list[Geometry], int]:
    """What there is before the first pixel is drawn, and the number of faces of which something is to be drawn."""
    check_scene(scene, tile)
    registers = Registers(
        tile=tile,
        depth=np.zeros((tile.height, tile.width), np.uint64),
        image=background(scene.background_top, scene.background_bottom, scene.canvas.height, tile),
        column_begin=tile.x + PIXEL_BIAS,
        column_end=tile.x + tile.width + PIXEL_BIAS,
        band_top=tile.y + PIXEL_BIAS,
        band_bottom=tile.y + tile.height + PIXEL_BIAS,
    )
    view = look_at(scene.camera, scene.canvas.width, scene.canvas.height, registers)
    lighting.set_lights(view, scene.lights, registers)
    drawn = 0
    geometry = []
    for index, obj in enumerate(scene.objects):
        mesh = open_mesh(obj.mesh)
        rotation = to_matrix(obj.rotation)
        vertex_shader.set_matrix(view, obj, rotation, registers)
        vertex_shader.set_normal_matrix(view, rotation, registers)
        set_rounding(tile, bool(obj.flags & WIREFRAME), registers)
        vertices = vertex_shader.run(mesh, obj.material.shading == SMOOTH, registers)
        cull = bool(obj.flags & CULL_BACKFACES)
        triangles, count = primitive_assembly.run(mesh, vertices, cull, index, registers)
        drawn += count
        geometry.append(Geometry(obj, mesh, vertices, triangles))
    return registers, view, geometry, drawn


def set_rounding(tile: Rectangle, wireframe: bool, registers: Registers) -> None:
    """Which rows and columns a vertex touches.

    For a face these are the pixel centres from it on, for a line the pixels nearest to it.
    """
    left, right = (tile.x + PIXEL_BIAS) << 8, (tile.x + tile.width + PIXEL_BIAS) << 8
    registers.tile_left = left - 128 if wireframe else left - 255
    registers.tile_span = right - left - 1 if wireframe else right - left + 255
    registers.round_top = (128 if wireframe else 255) << 128
    registers.round_bottom = (128 + 256 if wireframe else 255) << 128
