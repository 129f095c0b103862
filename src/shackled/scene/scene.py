"""Everything that a picture is made from."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from numpy.typing import ArrayLike

from ..checks import color
from ..errors import InputError
from .background import Background
from .camera import Camera
from .light import Light
from .object import Object

MAX_SIDE = 2048
MAX_LIGHTS = 4


@dataclass(frozen=True)
class Scene:
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
        object.__setattr__(self, "objects", tuple(self.objects))
        object.__setattr__(self, "lights", tuple(self.lights))
        object.__setattr__(self, "ambient_light", color(self.ambient_light, "the ambient light"))
        if len(self.lights) > MAX_LIGHTS:
            raise InputError(f"a scene has up to {MAX_LIGHTS} lights, not {len(self.lights)}")
        for name, side in (("width", self.width), ("height", self.height)):
            if not isinstance(side, int) or isinstance(side, bool) or not 1 <= side <= MAX_SIDE:
                raise InputError(f"the {name} of a picture must be from 1 to {MAX_SIDE} pixels, not {side!r}")
