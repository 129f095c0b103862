"""Set up position and projection of the camera.

Camera space is x to the right, y down, z forward, as the rows of a picture run.
"""

from __future__ import annotations

from dataclasses import dataclass

from .layout import PIXEL_BIAS
from .registers import Registers
from .roots import sqrt
from .scene_errors import Reverted
from .structs import ORTHOGRAPHIC, Camera
from .vector import Vector, cross, dot, normalize, subtract
from .words import divide_signed


@dataclass(frozen=True)
class View:
    """The camera.

    focal: sub-pixels per unit at distance 1 (perspective) or per unit (orthographic), Q32. center_x, center_y: twice
    the sub-pixel place of the middle of the canvas, plus one half to round.
    """

    eye: Vector
    right: Vector
    down: Vector
    forward: Vector
    orthographic: bool
    focal: int
    center_x: int
    center_y: int

    def to_camera(self, v: Vector) -> Vector:
        """Return a direction in camera space."""
        return dot(self.right, v), dot(self.down, v), dot(self.forward, v)


def look_at(camera: Camera, width: int, height: int, registers: Registers) -> View:
    """Return the basis of the camera, and set the registers that depend only on camera and canvas."""
    forward = normalize(subtract(camera.target, camera.eye))
    right = normalize(cross(forward, normalize(camera.up)))
    if not any(right):
        raise Reverted("NoViewDirection")
    orthographic = camera.projection == ORTHOGRAPHIC
    view = View(
        eye=camera.eye,
        right=right,
        down=cross(forward, right),
        forward=forward,
        orthographic=orthographic,
        focal=(height << 71) // camera.half_height,
        center_x=2 * (width * 128 + PIXEL_BIAS * 256 - 128) + 1,
        center_y=2 * (height * 128 + PIXEL_BIAS * 256 - 128) + 1,
    )
    registers.frame_is_orthographic = orthographic
    registers.near = camera.near
    registers.depth_scale = 1 << 54 if orthographic else camera.near << 54
    set_rays(view, width, height, registers)
    return view


def set_rays(view: View, width: int, height: int, registers: Registers) -> None:
    """Set the ray through the centre of a pixel, and the constants for its length."""
    # where all rays are parallel, places in world units (Q32) instead
    step = (1 << 72 if view.orthographic else 1 << 64) // view.focal
    registers.ray_step = step
    registers.ray_left = divide_signed((1 - (width + 2 * PIXEL_BIAS)) * step, 2)
    registers.ray_top = divide_signed((1 - (height + 2 * PIXEL_BIAS)) * step, 2)
    if view.orthographic:
        step = 0

    # the chord between the middle and the corner of the canvas, raised by half its largest error
    one = 1 << 24
    x, y = width * step // 2, height * step // 2
    square = one * one + x * x + y * y
    corner = sqrt(square)
    slope = ((corner - one) << 48) // (square - one * one + 1)
    raised = (corner - one) * (corner - one) // (8 * (corner + one))
    registers.length_slope = slope
    registers.length_at_0 = one - slope + raised
    registers.length_steps = 0 if corner < 21810380 else 1 if corner < 41943040 else 2 if corner < 100663296 else 12
