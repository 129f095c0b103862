"""Set up the effects of a scene: hemisphere light, rim, fog and tone."""

from __future__ import annotations

from . import gamma
from .effect_records import FOG, HEMISPHERE, RIM, TONE, TONE_GAMMA, fog_distances
from .layout import MIDDLE_86_AT, UPPER_86_AT
from .registers import Registers
from .structs import Material, Scene
from .vector import Matrix, transposed_times
from .view import View
from .words import color_lanes

#: A lane of Q10.
LANE_24 = 0xFFFFFF

#: The y axis of the world.
UP = (0, 1 << 32, 0)


def set_frame(scene: Scene, view: View, r: Registers) -> None:
    """Set the registers of the frame."""
    if content := r.records.get((TONE, 0)):
        r.exposure, r.tone_flags = int.from_bytes(content[:4], "big"), content[4]
    if content := r.records.get((RIM, 0)):
        r.rim_color, r.rim_power = light_of(color_of(content), r), content[3]
    if content := r.records.get((FOG, 0)):
        r.fog_color = color_lanes(color_of(content))
        r.fog_near, far = fog_distances(content)
        r.fog_range = far - r.fog_near
    for record, light in zip(r.lights, scene.lights, strict=True):
        record.color = light_of(light.color, r)
    if r.shadows:
        r.shadow_color = r.lights[r.shadows.light].color
    r.up_x, r.up_y, r.up_z = (part >> 8 for part in view.to_camera(UP))


def set_object(scene: Scene, material: Material, rotation: Matrix, r: Registers) -> None:
    """Set the registers of an object that is lit."""
    x, y, z = transposed_times(rotation, UP)
    r.up_in_mesh = (x >> 8 << UPPER_86_AT) + (y >> 8 << MIDDLE_86_AT) + (z >> 8)
    r.ambient = scaled(light_of(scene.ambient_light, r), material.ambient)
    for record, light in zip(r.lights, scene.lights, strict=True):
        record.diffuse = scaled(light_of(light.color, r), material.diffuse)
    if r.shadows:
        r.lights[r.shadows.light].color = r.shadow_color
        r.shadow_diffuse = r.lights[r.shadows.light].diffuse
    if content := r.records.get((HEMISPHERE, 0)):
        sky, ground = (light_of(color_of(part), r) for part in (content, content[3:]))
        r.hemisphere_sky, r.hemisphere_ground = scaled(sky, material.ambient), scaled(ground, material.ambient)


def color_of(content: bytes) -> int:
    """Return the colour at the beginning of a content, 0xRRGGBB."""
    return int.from_bytes(content[:3], "big")


def light_of(color: int, r: Registers) -> int:
    """Return the colour of a light as it is added up, lanes of Q10: decoded from sRGB if light is linear."""
    lanes = color_lanes(color) << 10
    if r.tone_flags & TONE_GAMMA == 0:
        return lanes
    return sum(gamma.decode(lanes >> at & LANE_24) << at for at in (0, 56, 112))


def scaled(light: int, coefficient: int) -> int:
    """Multiply lanes of Q10 by a coefficient (Q32): lanes of Q16 where 255 is one."""
    return sum((light >> at & LANE_24) * (coefficient >> 16) // (255 << 10) << at for at in (0, 56, 112))
