"""The bounds within which the light of smooth triangles is made of quadratic products: see SmoothLight.sol."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from attrs import evolve

import judge
from accuracy import LEVELS
from pictures import call_data, draw
from shackled import Camera, Light, Material, Mesh, Object, Scene
from shackled.image import decode_bmp
from shackled.reference import render, shading, smooth_light
from shackled.reference.smooth_light import UNBOUNDED_LIGHT

SHINY = Material("smooth", ambient=0.2, diffuse=0.7, specular=0.5, shininess=20)
AHEAD = (0.0, 0.0, 1.0)
WHITE, BLACK = (255, 255, 255), (0, 0, 0)


def one_triangle(
    normals: list[tuple[float, float, float]],
    light: Light,
    size: float = 1.0,
    distance: float = 5.0,
    colors: list[tuple[int, int, int]] | None = None,
    tilt: float = 0.0,
    **look: float,
) -> Scene:
    """A triangle before the camera; `tilt`: how much nearer its last corner is."""
    corners = size * np.array([[-1000, -800, 0], [1000, -800, 0], [0, 900, 1000 * tilt]])
    mesh = Mesh(np.rint(corners), [[0, 1, 2]], colors or [(200, 180, 160)] * 3, normals)
    thing = Object(mesh, (0, 0, -distance), scale=2**-10, material=evolve(SHINY, **look), cull=False)  # type: ignore[arg-type]
    return Scene([thing], Camera(near=0.1), [light], width=64, height=64)


def ways(scene: Scene, monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """What the reference finds of the light of each triangle."""
    found, made = [], smooth_light.set_light

    def set_light(*arguments: object) -> int:
        found.append(made(*arguments))  # type: ignore[arg-type]
        return found[-1]

    with monkeypatch.context() as patch:
        patch.setattr(shading, "set_light", set_light)
        decode_bmp(render(scene), scene.width, scene.height)
    return found


def error(scene: Scene) -> int:
    """How far the contract's picture is from the judge's where there is a triangle away from its edges."""
    expected = judge.render(call_data("render", scene))
    inner = expected.triangle >= 0
    inner[1:] &= expected.triangle[:-1] >= 0
    inner[:-1] &= expected.triangle[1:] >= 0
    inner[:, 1:] &= expected.triangle[:, :-1] >= 0
    inner[:, :-1] &= expected.triangle[:, 1:] >= 0
    assert inner.any()
    return int(np.abs(draw(scene).astype(int) - expected.pixels)[inner].max())


def leaning(angle: float, turn: float) -> tuple[float, float, float]:
    """A normal that leans away from the eye by an angle, in degrees."""
    a, b = np.radians(angle), np.radians(turn)
    return float(np.sin(a) * np.cos(b)), float(np.sin(a) * np.sin(b)), float(np.cos(a))


LIGHTS = [Light("directional", (1, 2, 3)), Light("point", (4, 6, 3)), Light("point", (-3, 2, 2), (255, 200, 120))]


@pytest.mark.parametrize("light", LIGHTS)
@pytest.mark.parametrize("angle", [0, 20, 40, 55, 60, 65, 75, 85, 89])
@pytest.mark.parametrize(("size", "tilt"), [(0.3, 0.0), (1.0, 0.5), (2.0, 1.0)])
def test_normals_that_differ(light: Light, angle: float, size: float, tilt: float) -> None:
    """Up to opposite ones, between which the interpolated normal vanishes."""
    normals = [leaning(angle, turn) for turn in (0, 120, 240)]
    colors = [WHITE, (255, 0, 0), (0, 0, 255)]
    for shininess in (2, 20, 128):
        assert error(one_triangle(normals, light, size, colors=colors, tilt=tilt, shininess=shininess)) <= 2 * LEVELS


@pytest.mark.parametrize("light", LIGHTS)
def test_opposite_normals_take_the_exact_way(light: Light, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where the square of the interpolated normal comes near zero."""
    flat = [leaning(88, turn) for turn in (0, 120, 240)]
    assert ways(one_triangle(flat, light, 0.2), monkeypatch) == [UNBOUNDED_LIGHT]
    opposite = [leaning(89, 0), leaning(89, 180), AHEAD]
    assert ways(one_triangle(opposite, light, 0.2), monkeypatch) == [UNBOUNDED_LIGHT]
    like = [leaning(20, turn) for turn in (0, 120, 240)]
    assert ways(one_triangle(like, light, 0.2), monkeypatch) != [UNBOUNDED_LIGHT]


@pytest.mark.parametrize("place", [(0, 0, -4.9), (0.3, 0.2, -4.5), (0, 0, -6), (3, 0, -5.01), (0, 0, 40)])
@pytest.mark.parametrize("size", [0.3, 1.0, 3.0])
def test_lamps_near_and_far(place: tuple[float, float, float], size: float) -> None:
    normals = [leaning(15, turn) for turn in (0, 120, 240)]
    for diffuse, shininess in itertools.product((0.1, 0.7, 1.0), (3, 20, 128)):
        assert (
            error(one_triangle(normals, Light("point", place), size, diffuse=diffuse, shininess=shininess))
            <= 2 * LEVELS
        )


def test_a_lamp_nearer_than_the_eye_takes_the_exact_way(monkeypatch: pytest.MonkeyPatch) -> None:
    assert ways(one_triangle([AHEAD] * 3, Light("point", (0, 0, -3)), 0.2), monkeypatch) == [UNBOUNDED_LIGHT]
    assert ways(one_triangle([AHEAD] * 3, Light("point", (0, 0, 1)), 0.2), monkeypatch) != [UNBOUNDED_LIGHT]


@pytest.mark.parametrize("size", [0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0])
@pytest.mark.parametrize("shininess", [2, 20, 60, 128])
def test_large_triangles(size: float, shininess: int) -> None:
    """Over which light and half vectors turn up to the bounds, and beyond."""
    for light, tilt in itertools.product(LIGHTS, (-1.0, 0.0, 1.0)):
        scene = one_triangle(
            [leaning(5, 90), leaning(10, 0), AHEAD], light, size, tilt=tilt, shininess=shininess, specular=0.9
        )
        assert error(scene) <= 2 * LEVELS


def test_the_half_vector_against_the_light_is_not_interpolated(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = one_triangle([AHEAD] * 3, Light("directional", (0.05, 0, -1)), 0.2)
    assert ways(scene, monkeypatch) == [UNBOUNDED_LIGHT]
