"""The Utah teapot, from the Bezier patches that Martin Newell drew in 1975.

32 bicubic patches. Those of the rim, the body, the lid and the bottom are quarters of surfaces of revolution, each
given by the control points of its profile; Newell's quarter circle is the Bezier curve with handles of 0.56 of the
radius. Handle and spout are given by the half at y <= 0 and mirrored. His z axis is up, the handle is at -x and the
spout at +x.
"""

from __future__ import annotations

import numpy as np

from ..base.checks import Floats, whole
from ..scene._mesh import Mesh
from .common import shapes

Profile = tuple[tuple[float, float], ...]
Limb = tuple[tuple[tuple[float, float], tuple[float, float], float], ...]

#: Control points (radius, height) of the profiles, each from the top down, or from the axis outward over the top.
PROFILES = (
    ((1.4, 2.4), (1.3375, 2.53125), (1.4375, 2.53125), (1.5, 2.4)),  # rim
    ((1.5, 2.4), (1.75, 1.875), (2.0, 1.35), (2.0, 0.9)),  # body, upper part
    ((2.0, 0.9), (2.0, 0.45), (1.5, 0.225), (1.5, 0.15)),  # body, lower part
    ((0.0, 3.15), (0.8, 3.15), (0.0, 2.85), (0.2, 2.7)),  # knob of the lid
    ((0.2, 2.7), (0.4, 2.55), (1.3, 2.55), (1.3, 2.4)),  # lid
    ((1.5, 0.15), (1.5, 0.075), (1.425, 0.0), (0.0, 0.0)),  # bottom
)

QUARTER = 0.56
#: The handles of the quarter circles of the knob's second control point, which Newell rounded: 0.45 for a radius of
#: 0.8.
KNOB_QUARTER = 0.45 / 0.8

#: Control points of handle and spout: rows that run along the limb, each with the place (x, z) of its inner and its
#: outer edge in the plane of symmetry, and half its width.
LIMBS = (
    (  # handle, from the rim to its back
        ((-1.6, 2.025), (-1.5, 2.25), 0.3),
        ((-2.3, 2.025), (-2.5, 2.25), 0.3),
        ((-2.7, 2.025), (-3.0, 2.25), 0.3),
        ((-2.7, 1.8), (-3.0, 1.8), 0.3),
    ),
    (  # handle, from its back to the body
        ((-2.7, 1.8), (-3.0, 1.8), 0.3),
        ((-2.7, 1.575), (-3.0, 1.35), 0.3),
        ((-2.5, 1.125), (-2.65, 0.9375), 0.3),
        ((-2.0, 0.9), (-1.9, 0.6), 0.3),
    ),
    (  # spout, from the body
        ((1.7, 1.425), (1.7, 0.6), 0.66),
        ((2.6, 1.425), (3.1, 0.825), 0.66),
        ((2.3, 2.1), (2.4, 2.025), 0.25),
        ((2.7, 2.4), (3.3, 2.4), 0.25),
    ),
    (  # spout, its tip
        ((2.7, 2.4), (3.3, 2.4), 0.25),
        ((2.8, 2.475), (3.525, 2.49375), 0.25),
        ((2.9, 2.475), (3.45, 2.5125), 0.15),
        ((2.8, 2.4), (3.2, 2.4), 0.15),
    ),
)


def patches() -> Floats:
    """Return the control points, (32, 4, 4, 3), z up, u and v in the order of the indices.

    The outside is where d/du x d/dv points.
    """
    quarters = [_quarter(profile, turn) for profile in PROFILES for turn in range(4)]
    halves = [_half(limb, side) for limb in LIMBS for side in (-1, 1)]
    return np.array(quarters + halves)


def teapot(divisions: int = 6) -> Mesh:
    """Return the teapot with y up, about 6.4 wide, standing on y = 0, with vertex normals.

    divisions: parts d into which each side of a patch is divided, 1..32; there are 64 d^2 - 8 d triangles.
    """
    divisions = whole(divisions, "the divisions of the teapot", 1, 32)
    weights = _bernstein(np.linspace(0, 1, divisions + 1))
    points = np.einsum("ui,vj,pijk->puvk", weights, weights, patches())
    side = divisions + 1
    faces = (shapes.cells(side, side) + side**2 * np.arange(len(points))[:, None, None]).reshape(-1, 3)
    # patches meet in the same points but for rounding; at the knob's top and in the middle of the bottom, a whole side
    # of a patch is one point
    return shapes.smooth(points[..., [0, 2, 1]].reshape(-1, 3) * (1, 1, -1), faces)


def _quarter(profile: Profile, turn: int) -> Floats:
    """Return the patch that a profile sweeps in a quarter turn about the z axis, after `turn` of them."""
    rows = []
    for radius, height in profile:
        handle = radius * (KNOB_QUARTER if (radius, height) == (0.8, 3.15) else QUARTER)
        rows.append([(radius, 0, height), (radius, handle, height), (handle, radius, height), (0, radius, height)])
    points = np.array(rows)
    for _ in range(turn):
        points = np.stack([-points[..., 1], points[..., 0], points[..., 2]], axis=-1)
    return points


def _half(limb: Limb, side: int) -> Floats:
    """Return the half of a limb at y < 0 (side -1) or y > 0 (side 1)."""
    rows = [[(xi, 0, zi), (xi, side * w, zi), (xo, side * w, zo), (xo, 0, zo)] for (xi, zi), (xo, zo), w in limb]
    return np.array(rows)[:, ::side]


def _bernstein(t: Floats) -> Floats:
    """Return the weights of the four control points at each t, (n, 4)."""
    s = 1 - t
    return np.stack([s**3, 3 * s**2 * t, 3 * s * t**2, t**3], axis=1)
