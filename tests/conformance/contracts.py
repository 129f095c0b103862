"""What the contracts draw: a picture, and which triangle each of its pixels shows."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np
from attrs import evolve
from numpy.typing import NDArray

from pictures import UNLIT, draw
from shackled import Background, Mesh, Object, Scene
from shackled.scene import fit

#: Of an object of which each triangle has corners of its own.
MAX_TRIANGLES = 65535 // 3


@dataclass(frozen=True)
class Drawing:
    """pixels: (H, W, 3). triangle: (H, W) the number of the triangle that is seen, -1 for none."""

    pixels: NDArray[np.uint8]
    triangle: NDArray[np.int64]


def picture(scene: Scene) -> Drawing:
    """The picture of a scene without wires."""
    scene = solid(scene)
    numbers = 1 + np.arange(sum(len(o.mesh.faces) for o in scene.objects))
    channels = draw(painted(scene, numbers[:, None] >> [16, 8, 0] & 255)).astype(np.int64)
    return Drawing(draw(scene), (channels << [16, 8, 0]).sum(axis=2) - 1)


def solid(scene: Scene) -> Scene:
    """The scene without wires, in the numbers that the contracts get."""
    return fit(evolve(scene, objects=[o for o in scene.objects if not o.wireframe]))


def painted(scene: Scene, colors: NDArray[np.int64]) -> Scene:
    """The scene on black, each triangle in one colour of (n, 3), without light."""
    objects = list(_painted(scene.objects, colors))
    return evolve(scene, objects=objects, lights=[], background=Background((0, 0, 0)), invert=False)


def _painted(objects: Iterable[Object], colors: NDArray[np.int64]) -> Iterator[Object]:
    count = 0
    for o in objects:
        positions, faces = o.mesh.positions, o.mesh.faces
        for first in range(0, len(faces), MAX_TRIANGLES):
            part = faces[first : first + MAX_TRIANGLES]
            own = np.repeat(colors[count : count + len(part)], 3, axis=0)
            mesh = Mesh(positions[part].reshape(-1, 3), np.arange(3 * len(part)).reshape(-1, 3), own)
            yield evolve(o, mesh=mesh, material=UNLIT)
            count += len(part)
