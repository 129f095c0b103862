"""Estimate the gas of a large picture from small pictures of the same scene."""

from __future__ import annotations

import math
from bisect import bisect_right
from dataclasses import dataclass

from attrs import evolve

from ..chain._opening import open_chain
from ..image import decode_bmp
from ..scene._codec import Rectangle
from ..scene._scene import Scene
from ._tiles import LARGE

#: The longer sides of the small pictures, in pixels: large enough that most faces cover a pixel.
SIDES = (128, 256)
#: The part of a gas limit that plans use.
USED = 0.9
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

    def gas(self, calls: int = 1) -> int:
        """Return the execution gas of the picture, rendered in so many calls of equal size."""
        fixed = self.fixed + (calls - 1) * self.call
        return round(fixed + calls * memory_gas(self.area // calls) + self.pixel * self.area)

    def cheapest_strips(self) -> int:
        """Return the number of strips in which the picture costs least; 1 for a picture that is not `LARGE`.

        Memory costs the square of its size: q / n for n strips in place of q for the whole. Each strip costs c more,
        for what it repeats and to send the scene, so that the least is at n = sqrt(q / c).
        """
        if self.area < LARGE:
            return 1
        each = STRIP * self.call + self.intrinsic
        return max(1, min(MOST_STRIPS, round(math.sqrt(_square(self.area) / max(1.0, each)))))

    def pixels_within(self, gas: int) -> int:
        """Return the most pixels of a strip that fits into a gas limit anywhere in the picture, intrinsic gas included;
        0 if none does.
        """
        # vertices and faces cost gas where pixels are covered
        pixel = (self.pixel + max(0.0, self.fixed - self.call) / self.area) * self.density
        left = USED * gas - self.intrinsic - self.call
        return max(0, bisect_right(range(1 << 22), left, key=lambda pixels: memory_gas(pixels) + pixels * pixel) - 1)


def estimate(scene: Scene) -> Estimate:
    """Estimate the cost of a scene, from small pictures of it that the embedded EVM draws."""
    chain = open_chain()
    small, large = (evolve(scene, width=width, height=height) for width, height in _sizes(scene))
    drawings = [chain.draw(each) for each in (small, large)]
    pixels = [each.width * each.height for each in (small, large)]
    gas = [(drawing.gas or 0) - memory_gas(count) for drawing, count in zip(drawings, pixels, strict=True)]
    slope = max(1.0, (gas[1] - gas[0]) / max(1, pixels[1] - pixels[0]))
    corner = chain.draw(large, Rectangle(0, 0, 1, 1))
    empty = chain.draw(evolve(small, objects=[], ground=None))
    drawn, background = (decode_bmp(each.bmp, small.width, small.height) for each in (drawings[0], empty))
    # the share of covered pixels of each row
    rows = (drawn != background).any(axis=2).mean(axis=1)
    return Estimate(
        area=scene.width * scene.height,
        fixed=max(0.0, gas[0] - slope * pixels[0]),
        call=float(corner.gas or 0),
        pixel=slope,
        density=float(rows.max() / rows.mean()) if rows.any() else 1.0,
        intrinsic=max(drawing.intrinsic_gas or 0 for drawing in drawings),
    )


def memory_gas(pixels: int) -> int:
    """Return the gas of the memory that engine and renderer each need for so many pixels of 3 bytes."""
    return 6 * (3 * pixels // 32) + _square(pixels)


def _square(pixels: int) -> int:
    """Return the part of `memory_gas` that grows with the square of the pixels."""
    return 2 * ((3 * pixels // 32) ** 2 // 512)


def _sizes(scene: Scene) -> list[tuple[int, int]]:
    """Return two canvas sizes of the same shape, none larger than that of the scene."""
    longer = max(scene.width, scene.height)
    sides = SIDES if longer >= SIDES[1] else ((longer + 1) // 2, longer)
    return [(max(1, round(scene.width * s / longer)), max(1, round(scene.height * s / longer))) for s in sides]
