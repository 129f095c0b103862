"""Where the eye is and how it projects."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from numpy.typing import ArrayLike

from ..checks import choice, number, vector
from ..errors import InputError
from .value import Value

Projection = Literal["perspective", "orthographic"]

#: Half the height of the picture at distance 1, by default: a field of view of about 50 degrees (the tangent of half).
DEFAULT_HALF_HEIGHT = 1 / 2.145


@dataclass(frozen=True, eq=False)
class Camera(Value):
    """A camera anywhere in a right-handed world with +y up.

    eye, target, up: (3,) float. The eye looks at the target; `up` is what appears upward in the picture.
    half_height: half the height of what the picture shows: at distance 1 for a perspective camera (the tangent of half
        the vertical field of view, 2^-10..2^10), in world units for an orthographic one.
    near: distance of the near plane; what is nearer is clipped. Positive for a perspective camera. None chooses a
        1,024th of how far any object reaches from the eye; all that is before an orthographic one is shown.
    """

    eye: ArrayLike = (0, 0, 0)
    target: ArrayLike = (0, 0, -1)
    up: ArrayLike = (0, 1, 0)
    projection: Projection = "perspective"
    half_height: float = DEFAULT_HALF_HEIGHT
    near: float | None = None

    def __post_init__(self) -> None:
        for name in ("eye", "target", "up"):
            object.__setattr__(self, name, vector(getattr(self, name), f"the camera's {name}"))
        choice(self.projection, "the camera's projection", ("perspective", "orthographic"))
        low, high = (2**-10, 2**10) if self.projection == "perspective" else (1e-30, 1e30)
        object.__setattr__(self, "half_height", number(self.half_height, "the camera's half_height", low, high))
        if self.near is not None:
            near = number(self.near, "the camera's near distance")
            if self.projection == "perspective" and near <= 0:
                raise InputError(
                    f"the camera's near distance must be above 0 for a perspective camera, not {self.near!r}"
                )
            object.__setattr__(self, "near", near)


def half_height_of(fov: float) -> float:
    """`half_height` of a perspective camera with a vertical field of view of `fov` degrees."""
    return math.tan(math.radians(number(fov, "the field of view in degrees", 0.2, 179.8)) / 2)
