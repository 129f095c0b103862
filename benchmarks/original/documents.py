"""Scenes in the JSON of the original contracts, and calls of their `render`."""

from __future__ import annotations

from typing import Any

from shackled import Mesh, Scene
from shackled.artifacts import artifact
from shackled.datasets.genesis import generate, seed_of

Document = dict[str, Any]

WHITE = [255, 255, 255]
TRIANGLE = {
    "verts": [[-700, -700, 0], [700, -700, 0], [0, 700, 0]],
    "faces": [[0, 1, 2]],
    "cols": [[255, 0, 0], [0, 255, 0], [0, 0, 255]],
}
#: Its keys are in the order of the struct.
LIGHT = {
    "applyLighting": True,
    "lightAmbiPower": 0,
    "lightDiffPower": 2000,
    "lightSpecPower": 3000,
    "inverseShininess": 10,
    "lightPos": [-50, 0, 0],
    "lightColSpec": WHITE,
    "lightColDiff": WHITE,
    "lightColAmbi": WHITE,
}


def document(side: int = 64, light: dict[str, Any] | None = None, **changes: Any) -> Document:
    """Return one triangle before the eye, unlit unless `light` says how, with these keys changed."""
    return {
        "canvasDim": side,
        **TRIANGLE,
        "objPosition": [0, 0, -2500],
        "objScale": 1,
        "backgroundColor": [[0, 0, 40], [0, 0, 160]],
        "lightingParams": LIGHT | {"applyLighting": light is not None} | (light or {}),
        "perspCamera": True,
        "backfaceCulling": True,
        "invert": False,
        "wireframe": False,
        **changes,
    }


def mesh_keys(mesh: Mesh) -> dict[str, Any]:
    """Return the keys of a mesh with whole coordinates."""
    return {"verts": mesh.positions.astype(int).tolist(), "faces": mesh.faces.tolist(), "cols": mesh.colors.tolist()}


def scene_document(scene: Scene) -> Document:
    """Return the document of a lit scene of one object without rotation, in the light and before the sky of LIGHT."""
    (thing,) = scene.objects
    place = {"objPosition": thing.position.astype(int).tolist()}
    perspective = scene.camera.projection == "perspective"
    return document(scene.width, {}, **mesh_keys(thing.mesh), **place, perspCamera=perspective)


def genesis_document(number: int, side: int = 128) -> Document:
    """Return a piece of the collection as the original drew it."""
    piece = generate(seed_of(number))
    return document(
        side,
        {},
        verts=list(map(list, piece.verts)),
        faces=list(map(list, piece.faces)),
        cols=list(map(list, piece.cols)),
        backgroundColor=list(map(list, piece.background)),
        backfaceCulling=piece.culling,
        invert=piece.invert,
        wireframe=piece.wireframe,
    )


def call_data(document: Document, svg: bool = False) -> bytes:
    """Return a call of `render` of the original's interface."""
    keys = {**document.get("renderParams", {}), **document}
    lighting = {"applyLighting": False, **keys.get("lightingParams", {})}
    white = dict.fromkeys(("lightColSpec", "lightColDiff", "lightColAmbi"), WHITE)
    defaults: dict[str, Any] = {"lightPos": [0] * 3, **white}
    given = (
        keys["faces"],
        keys["verts"],
        keys["cols"],
        keys.get("objPosition", [0, 0, 0]),
        keys.get("objScale", 1),
        keys.get("backgroundColor", [[0] * 3] * 2),
        tuple(lighting.get(key, defaults.get(key, 0)) for key in LIGHT),
        *(bool(keys.get(key, default)) for key, default in (("perspCamera", True), ("backfaceCulling", True))),
        *(bool(keys.get(key, False)) for key in ("invert", "wireframe")),
    )
    return artifact("Original").interface.encode("render", given, document["canvasDim"], svg)
