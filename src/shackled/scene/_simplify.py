"""Mesh simplification."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from importlib.util import find_spec

import numpy as np
from attrs import evolve
from numpy.typing import NDArray

from ..base.checks import Floats, Ints, whole
from ..errors import InputError
from ._crease import smoothed
from ._mesh import Mesh, components, proper, weld
from ._object import Object
from ._scene import Scene

#: Attempts until one suffices: aggressiveness, and the target as a share of the requested one, because a collapse may
#: stop a little above its target, or far above it if it is not aggressive enough.
FORCEFUL = ((7, 1.0), (7, 0.9), (10, 0.8), (14, 0.5))
#: These keep the shape better, but fail for more meshes.
GENTLE = ((5, 1.0), (5, 0.9))

#: What is missing where meshes cannot be simplified.
NEEDED = "needs the package fast-simplification, which is not installed: it has no wheels for some machines"


def is_possible() -> bool:
    """Return whether the package that simplifies meshes is installed."""
    return find_spec("fast_simplification") is not None


def simplify(mesh: Mesh, max_triangles: int, tries: Sequence[tuple[int, float]] = FORCEFUL) -> Mesh:
    """Return a mesh of at most `max_triangles` triangles, by edge collapse; itself if it is small enough.

    A vertex has the colour and the opacity of the nearest one that was collapsed into it, corners likewise their
    texture coordinates. Normals are dropped. tries: pairs of aggressiveness and target, as `FORCEFUL`. InputError if
    the target cannot be reached, or fast-simplification is not installed.
    """
    most = whole(max_triangles, "the number of triangles to simplify to", 1)
    if mesh.triangles <= most:
        return mesh
    if not is_possible():
        raise InputError(f"simplifying {mesh.triangles} triangles to {most} {NEEDED}")
    surface = _simplified(mesh, most, tries)
    count = len(surface.faces)
    if not 0 < count <= most:
        found = f"{count} remain" if count else "nothing would remain"
        raise InputError(f"a mesh of {mesh.triangles} triangles cannot be simplified to {most}: {found}")
    if mesh.uvs is None:
        return Mesh(surface.positions, surface.faces, surface.colors)
    return weld(surface.positions, surface.faces, surface.colors[surface.faces], uvs=surface.uvs)


def simplify_scene(scene: Scene, max_triangles: int, crease: float | None = None) -> Scene:
    """Return the scene with every mesh of more triangles simplified to `max_triangles`.

    Meshes with normals get new ones, smooth across edges of up to `crease` degrees; None for what suits the shape.
    """

    def simpler(o: Object) -> Object:
        mesh = simplify(o.mesh, max_triangles)
        has_lost_normals = o.material.shading == "smooth" and o.mesh.normals is not None and mesh is not o.mesh
        return smoothed(evolve(o, mesh=mesh), crease) if has_lost_normals else evolve(o, mesh=mesh)

    return evolve(scene, objects=map(simpler, scene.objects))


@dataclass(frozen=True)
class _Surface:
    """A mesh with one vertex for each position. colors: (n, 4). uvs: (m, 3, 2).

    places: (m, 3), numbers that corners have in common which are one point of the texture.
    """

    positions: Floats
    faces: Ints
    colors: NDArray[np.uint8]
    uvs: Floats
    places: Ints

    def part(self, faces: Ints, kept: Ints) -> _Surface:
        """Return the surface with other vertex numbers, (m, 3), and only those faces that are kept."""
        return replace(self, faces=faces[kept], uvs=self.uvs[kept], places=self.places[kept])


def _simplified(mesh: Mesh, max_triangles: int, tries: Sequence[tuple[int, float]]) -> _Surface:
    """Return the mesh after as many attempts as needed; it may have too many triangles, or none."""
    surface = _connect(mesh)
    for force, share in tries:
        if len(surface.faces) <= max_triangles:
            break
        surface = _collapse(surface, int(share * max_triangles), force)
    return surface


def _connect(mesh: Mesh) -> _Surface:
    """Return the mesh with one vertex for each position: so edges between colours can be collapsed too."""
    unique, first, number = np.unique(mesh.positions, axis=0, return_index=True, return_inverse=True)
    faces = number.reshape(-1)[mesh.faces]
    uvs, places = np.zeros((len(faces), 3, 2)), faces
    if mesh.uvs is not None:
        uvs = mesh.uvs[mesh.faces]
        both = np.hstack([mesh.positions, mesh.uvs])
        places = np.unique(both, axis=0, return_inverse=True)[1].reshape(-1)[mesh.faces]
    surface = _Surface(unique, faces, mesh.rgba[first], uvs, places)
    return surface.part(faces, proper(faces))


def _collapse(surface: _Surface, target: int, agg: int) -> _Surface:
    positions = surface.positions
    points, number, nearest = collapsed(positions, surface.faces, target, agg)
    # a face remains where no two of its vertices became one
    moved = number[surface.faces]
    kept = proper(moved)
    if len(kept) == 0:
        return replace(surface.part(moved, kept), positions=positions[:0], colors=surface.colors[:0])
    distance = np.linalg.norm(positions - points[number], axis=1)
    used, compact = np.unique(moved[kept], return_inverse=True)
    part = _on_texture(surface, moved, distance).part(moved, kept)
    return replace(part, positions=points[used], faces=compact.reshape(-1, 3), colors=surface.colors[nearest[used]])


def collapsed(
    positions: Floats, faces: Ints, target: int, agg: int, keep_borders: bool = False
) -> tuple[Floats, Ints, Ints]:
    """Return the points, (k, 3), that remain when edges are collapsed until `target` faces are left, or `agg` allows no
    more; which of them each old vertex became, (n,), -1 for none; and the old vertex that is nearest to each, (k,).

    keep_borders: whether edges that touch a border stay.
    """
    from fast_simplification import replay_simplification, simplify

    target = min(target, len(faces))
    corners = faces.astype(np.int32)
    _, _, collapses = simplify(
        positions, corners, target_count=target, agg=agg, return_collapses=True, preserve_border=keep_borders
    )
    points, _, number = replay_simplification(positions, corners, collapses)
    points, number = np.asarray(points, dtype=np.float64), np.asarray(number, dtype=np.int64)
    # of the vertices that became one, the nearest to it comes last, and so stays
    old = np.flatnonzero(number >= 0)
    old = old[np.argsort(-np.linalg.norm(positions[old] - points[number[old]], axis=1), kind="stable")]
    nearest = np.zeros(len(points), dtype=np.int64)
    nearest[number[old]] = old
    return points, number, nearest


def _on_texture(surface: _Surface, moved: Ints, distance: Floats) -> _Surface:
    """Return the surface with the texture coordinates after a collapse to vertices, (m, 3), at distances, (n,).

    Points of the texture between which an edge was collapsed are one: that nearest to the new vertex. So both sides of
    a seam keep their own.
    """
    ends = np.array([[0, 1], [1, 2], [2, 0]])
    collapsed = moved[:, ends[:, 0]] == moved[:, ends[:, 1]]
    links = surface.places[:, ends][collapsed]
    places = components(links, int(surface.places.max(initial=0)) + 1)[surface.places]
    order = np.lexsort((distance[surface.faces].reshape(-1), places.reshape(-1)))
    _, first, number = np.unique(places.reshape(-1)[order], return_index=True, return_inverse=True)
    uvs = np.empty((len(order), 2))
    uvs[order] = surface.uvs.reshape(-1, 2)[order[first]][number.reshape(-1)]
    return replace(surface, uvs=uvs.reshape(-1, 3, 2), places=places)
