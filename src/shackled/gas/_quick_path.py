"""The quick path of the EffectsEngine: faces all over which the colour is the same are lit once, not for each pixel."""

from __future__ import annotations

from collections import Counter

import numpy as np

from ..scene import Object, Scene
from ..values import listed, plural


def has_effects(scene: Scene) -> bool:
    """Return whether the EffectsEngine draws a scene."""
    effects = (scene.hemisphere, scene.rim, scene.fog, scene.tone, scene.ground)
    return (
        any(each is not None for each in effects)
        or any(light.shadow for light in scene.lights)
        or any(
            o.material.texture is not None
            or o.mesh.opacities is not None
            or o.fade is not None
            or any(o.material.emission)
            for o in scene.objects
        )
    )


def missed_quick_path(scene: Scene) -> dict[str, int]:
    """Return how many faces of a scene with effects are lit for each pixel, by the reason in words; {} without effects.

    Hidden faces count; those of wireframes and of a ground do not.
    """
    found: Counter[str] = Counter()
    if not has_effects(scene):
        return {}
    everywhere = [name for name, value in (("rim light", scene.rim), ("fog", scene.fog)) if value is not None]
    if any(light.kind == "point" for light in scene.lights):
        everywhere.append("a point or spot light")
    for o in scene.objects:
        if o.wireframe or o.fade is not None:
            continue
        reasons = [*_of_object(o), *everywhere]
        corners = o.mesh.colors[o.mesh.faces]
        varies = (corners != corners[:, :1]).any(axis=(1, 2))
        for is_varying, count in zip(*np.unique(varies, return_counts=True), strict=True):
            words = ["colours that vary inside the face"] * bool(is_varying) + reasons
            if words:
                found[" and ".join(words)] += int(count)
    return dict(found)


def quick_path_note(scene: Scene) -> str:
    """Return how many faces miss the quick path and why, in one line; "" if none does."""
    parts = [f"{count:,} because of {reason}" for reason, count in missed_quick_path(scene).items()]
    return (
        f"of {plural(scene.triangles, 'face')}, these miss the quick path of effects: {listed(parts)}" if parts else ""
    )


def _of_object(o: Object) -> list[str]:
    material, found = o.material, []
    if material.shading == "smooth":
        found.append("smooth shading")
    elif material.shading == "flat" and material.specular > 0:
        found.append(f"a highlight of {100 * material.specular:.3g} percent")
    if material.texture is not None:
        found.append("a texture")
    if o.mesh.opacities is not None:
        found.append("opacities of vertices")
    return found
