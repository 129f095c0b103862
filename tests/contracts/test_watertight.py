"""Meshes without gaps and overlaps give pictures without gaps and overlaps."""

from __future__ import annotations

import numpy as np
import pytest
from attrs import evolve
from numpy.typing import NDArray

from judge import render
from judge.verdict import outside
from pictures import (
    UNLIT,
    WHITE,
    call_data,
    counts,
    covered,
    draw,
    on_pixel_grid,
    pixel_grid_camera,
    recolored,
    unlit_scene,
)
from shackled import Camera, Light, Material, Mesh, Object, Scene
from shackled.datasets.common import shapes
from shackled.scene._in_range import in_range

Array = NDArray[np.float64]
Integers = NDArray[np.int64]


def split_square(rng: np.random.Generator, low: int, high: int, points: int) -> tuple[Array, Integers]:
    """A square with whole coordinates, cut by points within, most of its triangles slivers."""
    places = [(low, low), (low, high), (high, high), (high, low)]
    faces = [(0, 1, 2), (0, 2, 3)]
    while len(places) < 4 + points:
        a, b, c = faces[rng.integers(len(faces))]
        point = tuple(np.rint(rng.dirichlet((1, 1, 1)) @ np.array([places[a], places[b], places[c]])).astype(int))
        new = [(a, b, len(places)), (b, c, len(places)), (c, a, len(places))]
        if all(area(places[i], places[j], point) > 0 for i, j, _ in new):
            faces.remove((a, b, c))
            faces += new
            places.append(point)
    return np.array(places, float), np.array(faces)


def area(a: tuple[int, int], b: tuple[int, int], c: tuple[int, ...]) -> int:
    """Twice the area, positive for counter-clockwise where rows run down."""
    return int((c[0] - a[0]) * (b[1] - a[1]) - (b[0] - a[0]) * (c[1] - a[1]))


def jittered_grid(rng: np.random.Generator, side: int) -> tuple[Array, Integers]:
    """Points of (-1, 1)^2 in a grid, the inner ones moved a little, and triangles between them."""
    line = np.linspace(-1, 1, side + 1)
    points = np.stack(np.meshgrid(line, line, indexing="ij"), axis=-1)
    points[1:-1, 1:-1] += rng.uniform(-0.4, 0.4, (side - 1, side - 1, 2)) / side
    number = np.arange((side + 1) ** 2).reshape(side + 1, side + 1)
    a, b, c, d = (v.ravel() for v in (number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]))
    return points.reshape(-1, 2), np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])


def each_alone(scene: Scene) -> Integers:
    """(H, W): how many triangles of the scene's one object cover each pixel, drawn one by one."""
    (thing,) = scene.objects
    total = np.zeros((scene.height, scene.width), np.int64)
    for face in thing.mesh.faces:
        total += covered(evolve(scene, objects=[evolve(thing, mesh=evolve(thing.mesh, faces=[face]))]))
    return total


@pytest.mark.parametrize("seed", range(6))
def test_a_cut_square_covers_each_pixel_once(seed: int) -> None:
    rng = np.random.default_rng(seed)
    # borders through centres of pixels: those on two sides belong to it
    low, high = 3 * 256 + 128, 36 * 256 + 128
    points, faces = split_square(rng, low, high, 20)
    mesh = Mesh(on_pixel_grid(points, 40, 40), faces, np.full((len(points), 3), 255))
    scene = unlit_scene(mesh, pixel_grid_camera(40), 40)
    expected = np.zeros((40, 40), np.int64)
    expected[3:36, 3:36] = 1
    assert (each_alone(scene) == expected).all()
    assert counts(scene) == (len(faces), 33 * 33)


@pytest.mark.parametrize("seed", range(4))
def test_a_plane_in_perspective_covers_each_pixel_once(seed: int) -> None:
    rng = np.random.default_rng(seed)
    points, faces = jittered_grid(rng, 5)
    slope = rng.uniform(-0.6, 0.6, 2)
    corners = np.rint(1000 * np.column_stack([points, points @ slope - 2.5]))
    mesh = Mesh(corners, faces, np.full((len(points), 3), 255))
    scene = unlit_scene(mesh, Camera(near=1), 61, 47)
    times = each_alone(scene)
    assert times.max() == 1
    assert counts(scene)[1] == times.sum() > 500


@pytest.mark.parametrize("seed", range(4))
def test_a_clipped_plane_covers_each_pixel_once(seed: int) -> None:
    """A ground that goes through the near plane, behind the eye and far beyond all borders."""
    rng = np.random.default_rng(seed)
    points, faces = jittered_grid(rng, 4)
    tilt = rng.uniform(-0.2, 0.2)
    x, z = 3000 * points.T
    corners = np.rint(np.column_stack([x, -30 + tilt * x + 0 * z, z]))
    mesh = Mesh(corners, faces, np.full((len(points), 3), 255))
    scene = unlit_scene(mesh, Camera(near=4), 50, 50)
    times = each_alone(scene)
    assert times.max() == 1
    assert (times == covered(scene)).all()
    # below the horizon there is nothing but ground: no pixel is missing within a column
    assert (np.diff(times, axis=0) >= 0).all()
    assert times.sum() > 800


def box(size: float) -> Mesh:
    """A cube of 12 triangles, seen from outside."""
    return recolored(evolve(shapes.cube(), positions=np.sign(shapes.cube().positions) * size), WHITE)


