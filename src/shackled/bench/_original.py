"""The gas of the original Shackled contracts, measured again, and figures of their paper.

original.csv has the execution gas of the scenes. None of their code is used.
"""

from __future__ import annotations

import csv
from dataclasses import dataclass
from functools import cache
from importlib.resources import files


@dataclass(frozen=True)
class Measured:
    """A scene on the original contracts: faces, faces left after culling, side of the canvas, covered pixels, gas."""

    triangles: int
    drawn: int
    canvas: int
    lit_pixels: int
    gas: int


@cache
def original() -> dict[str, Measured]:
    """Return what was measured on the original contracts, by the name of the scene."""
    text = files(__package__).joinpath("original.csv").read_text("utf-8")
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    return {row.pop("scene"): Measured(**{k: int(v) for k, v in row.items()}) for row in csv.DictReader(lines)}


def original_gas(name: str) -> int | None:
    """Return the execution gas of a scene on the original contracts; None where it was not measured."""
    found = original().get(name)
    return None if found is None else found.gas


# ---- the build that original.csv was measured with: solc 0.8.9, optimizer with 200 runs ----

#: Bytes of the code of each contract.
CODE_SIZES = {
    "token": 17871,
    "Genesis": 17809,
    "ColorUtils": 15819,
    "GeomUtils": 11865,
    "Rasteriser": 11302,
    "Renderer": 11272,
    "Coords": 6307,
}
#: Gas of the transactions that deploy all seven.
DEPLOYMENT_GAS = 20_600_000

# ---- the paper ----
# I. Smith, C. Clifton: Shackled: a 3D Rendering Engine Programmed Entirely in Ethereum Smart Contracts

#: Mean gas of the common graphics objects, and how many times as much it is without culling.
PAPER_CULLED, PAPER_UNCULLED, PAPER_CULLING_RATIO = 4.39e10, 1.54e11, 3.51
#: The deployment of Shackled, in ether.
PAPER_DEPLOYMENT_ETHER = 0.258
