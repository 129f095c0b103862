"""The experiments of the Shackled paper on the contracts of this package, and some that it could not make.

Each is a module with `run(lab) -> Report`; `EXPERIMENTS` names them in the order of the paper.
"""

from __future__ import annotations

from importlib import import_module
from importlib.util import find_spec

from ..errors import InputError
from ._lab import Lab
from ._report import Report

EXPERIMENTS = {
    "canvas": "a cube on canvases of 8 x 8 to 512 x 512 pixels, both projections",
    "triangles": "1 to 16 equal triangles",
    "genesis": "the 1024 pieces of Genesis: gas against triangles",
    "culling": "the common objects, with and without backface culling",
    "deploy": "gas and bytes of every contract",
    "engines": "time and gas in every EVM at hand",
    "linear": "how well straight lines fit gas against triangles and pixels",
    "output": "sizes of BMP, data URI and SVG, and what they cost",
}


def run(name: str, lab: Lab) -> Report:
    """What the experiment of that name finds. InputError if there is none."""
    if name not in EXPERIMENTS:
        raise InputError(f"there is no experiment {name!r}; the experiments are {', '.join(EXPERIMENTS)}")
    report: Report = import_module(f"._{name}", __package__).run(lab)
    return report


def check_plots() -> None:
    """InputError if plots cannot be drawn."""
    if find_spec("matplotlib") is None:
        raise InputError("the plots need matplotlib, which is not installed: pip install 'shackled[bench]'")
