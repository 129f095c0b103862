"""Set up the lights of a frame."""

from __future__ import annotations

from .extensions import SPOT, spot_numbers
from .registers import LightRecord, Registers
from .structs import POINT, Light
from .vector import normalize, subtract
from .view import View
from .words import color_lanes

#: The least difference of the cosine over which a spot light fades, 2^-10, Q24.
MIN_CONE = 1 << 14


def set_lights(view: View, lights: tuple[Light, ...], registers: Registers) -> None:
    """Set the lights in camera space."""
    registers.lights = []
    for index, light in enumerate(lights):
        is_point = light.kind == POINT
        v = view.to_camera(subtract(light.vector, view.eye) if is_point else normalize(light.vector))
        x, y, z = (component >> (16 if is_point else 8) for component in v)
        registers.lights.append(LightRecord(is_point, x, y, z, color=color_lanes(light.color)))
        if (SPOT, index) in registers.records:
            set_spot(view, registers.records[SPOT, index], registers.lights[-1])


def set_spot(view: View, content: bytes, record: LightRecord) -> None:
    """Set the cone of a light. Light that fades over less than 2^-10 of the cosine fades over 2^-10."""
    x, y, z, inner, outer = spot_numbers(content)
    record.axis_x, record.axis_y, record.axis_z = (part >> 8 for part in view.to_camera(normalize((x, y, z))))
    record.cos_outer = outer >> 8
    record.cone = max((inner >> 8) - record.cos_outer, MIN_CONE)
