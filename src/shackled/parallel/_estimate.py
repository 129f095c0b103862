"""Estimate the gas of a large picture from small pictures of the same scene."""

from __future__ import annotations

import math
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
#: From so many pixels on, pictures are cut into strips to save gas: a fifth of that of plain flat models at 1024 x 1024
#: pixels, half at 2048 x 2048, but less than a tenth at 768 x 768, where a picture of one call is worth more.
LARGE = 1024 * 1024
#: The most strips of a picture that is cut only to save gas: each is a call, on a node a request.
MOST_STRIPS = 32
#: The cost of one more strip over `Estimate.call`, by measurement 1.3 to 1.9: triangles across its border are set up
#: twice.
STRIP = 2


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

    def cheapest_strips(self) -> int:
        """Return the number of strips in which the picture costs least; 1 for a picture that is not `LARGE`.

        Memory costs the square of its size: q / n for n strips in place of q for the whole. Each strip costs c more,
        for what it repeats and to send the scene, so that the least is at n = sqrt(q / c).
        """
        if self.area < LARGE:
            return 1
        each = STRIP * self.call + self.intrinsic
        return max(1, min(MOST_STRIPS, round(math.sqrt(_memory_gas(self.area)[1] / max(1.0, each)))))

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
    return sum(_memory_gas(pixels))


def _memory_gas(pixels: int) -> tuple[int, int]:
    """Return the linear and the quadratic part of `memory_gas`."""
    words = 3 * pixels // 32
    return 6 * words, 2 * (words * words // 512)


def is_large(scene: Scene) -> bool:
    """Return whether a picture is cut into strips because that is cheaper."""
    return scene.width * scene.height >= LARGE


def _sizes(scene: Scene) -> list[tuple[int, int]]:
    """Return two canvas sizes of the same shape, none larger than that of the scene."""
    longer = max(scene.width, scene.height)
    sides = SIDES if longer >= SIDES[1] else ((longer + 1) // 2, longer)
    return [(max(1, round(scene.width * s / longer)), max(1, round(scene.height * s / longer))) for s in sides]
