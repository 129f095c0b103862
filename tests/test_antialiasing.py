"""Four samples for each pixel: which of them a triangle covers, exactly, and what the picture is made of.

The fill rule and the shapes are those of `test_fill_rule`, at the places of the samples in place of the centres.
"""

from __future__ import annotations

import numpy as np
import pytest
from attrs import evolve
from benchmarks.scenes import cubes, staged_teapot
from numpy.typing import NDArray

from judge import judge
from pictures import draw, on_pixel_grid, pixel_grid_camera, soup, unlit_scene
from shackled import Background, Camera, Light, Material, Mesh, Object, Scene, load, render
from shackled.chain import open_chain
from shackled.image import decode_bmp
from shackled.scene import Rectangle
from test_fill_rule import KINDS, Integers, Triangles, expected_pixels, fan, grid, random_triangle, strip

#: Columns and rows of the samples from the centre of their pixel, in 1/256 of it.
SAMPLES = np.array([(-32, -96), (96, -32), (-96, 32), (32, 96)])
#: The level of a white pixel on black with so many samples.
LEVELS = np.array([0, 64, 128, 191, 255])
UNLIT = Material("unlit")


def expected_levels(corners: Integers, width: int, height: int) -> NDArray[np.int64]:
    """(H, W): the levels of a white triangle on black."""
    count = sum(expected_pixels(corners - sample, width, height).astype(int) for sample in SAMPLES)
    return np.asarray(LEVELS[count])


def drawn(corners: Triangles, width: int, height: int) -> NDArray[np.uint8]:
    """The picture of white triangles on black."""
    scene = unlit_scene(soup(on_pixel_grid(corners, width, height)), pixel_grid_camera(height), width, height)
    return draw(evolve(scene, background=Background("black"), antialias=True))[:, :, 0]


@pytest.mark.parametrize("kind", KINDS)
def test_every_sample_obeys_the_fill_rule(kind: str) -> None:
    rng = np.random.default_rng(1)
    covering = 0
    for _ in range(120):
        width, height = (int(side) for side in rng.integers(1, 33, 2))
        corners = random_triangle(rng, kind, width, height)
        expected = expected_levels(corners, width, height)
        covering += bool(expected.any())
        assert (drawn(corners, width, height) == expected).all(), f"{corners.tolist()} on {width} x {height}"
    assert covering > 30


def test_edges_through_samples() -> None:
    rng = np.random.default_rng(2)
    for _ in range(120):
        corners = rng.integers(0, 12, (3, 2)) * 256 + 128 + SAMPLES[rng.integers(0, 4, 3)]
        assert (drawn(corners, 12, 12) == expected_levels(corners, 12, 12)).all(), corners.tolist()


