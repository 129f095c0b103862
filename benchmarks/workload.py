"""Count the work of a scene: triangles and covered pixels by the contract, their rows and pixels in float64."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from shackled import Scene
from shackled.base.checks import Floats
from shackled.chain import open_chain
from shackled.scene._in_range import in_range
from shackled.stages import project


@dataclass
class Workload:
    """Sums over all objects.

    drawn: triangles left after culling and clipping. rows: of them, also where they cover no pixel. tested: pixels
    whose depths are compared. lit: pixels of the picture that any triangle covers. canvas: all its pixels.
    """

    vertices: int
    faces: int
    drawn: int
    rows: int
    tested: int
    lit: int
    canvas: int


def workload_of(scene: Scene) -> Workload:
    """Count the work of a scene that the near plane does not clip."""
    drawn, lit = open_chain().count(scene)
    rows = tested = 0
    for corners in _triangles(in_range(scene)):
        low, high = (int(each) for each in np.ceil(corners[:, 1].clip(0, scene.height)[[0, 2]] - 0.5))
        rows += high - low
        tested += _covered(corners, np.arange(low, high, dtype=np.float64) + 0.5, scene.width)
    return Workload(
        vertices=sum(len(o.mesh.positions) for o in scene.objects),
        faces=scene.triangles,
        drawn=drawn,
        rows=rows,
        tested=tested,
        lit=lit,
        canvas=scene.width * scene.height,
    )


def _triangles(scene: Scene) -> list[Floats]:
    """Return the triangles that are drawn, (3, 2) in pixels, the topmost corner first, the lowest last."""
    found = []
    for o in scene.objects:
        corners = project(o.world_positions(), scene)[0][o.mesh.faces]
        a, b, c = np.moveaxis(corners, 1, 0)
        # counter-clockwise on the canvas, whose rows count downward
        area = (c[:, 0] - a[:, 0]) * (b[:, 1] - a[:, 1]) - (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1])
        seen = corners[area > 0 if o.cull else area != 0]
        found += list(np.take_along_axis(seen, np.argsort(seen[:, :, 1], axis=1)[:, :, None], axis=1))
    return found


def _covered(corners: Floats, rows: Floats, width: int) -> int:
    """Return how many centres of pixels a triangle covers on these rows of centres."""
    top, _, low = corners
    long = np.interp(rows, [top[1], low[1]], [top[0], low[0]])
    short = np.interp(rows, corners[:, 1], corners[:, 0])
    begin, end = np.sort(np.stack([long, short]), axis=0).clip(0, width)
    return int((np.ceil(end - 0.5) - np.ceil(begin - 0.5)).sum())
