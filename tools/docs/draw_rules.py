"""Draw the pictures of the rules of docs/explain.md, in which the contracts may differ from contracts/picture.py.

python -m tools.docs.draw_rules

Each shows a scene of SIDE x SIDE pixels by the definition, the same by the contracts, and the difference.
"""

from __future__ import annotations

import runpy
from collections.abc import Callable

import numpy as np
from attrs import evolve
from numpy.typing import NDArray
from PIL import Image as PillowImage

from shackled import Background, Camera, Light, Material, Mesh, Object, Scene, Texture, render
from shackled.datasets.common import shapes
from shackled.gas import render_call
from shackled.scene._in_range import in_range
from tools.pages import IMAGES, ROOT

#: Pixels of a canvas, and how much they are enlarged.
SIDE, SCALE = 24, 5
WHITE, BLUE, RED, SKY = (255, 255, 255), (40, 80, 120), (200, 80, 60), Background("#5a6e82")
UNLIT, FLAT = Material("unlit"), Material("flat", ambient=0.2, diffuse=0.8, specular=0)
#: A horizontal square, seen from above: its corners, and its faces.
SQUARE = np.array([[-1.0, 0, -1], [-1, 0, 1], [1, 0, 1], [1, 0, -1]]), [[0, 1, 2], [0, 2, 3]]


def slivers() -> Scene:
    """Needles of less than 1/16 of a pixel, whose first vertex has another colour."""
    needles = [[[-0.97, y, 0], [0.97, y - 0.04, 0], [0.97, y - 0.045, 0]] for y in np.linspace(0.97, -0.9, 90)]
    colors = np.tile([(255, 140, 0), (0, 120, 255), (0, 120, 255)], (90, 1))
    mesh = Mesh(np.reshape(needles, (-1, 3)), np.arange(270).reshape(-1, 3), colors)
    camera = Camera((0, 0, 4), projection="orthographic", half_height=1)
    return canvas([Object(mesh, material=UNLIT, cull=False)], camera, background=Background(WHITE))


def backs() -> Scene:
    """A square, seen from below, with a smaller one above it that hides the light."""
    points, faces = SQUARE
    squares = Mesh(points, faces, (220, 200, 160)), Mesh(0.4 * points + [0, 0.5, 0], faces, RED)
    light = Light.directional(toward=(0.3, 1, 0.2), shadow=True)
    things = [Object(each, material=FLAT, cull=False) for each in squares]
    return canvas(things, Camera((0, -1.6, 1.8), half_height=0.55), light)


def fans() -> Scene:
    """A textured board that begins behind the eye."""
    points, faces = SQUARE
    checks = Texture(np.array([[WHITE, BLUE], [BLUE, WHITE]], np.uint8), "nearest", "repeat")
    board = Mesh(points * [3, 0, 5] - [0, 0, 3], faces, WHITE, uvs=24 * points[:, ::2])
    thing = Object(board, material=evolve(UNLIT, texture=checks), cull=False)
    return canvas([thing], Camera((0.5, 0.3, 0.8), (0.1, -0.3, -3), half_height=0.6, near=0.1))


def wires() -> Scene:
    """The edges of a steep grid, on which a light is reflected to the eye."""
    x, y = np.meshgrid([-0.9, -0.3, 0.3, 0.9], [-0.8, -0.1, 0.8])
    points = np.stack([x + 0.05 * y, y, 4 * x], axis=-1).reshape(-1, 3)
    faces = [[i, i + j, i + k] for i in (0, 1, 2, 4, 5, 6) for j, k in ((1, 5), (5, 4))]
    look = Material("flat", ambient=0.3, diffuse=0, specular=1, shininess=60)
    grid = Object(Mesh(points, faces, (200, 200, 200)), material=look, cull=False, wireframe=True)
    light = Light.directional(toward=(-8, 0, -15))
    return canvas([grid], Camera((0, 0, 9), half_height=0.13), light, antialias=False)


def wholes() -> Scene:
    """A smooth ball whose triangles are smaller than a pixel, with two colours."""
    ball = shapes.icosphere(4)
    stripes = np.sin(40 * ball.positions[:, 1:2]) > 0
    ball = evolve(ball, colors=np.where(stripes, WHITE, BLUE))
    thing = Object(ball, material=Material("smooth", ambient=0.3, diffuse=0.7, specular=0))
    return canvas([thing], Camera((0, 0, 6), half_height=0.2), Light.directional(toward=(0.3, 0.5, 1)))


def canvas(
    things: list[Object], camera: Camera, *lights: Light, background: Background = SKY, antialias: bool = True
) -> Scene:
    """Return a scene of SIDE x SIDE pixels."""
    return in_range(Scene(things, camera, lights, background, width=SIDE, height=SIDE, antialias=antialias))


#: By the names of the rules in tests/judge.
SCENES: dict[str, Callable[[], Scene]] = {each.__name__: each for each in (slivers, backs, fans, wires, wholes)}


def draw(name: str) -> NDArray[np.uint8]:
    """Return the picture of a rule, (SIDE, 3 * SIDE + 2, 3): three parts with white lines between them."""
    scene = SCENES[name]()
    defined = runpy.run_path(str(ROOT / "contracts" / "picture.py"))["draw"](render_call(scene))
    drawn = render(scene).pixels
    line = np.full((SIDE, 1, 3), 255)
    parts = [defined, line, drawn, line, np.abs(drawn.astype(int) - defined)]
    return np.hstack(parts).astype(np.uint8)


def main() -> None:
    """Draw the pictures."""
    for name in SCENES:
        image = PillowImage.fromarray(draw(name))
        size = (SCALE * image.width, SCALE * image.height)
        image.resize(size, PillowImage.Resampling.NEAREST).save(IMAGES / f"rule-{name}.png", optimize=True)


if __name__ == "__main__":
    main()
