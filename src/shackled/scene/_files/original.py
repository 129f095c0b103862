"""Scenes of the original Shackled contracts, as JSON.

Exact: geometry, position and scale, camera, culling, wireframe, background, invert. The original's light is one
directional light that adds a highlight and a diffuse term to the colour of the surface. Here the ambient coefficient is
1, so that the colour shows in full, too; the diffuse term is multiplied by the colour of the surface, and `k =
lightDiffPower / |lightPos|^2` is not cut to an integer. Left out: `lightAmbiPower` (a colour added everywhere), and a
diffuse colour of another hue than the specular one, of which the mean is taken while there is a highlight.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ...base.checks import Floats
from ...errors import InputError
from .._arithmetic import dot, from_euler
from .._camera import Camera
from .._effects import Background
from .._fields import FIELDS
from .._light import Light
from .._mesh import Mesh
from .._object import Material, Object
from .._scene import Scene
from .._staging import MAX_SIDE
from .table import Table, about

#: Half of what the original's orthographic camera spans, in world units for each pixel of the canvas.
ORTHOGRAPHIC_UNITS = 500


def original_scene(document: Mapping[str, Any]) -> Scene:
    """Return the scene of the original's JSON, whose keys stand at the top level or under `renderParams`.

    Without faces it is one of background only. InputError names the key that is wrong.
    """
    keys = Table({**Table(document, "").table("renderParams").values, **document}, "")
    for key in ("canvasDim", "verts", "faces"):
        if key not in keys:
            raise InputError(f"{key} is missing")
    side = keys.get("canvasDim")
    if type(side) is not int or not 1 <= side <= MAX_SIDE:
        raise InputError(f"canvasDim must be a whole number from 1 to {MAX_SIDE}, not {side!r:.60}")
    orthographic = Camera(projection="orthographic", half_height=ORTHOGRAPHIC_UNITS * side)
    camera = Camera() if keys.flag("perspCamera", True) else orthographic
    material, lights = _light(keys.table("lightingParams"))
    scale = keys.number("objScale", 1)
    position = keys.numbers("objPosition", (0, 0, 0))
    rotation = from_euler(keys.numbers("rotation", (0, 0, 0)))
    cull, wireframe = keys.flag("backfaceCulling", True), keys.flag("wireframe", False)
    # the original's scale may be negative, ours not: then the mesh is mirrored at its origin instead
    mesh = _mesh(keys, -1 if scale < 0 else 1)
    return Scene(
        objects=[Object(mesh, position, rotation, abs(scale), material, cull, wireframe)] if mesh else [],
        camera=camera,
        lights=lights,
        background=_background(keys),
        invert=keys.flag("invert", False),
        width=side,
        height=side,
    )


def _mesh(keys: Table, sign: int) -> Mesh | None:
    """Return the mesh, its positions times `sign`; None without faces."""
    positions, faces = keys.matrix("verts"), keys.matrix("faces", whole=True)
    colors = keys.matrix("cols", whole=True) if "cols" in keys else None
    if not len(faces):
        return None
    if colors is not None:
        last = int(faces.max())
        if len(positions) > last >= len(colors):
            raise InputError(f"cols has {len(colors)} colours, but a face uses vertex {last}, which needs one")
        outside = np.flatnonzero(((colors < 0) | (colors > 255)).any(axis=1))
        if len(outside):
            found = keys.get("cols")[outside[0]]
            raise InputError(f"cols[{outside[0]}] must be red, green and blue from 0 to 255, not {found}")
        unused = np.zeros((max(0, len(positions) - len(colors)), 3), dtype=np.int64)
        colors = np.concatenate([colors, unused])[: len(positions)]
    return Mesh(sign * positions, faces, colors)


def _light(lighting: Table) -> tuple[Material, list[Light]]:
    if not lighting.flag("applyLighting", False):
        return Material("unlit"), []
    vector = np.array(lighting.numbers("lightPos", (0, 0, 0)))
    square = float(dot(vector, vector))
    if square == 0:
        raise InputError(f"{lighting.place('lightPos')} must not be the origin: it is the direction toward the light")
    diffuse_color, specular_color = _light_color(lighting, "lightColDiff"), _light_color(lighting, "lightColSpec")
    diffuse = lighting.number("lightDiffPower", 0) / square
    specular = lighting.number("lightSpecPower", 0) / square
    # one light has one colour: that of the highlight where there is one
    color = specular_color if specular > 0 and specular_color.any() else diffuse_color
    hue = np.rint(color * 255 / color.max()) if color.any() else np.full(3, 255.0)
    material = Material(
        "flat",
        ambient=1,
        diffuse=_within("diffuse", diffuse * float(diffuse_color.mean() / hue.mean())),
        specular=_within("specular", specular * float(specular_color.max() / 255)),
        shininess=round(_within("shininess", lighting.number("inverseShininess", 1))),
    )
    return material, [Light("directional", vector, hue)]


def _light_color(lighting: Table, key: str) -> Floats:
    """Return red, green and blue, of any size: the original's powers may be in them."""
    color = np.array(lighting.numbers(key, (255, 255, 255)))
    if (color < 0).any():
        raise InputError(f"{lighting.place(key)} must not be negative, not {lighting.get(key)!r:.60}")
    return color


def _background(keys: Table) -> Background:
    colors = keys.matrix("backgroundColor", whole=True) if "backgroundColor" in keys else np.zeros((2, 3), int)
    if len(colors) != 2:
        raise InputError(f"backgroundColor must be two colours, the top one and the bottom one, not {len(colors)}")
    with about("backgroundColor"):
        return Background(colors[0].tolist(), colors[1].tolist())


def _within(name: str, value: float) -> float:
    """Return a coefficient of a material within its range."""
    return float(np.clip(value, *FIELDS["Material"][name].limits))
