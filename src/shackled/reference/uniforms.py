"""Compute what is constant for a frame or an object, before the engine draws."""

from __future__ import annotations

from . import effects, ground, lights, materials, mesh_space, transform
from .extensions import OPACITY, OPAQUE
from .layout import IS_BLENDED, IS_ORTHOGRAPHIC, IS_SMOOTH, PIXEL_BIAS
from .opacities import OPACITIES
from .registers import Registers
from .structs import UNLIT, WIREFRAME, Scene
from .texture import TEXTURE
from .vector import to_matrix
from .view import View, look_at


def set_frame(scene: Scene, registers: Registers) -> View:
    """Set the registers of the frame."""
    tile = registers.tile
    registers.column_begin = tile.x + PIXEL_BIAS
    registers.column_end = tile.x + tile.width + PIXEL_BIAS
    view = look_at(scene.camera, scene.canvas.width, scene.canvas.height, registers)
    lights.set_lights(view, scene.lights, registers)
    return view


def set_object(view: View, scene: Scene, index: int, registers: Registers) -> None:
    """Set the registers of an object."""
    obj = scene.objects[index]
    registers.opacity = registers.object_opacity = opacity_of(index, registers)
    registers.opacities = registers.records.get((OPACITIES, index))
    registers.texture = registers.records.get((TEXTURE, index))
    rotation = to_matrix(obj.rotation)
    transform.set_matrix(view, obj, rotation, registers)
    transform.set_rounding(registers.tile, bool(obj.flags & WIREFRAME), registers)
    mode = IS_ORTHOGRAPHIC if view.orthographic else 0
    if registers.opacity != OPAQUE or registers.opacities is not None:
        mode |= IS_BLENDED
    if obj.material.shading != UNLIT:
        mode |= materials.set_material(view, scene, obj.material, registers)
        if mode & IS_SMOOTH:
            transform.set_normal_matrix(view, rotation, registers)
        else:
            mesh_space.set_mesh_space(view, scene, obj, rotation, registers)
        if registers.has_effects:
            effects.set_object(scene, obj.material, rotation, registers)
    registers.object_mode = mode
    if registers.has_effects:
        ground.set_object(index, registers)


def opacity_of(index: int, registers: Registers) -> int:
    """Return the opacity of an object, Q24."""
    content = registers.records.get((OPACITY, index))
    return OPAQUE if content is None else int.from_bytes(content, "big")
