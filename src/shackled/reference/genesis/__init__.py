"""The generator of Genesis once more, in Python: what the contract must equal. A seed becomes prisms and colours.

Each file mirrors one of contracts/src/genesis; this one mirrors Genesis.sol.
"""

from __future__ import annotations

from ...datasets.genesis import GenesisPiece
from ...errors import InputError
from .colors import paint
from .layout import Layout
from .prisms import Prisms
from .random import Random
from .schemes import NEVER_INVERTED, choose_scheme
from .structures import SWARM, choose_structure

__all__ = ["generate", "pseudosymmetry"]


def generate(seed: bytes) -> GenesisPiece:
    """Make the piece of a seed of 32 bytes as the contract does. InputError for the rare seed that has none."""
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
    """Name the mirrors."""
    if mirror_x:
        return "Diagonal" if mirror_y else "Horizontal"
    return "Vertical" if mirror_y else "Scattered"
