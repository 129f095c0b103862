"""Anti-aliased pictures: what OpenGL shows at the places of the four samples."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
from attrs import evolve
from numpy.typing import NDArray

from pictures import UNLIT, draw
from shackled import Background, Mesh, Object, Scene
from shackled.scene import fit

from . import opengl
from .neighbours import around
from .world import World, before_camera

#: Columns and rows of the samples, in pixels from the centre.
SAMPLES = np.array([(-1, -3), (3, -1), (-3, 1), (1, 3)]) / 8
#: How far the samples are moved, in pixels, to see what rounding may change.
MOVES = np.array([(0, 0), (1, 1), (1, -1), (-1, 1), (-1, -1)]) / 24
#: A mean of four colours is rounded to the nearest level.
ROUNDING = 0.51
#: Levels by which the light of a pixel that shows one triangle may differ from that of the plain picture: twice what
#: each may be off.
MOST = 16.0


@dataclass(frozen=True)
class Coverage:
    """pixels: how many show anything. sure: of those, how many are not changed by rounding. faults: one line each."""

    pixels: int = 0
    sure: int = 0
    interior: int = 0
    worst: float = 0.0
    faults: list[str] = field(default_factory=list)

    def __add__(self, other: Coverage) -> Coverage:
        """Both together."""
        return Coverage(
            self.pixels + other.pixels,
            self.sure + other.sure,
            self.interior + other.interior,
            max(self.worst, other.worst),
            self.faults + other.faults,
        )


def compare_samples(name: str, scene: Scene) -> Coverage:
    """Compare which triangles the samples of each pixel show, by a colour for each."""
    scene = fit(evolve(scene, objects=[o for o in scene.objects if not o.wireframe and o.opacity == 1]))
    world = before_camera(scene)
    colors = np.random.default_rng(1).integers(20, 256, (world_size(world) + 1, 3))
    colors[0] = 0
    painted = evolve(
        scene,
        objects=list(_painted(scene.objects, colors)),
        lights=[],
        background=Background("black"),
        invert=False,
        antialias=True,
    )
    ours = draw(painted).astype(float)
    seen = np.array([[opengl.draw(world, place=tuple(place + move)).triangle for move in MOVES] for place in SAMPLES])
    sure = (seen == seen[:, :1]).all(axis=(0, 1))
    expected = colors[seen[:, 0] + 1].mean(axis=0)
    error = np.abs(ours - expected).max(axis=2)
    shows = (seen >= 0).any(axis=(0, 1))
    faults = _faults(name, "the samples show other triangles", sure & (error > ROUNDING), ours, expected)
    # where a pixel and those around it show one triangle, the light is that of the plain picture
    smoothed, plain = (draw(evolve(scene, antialias=flag)).astype(float) for flag in (True, False))
    center = opengl.draw(world).triangle
    inner = sure & (seen[:, 0] == center).all(axis=0) & ~_near_edges(center)
    # highlights end where their light does, between two pixels
    near = around(plain)
    beyond = np.maximum(smoothed - near.max(axis=0), near.min(axis=0) - smoothed)
    difference = np.maximum(beyond, 0).max(axis=2) * inner
    faults += _faults(name, "the light is not that of the plain picture", difference > MOST, smoothed, plain)
    return Coverage(
        int(shows.sum()), int((sure & shows).sum()), int(inner.sum()), float(difference.max(initial=0.0)), faults
    )


def world_size(world: World) -> int:
    """How many triangles a world has."""
    return sum(len(solid.corners) for solid in world.solids)


def _painted(objects: tuple[Object, ...], colors: NDArray[np.int64]) -> Iterator[Object]:
    """The objects, each triangle in one colour."""
    count = 0
    for o in objects:
        positions, faces = o.mesh.positions, o.mesh.faces
        own = np.repeat(colors[1 + count : 1 + count + len(faces)], 3, axis=0)
        mesh = Mesh(positions[faces].reshape(-1, 3), np.arange(3 * len(faces)).reshape(-1, 3), own)
        yield evolve(o, mesh=mesh, material=UNLIT)
        count += len(faces)


def _near_edges(triangles: NDArray[np.int64]) -> NDArray[np.bool_]:
    """(H, W): where a pixel around shows another triangle."""
    wide = np.pad(triangles, 1, constant_values=-2)
    rows, columns = triangles.shape
    return np.asarray(
        np.any([wide[i : i + rows, j : j + columns] != triangles for i in range(3) for j in range(3)], axis=0)
    )


def _faults(
    name: str, what: str, wrong: NDArray[np.bool_], ours: NDArray[np.float64], theirs: NDArray[np.float64]
) -> list[str]:
    places = np.argwhere(wrong)
    if not len(places):
        return []
    row, column = places[0]
    values = f"{ours[row, column].tolist()} in place of {theirs[row, column].tolist()}"
    return [f"{name}: {len(places)} pixels, {what}; pixel ({column}, {row}) is {values}"]
