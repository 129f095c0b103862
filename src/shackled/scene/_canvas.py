"""Scenes with the triangles that their canvas can show."""

from __future__ import annotations

import numpy as np
from attrs import evolve

from ..errors import warn
from ._arithmetic import dot, length, unit, units
from ._mesh import Mesh, face_normals, weld, without_slivers
from ._object import Object
from ._scene import Scene
from ._simplify import NEEDED, collapsed, is_possible

#: Scenes of more triangles are simplified: one for so many pixels of the canvas, or this number if that is more.
PIXELS, FEWEST = 8, 4096
#: The share of triangles that are left at most, or the scene stays as it is.
WORTH = 0.9
#: By how many pixels the surface may move.
TOLERANCE = 0.375
#: Collapses end in the library when each of those that are left would move the surface by more than this distance.
_AGGRESSIVENESS = 5
_DISTANCE = (1e-9 * 102**_AGGRESSIVENESS) ** 0.5
#: Where more of the faces have corners of different colours, the colours are a picture, as fine as a pixel.
_PAINTED = 0.01
#: Digits of the normals of faces by which these are in one plane.
_DIGITS = 4


def as_shown(scene: Scene, name: str) -> Scene:
    """Return the scene without triangles that its canvas is too coarse to show; an InputWarning with the name tells.

    Borders, creases, seams of textures and edges between colours stay as they are, as do the edges of flat shading that
    are seen, wireframes, and all that reaches behind the camera.
    """
    objects = [each for each in scene.objects if not each.wireframe]
    total = sum(each.mesh.triangles for each in objects)
    pixels = scene.width * scene.height
    most = max(pixels if any(_is_painted(each.mesh) for each in objects) else pixels // PIXELS, FEWEST)
    if total <= most or not np.isfinite(scale := _pixels_per_unit(scene)):
        return scene
    canvas = f"{scene.width} x {scene.height} pixels"
    if not is_possible():
        warn(f"{name} is drawn with all of its {total:,} triangles, more than {canvas} show: simplifying it {NEEDED}")
        return scene
    reduced = [each if each.wireframe else _reduced(each, scale, most / total) for each in scene.objects]
    shown = evolve(scene, objects=reduced)
    if shown.triangles > WORTH * scene.triangles:
        return scene
    warn(
        f"{name} is simplified from {scene.triangles:,} to {shown.triangles:,} triangles, as {canvas} show no more; "
        "`max_triangles` all keeps every one"
    )
    return shown


def _is_painted(mesh: Mesh) -> bool:
    colors = mesh.rgba[mesh.faces]
    return bool((colors != colors[:, :1]).any(axis=(1, 2)).mean() > _PAINTED)


def _pixels_per_unit(scene: Scene) -> float:
    """Return how many pixels a unit of the world has at the nearest point; inf if that is not in front of the eye."""
    camera = scene.camera
    pixels = scene.height / (2 * camera.half_height)
    if camera.projection == "orthographic":
        return pixels
    forward = camera.target - camera.eye
    nearest = float(dot(scene.world_positions() - camera.eye, unit(forward)).min()) if forward.any() else 0.0
    return pixels / nearest if nearest > 0 else np.inf


def _reduced(o: Object, scale: float, share: float) -> Object:
    """Return the object with that share of its triangles, or more, as the surface moves by `TOLERANCE` at most.

    Colours and normals become the means, by area, of those collapsed into one. scale: pixels per unit.
    """
    mesh, scale = o.mesh, o.scale * scale * _DISTANCE / TOLERANCE
    whole = _apart(mesh) if o.material.shading == "flat" else mesh
    count = len(whole.positions)
    normals = np.zeros((count, 3)) if whole.normals is None else whole.normals
    uvs = np.zeros((count, 2)) if whole.uvs is None else whole.uvs
    # vertices of one place that differ are on a border of either part, which stays
    rows, number = np.unique(np.hstack([whole.positions, whole.rgba, normals, uvs]), axis=0, return_inverse=True)
    faces = without_slivers(number.reshape(-1)[whole.faces])
    positions, values = np.ascontiguousarray(rows[:, :3] * scale), rows[:, 3:]
    points, became, nearest = collapsed(positions, faces, int(share * len(faces)), _AGGRESSIVENESS, keep_borders=True)
    # the library has no place for some vertices of needles
    lost = ~np.isfinite(points).all(axis=1)
    points[lost] = positions[nearest[lost]]
    weights = np.bincount(faces.ravel(), np.repeat(length(face_normals(positions[faces])), 3), len(rows))
    old = np.flatnonzero((became >= 0) & (weights > 0))
    sums = np.zeros((len(points), 7))
    np.add.at(sums, became[old], weights[old, None] * values[old, :7])
    left = without_slivers(became[faces])
    if not len(left):
        return o
    areas = np.bincount(became[old], weights[old], len(points))[:, None]
    colors = np.rint(np.divide(sums[:, :4], areas, out=values[nearest, :4], where=areas > 0))
    lengths = length(sums[:, 4:])[:, None]
    normals = np.divide(sums[:, 4:], lengths, out=values[nearest, 4:7], where=lengths > 0)
    shading, texture = None if mesh.normals is None else normals, None if mesh.uvs is None else values[nearest, 7:]
    corners = [None if each is None else each[left] for each in (colors, shading, texture)]
    return evolve(o, mesh=weld(points / scale, left, *corners))


def _apart(mesh: Mesh) -> Mesh:
    """Return the mesh with vertices, and normals, of their own for each face; those of faces in one plane are alike."""
    corners = mesh.positions[mesh.faces]
    normals = np.round(units(face_normals(corners)), _DIGITS) + 0.0
    flat = mesh.faces.reshape(-1)
    uvs = None if mesh.uvs is None else mesh.uvs[flat]
    apart = np.arange(len(flat)).reshape(-1, 3)
    return Mesh(corners.reshape(-1, 3), apart, mesh.rgba[flat], np.repeat(normals, 3, axis=0), uvs)
