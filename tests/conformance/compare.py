"""A picture of the contracts against OpenGL's: what is compared, and what is within the bounds."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from attrs import evolve
from numpy.typing import NDArray

from judge import Picture, Verdict, render
from judge.verdict import MANY, MEAN_OF_SCENE, MOST
from pictures import UNLIT, Pixels, call_data, draw
from shackled import Background, Mesh, Object, Scene
from shackled.scene._in_range import in_range

from . import opengl
from .world import before_camera

Triangles = NDArray[np.int64]
Array = NDArray[np.float64]

#: N.L of a light that may reach a surface or not: the corners of a mesh are rounded.
GRAZING = 2.0**-11
#: One in so many pixels of a built-in piece may be off by more than MANY levels.
FEW_OF_PIECE = 200
#: Triangles of an object of which each has corners of its own.
MAX_TRIANGLES = 65535 // 3
#: What a Verdict calls pixels that show another triangle than OpenGL's.
ANOTHER = "another triangle"


@dataclass(frozen=True)
class Drawing:
    """pixels: (H, W, 3). triangle: (H, W) the number of the triangle that is seen, -1 for none."""

    pixels: Pixels
    triangle: Triangles


def picture(scene: Scene) -> Drawing:
    """Draw a scene without wires by the contracts, and the numbers of its triangles as colours."""
    scene = solid(scene)
    numbers = 1 + np.arange(sum(len(o.mesh.faces) for o in scene.objects))
    objects = list(_painted(scene.objects, numbers[:, None] >> [16, 8, 0] & 255))
    painted = evolve(scene, objects=objects, lights=[], background=Background((0, 0, 0)), invert=False)
    return Drawing(draw(scene), (draw(painted).astype(np.int64) << [16, 8, 0]).sum(axis=2) - 1)


def solid(scene: Scene) -> Scene:
    """Return the scene without wires, in the numbers that the contracts get."""
    return in_range(evolve(scene, objects=[o for o in scene.objects if not o.wireframe]))


def _painted(objects: Iterable[Object], colors: NDArray[np.int64]) -> Iterator[Object]:
    """The objects without light, each triangle in one colour of (n, 3)."""
    count = 0
    for o in objects:
        for first in range(0, len(o.mesh.faces), MAX_TRIANGLES):
            part = o.mesh.faces[first : first + MAX_TRIANGLES]
            own = np.repeat(colors[count : count + len(part)], 3, axis=0)
            mesh = Mesh(o.mesh.positions[part].reshape(-1, 3), np.arange(3 * len(part)).reshape(-1, 3), own)
            yield evolve(o, mesh=mesh, material=UNLIT)
            count += len(part)


def compare(name: str, scene: Scene, is_piece: bool = False) -> Verdict:
    """Draw a scene by the contracts and by OpenGL; `is_piece` adds the bound of built-in pieces.

    Colours are compared in interior pixels: those whose eight neighbours show the same triangle, too.
    """
    world = before_camera(scene)
    ours, theirs = picture(scene), opengl.draw(world)
    expected = 255 - theirs.color if scene.invert else theirs.color
    error = np.abs(ours.pixels - expected)
    # a highlight ends where its light does, not gradually: N.L decides, and is zero in the line between two pixels
    step = ~(around(theirs.shining) == theirs.shining).all(axis=0)
    error[step] = outside(ours.pixels, around(expected))[step]
    inner = interior(theirs.triangle) & (ours.triangle == theirs.triangle)
    if (error[inner] > MANY).any():
        both = np.stack([opengl.draw(world, threshold).color for threshold in (-GRAZING, GRAZING)])
        error = np.minimum(error, outside(ours.pixels, 255 - both if scene.invert else both))
    largest = np.where(inner, error.max(axis=2), 0)
    different = np.argwhere(ours.triangle != theirs.triangle)
    faults = []
    if len(different):
        wrong = _wrong(render(call_data("render", solid(scene))), ours.triangle, theirs.triangle, different)
        faults += [f"{name}: {len(wrong)} pixels show a wrong triangle; {wrong[0]}"] if wrong else []
    result = Verdict(
        scenes=1,
        lit=int(((theirs.triangle >= 0) | (ours.triangle >= 0)).sum()),
        interior=int(inner.sum()),
        many=int((largest > MANY).sum()),
        far=int((largest > MOST).sum()),
        worst=float(largest.max(initial=0.0)),
        error=float(error[inner].sum()),
        explained=Counter({ANOTHER: len(different)}),
        faults=faults,
    )
    if result.far or (is_piece and result.many * FEW_OF_PIECE > result.interior):
        row, column = np.unravel_index(largest.argmax(), inner.shape)
        count, bound = (result.far, MOST) if result.far else (result.many, MANY)
        faults.append(
            f"{name}: {count} interior pixels are off by more than {bound:g} levels; pixel ({column}, {row}) is "
            f"{tuple(ours.pixels[row, column].tolist())}, with OpenGL {tuple(expected[row, column].round(1).tolist())}"
        )
    if result.mean > MEAN_OF_SCENE:
        faults.append(f"{name}: the mean error is {result.mean:.3f} levels over {result.interior} pixels")
    return result


def _wrong(right: Picture, ours: Triangles, theirs: Triangles, places: Triangles) -> list[str]:
    """Those of the pixels that may not show what the contracts draw, in words."""
    found = []
    for row, column in places.tolist():
        allowed = right.may_show(column, row)
        if ours[row, column] not in allowed:
            found.append(
                f"pixel ({column}, {row}) shows triangle {ours[row, column]}, with OpenGL {theirs[row, column]}; "
                f"it may show {' or '.join(map(str, allowed))} (-1: nothing)"
            )
    return found


def interior(triangle: Triangles) -> NDArray[np.bool_]:
    """Return which pixels show a triangle, as do their neighbours on the canvas, and the same one: (H, W)."""
    return np.asarray((around(triangle) == triangle).all(axis=0) & (triangle >= 0))


def around(values: NDArray[Any]) -> NDArray[Any]:
    """Return the values of each pixel and its eight neighbours: (9, H, W, ...)."""
    height, width = values.shape[:2]
    padded = np.pad(values, [(1, 1), (1, 1)] + [(0, 0)] * (values.ndim - 2), mode="edge")
    return np.stack([padded[down : down + height, right : right + width] for down, right in np.ndindex(3, 3)])


def outside(pixels: Pixels, expected: Array) -> Array:
    """Return how far a channel is outside of the range of several pictures, (n, H, W, 3): (H, W, 3)."""
    return np.asarray(np.maximum(0, np.maximum(pixels - expected.max(axis=0), expected.min(axis=0) - pixels)))
