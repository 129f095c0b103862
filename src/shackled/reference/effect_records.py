"""Check the records of effects: hemisphere light, rim, fog, tone, textures, shadows and grounds."""

from __future__ import annotations

from .extensions import MAX_COORDINATE, Records
from .opacities import OPACITIES, check_opacities
from .scene_errors import Reverted
from .structs import Scene
from .texture import TEXTURE, check_texture

#: Kinds of records of the scene.
HEMISPHERE, RIM, FOG, TONE = 4, 5, 6, 7
#: Kinds of objects and, of the light that casts shadows, SHADOW. A GROUND casts none, and fades.
SHADOW, GROUND = 10, 11
KINDS = {HEMISPHERE, RIM, FOG, TONE, TEXTURE, OPACITIES, SHADOW, GROUND}
#: The sizes of contents; those of TEXTURE and OPACITIES depend on the mesh.
SIZES = {HEMISPHERE: 6, RIM: 4, FOG: 19, TONE: 5, SHADOW: 32, GROUND: 32}
#: Flags of a TONE: the filmic curve; light is added up in linear values.
TONE_FILMIC, TONE_GAMMA = 1, 2
#: The greatest power of a RIM, and the greatest exposure of a TONE, Q16.
MAX_RIM_POWER, MAX_EXPOSURE = 16, 64 << 16
#: Which faces of culled objects cast shadows: all, those turned away from the light, those turned to it.
ALL, AVERSE, TURNED = 1, 2, 3


def check(records: Records, scene: Scene) -> None:
    """Check all records of effects."""
    has_shadow = False
    for (kind, index), content in records.items():
        if kind < HEMISPHERE:
            continue
        if kind not in KINDS:
            raise Reverted("UnknownExtension", kind=kind, index=index)
        count = 1 if kind <= TONE else len(scene.lights if kind == SHADOW else scene.objects)
        if index >= count:
            raise Reverted("ExtensionIndex", kind=kind, index=index, count=count)
        if kind == TEXTURE:
            check_texture(content, index, scene)
            continue
        if kind == OPACITIES:
            check_opacities(content, index, scene)
            continue
        if len(content) != SIZES[kind]:
            raise Reverted("ExtensionSize", kind=kind, index=index, expected=SIZES[kind], actual=len(content))
        check_values(kind, index, content)
        if kind == SHADOW:
            if has_shadow:
                raise Reverted("SeveralShadows", light=index)
            has_shadow = True
            rule = int.from_bytes(content, "big")
            if not ALL <= rule <= TURNED:
                raise Reverted("ShadowRuleOutOfRange", light=index, rule=rule)


def check_values(kind: int, index: int, content: bytes) -> None:
    """Check the numbers of a RIM, a FOG, a TONE or a GROUND."""
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
    if kind == GROUND:
        inner, outer = radii(content)
        if inner >= outer or outer > MAX_COORDINATE:
            raise Reverted("GroundOutOfRange", object=index, inner=inner, outer=outer)


def fog_distances(content: bytes) -> tuple[int, int]:
    """Return the distances at which fog begins and at which it hides everything, Q32."""
    return int.from_bytes(content[3:11], "big", signed=True), int.from_bytes(content[11:], "big", signed=True)


def radii(content: bytes) -> tuple[int, int]:
    """Return the distances at which a ground begins to fade and at which nothing is left of it, Q32."""
    return int.from_bytes(content[:8], "big"), int.from_bytes(content[8:16], "big")
