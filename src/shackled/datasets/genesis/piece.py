"""A piece of the collection: from a seed to prisms, colours and names.

As contracts/src/genesis/Genesis.sol.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from ...errors import InputError
from ...scene.background import Background
from ...scene.light import Light
from ...scene.material import Material
from ...scene.mesh import Mesh
from ...scene.object import Object
from ...scene.scene import Scene
from .colors import paint
from .layout import Layout
from .prisms import Prisms
from .random import Random
from .schemes import NEVER_INVERTED, choose_scheme
from .structures import SWARM, choose_structure
from .trigonometry import Point3

#: Every piece is lit alike: its colours show in full, and light comes from the left.
MATERIAL = Material("flat", ambient=1, diffuse=0.8, specular=1.2, shininess=10)
LIGHT = Light("directional", (-50, 0, 0))
POSITION = (0, 0, -2500)


@dataclass(frozen=True)
class GenesisPiece:
    """What a seed stands for.

    background: the colours at the top and at the bottom. prisms: how many. verts: six a prism. cols: their colours,
    red, green and blue, 0..255. faces: seven a prism. culling: whether faces that turn away are left out.
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
        """The piece as JSON has it; `seed` in 64 hexadecimal digits."""
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
        """How it is drawn: 128 x 128 pixels, seen from the front, lit from the left."""
        mesh = Mesh(self.verts, self.faces, self.cols)
        return Scene(
            [Object(mesh, POSITION, material=MATERIAL, cull=self.culling, wireframe=self.wireframe)],
            lights=[LIGHT],
            background=Background(*self.background),
            invert=self.invert,
        )


def generate(seed: bytes) -> GenesisPiece:
    """The piece of a seed of 32 bytes, as the contract makes it. InputError for the rare seed that has none."""
    if len(seed) != 32:
        raise InputError(f"a seed has 32 bytes, not {len(seed)}")
    random = Random(seed)
    structure = choose_structure(random)
    layout = Layout(random, structure)
    triangles = layout.triangles
    if not triangles:
        raise InputError(f"the seed {seed.hex()} has no piece: no triangle fits")
    prisms = Prisms(random, triangles)
    scheme = choose_scheme(random, len(triangles))
    wireframe = structure.index != SWARM and random.draw("wireframe", low=1, high=100) > 95
    return GenesisPiece(
        seed=seed,
        structure=structure.name,
        chroma=scheme.name,
        pseudosymmetry=pseudosymmetry(layout.mirror_x, layout.mirror_y),
        prisms=len(triangles),
        wireframe=wireframe,
        culling=not wireframe,
        invert=scheme.index not in NEVER_INVERTED and random.draw("invert", low=1, high=10) > 6,
        background=(scheme.top, scheme.bottom),
        verts=prisms.vertices,
        cols=paint(random, scheme, prisms),
        faces=prisms.faces,
    )


def pseudosymmetry(mirror_x: bool, mirror_y: bool) -> str:
    """What the mirrors are called."""
    if mirror_x:
        return "Diagonal" if mirror_y else "Horizontal"
    return "Vertical" if mirror_y else "Scattered"