def test_slivers() -> None:
    rng = np.random.default_rng(3)
    for _ in range(120):
        start, end = rng.integers(-2000, 10000, (2, 2))
        corners = np.array([start, end, (start + end) // 2 + rng.integers(-40, 41, 2)])
        assert (drawn(corners, 31, 31) == expected_levels(corners, 31, 31)).all(), corners.tolist()


@pytest.mark.parametrize("shape", [fan, grid, strip])
def test_triangles_of_a_shape_share_no_sample_and_leave_none_out(shape: object) -> None:
    triangles = shape(np.random.default_rng(5))  # type: ignore[operator]
    alone = sum(np.searchsorted(LEVELS, drawn(corners[None], 32, 32)) for corners in triangles)
    assert (drawn(triangles, 32, 32) == LEVELS[alone]).all()


# ---- what is made of the samples ----


def picture(scene: Scene) -> NDArray[np.uint8]:
    """The pixels of a scene of any numbers."""
    return render(scene).pixels


def supersampled(scene: Scene) -> NDArray[np.float64]:
    """The mean of 4 x 4 pixels of a plain picture, four times as large, for each pixel."""
    large = picture(evolve(scene, width=4 * scene.width, height=4 * scene.height)).astype(float)
    return np.asarray(large.reshape(scene.height, 4, scene.width, 4, 3).mean(axis=(1, 3)))


@pytest.mark.parametrize("name", ["unlit", "flat", "cubes", "icons/crown", "icons/ethereum", "genesis/12"])
def test_half_as_far_from_a_supersampled_picture(name: str) -> None:
    if name == "cubes":
        scene = cubes(96)
    elif "/" in name:
        scene = load(name)
    else:
        scene = staged_teapot(name, 96)  # type: ignore[arg-type]
    expected = supersampled(scene)
    plain, smoothed = (np.abs(picture(evolve(scene, antialias=flag)) - expected).mean() for flag in (False, True))
    assert smoothed <= plain / 2


def test_surfaces_that_meet_are_smoothed_where_they_do() -> None:
    """Depths are tested for each sample."""
    across = np.array([[[-9, -9, -9], [9, -9, 9], [9, 9, 9]], [[-9, -9, -9], [9, 9, 9], [-9, 9, -9]]], float)
    wall = across * [1, 1, 0]
    mesh = soup(np.concatenate([across, wall]), [(255, 0, 0)] * 2 + [(0, 0, 255)] * 2)
    camera = Camera((3, 4, 20), (0, 0, 0), (0.2, 1, 0), half_height=0.3)
    scene = Scene([Object(mesh, material=UNLIT, cull=False)], camera, width=48, height=48, antialias=True)
    pixels = picture(scene)
    mixed = (pixels[:, :, 0] > 0) & (pixels[:, :, 2] > 0)
    assert 12 <= mixed.sum() <= 3 * 48
    assert set(np.unique(pixels[:, :, 0])) <= set(LEVELS)


def test_a_wire_is_a_pixel_wide() -> None:
    """A line of 20 pixels in any direction has the area of 20 pixels."""
    for angle in np.radians([0, 7, 30, 45, 80, 91, 133]):
        middle, end = np.array([4011, 4013]), 2560 * np.array([np.cos(angle), np.sin(angle)])
        corners = np.array([middle - end, middle + end, middle])[None]
        scene = unlit_scene(soup(on_pixel_grid(corners, 31, 31)), pixel_grid_camera(31), 31)
        # the line to the corner in the middle and back lies on the first
        wire = evolve(scene.objects[0], wireframe=True, mesh=wider(scene.objects[0].mesh))
        pixels = picture(evolve(scene, objects=[wire], background=Background("black"), antialias=True))
        assert 18.5 <= pixels[:, :, 0].sum() / 255 <= 21.5, angle


def wider(mesh: Mesh) -> Mesh:
    """The mesh with its last corner 1/256 of a pixel away, since triangles without an area have no wires."""
    positions = mesh.positions.copy()
    positions[2] += [1, 1, 0]
    return evolve(mesh, positions=positions)


def mixed_scene(width: int, height: int) -> Scene:
    """Objects of all engines, in turns: flat, smooth, wires, glass, flat again; a spot light."""
    base = cubes(height)
    first, second, third = base.objects
    objects = [
        first,
        evolve(third, position=(0, 100, -1500)),
        evolve(second, position=(-300, -200, -1400), wireframe=True),
        evolve(second, position=(300, 0, -1000), opacity=0.4, scale=0.5),
        evolve(first, position=(0, -400, -1600), scale=0.7),
        evolve(third, position=(-200, 100, -900), opacity=0.7, scale=0.3),
    ]
    lights = (
        *base.lights,
        Light.spot(position=(0, 900, -200), direction=(0, -0.5, -1), color="white", inner_angle=20, outer_angle=50),
    )
    return evolve(base, objects=objects, lights=lights, width=width, height=height, antialias=True)


@pytest.mark.parametrize(("width", "height"), [(60, 44), (200, 110)])
def test_engines_hand_on_their_samples(width: int, height: int) -> None:
    """The larger one has more than one band."""
    scene = mixed_scene(width, height)
    expected = render(scene)
    assert judge("engines", scene).faults == []
    assert (picture(evolve(scene, invert=True)) == 255 - expected.pixels).all()
    x, y, columns, rows = width // 3, height // 4, width // 2, height // 2
    tile = decode_bmp(open_chain().draw(scene, Rectangle(x, y, columns, rows)).bmp, columns, rows)
    assert (tile == expected.pixels[y : y + rows, x : x + columns]).all()


def test_large_pictures_are_drawn_in_bands() -> None:
    scene = evolve(staged_teapot("flat", (300, 200)), antialias=True)
    assert judge("bands", scene).faults == []


def test_nothing_to_draw() -> None:
    scene = Scene([], background=Background("navy", "white"), width=20, height=9)
    assert (picture(evolve(scene, antialias=True)) == picture(scene)).all()
