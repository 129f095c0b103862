"""Smooth surfaces with four samples per pixel: exact where open edges are, whole pixels elsewhere, no gap anywhere."""

from __future__ import annotations

import numpy as np
import pytest
from attrs import evolve

import judge
from judge.verdict import outside
from pictures import call_data, draw
from shackled import Camera, Light, Material, Mesh, Object, Scene
from shackled.scene import Rectangle
from test_watertight import torus

#: One colour everywhere, so that a pixel shows how many of its samples are covered.
WHITE = Material("smooth", ambient=1.0, diffuse=0.0, specular=0.0)
LIT = Material("smooth", ambient=0.2, diffuse=0.7, specular=0.5, shininess=20)
SIZE = 48


def ball(steps: int) -> Mesh:
    """An octahedron whose faces are cut in four `steps` times, with whole coordinates."""
    points = [np.array(p, float) for p in ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1))]
    faces = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
    known: dict[tuple[int, int], int] = {}

    def middle(a: int, b: int) -> int:
        key = (min(a, b), max(a, b))
        if key not in known:
            known[key] = len(points)
            points.append(points[a] + points[b])
            points[-1] /= np.linalg.norm(points[-1])
        return known[key]

    for _ in range(steps):
        cut = []
        for a, b, c in faces:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            cut += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        faces = cut
    whole = np.rint(1000 * np.array(points))
    return Mesh(whole, faces, [(255, 255, 255)] * len(whole), whole)


def views(mesh: Mesh, material: Material, count: int) -> list[Scene]:
    """Views from all sides, every third so near that faces are clipped."""
    rng = np.random.default_rng(len(mesh.faces))
    reach = float(np.linalg.norm(mesh.positions, axis=1).max())
    found = []
    for i in range(count):
        direction = rng.normal(size=3)
        eye = direction / np.linalg.norm(direction) * reach * (1.05 if i % 3 == 2 else rng.uniform(1.8, 4))
        thing = Object(mesh, (0, 0, 0), material=material)
        camera = Camera(tuple(eye), tuple(rng.normal(size=3) * reach / 8), near=reach / 50)
        found.append(Scene([thing], camera, [Light("directional", (1, 2, 3))], width=SIZE, height=SIZE, antialias=True))
    return found


def with_normals(mesh: Mesh) -> Mesh:
    """Give each vertex the direction from the centre as its normal: the tests here hold for any normals."""
    return evolve(mesh, normals=mesh.positions)


CLOSED = [ball(1), ball(2), ball(3), with_normals(torus(14, 9))]


@pytest.mark.parametrize("mesh", CLOSED, ids=["32", "128", "512", "torus"])
def test_each_sample_is_covered_once(mesh: Mesh) -> None:
    # samples that are covered twice or never, or beyond the silhouette, are a quarter of white off
    for scene in views(mesh, WHITE, 6):
        expected = judge.render(call_data("render", scene))
        drawn = draw(scene).astype(float)
        assert outside(drawn, expected.low, expected.high).max() <= 1


@pytest.mark.parametrize("mesh", CLOSED, ids=["32", "128", "512", "torus"])
def test_tiles_are_parts_of_the_whole(mesh: Mesh) -> None:
    for scene in views(mesh, LIT, 3):
        whole = draw(scene)
        for x, y, width, height in ((0, 0, 17, SIZE), (17, 0, SIZE - 17, 31), (5, 20, 9, 9), (20, 31, 28, 17)):
            tile = draw(scene, Rectangle(x, y, width, height))
            np.testing.assert_array_equal(tile, whole[y : y + height, x : x + width])


def test_vertices_of_many_triangles() -> None:
    # a cone of 40 faces: more than a vertex record can name
    turns = np.linspace(0, 2 * np.pi, 40, endpoint=False)
    rim = np.rint(1000 * np.stack([np.cos(turns), np.sin(turns), -0.5 + 0 * turns], axis=1))
    points = np.concatenate([[[0, 0, 800]], rim])
    faces = [(0, 1 + i, 1 + (i + 1) % 40) for i in range(40)]
    mesh = Mesh(points, faces, [(255, 255, 255)] * 41, points)
    scene = evolve(views(mesh, WHITE, 1)[0], camera=Camera((300.0, 200.0, 3000.0), (0, 0, 0), near=10))
    expected = judge.render(call_data("render", scene))
    assert outside(draw(scene).astype(float), expected.low, expected.high).max() <= 1


def frames(count: int) -> list[Scene]:
    """A turntable of a ball."""
    mesh, found = ball(2), []
    for angle in np.linspace(0, 2 * np.pi, count, endpoint=False):
        eye = (2500 * float(np.sin(angle)), 700.0, 2500 * float(np.cos(angle)))
        scene = views(mesh, LIT, 1)[0]
        found.append(evolve(scene, camera=Camera(eye, (0, 0, 0), near=10)))
    return found


def test_no_pixel_of_a_turntable_flickers() -> None:
    # in each frame, every pixel is within the range of the judge, whose picture has no history
    for scene in frames(72):
        expected = judge.render(call_data("render", scene))
        verdict = judge.judge_pixels("frame", draw(scene).astype(float), expected)
        assert not verdict.faults
