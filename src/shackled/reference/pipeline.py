"""Render a scene, stage by stage."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from . import (
    compositor,
    effect_records,
    effects,
    primitive_assembly,
    rasterizer,
    samples,
    shadows,
    uniforms,
    vertex_shader,
    wireframe,
)
from .checks import check_scene
from .extensions import has_effects, is_antialiased, read_records
from .layout import IS_BLENDED, IS_DEPTH_PASS, IS_ORTHOGRAPHIC, PIXEL_BIAS
from .mesh import Mesh, open_mesh
from .primitive_assembly import Triangle
from .registers import Registers
from .structs import CULL_BACKFACES, WIREFRAME, Object, Rectangle, Scene
from .vertex_shader import Vertex
from .view import View


@dataclass(frozen=True)
class Picture:
    """A rendered tile.

    pixels: (height, width, 3) bytes, red, green, blue, rows from the top. triangles: how many survived culling and
    clipping. lit_pixels: how many pixels are covered by any.
    """

    pixels: NDArray[np.uint8]
    triangles: int
    lit_pixels: int


@dataclass(frozen=True)
class Geometry:
    """The output of vertex shader and primitive assembly for an object.

    vertices: the records of all vertices of the mesh. triangles: those to draw.
    """

    object: Object
    mesh: Mesh
    vertices: list[Vertex]
    triangles: list[Triangle]


def draw(scene: Scene, tile: Rectangle) -> Picture:
    """Draw a part of the canvas; raise Reverted where the contract refuses."""
    registers, view, geometry, triangles = assemble(scene, tile)
    if registers.has_effects:
        effects.set_frame(scene, view, registers)
    for blended in (False, True):
        compositor.begin(blended, scene, registers)
        if registers.antialiased and not blended:
            registers.sample_colors = np.repeat(registers.image[:, :, None], 4, axis=2)
        for index, part in enumerate(geometry):
            uniforms.set_object(view, scene, index, registers)
            registers.shadow_faces = registers.shadows.faces[index] if registers.shadows else []
            mode = registers.object_mode
            if (mode & IS_BLENDED != 0) != blended or registers.opacity == 0:
                continue
            if blended:
                # first find its nearest surface, then draw its colour
                registers.object_mode = (mode & IS_ORTHOGRAPHIC) | IS_DEPTH_PASS
                draw_object(part, registers)
                registers.object_mode = mode
            draw_object(part, registers)
    lit = registers.depth != 0
    if registers.antialiased:
        samples.resolve(registers)
        lit = (registers.sample_depths != 0).any(axis=2)
    pixels = registers.image[:, :, ::-1]
    return Picture(~pixels if scene.invert else pixels, triangles, int(np.count_nonzero(lit)))


def draw_object(part: Geometry, registers: Registers) -> None:
    """Draw the triangles of an object, or their edges."""
    is_wire = bool(part.object.flags & WIREFRAME)
    if registers.antialiased:
        samples.run(part.triangles, part.mesh, is_wire, registers)
    else:
        (wireframe if is_wire else rasterizer).run(part.triangles, part.mesh, registers)


def assemble(scene: Scene, tile: Rectangle) -> tuple[Registers, View, list[Geometry], int]:
    """Return registers, view and geometry before the first pixel is drawn, and the number of faces to draw."""
    check_scene(scene, tile)
    effect_records.check(records := read_records(scene.extensions), scene)
    registers = Registers(
        tile=tile,
        depth=np.zeros((tile.height, tile.width), np.uint64),
        image=np.zeros((tile.height, tile.width, 3), np.uint8),
        records=records,
        antialiased=is_antialiased(records),
        has_effects=has_effects(records),
        sample_depths=np.zeros((tile.height, tile.width, 4), np.uint64),
        sample_colors=np.zeros((tile.height, tile.width, 4, 3), np.uint8),
        band_top=tile.y + PIXEL_BIAS,
        band_bottom=tile.y + tile.height + PIXEL_BIAS,
    )
    view = uniforms.set_frame(scene, registers)
    if registers.has_effects:
        registers.shadows = shadows.cast(scene, view, registers)
    drawn = 0
    geometry = []
    distances: list[int] = []
    for index, obj in enumerate(scene.objects):
        mesh = open_mesh(obj.mesh)
        uniforms.set_object(view, scene, index, registers)
        vertices = vertex_shader.run(mesh, registers)
        if registers.antialiased:
            distances += vertex_shader.distances(mesh, registers)
        cull = bool(obj.flags & CULL_BACKFACES)
        triangles, count = primitive_assembly.run(mesh, vertices, cull, index, registers)
        # invisible objects are only checked
        drawn += count if registers.opacity else 0
        geometry.append(Geometry(obj, mesh, vertices, triangles))
    if registers.antialiased:
        samples.set_depths(distances, registers)
    return registers, view, geometry, drawn
