"""What a mesh or scene file holds, in its own coordinates."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from attrs import evolve
from numpy.typing import NDArray

from .._load import load
from ..datasets import Piece
from ..errors import InputError
from ..scene import (
    GLTF,
    READERS,
    Axis,
    Link,
    Material,
    Mesh,
    Object,
    animations_of,
    axis_of_format,
    base_axis,
    faces_of_all,
    is_closed,
    read_model,
)


@dataclass(frozen=True)
class Facts:
    """Figures of all objects, taken together.

    low, high: the bounds. parts: how many objects. open_edges: edges of one face; crowded_edges: of three or more;
    disagreeing_edges: of two faces that are wound differently. closed: as `is_closed`, from outside. inside_out:
    whether faces of a closed surface are seen from inside. up: the axis that is taken as up. base: "y" or "z", along
    which the model stands on a flat base; None if it does so along none, or both. textures: width and height of each.
    colors: different ones of vertices. opaque: whether nothing is transparent. normals: how many parts have them.
    animations: the name and the length in seconds of each.
    """

    low: list[float]
    high: list[float]
    vertices: int
    triangles: int
    parts: int
    closed: bool
    inside_out: bool
    open_edges: int
    crowded_edges: int
    disagreeing_edges: int
    up: Axis
    base: Axis | None
    materials: int
    textures: list[list[int]]
    colors: int
    opaque: bool
    normals: int
    animations: list[tuple[str, float]]


def facts_of(place: Path | Piece | Link) -> Facts:
    """Return the facts of a file or a piece."""
    kind = place.suffix.lower() if isinstance(place, Path) else ""
    if kind in READERS and isinstance(place, Path):
        parts = read_model(place)
        objects = [
            Object(each.mesh, material=evolve(Material(), **each.material), opacity=each.opacity) for each in parts
        ]
    else:
        objects = [*load(place).objects]
    if not objects:
        raise InputError(f"{place} has no objects")
    positions = np.concatenate([each.world_positions() for each in objects])
    faces = faces_of_all(each.mesh for each in objects)
    single, crowded, disagreeing = _edges(positions, faces)
    is_tight = not (single or crowded or disagreeing)
    textures = [each.material.texture for each in objects if each.material.texture is not None]
    return Facts(
        low=positions.min(axis=0).tolist(),
        high=positions.max(axis=0).tolist(),
        vertices=len(positions),
        triangles=len(faces),
        parts=len(objects),
        closed=is_tight,
        inside_out=is_tight and not is_closed(Mesh(positions, faces)),
        open_edges=single,
        crowded_edges=crowded,
        disagreeing_edges=disagreeing,
        up=axis_of_format(place) if isinstance(place, Path) else "y",
        base=base_axis(positions, faces),
        materials=len({(each.material, each.opacity) for each in objects}),
        textures=[[*each.pixels.shape[1::-1]] for each in textures],
        colors=len(np.unique(np.concatenate([each.mesh.rgba[:, :3] for each in objects]), axis=0)),
        opaque=all(each.is_opaque for each in objects),
        normals=sum(each.mesh.normals is not None for each in objects),
        animations=animations_of(place) if kind in GLTF and isinstance(place, Path) else [],
    )


def _edges(positions: NDArray[np.float64], faces: NDArray[np.int64]) -> tuple[int, int, int]:
    """Return the numbers of edges of one face, of three or more, and of two that are wound differently.

    Corners at one place are one; edges without length are none.
    """
    places = np.unique(positions, axis=0, return_inverse=True)[1].reshape(-1)
    edges = places[faces][:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    edges = edges[edges[:, 0] != edges[:, 1]]
    forward = edges[:, 0] < edges[:, 1]
    _, number = np.unique(np.sort(edges, axis=1), axis=0, return_inverse=True)
    number = number.reshape(-1)
    count = np.bincount(number)
    ahead = np.bincount(number, forward, len(count))
    return int((count == 1).sum()), int((count > 2).sum()), int(((count == 2) & (ahead != 1)).sum())
