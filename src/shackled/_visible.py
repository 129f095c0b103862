"""Why nothing of a scene is to be seen."""

from __future__ import annotations

from attrs import evolve

from .chain import open_chain
from .scene import Scene, is_visible


def why_nothing(scene: Scene, evm: str | None = None) -> str:
    """Return, in a sentence, the likely cause for which a picture of a scene shows only the background.

    evm: the embedded EVM that counts triangles; None for the default. Raises ChainError if a call fails.
    """
    if not scene.objects:
        return "the scene has no objects"
    if not any(is_visible(each.mesh, each.opacity, each.material.texture) for each in scene.objects):
        return "everything is transparent: its opacity is 0; `opacity` of 1 and opaque colours show it"
    chain = open_chain(evm)
    triangles, covered = chain.count(scene)
    if covered:
        return "everything that is drawn has the colour of the background"
    shown = evolve(scene, objects=[evolve(each, cull=False) for each in scene.objects])
    if not triangles and chain.count(shown)[1]:
        return "all faces turn away from the viewer and are culled: --no-cull, or cull=False, draws them"
    return "everything is smaller than a pixel, or outside of the view: `eye`, `target`, `fov` and `near` place it"
