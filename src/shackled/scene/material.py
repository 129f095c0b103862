"""How a surface answers light."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from ..checks import choice, number
from .value import Value

Shading = Literal["unlit", "flat", "smooth"]


@dataclass(frozen=True, eq=False)
class Material(Value):
    """Coefficients of Blinn-Phong shading, each 0..4; the exponent `shininess` 1..128.

    shading: "unlit" shows the vertex colours as they are, "flat" takes the normals of the faces, "smooth" those of the
        vertices.
    """

    shading: Shading = "flat"
    ambient: float = 0.2
    diffuse: float = 0.7
    specular: float = 0.4
    shininess: int = 20

    def __post_init__(self) -> None:
        choice(self.shading, "the shading of a material", ("unlit", "flat", "smooth"))
        for name in ("ambient", "diffuse", "specular"):
            value = number(getattr(self, name), f"the {name} coefficient of a material", 0, 4)
            object.__setattr__(self, name, value)
        shininess = number(self.shininess, "the shininess of a material", 1, 128)
        object.__setattr__(self, "shininess", round(shininess))
