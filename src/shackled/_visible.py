"""Why nothing of a scene is to be seen."""

from __future__ import annotations

import numpy as np
from attrs import evolve

from .chain._opening import open_chain
from .scene._files.model import is_visible
from .scene._scene import Scene


def why_nothing(scene: Scene, evm: str | None = None) -> str:
    """Return, in a sentence, the likely cause for which a picture of a scene shows only the background.

    evm: the embedded EVM that counts triangles; None for the default. Raises ChainError if a call fails.
    """
    if not scene.objects:
        return "the scene has no objects"
    if not any(is_visible(each.mesh, each.opacity, each.material.texture) for each in scene.objects):
        return "everything is transparent: its opacity is 0; `opacity` of 1 and opaque colours show it"
    if _is_outside(scene):
        return "everything is outside of the view: `eye`, `target`, `fov` and `near` place it"
    chain = open_chain(evm)
    triangles, covered = chain.count(scene)
    if covered:
        return "everything that is drawn has the colour of the background"
    shown = evolve(scene, objects=[evolve(each, cull=False) for each in scene.objects])
    if not triangles and chain.count(shown)[1]:
        return "all faces turn away from the viewer and are culled: --no-cull, or cull=False, draws them"
    return "everything is outside of the view, or smaller than a pixel"


@np.errstate(all="ignore")
def _is_outside(scene: Scene) -> bool:
    """Return whether all points of a scene are on the outer side of one side of the view."""
    camera, points = scene.camera, scene.world_positions() - scene.camera.eye
    forward = camera.target - camera.eye
    right = np.cross(forward, camera.up)
    axes = np.stack([right, np.cross(right, forward), forward])
    x, y, z = (points @ (axes / np.linalg.norm(axes, axis=1, keepdims=True)).T).T
    top = camera.half_height * (z if camera.projection == "perspective" else 1)
    side = top * scene.width / scene.height
    near = -np.inf if camera.projection == "orthographic" else 0
    sides = (z - (near if camera.near is None else camera.near), side - x, side + x, top - y, top + y)
    return any(bool((each < 0).all()) for each in sides)
