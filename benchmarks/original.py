"""The interface of the original contracts, and what those cost."""

from __future__ import annotations

import numpy as np
from eth_abi.abi import encode

from shackled import Mesh
from shackled.artifacts import artifact
from shackled.bench.original import original

LIGHTING = "(bool,int256,int256,int256,uint256,int256[3],int256[3],int256[3],int256[3])"
PARAMETERS = f"(uint256[3][],int256[3][],int256[3][],int256[3],int256,int256[3][2],{LIGHTING},bool,bool,bool,bool)"

#: Toward the upper right; power 2,000 at a distance of 50, as the original's own pieces have it.
LIGHT = (True, 0, 2000, 2000, 10, (40, 30, 0), (255, 255, 255), (1, 1, 1), (0, 0, 0))


def original_gas() -> dict[str, int]:
    """Execution gas of the original contracts, by the name of the scene."""
    return {name: figures.gas for name, figures in original().items()}


def original_call(mesh: Mesh, size: int, svg: bool) -> bytes:
    """A call of `render` of the original's interface: a mesh of whole coordinates, lit, before the camera."""
    faces, positions, colors = (
        np.asarray(table).astype(int).tolist() for table in (mesh.faces, mesh.positions, mesh.colors)
    )
    background = ((0, 0, 40), (0, 0, 160))
    parameters = (faces, positions, colors, (0, 0, -2500), 1, background, LIGHT, True, True, False, False)
    return artifact("Original").selectors["render"] + encode([PARAMETERS, "int256", "bool"], [parameters, size, svg])
