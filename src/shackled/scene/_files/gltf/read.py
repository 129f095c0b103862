"""Meshes of glTF files."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ....errors import InputError, warn
from ..._crease import filled
from ..._fields import FIELDS
from ..._mesh import face_normals, weld
from ..model import MeshPart, tinted
from .animation import posed
from .document import Document
from .nodes import Node, instances, placed
from .primitives import Piece, in_place, pieces_of

#: The exponent of the widest highlights; even wider ones only fade the colours.
_WIDEST = 10
#: That of the narrowest.
_NARROWEST = FIELDS["Material"]["shininess"].limits[1]


@np.errstate(all="ignore")
def read_gltf(
    path: Path, animation: str | int | None = None, time: float | None = None, use_camera: str | int | None = None
) -> list[MeshPart]:
    """Return the meshes of a glTF or GLB file, one for each `Piece.group`: its scene, or else its first one.

    The colour of a vertex is its own times the base colour of its material, both linear in the file, and sRGB here;
    light grey if it has neither. Meshes are at rest, or as an animation, by its name or number, the first one by
    default, puts them at a time in seconds. use_camera: of `read_view`; without it a note tells of cameras and lights.
    """
    gltf = Document(path)
    nodes = nodes_of(gltf, animation, time)
    groups: dict[tuple[object, ...], list[Piece]] = {}
    # meshes that several nodes show as they are
    shown = Counter(_mesh_of(node) for node in nodes.values())
    known: dict[str, list[Piece]] = {}
    turn = 0
    for node in nodes.values():
        if not node.is_shown:
            continue
        if "camera" in node.keys and use_camera is None:
            gltf.leave_out("camera", node.keys.where, "{}; `use_camera` takes one, with the lights")
        if "KHR_lights_punctual" in node.keys.table("extensions") and use_camera is None:
            gltf.leave_out("light", node.keys.where)
        mesh = _mesh_of(node)
        pieces = known.get(mesh) or (list(pieces_of(gltf, node, nodes)) if "mesh" in node.keys else [])
        if mesh and shown[mesh] > 1:
            known[mesh] = pieces
        size = sum(len(piece.faces) for piece in pieces)
        if not size:
            continue
        matrices = instances(gltf, node, size)
        for piece in pieces:
            groups.setdefault(piece.group, []).append(in_place(piece, matrices, turn))
        turn += len(matrices)
    if not groups:
        raise InputError("; ".join(["it has no triangles that are shown", *gltf.left_out()]))
    for each in gltf.left_out():
        warn(f"{path}: {each}")
    textures = {pieces[0].picture.name for pieces in groups.values() if pieces[0].picture is not None}
    return [_join(pieces, len(textures)) for pieces in groups.values()]


def _mesh_of(node: Node) -> str:
    """Return what the mesh of a node is known by; "" for one that the node changes."""
    is_own = "mesh" not in node.keys or "skin" in node.keys or "weights" in node.keys
    return "" if is_own else str(node.keys.get("mesh"))


def nodes_of(gltf: Document, animation: str | int | None, time: float | None) -> dict[int, Node]:
    """Return the nodes in their places, at rest or moved by an animation."""
    nodes = gltf.keys.tables("nodes")
    if animation is not None or time is not None:
        nodes = posed(gltf, nodes, 0 if animation is None else animation, time or 0.0)
    return placed(gltf, nodes)


def _material(pieces: Sequence[Piece]) -> dict[str, Any]:
    """Return the fields of a Material; highlights are the mean of all pieces that tell of them, by area."""
    first = pieces[0].surface
    if first.is_unlit:
        return {"shading": "unlit"}
    fields: dict[str, Any] = {"emission": first.emission} if any(first.emission) else {}
    gloss, areas = [], []
    for piece in pieces:
        if piece.surface.gloss is not None:
            gloss.append(piece.surface.gloss)
            areas.append(float(np.linalg.norm(face_normals(piece.positions[piece.faces]), axis=1).sum()))
    if not 0 < sum(areas) < math.inf:
        return fields
    roughness, metalness = np.clip(np.average(gloss, 0, areas), 0, 1).tolist()
    # Beckmann's roughness of a Blinn-Phong exponent; the strength of highlights is a matter of taste
    return fields | {
        "specular": round((0.8 + 0.3 * metalness) * (1 - roughness), 3),
        "shininess": round(min(max(2 / max(roughness, 0.1) ** 4 - 2, _WIDEST), _NARROWEST)),
    }


def _join(pieces: Sequence[Piece], count: int) -> MeshPart:
    """Return pieces with one texture, or with none, as one. count: how many textures the file has."""
    starts = np.cumsum([0, *(len(piece.positions) for piece in pieces)])
    corners = np.concatenate([piece.faces + start for piece, start in zip(pieces, starts, strict=False)])
    corners = corners[np.concatenate([piece.turn for piece in pieces]).argsort(kind="stable")]
    positions, colors, normals, uvs = (
        np.concatenate([getattr(piece, name) for piece in pieces]) for name in ("positions", "colors", "normals", "uvs")
    )
    material = _material(pieces)
    corner_colors, corner_uvs = colors[corners], None
    picture, surface = pieces[0].picture, pieces[0].surface
    if picture is not None and picture.is_plain(uvs[corners]):
        corner_colors = tinted(corner_colors, picture, uvs[corners])
    elif picture is not None:
        material["texture"], corner_uvs = picture.texture(uvs[corners], count)
    found = filled(positions, corners, normals[corners]) if normals.any() else None
    mesh = weld(positions, corners, corner_colors, found, corner_uvs)
    return MeshPart(mesh, material, surface.opacity, surface.is_two_sided)
