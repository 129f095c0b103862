"""A ground under the objects of a scene."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from attrs import evolve, field, frozen
from numpy.typing import ArrayLike

from ..base.checks import Color, Floats, color, optional_number, vector
from ..errors import InputError
from ._arithmetic import length
from ._mesh import Mesh
from ._object import Material, Object
from ._table import from_table

#: The radius of a ground, as a multiple of half the diagonal of the box around the objects; the part of the radius at
#: which it begins to fade; how far it is below the lowest vertex, as a part of that half diagonal.
REACH, INNER, GAP = 2.25, 0.4, 2.0**-10
#: Matte.
MATERIAL = Material("flat", ambient=0.4, diffuse=0.7, specular=0.0)
#: Its coordinates are multiples of the half diagonal, rounded up to a power of two, times this.
STEP = 2.0**-20


def _center(value: ArrayLike | None, name: str = "the center") -> tuple[float, float] | None:
    if value is None:
        return None
    x, z = vector(value, name, 2).tolist()
    return x, z


def _check_radii(inner: float, radius: float) -> None:
    if inner >= radius:
        raise InputError(f"the inner radius of a ground, {inner:g}, must be below its radius, {radius:g}")


@frozen(field_transformer=from_table)
class Ground:
    """A level, matte disc under the objects, which receives shadows and fades into the background; it is drawn last.

    height: its y in the world; just below the lowest vertex by default.
    radius: where nothing is left of it, in world units, above 0; a multiple of the size of the objects by default.
    center: its x and z in the world; the middle of the objects by default.
    inner: where it begins to fade, in world units, at least 0 and below the radius; 0.4 of the radius by default.
    """

    color: Color = field(converter=color)
    height: float | None = field(default=None, converter=optional_number)
    radius: float | None = field(default=None, converter=optional_number)
    center: tuple[float, float] | None = field(default=None, converter=_center)
    inner: float | None = field(default=None, converter=optional_number)

    def __attrs_post_init__(self) -> None:
        if self.radius == 0:
            raise InputError("the radius of a ground must be above 0")
        if self.radius is not None and self.inner is not None:
            _check_radii(self.inner, self.radius)

    def under(self, points: Floats) -> Object:
        """Return the object that is this ground under points of the world, (n, 3)."""
        if not len(points):
            points = np.zeros((1, 3))
        low, high = points.min(axis=0) / 2, points.max(axis=0) / 2
        half = float(length(high - low)) or 1.0
        step = math.ldexp(STEP, math.frexp(half)[1])

        def on_grid(value: float) -> float:
            return math.floor(value / step) * step

        x, _, z = (on_grid(float(value)) for value in low + high)
        if self.center is not None:
            x, z = self.center
        height = on_grid(2 * float(low[1]) - GAP * half) if self.height is None else self.height
        radius = on_grid(REACH * half) if self.radius is None else self.radius
        inner = INNER * radius if self.inner is None else self.inner
        _check_radii(inner, radius)
        mesh = Mesh([(-1, 0, -1), (-1, 0, 1), (1, 0, 1), (1, 0, -1)], [(0, 1, 2, 3)], self.color)
        return Object(mesh, (x, height, z), scale=radius, material=MATERIAL, fade=(inner, radius))

    def settled(self, points: Floats) -> Ground:
        """Return the ground with what it is by default under points of the world, (n, 3)."""
        under = self.under(points)
        x, height, z = under.position.tolist()
        return evolve(self, height=height, radius=under.scale, center=(x, z), inner=under.fade and under.fade[0])


def ground_of(value: Any, name: str = "the ground") -> Ground | None:
    """Return a ground, given as itself or as a colour."""
    return value if value is None or isinstance(value, Ground) else Ground(color(value, name))
