"""The quick path of the EffectsEngine: faces all over which the colour is the same are lit once, not for each pixel."""

from __future__ import annotations

from collections import Counter

from ..base.values import listed, plural
from ..scene._codec import has_effects
from ..scene._scene import Scene


def missed_quick_path(scene: Scene) -> dict[str, int]:
    """Return how many faces of a scene with effects are lit for each pixel, by the reason in words; {} without effects.

    Hidden faces count; those of wireframes and of a ground do not.
    """
    found: Counter[str] = Counter()
    for o in scene.objects if has_effects(scene) else ():
        if o.wireframe or o.fade is not None:
            continue
        material, corners = o.material, o.mesh.colors[o.mesh.faces]
        reasons = {
            "smooth shading": material.shading == "smooth",
            f"a highlight of {100 * material.specular:.3g} percent": material.shading == "flat" and material.specular,
            "a texture": material.texture is not None,
            "opacities of vertices": o.mesh.opacities is not None,
            "rim light": scene.rim is not None,
            "fog": scene.fog is not None,
            "a point or spot light": any(light.kind == "point" for light in scene.lights),
        }
        words = [name for name, holds in reasons.items() if holds]
        varying = int((corners != corners[:, :1]).any(axis=(1, 2)).sum())
        found[" and ".join(words)] += o.mesh.triangles - varying
        found[" and ".join(["colours that vary inside the face", *words])] += varying
    return {reason: count for reason, count in found.items() if reason and count}


def quick_path_note(scene: Scene) -> str:
    """Return how many faces miss the quick path and why, in one line; "" if none does."""
    parts = [f"{count:,} because of {reason}" for reason, count in missed_quick_path(scene).items()]
    return (
        f"of {plural(scene.triangles, 'face')}, these miss the quick path of effects: {listed(parts)}" if parts else ""
    )
