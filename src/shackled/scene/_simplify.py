"""Mesh simplification."""

from __future__ import annotations

from collections.abc import Sequence
from importlib.util import find_spec

import numpy as np
from attrs import evolve
from numpy.typing import NDArray

from ..checks import integer
from ..errors import InputError
from ._crease import SIMPLIFIED_CREASE, smoothed
from ._mesh import Mesh, without_slivers
from ._object import Object
from ._scene import Scene

#: Attempts until one suffices: aggressiveness, and the target as a share of the requested one, because a collapse may
#: stop a little above its target, or far above it if it is not aggressive enough.
FORCEFUL = ((7, 1.0), (7, 0.9), (10, 0.8), (14, 0.5))
#: These keep the shape better, but fail for more meshes.
GENTLE = ((5, 1.0), (5, 0.9))


def simplify(mesh: Mesh, max_triangles: int, tries: Sequence[tuple[int, float]] = FORCEFUL) -> Mesh:
    """Return a mesh of at most `max_triangles` triangles, by edge collapse.

    Each vertex has the colour of the nearest vertex that was collapsed into it. Normals are dropped. A mesh that is
    small enough is returned unchanged. tries: pairs of aggressiveness and target, as `FORCEFUL`. InputError if the
    target cannot be reached (it names a number that can), or fast-simplification is not installed.
    """
    most = integer(max_triangles)
    if most is None or most < 1:
        raise InputError(
            f"the number of triangles to simplify to must be a whole number, at least 1, not {max_triangles!r}"
        )
    if mesh.triangles <= most:
        return mesh
    if find_spec("fast_simplification") is None:
        raise InputError(
            f"simplifying {mesh.triangles} triangles to {most} needs a package that is not installed: "
            "pip install 'shackled[simplify]'"
        )
    positions, faces, colors = _simplified(mesh, most, tries)
    if not 0 < len(faces) <= most:
        found = f"{len(faces)} remain" if len(faces) else "nothing would remain"
        if len(faces) and len(_simplified(mesh, len(faces), tries)[1]) <= len(faces):
            found += f"; {len(faces)} would do"
        raise InputError(f"a mesh of {mesh.triangles} triangles cannot be simplified to {most}: {found}")
    return Mesh(positions, faces, colors)


def simplify_scene(scene: Scene, max_triangles: int, crease: float = SIMPLIFIED_CREASE) -> Scene:
    """Return the scene with every mesh of more triangles simplified to `max_triangles`.

    Meshes with normals get new ones, smooth across edges of up to `crease` degrees.
    """
    return evolve(scene, objects=[_simplified_object(o, max_triangles, crease) for o in scene.objects])


def _simplified_object(o: Object, max_triangles: int, crease: float) -> Object:
    simpler = evolve(o, mesh=simplify(o.mesh, max_triangles))
    had_normals = o.material.shading == "smooth" and o.mesh.normals is not None
    return smoothed(simpler, crease) if had_normals and simpler.mesh is not o.mesh else simpler


_Surface = tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.uint8]]


def _simplified(mesh: Mesh, max_triangles: int, tries: Sequence[tuple[int, float]]) -> _Surface:
    """Return the mesh after as many attempts as needed; it may have too many triangles, or none."""
    surface = _connect(mesh)
    for force, share in tries:
        if len(surface[1]) <= max_triangles:
            break
        surface = _collapse(*surface, int(share * max_triangles), force)
    return surface


def _connect(mesh: Mesh) -> _Surface:
    """Return the mesh with one vertex for each position, whatever its colour.

    So edges between colours can be collapsed too.
    """
    positions = mesh.positions
    unique, first, number = np.unique(positions, axis=0, return_index=True, return_inverse=True)
    faces = number.reshape(-1)[mesh.faces]
    return unique, without_slivers(faces), mesh.colors[first]


def _collapse(
    positions: NDArray[np.float64], faces: NDArray[np.int64], colors: NDArray[np.uint8], target: int, agg: int
) -> _Surface:
    from fast_simplification import replay_simplification
    from fast_simplification import simplify as collapse_edges

    if len(faces) == 0:
        return positions, faces, colors
    _, _, collapses = collapse_edges(
        positions, faces.astype(np.int32), target_count=min(target, len(faces)), agg=agg, return_collapses=True
    )
    points, triangles, number = replay_simplification(positions, faces.astype(np.int32), collapses)
    triangles = without_slivers(np.asarray(triangles, dtype=np.int64).reshape(-1, 3))
    if len(triangles) == 0:
        return positions[:0], triangles, colors[:0]
    # of the vertices that became one, the nearest to it comes last, and so stays
    kept = np.flatnonzero(number >= 0)
    distance = np.linalg.norm(positions[kept] - points[number[kept]], axis=1)
    kept = kept[np.argsort(-distance, kind="stable")]
    nearest = np.zeros(len(points), dtype=np.int64)
    nearest[number[kept]] = kept
    used, compact = np.unique(triangles, return_inverse=True)
    return np.asarray(points, dtype=np.float64)[used], compact.reshape(-1, 3), colors[nearest[used]]
