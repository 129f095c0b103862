"""The colours of points of an object, by the formulas of contracts/picture.py, and what they may be instead."""

from __future__ import annotations

from typing import Any

import numpy as np

from picture import (
    FLAT,
    UNLIT,
    Array,
    Integers,
    colored,
    dot,
    light,
    normals,
    radiance,
    surface,
    through_cone,
    toward,
    unit,
)

from .world import World, unproject

#: A highlight ends where N.L is zero: it may or may not be there where N.L is this near to zero.
GRAZING = np.array([0.004, 0, -0.004])[:, None, None]


def colors(
    world: World, solid: Any, face: Integers, weights: Array, places: Array | None = None
) -> tuple[Array, Array, Array]:
    """Return the colours (3, n, 3), 0..255, of points of an object: the least, the likely and the most; lit by all
    lights, and where the light with shadows does not reach. And their opacities (n,).

    face, weights: (n,) and (n, 3) say which points. places: (n, 2) of the canvas, in pixels, where lines of sight and
    to lights begin, at the depths of the points; how far the eye and lights are before a flat face is that of the
    point.
    """
    scene, camera, faces = world.scene, world.camera, solid.faces[face]
    point, base, opacity = surface(solid, faces, weights)
    beside = point if places is None else unproject(camera, places, camera.seen(point)[:, 2:])
    if solid.shading == UNLIT:
        lit = dark = np.broadcast_to(light(scene, base), (3, *base.shape))
    else:
        normal, view = normals(scene, solid, faces, weights), unit(camera.toward(beside))
        rise = dot(normal, beside - point) * (solid.shading == FLAT)
        facing = dot(normal, view) + (rise / _length(camera.eye - beside) if camera.is_perspective else 0)
        cosines = []
        for lamp in scene.lights:
            way = unit(toward(lamp, beside))
            n_l = dot(normal, way) + (rise / _length(lamp.vector - beside) if lamp.is_point else 0)
            cosines.append((through_cone(lamp, way), n_l, (n_l + facing) / _length(way + view)))
        lit, dark = radiance(scene, solid, base, normal, facing, cosines, GRAZING)
    return colored(scene, solid, lit, point), colored(scene, solid, dark, point), opacity


def _length(vectors: Array) -> Array:
    return np.asarray(np.maximum(np.linalg.norm(vectors, axis=-1, keepdims=True), 1e-300))
