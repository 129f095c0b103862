"""Check and set up the effects of a scene: hemisphere light, rim, fog and tone."""

from __future__ import annotations

from . import gamma
from .extensions import MAX_COORDINATE, Records
from .layout import MIDDLE_86_AT, UPPER_86_AT
from .materials import scaled
from .opacities import OPACITIES, check_opacities
from .registers import Registers
from .scene_errors import Reverted
from .structs import Material, Scene
from .texture import TEXTURE, check_texture
from .vector import Matrix, transposed_times
from .view import View
from .words import color_lanes

#: Kinds of records of the scene, and the sizes of their contents.
HEMISPHERE, RIM, FOG, TONE = 4, 5, 6, 7
#: Kinds of records that `shadows` checks: of the light that casts shadows, and of objects that cast none and fade.
SHADOW, GROUND = 10, 11
SIZES = {HEMISPHERE: 6, RIM: 4, FOG: 19, TONE: 5}
#: Flags of a TONE: the filmic curve; light is added up in linear values.
TONE_FILMIC, TONE_GAMMA = 1, 2
#: The greatest power of a RIM, and the greatest exposure of a TONE, Q16.
MAX_RIM_POWER, MAX_EXPOSURE = 16, 64 << 16
#: The y axis of the world.
UP = (0, 1 << 32, 0)


def has_shadows(records: Records) -> bool:
    """Return whether the contract Shadows is called."""
    return any(kind >= SHADOW for kind, _ in records)


def check_effects(records: Records, scene: Scene) -> None:
    """Check the records of effects."""
    for (kind, index), content in records.items():
        if kind < HEMISPHERE or kind in (SHADOW, GROUND):
            continue
        if kind == TEXTURE:
            check_texture(content, index, scene)
            continue
        if kind == OPACITIES:
            check_opacities(content, index, scene)
            continue
        if kind not in SIZES:
            raise Reverted("UnknownExtension", kind=kind, index=index)
        if len(content) != SIZES[kind]:
            raise Reverted("ExtensionSize", kind=kind, index=index, expected=SIZES[kind], actual=len(content))
        if index:
            raise Reverted("ExtensionIndex", kind=kind, index=index, count=1)
        if kind == RIM and not 1 <= content[3] <= MAX_RIM_POWER:
            raise Reverted("RimPowerOutOfRange", power=content[3])
        if kind == FOG:
            near, far = fog_distances(content)
            if not 0 <= near < far <= MAX_COORDINATE:
                raise Reverted("FogOutOfRange", near=near, far=far)
        if kind == TONE:
            exposure, flags = int.from_bytes(content[:4], "big"), content[4]
            if not 0 < exposure <= MAX_EXPOSURE:
                raise Reverted("ExposureOutOfRange", exposure=exposure)
            if flags > TONE_FILMIC | TONE_GAMMA:
                raise Reverted("UnknownToneFlags", flags=flags)


def set_frame(scene: Scene, view: View, r: Registers) -> None:
    """Check the records, and set the registers of the frame."""
    check_effects(r.records, scene)
    if content := r.records.get((TONE, 0)):
        r.exposure, r.tone_flags = int.from_bytes(content[:4], "big"), content[4]
    if content := r.records.get((RIM, 0)):
        r.rim_color, r.rim_power = color_lanes(light_color(color_of(content), r)), content[3]
    if content := r.records.get((FOG, 0)):
        r.fog_color = color_lanes(color_of(content))
        r.fog_near, far = fog_distances(content)
        r.fog_range = far - r.fog_near
    for record, light in zip(r.lights, scene.lights, strict=True):
        record.color = color_lanes(light_color(light.color, r))
    if r.shadows:
        r.shadow_color = r.lights[r.shadows.light].color
    r.up_x, r.up_y, r.up_z = (part >> 8 for part in view.to_camera(UP))


def set_object(scene: Scene, material: Material, rotation: Matrix, r: Registers) -> None:
    """Set the registers of an object that is lit."""
    x, y, z = transposed_times(rotation, UP)
    r.up_in_mesh = (x >> 8 << UPPER_86_AT) + (y >> 8 << MIDDLE_86_AT) + (z >> 8)
    r.ambient = scaled(light_color(scene.ambient_light, r), material.ambient)
    for record, light in zip(r.lights, scene.lights, strict=True):
        record.diffuse = scaled(light_color(light.color, r), material.diffuse)
    if r.shadows:
        r.lights[r.shadows.light].color = r.shadow_color
        r.shadow_diffuse = r.lights[r.shadows.light].diffuse
    if content := r.records.get((HEMISPHERE, 0)):
        sky, ground = (light_color(color_of(part), r) for part in (content, content[3:]))
        r.hemisphere_sky, r.hemisphere_ground = scaled(sky, material.ambient), scaled(ground, material.ambient)


def color_of(content: bytes) -> int:
    """Return the colour at the beginning of a content, 0xRRGGBB."""
    return int.from_bytes(content[:3], "big")


def fog_distances(content: bytes) -> tuple[int, int]:
    """Return the distances at which fog begins and at which it hides everything, Q32."""
    return int.from_bytes(content[3:11], "big", signed=True), int.from_bytes(content[11:], "big", signed=True)


def light_color(color: int, r: Registers) -> int:
    """Return the colour of a light as it is added up: decoded from sRGB, to the nearest level, if light is linear."""
    return gamma.decode_color(color) if r.tone_flags & TONE_GAMMA else color
