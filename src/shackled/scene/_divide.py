"""Objects of so many vertices and triangles as a contract takes."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from attrs import evolve
from numpy.typing import NDArray

from ._mesh import MAX_FACES, MAX_VERTICES, part_of_faces
from ._object import Object


def divided(o: Object) -> list[Object]:
    """Return the object, or, if its mesh is too large for a contract, several that together are the same.

    Each has the next faces of the mesh, so that what is close together in a file stays together. Vertices at the cuts
    are in both parts, with their normals.
    """
    mesh = o.mesh
    if len(mesh.positions) <= MAX_VERTICES and mesh.triangles <= MAX_FACES:
        return [o]
    return [evolve(o, mesh=part_of_faces(mesh, faces)) for faces in _runs(mesh.faces)]


def _runs(faces: NDArray[np.int64]) -> Iterator[NDArray[np.int64]]:
    while len(faces):
        run = faces[:MAX_FACES]
        # where each vertex is named first: the run ends before the one that is too many
        firsts = np.sort(np.unique(run, return_index=True)[1])
        if len(firsts) > MAX_VERTICES:
            run = run[: firsts[MAX_VERTICES] // 3]
        yield run
        faces = faces[len(run) :]
