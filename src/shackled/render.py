"""From a scene to a picture."""

from __future__ import annotations

import time
from dataclasses import replace
from pathlib import Path

from .chain import Chain, open_chain
from .errors import InputError
from .image import Image, decode_bmp
from .scene.scene import Scene


def render(
    scene: Scene | str | Path,
    size: int | tuple[int, int] | None = None,
    chain: Chain | str | None = None,
    max_triangles: int | None = None,
) -> Image:
    """Makes the picture of a scene.

    scene: a Scene, the path of a mesh or scene file, or the name of a piece of a dataset.
    size: side of a square picture, or (width, height), in pixels; None takes the scene's.
    chain: where, by name or itself; None takes the fastest EVM that is installed.
    max_triangles: meshes of more are simplified.
    InputError for what is wrong with the scene, RenderError for what fails in the call.
    """
    if not isinstance(scene, Scene):
        from .load import load

        scene = load(scene)
    if size is not None:
        scene = resize(scene, size)
    if max_triangles is not None:
        scene = simplify_scene(scene, max_triangles)
    if chain is None or isinstance(chain, str):
        chain = open_chain(chain)
    started = time.perf_counter()
    drawing = chain.draw(scene)
    seconds = time.perf_counter() - started
    triangles, lit_pixels = chain.count(scene)
    return Image(
        pixels=decode_bmp(drawing.bmp, scene.width, scene.height),
        bmp=drawing.bmp,
        gas=drawing.gas,
        intrinsic_gas=drawing.intrinsic_gas,
        triangles=triangles,
        lit_pixels=lit_pixels,
        chain=chain.name,
        seconds=seconds,
    )


def resize(scene: Scene, size: int | tuple[int, int]) -> Scene:
    """The scene on a canvas of another size; the camera keeps its vertical field of view."""
    try:
        width, height = (size, size) if isinstance(size, int) else size
    except (TypeError, ValueError):
        raise InputError(f"the size of a picture must be one number or (width, height), not {size!r}") from None
    return replace(scene, width=width, height=height)


def simplify_scene(scene: Scene, max_triangles: int) -> Scene:
    """The scene with every mesh of more triangles simplified to `max_triangles`."""
    from .scene.simplify import simplify

    return replace(scene, objects=[replace(o, mesh=simplify(o.mesh, max_triangles)) for o in scene.objects])
