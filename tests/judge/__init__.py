"""Judge pictures by their definition in float64, contracts/picture.py, which shares nothing with the package.

It reads the same calldata as the contracts, so that both see the same numbers. For each pixel it finds the range in
which its colour may lie when samples move by 0.04 pixels.
"""

from .composition import Picture, render
from .verdict import Verdict, draw_in_tiles, judge, judge_pixels

__all__ = ["Picture", "Verdict", "draw_in_tiles", "judge", "judge_pixels", "render"]
