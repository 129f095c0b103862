"""Scenes that several tests draw."""

from __future__ import annotations

import numpy as np
from attrs import evolve

from shackled import Background, Camera, Light, Material, Mesh, Object, Scene
from shackled.datasets import teapot

POT = teapot(2)
SQUARE = Mesh(
    [[-2, -2, 0], [2, -2, 0], [2, 2, 0], [-2, 2, 0]],
    [[0, 1, 2], [0, 2, 3]],
    [[255, 0, 0], [0, 255, 0], [0, 0, 255], [255, 255, 0]],
)
#: Small scenes that go through every stage, by name.
SMALL_SCENES = {
    "smooth": Scene(
        [Object(POT, rotation=(0, 0.3, 0, 1), material=Material("smooth"), cull=False)],
        Camera(eye=(2, 4, 8), target=(0, 1.5, 0)),
        [Light("point", (3, 6, 5)), Light("directional", (-1, 0.5, 0), (90, 60, 30))],
        Background("#102040", "#a0b0c0"),
        width=40,
        height=28,
    ),
    "clipped, wires, inverted": Scene(
        [Object(SQUARE, (0, 0, 2), scale=1.5, cull=False), Object(POT, wireframe=True, material=Material("unlit"))],
        Camera(eye=(1, 1, 2.5), target=(0, 1, 0), near=0.25),
        [Light("directional", (1, 1, 1))],
        invert=True,
        width=33,
        height=21,
    ),
    "empty": Scene([], width=5, height=3),
}

WHITE, RED, GREEN, BLUE = (255, 255, 255), (255, 60, 40), (60, 255, 90), (70, 110, 255)

LIGHTS = (
    Light("directional", (1, 2, 2), WHITE),
    Light("point", (-8, 6, 4), RED),
    Light("directional", (-2, 0.5, 1), BLUE),
    Light("point", (5, 1, 6), GREEN),
)


def teapot_scene(lights: int = 1, first: int = 0) -> Scene:
    """The teapot with some of the four lights."""
    return Scene(
        [Object(painted(teapot(5)), position=(0, -1.4, 0), material=Material("smooth", 0.25, 0.6, 0.5, 30))],
        Camera(eye=(1.8, 3.15, 8.28), target=(0, 0, 0)),
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
