"""A piece of Genesis."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from ...scene import Background, Light, Material, Mesh, Object, Scene

#: A vertex, a colour, or the corners of a face.
Point3 = tuple[int, int, int]

#: Every piece has full ambient light, and a light from the left.
MATERIAL = Material("flat", ambient=1, diffuse=0.8, specular=1.2, shininess=10)
LIGHT = Light("directional", (-50, 0, 0))
POSITION = (0, 0, -2500)


@dataclass(frozen=True)
class GenesisPiece:
    """The piece of a seed.

    background: the colours of the top and the bottom.
    prisms: number of prisms.
    verts: six vertices per prism.
    cols: their colours, red, green and blue, 0..255.
    faces: seven faces per prism.
    culling: whether faces that point away are left out.
    """

    seed: bytes
    structure: str
    chroma: str
    pseudosymmetry: str
    prisms: int
    wireframe: bool
    culling: bool
    invert: bool
    background: tuple[Point3, Point3]
    verts: Sequence[Point3]
    cols: Sequence[Point3]
    faces: Sequence[Point3]

    def document(self) -> dict[str, Any]:
        """Return the piece as a JSON object; `seed` is 64 hexadecimal digits."""
        return {
            "seed": self.seed.hex(),
            "structure": self.structure,
            "chroma": self.chroma,
            "pseudosymmetry": self.pseudosymmetry,
            "prisms": self.prisms,
            "wireframe": self.wireframe,
            "culling": self.culling,
            "invert": self.invert,
            "background": [list(color) for color in self.background],
            "verts": [list(vertex) for vertex in self.verts],
            "cols": [list(color) for color in self.cols],
            "faces": [list(face) for face in self.faces],
        }

    def scene(self) -> Scene:
        """Return the scene: 128 x 128 pixels, seen from the front, lit from the left."""
        mesh = Mesh(self.verts, self.faces, self.cols)
        return Scene(
            [Object(mesh, POSITION, material=MATERIAL, cull=self.culling, wireframe=self.wireframe)],
            lights=[LIGHT],
            background=Background(*self.background),
            invert=self.invert,
        )
