"""Cameras: position, direction and projection."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from attrs import field, frozen
from numpy.typing import ArrayLike

from ..base.checks import Floats, choice, number, optional_number, vector
from ..base.synonyms import Given, with_synonyms
from ..base.values import Value
from ..errors import InputError
from ._arithmetic import tangent
from ._fields import FIELDS, Projection
from ._table import USUAL, from_table

#: Half the height of the picture at distance 1, by default: a field of view of about 50 degrees (the tangent of half).
DEFAULT_HALF_HEIGHT: float = FIELDS["Camera"]["half_height"].default

_EYE, _TARGET, _UP = (FIELDS["Camera"][name].default for name in ("eye", "target", "up"))


def _with_fov(given: Given) -> Given:
    """Return the fields of a camera, whose half height may be given by its field of view."""
    if "fov" in given:
        if "half_height" in given:
            raise InputError("`fov` and `half_height` exclude each other: give one of them")
        given["half_height"] = half_height_in(given, given.get("projection", "perspective") != "perspective")
        del given["fov"]
    return given


def half_height_in(given: Mapping[str, Any], orthographic: bool) -> float | None:
    """Return the half height of the view that `fov` or `half_height` asks for; None without them."""
    if "fov" not in given:
        return given.get("half_height")
    if orthographic:
        raise InputError("an orthographic camera has no field of view: give `half_height` instead of `fov`")
    return half_height_of(given["fov"])


@with_synonyms("fov", read=_with_fov)
@frozen(field_transformer=from_table)
class Camera(Value):
    """A camera anywhere in a right-handed world with +y up.

    eye, target, up: (3,) float. The eye looks at the target; `up` is what appears upward in the picture.
    half_height: half the height of what the picture shows: at distance 1 for a perspective camera (the tangent of half
        the vertical field of view, 2^-10..2^10), in world units for an orthographic one. Also given as `fov`, in
        degrees, of a perspective camera.
    near: distance of the near plane, before which geometry is clipped. Positive for a perspective camera. None for
        1/1,024 of the farthest distance of an object; an orthographic camera then clips nothing.
    """

    eye: Floats = field(default=USUAL, converter=vector)
    target: Floats = field(default=USUAL, converter=vector)
    up: Floats = field(default=USUAL, converter=vector)
    projection: Projection = field(default=USUAL, converter=choice)
    half_height: float = field(default=USUAL, converter=number)
    near: float | None = field(default=None, converter=optional_number)

    def __attrs_post_init__(self) -> None:
        perspective = self.projection == "perspective"
        low, high = (2**-10, 2**10) if perspective else (1e-30, 1e30)
        number(self.half_height, "the camera's half_height", low, high)
        if perspective and self.near is not None and self.near <= 0:
            raise InputError(f"the camera's near distance must be above 0 for a perspective camera, not {self.near!r}")

    @classmethod
    @with_synonyms()
    def perspective(
        cls,
        eye: ArrayLike = _EYE,
        target: ArrayLike = _TARGET,
        up: ArrayLike = _UP,
        *,
        fov: float = 50,
        near: float | None = None,
    ) -> Camera:
        """Return a perspective camera. fov: its vertical field of view in degrees, 0.2..179.8."""
        return cls(eye, target, up, "perspective", half_height_of(fov), near)

    look_at = perspective

    @classmethod
    def orthographic(
        cls,
        eye: ArrayLike = _EYE,
        target: ArrayLike = _TARGET,
        up: ArrayLike = _UP,
        *,
        height: float,
        near: float | None = None,
    ) -> Camera:
        """Return an orthographic camera. height: of what the picture shows, in world units."""
        return cls(eye, target, up, "orthographic", number(height, "the height that the camera shows") / 2, near)


def half_height_of(fov: float) -> float:
    """Return the `half_height` of a perspective camera with a vertical field of view of `fov` degrees."""
    return tangent(number(fov, "the field of view in degrees", *FIELDS["Camera"]["fov"].limits) / 2)
