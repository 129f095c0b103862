"""Materials."""

from __future__ import annotations

import os
from typing import Literal, cast

from attrs import field, frozen

from ..checks import Color, choice, color, instance, number, whole
from ..values import checked, with_names
from ..words import words_of
from ._texture import Texture

Shading = Literal["unlit", "flat", "smooth"]
SHADINGS: tuple[Shading, ...] = ("unlit", "flat", "smooth")


#: The ranges of the coefficients and of the exponent.
COEFFICIENTS = (0, 4)
EXPONENTS = (1, 128)


def _shading(value: str) -> Shading:
    return cast(Shading, choice(value, "the shading of a material", SHADINGS))


def _texture(value: Texture | None) -> Texture | None:
    if isinstance(value, str | os.PathLike):
        return Texture.open(value)
    if value is not None:
        instance(value, "the texture of a material", Texture)
    return value


@words_of()
@frozen(field_transformer=with_names)
class Material:
    """Coefficients of Blinn-Phong shading, each 0..4; the exponent `shininess` 1..128, a whole number.

    shading: "unlit" shows the vertex colours as they are, "flat" takes the normals of the faces, "smooth" those of the
        vertices.
    texture: multiplied with the colours of the vertices, or None; also the path of an image. The mesh needs `uvs`.
    emission: the colour of the light that the surface emits, added to what it reflects; black for none. Other objects
        are not lit by it.
    """

    shading: Shading = field(default="flat", converter=_shading)
    ambient: float = field(
        default=0.3, converter=number, metadata=checked("the ambient coefficient of a material", *COEFFICIENTS)
    )
    diffuse: float = field(
        default=0.75, converter=number, metadata=checked("the diffuse coefficient of a material", *COEFFICIENTS)
    )
    specular: float = field(
        default=0.3, converter=number, metadata=checked("the specular coefficient of a material", *COEFFICIENTS)
    )
    shininess: int = field(default=24, converter=whole, metadata=checked("the shininess of a material", *EXPONENTS))
    texture: Texture | None = field(default=None, converter=_texture)
    emission: Color = field(default=(0, 0, 0), converter=color, metadata=checked("the emission of a material"))
