"""Everything that a picture is made from."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from ..checks import color, instance, integer
from ..errors import InputError
from .background import Background
from .camera import Camera
from .light import Light
from .object import Object
from .value import Value, plural

MAX_SIDE = 2048
MAX_LIGHTS = 4


@dataclass(frozen=True, eq=False)
class Scene(Value):
    """Objects, drawn in their order with one depth buffer, seen by a camera.

    width, height: of the picture in pixels, 1..2048.
    invert: every byte v of the picture becomes 255 - v.
    ambient_light: the colour of the light that comes from everywhere.
    """

    objects: Sequence[Object]
    camera: Camera = field(default_factory=Camera)
    lights: Sequence[Light] = ()
    background: Background = field(default_factory=Background)
    ambient_light: ArrayLike = (255, 255, 255)
    invert: bool = False
    width: int = 128
    height: int = 128

    def __post_init__(self) -> None:
        for name, kind in (("objects", Object), ("lights", Light)):
            try:
                parts = tuple(getattr(self, name))
            except TypeError:
                raise InputError(f"the {name} of a scene must be a list, not {getattr(self, name)!r:.60}") from None
            for number, part in enumerate(parts):
                instance(part, f"{name}[{number}] of a scene", kind)
            object.__setattr__(self, name, parts)
        instance(self.camera, "the camera of a scene", Camera)
        instance(self.background, "the background of a scene", Background)
        object.__setattr__(self, "ambient_light", color(self.ambient_light, "the ambient light"))
        if len(self.lights) > MAX_LIGHTS:
            raise InputError(f"a scene has up to {MAX_LIGHTS} lights, not {len(self.lights)}")
        for name in ("width", "height"):
            side = integer(getattr(self, name))
            if side is None or not 1 <= side <= MAX_SIDE:
                raise InputError(
                    f"the {name} of a picture must be from 1 to {MAX_SIDE} pixels, not {getattr(self, name)!r}"
                )
            object.__setattr__(self, name, side)

    def __repr__(self) -> str:
        """A line."""
        triangles = sum(len(np.asarray(each.mesh.faces)) for each in self.objects)
        return (
            f"<Scene {self.width} x {self.height}, {plural(len(self.objects), 'object')}, "
            f"{plural(triangles, 'triangle')}, {plural(len(self.lights), 'light')}>"
        )
