"""A picture of the contracts against OpenGL's: what is compared, and what is within the bounds."""

from __future__ import annotations

from dataclasses import dataclass, field, fields

import numpy as np
from numpy.typing import NDArray

from judge import Picture, render
from pictures import call_data
from shackled import Scene

from . import contracts, opengl
from .neighbours import around, interior, uniform
from .world import before_camera

Triangles = NDArray[np.int64]

#: Levels of 255 by which no pixel may be off, and by which few may be.
MOST, MANY = 8.0, 4.0
#: N.L of a light that may reach a surface or not: the corners of a mesh are rounded.
GRAZING = 2.0**-11
#: The share of the pixels that may be off by more than MANY: of all of a run, and of those of a built-in piece.
SHARE_OF_RUN, SHARE_OF_PIECE = 1 / 10_000, 1 / 200
#: Fewer scenes are no run.
LEAST_RUN = 20
#: The mean error over a run, and over the pixels of a scene.
MEAN_OF_RUN, MEAN_OF_SCENE = 0.35, 0.6


@dataclass(frozen=True)
class Result:
    """The comparison of one scene, or the sum of those of many.

    scenes: how many. empty: in how many OpenGL draws nothing. pixels: that either drew. interior: those of which the
    eight neighbours show the same triangle too; only their colours are compared. differing: pixels that show different
    triangles. error: the sum of the errors of all channels. many: pixels off by more than MANY levels.
    worst: the largest error. faults: what is out of bounds, in words.
    """

    scenes: int = 0
    empty: int = 0
    pixels: int = 0
    interior: int = 0
    differing: int = 0
    error: float = 0.0
    many: int = 0
    worst: float = 0.0
    faults: list[str] = field(default_factory=list)

    @property
    def mean(self) -> float:
        """The mean error of a channel."""
        return self.error / max(3 * self.interior, 1)

    def __add__(self, other: Result) -> Result:
        sums = {each.name: getattr(self, each.name) + getattr(other, each.name) for each in fields(self)}
        return Result(**sums | {"worst": max(self.worst, other.worst)})

    def faults_of_run(self) -> list[str]:
        """What is out of bounds, in any scene or in all of them together."""
        found = list(self.faults)
        if self.scenes < LEAST_RUN:
            return found
        if self.many > SHARE_OF_RUN * self.interior:
            found.append(f"{self.many} of {self.interior} pixels are off by more than {MANY:g} levels")
        if self.mean > MEAN_OF_RUN:
            found.append(f"the mean error is {self.mean:.3f} levels")
        return found


def compare(name: str, scene: Scene, is_piece: bool = False) -> Result:
    """Draws a scene by the contracts and by OpenGL; `is_piece` adds the bound of built-in pieces."""
    world = before_camera(scene)
    ours, theirs = contracts.picture(scene), opengl.draw(world)
    expected = 255 - theirs.color if scene.invert else theirs.color
    error = np.abs(ours.pixels - expected)
    step = ~uniform(theirs.shining)
    error[step] = beyond(ours.pixels, expected)[step]
    inner = interior(theirs.triangle) & (ours.triangle == theirs.triangle)
    if (error[inner] > MANY).any():
        both = np.stack([opengl.draw(world, threshold).color for threshold in (-GRAZING, GRAZING)])
        error = np.minimum(error, outside(ours.pixels, 255 - both if scene.invert else both))
    largest = error.max(axis=2)
    faults = []
    different = np.argwhere(ours.triangle != theirs.triangle)
    wrong = (
        _wrong(render(call_data("render", contracts.solid(scene))), ours.triangle, theirs.triangle, different)
        if len(different)
        else []
    )
    if wrong:
        faults.append(f"{name}: {len(wrong)} pixels show a wrong triangle; {wrong[0]}")
    far = np.argwhere(inner & (largest > MOST))
    if len(far):
        row, column = max(far, key=lambda place: float(largest[tuple(place)]))
        faults.append(
            f"{name}: {len(far)} interior pixels are off by more than {MOST:g} levels; pixel ({column}, {row}) is "
            f"{tuple(ours.pixels[row, column].tolist())}, with OpenGL {_color(expected[row, column])}"
        )
    result = Result(
        scenes=1,
        empty=int(not (theirs.triangle >= 0).any()),
        pixels=int(((theirs.triangle >= 0) | (ours.triangle >= 0)).sum()),
        interior=int(inner.sum()),
        differing=len(different),
        error=float(error[inner].sum()),
        many=int((largest[inner] > MANY).sum()),
        worst=float(largest[inner].max(initial=0.0)),
        faults=faults,
    )
    if result.mean > MEAN_OF_SCENE:
        faults.append(f"{name}: the mean error is {result.mean:.3f} levels over {result.interior} pixels")
    if is_piece and result.many > SHARE_OF_PIECE * result.interior:
        row, column = np.unravel_index(np.where(inner, largest, 0).argmax(), inner.shape)
        faults.append(
            f"{name}: {result.many} of {result.interior} pixels are off by more than {MANY:g} levels; pixel "
            f"({column}, {row}) is {tuple(ours.pixels[row, column].tolist())}, with OpenGL "
            f"{_color(expected[row, column])}"
        )
    return result


def _wrong(right: Picture, ours: Triangles, theirs: Triangles, places: Triangles) -> list[str]:
    """Those of the pixels that may not show what the contracts draw, in words."""
    found = []
    for row, column in places.tolist():
        allowed = right.may_show(column, row)
        if ours[row, column] not in allowed:
            found.append(
                f"pixel ({column}, {row}) shows {_triangle(ours[row, column])}, with OpenGL "
                f"{_triangle(theirs[row, column])}; it may show {' or '.join(map(_triangle, allowed))}"
            )
    return found


def beyond(pixels: NDArray[np.uint8], expected: NDArray[np.float64]) -> NDArray[np.float64]:
    """(H, W, 3): how far a channel is outside of what it and its neighbours should be.

    A highlight ends where its light does, not gradually: N.L decides, and is zero in the line between two pixels.
    """
    return outside(pixels, around(expected))


def outside(pixels: NDArray[np.uint8], expected: NDArray[np.float64]) -> NDArray[np.float64]:
    """(H, W, 3): how far a channel is outside of the range of several pictures, (n, H, W, 3)."""
    return np.asarray(np.maximum(0, np.maximum(pixels - expected.max(axis=0), expected.min(axis=0) - pixels)))


def _triangle(number: int) -> str:
    return f"triangle {number}" if number >= 0 else "nothing"


def _color(values: NDArray[np.float64]) -> str:
    return f"({', '.join(f'{value:.1f}' for value in values)})"
