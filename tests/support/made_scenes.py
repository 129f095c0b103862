"""Scenes that several tests draw."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from attrs import evolve

from pictures import UNLIT
from shackled import Background, Camera, Light, Material, Mesh, Object, Scene
from shackled.bench.scenes import SUN
from shackled.datasets import teapot
from shackled.scene import vertex_normals

WHITE, RED, GREEN, BLUE = (255, 255, 255), (255, 60, 40), (60, 255, 90), (70, 110, 255)

LIGHTS = (
    Light("directional", (1, 2, 2), WHITE),
    Light("point", (-8, 6, 4), RED),
    Light("directional", (-2, 0.5, 1), BLUE),
    Light("point", (5, 1, 6), GREEN),
)


def teapot_scene(lights: int = 1, first: int = 0, *, distance: float = 9.0, **material: Any) -> Scene:
    """The teapot with some of the four lights."""
    look = Material("smooth", **{"ambient": 0.25, "diffuse": 0.6, "specular": 0.5, "shininess": 30} | material)
    return Scene(
        [Object(painted(teapot(5)), position=(0, -1.4, 0), material=look)],
        Camera(eye=(0.2 * distance, 0.35 * distance, 0.92 * distance), target=(0, 0, 0)),
        lights=[LIGHTS[(first + i) % 4] for i in range(lights)],
        background=Background((20, 30, 60), (200, 210, 220)),
    )


def painted(mesh: Mesh) -> Mesh:
    """The mesh with colours that change along its axes."""
    points = mesh.positions
    part = (points - points.min(axis=0)) / np.maximum(np.ptp(points, axis=0), 1e-9)
    return evolve(mesh, colors=np.rint(80 + 150 * part).astype(int))


def flat(scene: Scene) -> Scene:
    """The scene with the normals of faces."""
    return evolve(scene, objects=[evolve(o, material=evolve(o.material, shading="flat")) for o in scene.objects])


def ground(
    material: Material, lights: list[Light], size: float = 4000.0, step: int = 1, half_height: float = 0.466
) -> Scene:
    """A plane from beneath the eye to the horizon, of 2 step^2 triangles."""
    line = np.linspace(-1, 1, step + 1)
    x, z = (v.ravel() for v in np.meshgrid(line, line))
    points = size * np.stack([x, 0 * x, -z], axis=1)
    grid = np.arange((step + 1) ** 2).reshape(step + 1, step + 1)
    a, b, c, d = (v.ravel() for v in (grid[:-1, :-1], grid[:-1, 1:], grid[1:, 1:], grid[1:, :-1]))
    faces = np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])
    mesh = Mesh(points, faces, normals=vertex_normals(points, faces))
    mesh = evolve(mesh, colors=np.stack([200 + 50 * x, 120 + 100 * z, 150 - 100 * x], axis=1).astype(int))
    camera = Camera(eye=(0, 10, 0), target=(0, 6, -20), near=0.5, half_height=half_height)
    return Scene([Object(mesh, material=material)], camera, lights, Background((90, 120, 250)))


def big_triangles(material: Material, lights: list[Light]) -> Scene:
    """Three triangles that come close to the eye and reach far beyond the picture."""
    points = np.array(
        [
            [[-60, -8, -2], [90, -20, -30], [-5, 70, -100]],
            [[-3, -3, -1.5], [3, -2, -60], [-2, 5, -12]],
            [[40, -40, 5], [30, 50, -80], [-10, 4, -90]],
        ],
        dtype=np.float64,
    )
    colors = [[255, 40, 30], [30, 250, 60], [40, 80, 255], [250, 250, 30], [30, 240, 240], [230, 40, 250]]
    colors += [[200, 200, 200], [0, 0, 0], [255, 255, 255]]
    mesh = Mesh(points.reshape(-1, 3), np.arange(9).reshape(-1, 3), colors)
    mesh = evolve(mesh, normals=vertex_normals(mesh.positions, mesh.faces))
    return Scene([Object(mesh, material=material, cull=False)], Camera(near=0.5), lights)


def screen_triangle(
    corners: Sequence[tuple[float, float]],
    distances: Sequence[float],
    colors: Sequence[tuple[int, int, int]],
    material: Material = UNLIT,
    light: Light = SUN,
) -> Scene:
    """One triangle with its corners at these columns and rows, and distances from the eye."""
    column, row = np.array(corners).T
    distance = np.array(distances)
    unit = distance / 64 / 2.145
    points = np.stack([(column - 64) * unit, (64 - row) * unit, -distance], axis=1)
    mesh = Mesh(np.rint(1000 * points), [[0, 1, 2]], colors)
    return Scene([Object(mesh, scale=2**-10, material=material, cull=False)], Camera(near=1), [light])
