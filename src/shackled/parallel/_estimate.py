"""Estimate the gas of a large picture from small pictures of the same scene."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from attrs import evolve
from numpy.typing import NDArray

from ..chain import ContractChain
from ..image import decode_bmp
from ..scene import Rectangle, Scene

Pixels = NDArray[np.uint8]

#: The longer sides of the small pictures, in pixels: large enough that most faces cover a pixel.
SIDES = (128, 256)
#: The part of a gas limit that plans use.
USED = 0.9


@dataclass(frozen=True)
class Estimate:
    """The parts of an estimate.

    area: pixels of the picture. fixed: gas of the picture without its pixels. call: the part of `fixed` that each call
    costs, however small its tile, to find the faces that it shows. pixel: mean gas of a pixel. density: the cost of a
    pixel in the densest strip of the picture, divided by the mean. intrinsic: gas to send the scene.
    """

    area: int
    fixed: float
    call: float
    pixel: float
    density: float
    intrinsic: int

    def gas(self, pixels: int, calls: int = 1) -> int:
        """Return the execution gas of a picture that is rendered in so many calls of equal size."""
        return round(self.fixed + (calls - 1) * self.call + calls * memory_gas(pixels // calls) + self.pixel * pixels)

    def pixels_within(self, gas: int) -> int:
        """Return the most pixels of a strip that fits into a gas limit anywhere in the picture, intrinsic gas included;
        0 if none does.
        """
        # vertices and faces cost gas where pixels are covered
        pixel = (self.pixel + max(0.0, self.fixed - self.call) / self.area) * self.density
        fitting, beyond = 0, 1 << 22
        while beyond - fitting > 1:
            middle = (fitting + beyond) // 2
            need = self.intrinsic + self.call + memory_gas(middle) + middle * pixel
            fitting, beyond = (middle, beyond) if need <= USED * gas else (fitting, middle)
        return fitting


def estimate(scene: Scene, chain: ContractChain) -> Estimate:
    """Estimate the cost of a scene; draws small pictures on a chain, which should be a fast one."""
    small, large = (evolve(scene, width=width, height=height) for width, height in _sizes(scene))
    drawings = [chain.draw(each) for each in (small, large)]
    pixels = [each.width * each.height for each in (small, large)]
    gas = [(drawing.gas or 0) - memory_gas(count) for drawing, count in zip(drawings, pixels, strict=True)]
    slope = max(1.0, (gas[1] - gas[0]) / max(1, pixels[1] - pixels[0]))
    corner = chain.draw(large, Rectangle(0, 0, 1, 1))
    empty = chain.draw(evolve(small, objects=[], ground=None))
    return Estimate(
        area=scene.width * scene.height,
        fixed=max(0.0, gas[0] - slope * pixels[0]),
        call=float(corner.gas or 0),
        pixel=slope,
        density=_density(*(decode_bmp(each.bmp, small.width, small.height) for each in (drawings[0], empty))),
        intrinsic=max(drawing.intrinsic_gas or 0 for drawing in drawings),
    )


def _density(drawn: Pixels, empty: Pixels) -> float:
    """Return the share of covered pixels in the densest row, divided by that of the picture."""
    rows = (drawn != empty).any(axis=2).mean(axis=1)
    return float(rows.max() / rows.mean()) if rows.any() else 1.0


def memory_gas(pixels: int) -> int:
    """Return the gas of the memory that engine and renderer each need for so many pixels of 3 bytes."""
    words = 3 * pixels // 32
    return 2 * (3 * words + words * words // 512)


def _sizes(scene: Scene) -> list[tuple[int, int]]:
    """Return two canvas sizes of the same shape, none larger than that of the scene."""
    longer = max(scene.width, scene.height)
    sides = SIDES if longer >= SIDES[1] else ((longer + 1) // 2, longer)
    return [(max(1, round(scene.width * s / longer)), max(1, round(scene.height * s / longer))) for s in sides]
