"""Scenes in the JSON of the original contracts: of the kinds that it was measured with, pieces, and odd ones."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
from benchmarks.original.documents import (
    LIGHT,
    TRIANGLE,
    WHITE,
    Document,
    call_data,
    document,
    genesis_document,
    mesh_keys,
    scene_document,
)
from benchmarks.original.recipe import MODEL_LIGHT

from shackled import Mesh
from shackled.bench import scenes
from shackled.datasets._pieces import require

__all__ = [
    "LIGHT",
    "call_data",
    "document",
    "documents",
    "genesis_document",
    "object_keys",
    "wrong_documents",
]

#: Where light comes from.
DIRECTIONS = {"left": [-50, 0, 0], "above": [0, 50, 0], "behind the eye": [0, 0, 50], "behind": [30, 0, -40]}
#: Built-in pieces of one object, of about 1,000 triangles.
OBJECTS = ("teapot", "torus", "torus-knot", "spring", "superellipsoid", "seashell", "uv-sphere")


def object_keys(name: str, radius: int = 800) -> dict[str, Any]:
    """The keys of the mesh of a built-in piece, of this size, in colours that change along its axes."""
    piece = require(name)
    (thing,) = piece.make().objects
    points = thing.world_positions()
    low, high = points.min(axis=0), points.max(axis=0)
    part = (points - low) / (high - low)
    placed = (points - (low + high) / 2) * (2 * radius / (high - low).max())
    return mesh_keys(Mesh(np.rint(placed), thing.mesh.faces, np.rint(80 + 150 * part).astype(int)))


def object_document(name: str, side: int = 128) -> Document:
    """A built-in piece under a light from above."""
    return document(side, MODEL_LIGHT, **object_keys(name))


def quads(count: int = 1, gap: int = 10) -> dict[str, Any]:
    """The keys of quads that fill the canvas, one behind the other."""
    corners = [(-1300, -1300), (1300, -1300), (1300, 1300), (-1300, 1300)]
    return {
        "verts": [[x, y, -gap * layer] for layer in range(count) for x, y in corners],
        "faces": [[4 * layer + k for k in face] for layer in range(count) for face in ([0, 1, 2], [0, 2, 3])],
        "cols": [[60 * layer, 255 - 60 * layer, 40 * corner] for layer in range(count) for corner in range(4)],
    }


def crossing(scale: int, order: list[int], **changes: Any) -> Document:
    """Two triangles, a red one in front of a green one, in this order."""
    near, far = [[-9, -6, 4], [3, -6, 4], [3, 6, 4]], [[-3, -6, -4], [9, -6, -4], [9, 6, -4]]
    return document(
        verts=(scale * np.array([*near, *far])).tolist(),
        faces=[[[0, 1, 2], [3, 4, 5]][k] for k in order],
        cols=[[255, 0, 0]] * 3 + [[0, 255, 0]] * 3,
        **changes,
    )


@cache
def documents() -> dict[str, Document]:
    """Those that are drawn, by name."""
    ball, orthographic = object_keys("icosphere"), {"perspCamera": False, "objPosition": [0, 0, -150000]}
    found = {f"genesis {number}": genesis_document(number) for number in (*range(12), 21)}
    for side in (8, 32, 128):
        for projection in ("perspective", "orthographic"):
            found[f"cube {projection} {side}"] = scene_document(scenes.cube(side, projection))
    for count in (1, 7, 16):
        found[f"{count} triangles"] = scene_document(scenes.equal_triangles(count))
    for name, direction in DIRECTIONS.items():
        found[f"diffuse from {name}"] = document(64, {"lightPos": direction, "lightSpecPower": 0}, **ball)
        found[f"highlight from {name}"] = document(64, {"lightPos": direction, "lightDiffPower": 0}, **ball)
    for shininess in (1, 20, 128):
        found[f"shininess {shininess}"] = document(64, {"inverseShininess": shininess}, **ball)
    for layers in (1, 2, 4):
        found[f"{layers} layers"] = document(**quads(layers))
    for front in (0, 1):
        order = [front, 1 - front]
        found[f"depth {order}"] = crossing(100, order)
        found[f"depth {order}, orthographic"] = crossing(6000, order, **orthographic)
    found |= {name: object_document(name) for name in ("teapot", "torus-knot")}
    return found | {
        "empty": document(faces=[]),
        "quad": document(128, {}, **quads()),
        "unlit ball": document(128, **ball),
        "wireframe": document(wireframe=True, **ball),
        "wireframe, culled": document(wireframe=True, backfaceCulling=False, **ball),
        "wireframe beyond the canvas": document(wireframe=True, objScale=4),
        "canvas 100": document(100),
        "canvas 48": document(48, {}),
        "inverted": document(invert=True),
        "clockwise": document(faces=[[0, 2, 1]]),
        "clockwise, both sides": document(faces=[[0, 2, 1]], backfaceCulling=False),
        "no size": document(objScale=0),
        "mirrored": document(objScale=-1, backfaceCulling=False),
        "beyond the canvas": document(verts=[[-20000, -20000, 0], [20000, -20000, 0], [0, 20000, 0]]),
        "behind the eye": document(objPosition=[0, 0, 2500], backfaceCulling=False),
        "through the plane of the eye": document(
            verts=[[-700, -700, 0], [700, -700, 0], [0, 700, 4000]], backfaceCulling=False
        ),
        "a corner in the plane of the eye": document(verts=[[-700, -700, 0], [700, -700, 0], [0, 700, 2500]]),
        "a face without area": document(
            64, {}, verts=[*TRIANGLE["verts"], [0, 0, 0]], faces=[[0, 1, 2], [3, 3, 3]], cols=[*TRIANGLE["cols"], WHITE]
        ),
        "first render": document(
            128,
            verts=[[-1, 0, 0], [-1, 2, 0], [0, 2, 0], [1, 0, 5], [1, -2, 5], [0, -2, 5]],
            faces=[[0, 1, 2], [3, 4, 5]],
            cols=[*TRIANGLE["cols"], [255, 255, 0], [0, 255, 255], [255, 0, 255]],
            objPosition=[0, 0, 0],
            objScale=16000,
            perspCamera=False,
            backfaceCulling=False,
        ),
    }


def wrong_documents() -> dict[str, Document]:
    """Those that no scene can be made of: the original reverts on the first four, and draws garbage for the others."""
    return {
        "no such vertex": document(faces=[[0, 1, 7]]),
        "no canvas": document(0),
        "a light at the origin": document(64, {"lightPos": [0, 0, 0]}),
        "too few colours": document(cols=[[255, 0, 0]]),
        "a negative background": document(backgroundColor=[[-10, 0, 0], [0, 0, 0]]),
        "a negative background, inverted": document(backgroundColor=[[-10, 0, 0], [0, 0, 0]], invert=True),
        "a colour out of range": document(cols=[[-50, 0, 0], [0, 300, 0], [0, 0, 255]]),
        "a colour out of range, inverted": document(cols=[[-50, 0, 0], [0, 300, 0], [0, 0, 255]], invert=True),
    }
