"""Anti-aliased pictures: what OpenGL shows at the places of the four samples."""

from __future__ import annotations

import numpy as np
from attrs import evolve
from numpy.typing import NDArray

from pictures import draw
from shackled import Scene
from shackled.scene import fit

from . import opengl
from .compare import Result, beyond
from .contracts import painted
from .neighbours import interior
from .world import before_camera

#: Columns and rows of the samples, in pixels from the centre.
SAMPLES = np.array([(-1, -3), (3, -1), (-3, 1), (1, 3)]) / 8
#: How far the samples are moved, in pixels, to see what rounding may change.
MOVES = np.array([(0, 0), (1, 1), (1, -1), (-1, 1), (-1, -1)]) / 24
#: A mean of four colours is rounded to the nearest level.
ROUNDING = 0.51
#: Levels by which a pixel that shows one triangle may leave the range of the plain picture around it. The most that was
#: found is 1, in the random scenes of the seeds 200 to 650 and in all pieces.
MOST = 2.0


def compare_samples(name: str, scene: Scene) -> Result:
    """Compare which triangles the samples of each pixel show, by a colour for each; then their light.

    `differing` in the result counts pixels of which rounding may change a sample: they are not compared.
    """
    scene = fit(evolve(scene, objects=[o for o in scene.objects if not o.wireframe and o.opacity == 1]))
    world = before_camera(scene)
    colors = np.random.default_rng(1).integers(20, 256, (1 + sum(len(o.mesh.faces) for o in scene.objects), 3))
    colors[0] = 0
    ours = draw(evolve(painted(scene, colors[1:]), antialias=True)).astype(float)
    seen = np.array([[opengl.draw(world, place=tuple(place + move)).triangle for move in MOVES] for place in SAMPLES])
    sure = (seen == seen[:, :1]).all(axis=(0, 1))
    expected = colors[seen[:, 0] + 1].mean(axis=0)
    error = np.abs(ours - expected).max(axis=2)
    shows = (seen >= 0).any(axis=(0, 1))
    faults = _faults(name, "the samples show other triangles", sure & (error > ROUNDING), ours, expected)
    # where a pixel and those around it show one triangle, the light is that of the plain picture
    smoothed, plain = (draw(evolve(scene, antialias=flag)) for flag in (True, False))
    center = opengl.draw(world).triangle
    inner = sure & (seen[:, 0] == center).all(axis=0) & interior(center)
    light = beyond(smoothed, plain.astype(float)).max(axis=2) * inner
    faults += _faults(name, "the light is not that of the plain picture", light > MOST, smoothed, plain)
    return Result(
        scenes=1,
        empty=int(not shows.any()),
        pixels=int(shows.sum()),
        interior=int(inner.sum()),
        differing=int((shows & ~sure).sum()),
        worst=float(light.max(initial=0.0)),
        faults=faults,
    )


def _faults(
    name: str, what: str, wrong: NDArray[np.bool_], ours: NDArray[np.generic], theirs: NDArray[np.generic]
) -> list[str]:
    places = np.argwhere(wrong)
    if not len(places):
        return []
    row, column = places[0]
    values = f"{ours[row, column].tolist()} in place of {theirs[row, column].tolist()}"
    return [f"{name}: {len(places)} pixels, {what}; pixel ({column}, {row}) is {values}"]
