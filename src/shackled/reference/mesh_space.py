"""Set up the space of a mesh, in which flat faces are lit, since their corners are small integers there."""

from __future__ import annotations

from .layout import MIDDLE_86_AT, UPPER_86_AT
from .registers import Registers
from .structs import POINT, Object, Scene
from .vector import Matrix, Vector, normalize, subtract, transposed_times
from .view import View
from .words import divide_signed

#: The scale that makes Q24 of a unit vector in the space of the mesh.
DIRECTION = 1 << 40


def set_mesh_space(view: View, scene: Scene, obj: Object, rotation: Matrix, registers: Registers) -> None:
    """Set scale, eye and lights in the space of the mesh."""
    if obj.scale == 0:
        return
    registers.scale = obj.scale
    if not view.orthographic:
        registers.scale_per_near = divide_signed(obj.scale << 64, registers.near)

    def to_mesh(v: Vector, scale: int) -> Vector:
        x, y, z = transposed_times(rotation, v)
        return divide_signed(x << 32, scale), divide_signed(y << 32, scale), divide_signed(z << 32, scale)

    def lanes(v: Vector) -> int:
        """Return a unit vector, Q24, in signed lanes of 86 bits, z lowest."""
        x, y, z = transposed_times(rotation, v)
        return (x >> 8 << UPPER_86_AT) + (y >> 8 << MIDDLE_86_AT) + (z >> 8)

    registers.normal_x, registers.normal_y, registers.normal_z = map(lanes, (view.right, view.down, view.forward))
    if view.orthographic:
        eye = to_mesh(view.forward, DIRECTION)
    else:
        eye = to_mesh(subtract(view.eye, obj.position), obj.scale)
    registers.eye_x, registers.eye_y, registers.eye_z = eye
    for record, light in zip(registers.lights, scene.lights, strict=True):
        if light.kind == POINT:
            v = to_mesh(subtract(light.vector, obj.position), obj.scale)
            record.mesh_x, record.mesh_y, record.mesh_z = v
        else:
            record.mesh_lanes = lanes(normalize(light.vector))
