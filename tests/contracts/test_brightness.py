"""More light is never darker: a colour that rises through 255 stays there, in every way of shading."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import pytest
from attrs import evolve

from pictures import WHITE, Pixels, draw, recolored
from random_scenes import random_case
from shackled import Background, Camera, Light, Material, Mesh, Object, Scene

SIZE = 8
SUN, LAMP = Light("directional", (0, 0, 1)), Light("point", (300, 200, -600))

#: From just below to just above the brightest colour.
FACTORS = np.arange(0.99, 1.02, 1 / 4096)


def wall(material: Material, lights: list[Light], color: int = 255, tilt: float = 0.0, **look: bool) -> Scene:
    """Two squares of two triangles, one within the canvas and one behind it beyond all borders, which are drawn by
    different loops; the higher the farther by `tilt`.
    """
    square = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, -tilt], [-1, 1, -tilt]])
    mesh = Mesh(1000 * square, [[0, 1, 2], [0, 2, 3]], [[color] * 3] * 4, [[0, 0, 1]] * 4)
    near = Object(mesh, (0, 0, -3000), material=material, cull=False, **look)
    far = evolve(near, position=(0, 0, -12000), scale=16.0)
    return Scene([near, far], Camera(near=1), lights, width=SIZE, height=SIZE)


#: What draws a colour that is `level` of 255 where light falls on it at right angles.
WAYS: dict[str, Callable[[float], Scene]] = {
    "flat, ambient light only": lambda level: wall(Material("flat", level, 0, 0), [SUN]),
    "flat, of a grey mesh": lambda level: wall(Material("flat", level * 255 / 200, 0, 0), [SUN], 200),
    "flat": lambda level: wall(Material("flat", 0.3 * level, 0.7 * level, 0), [SUN]),
    "flat, tilted": lambda level: wall(Material("flat", level, 0.1, 0), [SUN], tilt=2),
    "flat, with a highlight": lambda level: wall(Material("flat", 0.5 * level, 0, 0.5 * level, 2), [SUN]),
    "flat, point light": lambda level: wall(Material("flat", 0.6 * level, 0.6, 0), [LAMP]),
    "flat, point light and highlight": lambda level: wall(Material("flat", 0.5 * level, 0.5, 0.2), [LAMP], tilt=1),
    "smooth": lambda level: wall(Material("smooth", 0.3 * level, 0.7 * level, 0), [SUN]),
    "smooth, point light": lambda level: wall(Material("smooth", 0.6 * level, 0.6, 0.3), [LAMP]),
    "smooth, two lights": lambda level: wall(Material("smooth", 0.5 * level, 0.4, 0.1), [SUN, LAMP], tilt=1),
    "smooth, no light": lambda level: wall(Material("smooth", level, 0, 0), []),
    "wires": lambda level: wall(Material("flat", level, 0, 0), [SUN], wireframe=True),
    "wires, tilted": lambda level: wall(Material("flat", 0.9 * level, 0.1, 0.1), [SUN], tilt=1, wireframe=True),
    "wires, smooth": lambda level: wall(Material("smooth", 0.6 * level, 0.5, 0.1), [LAMP], wireframe=True),
}


@pytest.mark.parametrize("way", WAYS)
def test_more_light_is_never_darker(way: str) -> None:
    before: Pixels = np.zeros((SIZE, SIZE, 3), np.uint8)
    for factor in FACTORS:
        pixels = draw(WAYS[way](float(factor)))
        # a brighter triangle may be shaded in another way, and come out a level lower where both are rounded
        darker = pixels.astype(int) + 1 < before
        assert not darker.any(), f"{factor}: {pixels[darker]} after {before[darker]}"
        before = pixels
    assert before.max() == 255


def test_brightest_vertex_colors() -> None:
    """Without light colours do not rise above 255, but interpolation must not take them there."""
    scene = wall(Material("unlit"), [])
    before: Pixels = np.zeros((SIZE, SIZE, 3), np.uint8)
    for level in range(250, 256):
        colors = [[level] * 3, [255] * 3, [level, 255, level], [255, level, level]]
        objects = [evolve(o, mesh=evolve(o.mesh, colors=colors)) for o in scene.objects]
        pixels = draw(evolve(scene, objects=objects))
        assert (pixels >= before).all()
        before = pixels
    assert (before == 255).all()


# ---- random scenes ----

KINDS = ("plain", "antialiased", "bent", "shadows")
PARTS = ("ambient", "diffuse", "specular")
NO_EFFECTS: dict[str, Any] = {"invert": False, "hemisphere": None, "rim": None, "fog": None, "tone": None}


def of_materials(scene: Scene, change: Callable[[Material], Material]) -> Scene:
    """The scene with other materials."""
    return evolve(scene, objects=[evolve(o, material=change(o.material)) for o in scene.objects])


def brighter(look: Material, part: str, more: int) -> Material:
    return evolve(look, **{part: min(getattr(look, part) + more / 333, 4.0)})


@pytest.mark.parametrize("kind", KINDS)
def test_white_in_full_light_is_white(kind: str) -> None:
    """Whatever shines on it besides, and however little above 255 its light is; the background is white, too."""
    for seed, more in zip(range(1, 25), 3 * (3, 4, 0, 1, 2, 5, 8, 100), strict=True):
        scene = random_case(seed, kind).scene
        white = [evolve(o, mesh=recolored(o.mesh, WHITE)) for o in scene.objects]
        scene = evolve(scene, objects=white, background=Background(WHITE), ambient_light=WHITE, **NO_EFFECTS)
        scene = of_materials(scene, partial(evolve, ambient=1 + more / 1024))
        assert draw(scene).min() >= 254, seed


#: How many pixels are darker: pixels of several small triangles, of which the engine for four lights takes another.
DARKER = {("antialiased", 11): 5}


@pytest.mark.parametrize("kind", KINDS)
def test_more_light_of_random_scenes_is_never_darker(kind: str) -> None:
    for seed, more in zip(range(1, 25), 8 * (1, 20, 100), strict=True):
        scene = evolve(random_case(seed, kind).scene, **NO_EFFECTS)
        extra = [evolve(light, shadow=False) for light in random_case(seed + 1, kind).scene.lights]
        brighter_lights = [evolve(light, color=np.minimum(np.add(light.color, more), 255)) for light in scene.lights]
        changed = [
            evolve(scene, lights=[*scene.lights, *extra][:4]),
            evolve(scene, lights=brighter_lights),
            evolve(scene, ambient_light=np.minimum(np.add(scene.ambient_light, more), 255)),
            *(of_materials(scene, partial(brighter, part=part, more=more)) for part in PARTS),
        ]
        before = draw(scene).astype(int)
        darker = sum(int((before - draw(each) > 1).any(axis=2).sum()) for each in changed)
        assert darker == DARKER.get((kind, seed), 0), seed