def torus(across: int = 14, down: int = 9) -> Mesh:
    """A closed surface that hides parts of itself."""
    mesh = shapes.torus(0.7, 0.3, across, down)
    return recolored(evolve(mesh, positions=np.rint(1000 * mesh.positions)), WHITE)


@pytest.mark.parametrize("projection", ["perspective", "orthographic"])
@pytest.mark.parametrize("mesh", [box(800), torus()], ids=["box", "torus"])
def test_front_and_back_of_a_closed_mesh_cover_the_same(mesh: Mesh, projection: str) -> None:
    rng = np.random.default_rng(7)
    behind = evolve(mesh, faces=mesh.faces[:, ::-1])
    for _ in range(8):
        camera = Camera(
            eye=np.rint(rng.normal(size=3) * 200 + [0, 0, 3200]),
            target=(0, 0, 0),
            projection=projection,
            half_height=1200.0 if projection == "orthographic" else 0.5,
            near=1,
        )
        rotation = rng.normal(size=4)
        front, back = (
            covered(unlit_scene([Object(side, rotation=rotation, material=UNLIT, cull=True)], camera, 64))
            for side in (mesh, behind)
        )
        assert (front == back).all()
        assert front.sum() > 500


def test_a_closed_mesh_covers_each_pixel_as_often_front_as_back() -> None:
    mesh = torus(9, 6)
    camera = Camera(eye=(0, 0, 3000), target=(0, 0, 0), half_height=0.4, near=1)
    behind = evolve(mesh, faces=mesh.faces[:, ::-1])
    front, back = (
        each_alone(unlit_scene([Object(side, rotation=(0.4, 0.5, 0.1, 0.7), material=UNLIT, cull=True)], camera, 40))
        for side in (mesh, behind)
    )
    assert (front == back).all()
    assert front.max() > 1


@pytest.mark.parametrize("half_height", [0.3, 1.0, 4.0, 30.0])
@pytest.mark.parametrize("size", [5.0, 500.0, 30000.0])
def test_a_room_from_within_has_no_holes(half_height: float, size: float) -> None:
    """The clipper cuts most of its walls."""
    rng = np.random.default_rng(11)
    for _ in range(5):
        eye = np.rint(rng.uniform(-0.8, 0.8, 3) * size)
        target, up = eye + rng.normal(size=3), rng.normal(size=3)
        camera = Camera(eye, target, up, half_height=half_height, near=2**-10)
        assert covered(unlit_scene(box(size), camera, 40, 30)).all()


def test_a_fine_mesh_has_no_gaps() -> None:
    """Hills of triangles smaller than a pixel, before a background that would show."""
    rng = np.random.default_rng(3)
    points, faces = jittered_grid(rng, 60)
    corners = np.rint(np.column_stack([1500 * points, rng.uniform(-15, 15, len(points)) - 1200]))
    assert covered(unlit_scene(Mesh(corners, faces, np.full((len(points), 3), 255)), Camera(near=1), 40)).all()


#: One colour everywhere, so that a pixel shows how many of its samples are covered.
PLAIN = Material("smooth", ambient=1.0, diffuse=0.0, specular=0.0)


@pytest.mark.parametrize("mesh", [shapes.icosphere(1), shapes.icosphere(2), torus()], ids=["80", "320", "torus"])
def test_each_sample_of_a_smooth_surface_is_covered_once(mesh: Mesh) -> None:
    """From all sides, every third time so near that faces are clipped: exact where open edges are, whole elsewhere."""
    rng = np.random.default_rng(len(mesh.faces))
    thing = Object(recolored(mesh, WHITE), material=PLAIN, scale=1000 / np.linalg.norm(mesh.positions, axis=1).max())
    for i in range(6):
        direction = rng.normal(size=3)
        eye = direction / np.linalg.norm(direction) * 1000 * (1.05 if i % 3 == 2 else rng.uniform(1.8, 4))
        camera = Camera(tuple(eye), tuple(rng.normal(size=3) * 125), near=20)
        sun = Light("directional", (1, 2, 3))
        scene = in_range(Scene([thing], camera, [sun], "black", width=48, height=48, antialias=True))
        expected = render(call_data("render", scene))
        # samples that are covered twice or never, or beyond the silhouette, are a quarter of white off
        assert outside(draw(scene), expected.low, expected.high).max() <= 1


@pytest.mark.parametrize("count", [12, 18, 40])
def test_the_edges_of_a_fan_with_gaps_are_open(count: int) -> None:
    """Around a vertex with few faces and with many, of which every third is left out."""
    turns = np.arange(count) * 2 * np.pi / count
    around = 900 * np.stack([np.cos(turns), np.sin(turns), 0 * turns], axis=1)
    points = np.rint(np.concatenate([[(0, 0, 0)], around]))
    faces = [(0, 1 + i, 1 + (i + 1) % count) for i in range(count) if i % 3]
    mesh = recolored(Mesh(points, faces, normals=[(0, 0, 1)] * len(points)), WHITE)
    sun = Light("directional", (1, 2, 3))
    thing = Object(mesh, (0, 0, -2500), material=PLAIN)
    scene = in_range(Scene([thing], Camera(), [sun], "black", width=64, height=64, antialias=True))
    expected = render(call_data("render", scene))
    assert outside(draw(scene), expected.low, expected.high).max() <= 1
