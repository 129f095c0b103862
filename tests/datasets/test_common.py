"""The common objects that need no file."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np
import pytest
from attrs import evolve

import shackled
from shackled import Mesh
from shackled.datasets import Piece
from shackled.datasets._pieces import require
from shackled.datasets.common import builtin, shapes
from shackled.datasets.common._cornell_box import EYE, HEIGHT, cornell_box
from shackled.datasets.common._models import models
from shackled.scene._staging import is_closed, signed_volume

CLOSED: dict[Callable[..., Mesh], tuple[int, float | None]] = {
    shapes.tetrahedron: (4, 8 * 3**0.5 / 27),
    shapes.octahedron: (8, 4 / 3),
    shapes.icosahedron: (20, 2.53615),
    shapes.dodecahedron: (36, 2.78516),
    shapes.cube: (12, 1.2**3),
    shapes.icosphere: (320, 4.0471),
    shapes.sphere: (960, 4.12194),
    shapes.torus: (1152, 2 * np.pi**2 * 0.72 * 0.28**2 * 0.970),
    shapes.torus_knot: (1176, None),
    shapes.spring: (1136, None),
    shapes.superellipsoid: (1080, None),
    shapes.cylinder: (160, 1.8 * 40 / 2 * np.sin(2 * np.pi / 40) * 0.75**2),
    shapes.cone: (80, 1.8 / 3 * 40 / 2 * np.sin(2 * np.pi / 40) * 0.85**2),
    partial(shapes.menger_sponge, 1): (144, 1.3**3 * 20 / 27),
    shapes.menger_sponge: (2112, 1.3**3 * (20 / 27) ** 2),
}


@pytest.mark.parametrize("make", CLOSED)
def test_closed_shapes(make: Callable[..., Mesh]) -> None:
    triangles, volume = CLOSED[make]
    mesh = make()
    assert mesh.triangles == triangles
    assert is_closed(mesh)
    if volume is not None:
        assert signed_volume(mesh) == pytest.approx(volume, rel=2e-3)
    a, b, c = mesh.positions[mesh.faces].transpose(1, 0, 2)
    areas = np.cross(b - a, c - a)
    assert np.linalg.norm(areas, axis=1).min() > 1e-6
    if mesh.normals is not None:
        normals = mesh.normals[mesh.faces]
        assert np.linalg.norm(normals, axis=2) == pytest.approx(1)
        assert (np.einsum("fcd,fd->fc", normals, areas) > 0).all()


@pytest.mark.parametrize("make", [shapes.moebius_strip, shapes.klein_bottle])
def test_one_sided_surfaces_have_faces_on_both_sides(make: Callable[[], Mesh]) -> None:
    mesh = make()
    number = np.unique(mesh.positions, axis=0, return_inverse=True)[1].reshape(-1)
    edges = number[mesh.faces[:, [0, 1, 1, 2, 2, 0]]].reshape(-1, 2)
    # the back of an edge is an edge of the back
    assert set(map(tuple, edges.tolist())) == set(map(tuple, edges[:, ::-1].tolist()))
    assert mesh.normals is not None
    front, back = np.split(mesh.normals, 2)
    assert (front == -back).all()


def test_the_moebius_strip_has_half_a_turn() -> None:
    points = shapes.moebius_strip(60, 5).positions[: 61 * 6].reshape(61, 6, 3)
    np.testing.assert_allclose(points[-1], points[0, ::-1], atol=1e-9)
    assert not np.allclose(points[-1], points[0])


def test_the_cube_has_the_colour_of_each_corner() -> None:
    np.testing.assert_array_equal(shapes.cube().colors, np.where(shapes.cube().positions > 0, 255, 0))


def test_the_cornell_box_has_the_published_measures() -> None:
    room, short, tall, lamp = (o.mesh.positions for o in cornell_box().objects)
    assert room.max(axis=0).tolist() == [556, 548.8, 559.2]
    assert room.min(axis=0).tolist() == [0, 0, 0]
    assert (lamp[:, 1] == HEIGHT).all()
    assert (np.ptp(lamp, axis=0) == [130, 0, 105]).all()
    assert (cornell_box().camera.eye == EYE).all()
    for block, height in ((short, 165), (tall, 330)):
        assert block[:, 1].max() == height
        ground = np.unique(block[block[:, 1] == 0], axis=0)
        assert len(ground) == 4
        # about 165 wide, as the sides of both blocks are
        assert np.sort(np.linalg.norm(ground - ground[0], axis=1))[1:3] == pytest.approx([165, 165], rel=0.05), height


def test_the_cornell_box_looks_as_it_should() -> None:
    assert all(o.cull for o in cornell_box().objects)
    pixels = shackled.render(cornell_box()).pixels.astype(int)
    assert (pixels[64, 10] - pixels[64, 10].min() > [80, -1, -1]).all()  # the red wall is at the left
    assert pixels[64, 118, 1] > pixels[64, 118, 0] + 40  # the green one at the right
    assert (pixels[18, 64] > 220).all()  # the lamp
    assert (pixels[40, 64] > 150).all()  # the back wall
    assert (pixels[4:-4, 4:-4].max(axis=2) > 20).all()  # and nothing between them


def test_the_first_render_has_the_points_of_the_paper() -> None:
    mesh = builtin.first_render().objects[0].mesh
    points = mesh.positions[mesh.faces].tolist()
    assert points == [[[-1, 0, 0], [-1, 2, 0], [0, 2, 0]], [[1, 0, 5], [1, -2, 5], [0, -2, 5]]]


@pytest.mark.parametrize("piece", builtin.pieces(), ids=lambda piece: piece.name)
def test_every_piece_makes_a_picture(piece: Piece) -> None:
    assert (piece.dataset, piece.licence, piece.commercial) == ("common", "MIT", True)
    image = shackled.render(piece.make())
    covered = (image.covered_pixels or 0) / 128**2
    assert 0.02 < covered <= (0.31 if piece.name.startswith("wireframe") else 1)
    if piece.name != "cornell-box":  # which fills its picture
        background = shackled.render(evolve(piece.make(), objects=[])).pixels
        for side in np.nonzero((image.pixels != background).any(axis=2)):
            assert side.min() >= 4
            assert side.max() < 124
            assert (side.min() + side.max()) / 2 == pytest.approx(63.5, abs=3)


def test_names() -> None:
    names = {piece.name for piece in builtin.pieces()}
    assert len(names | models().keys()) == len(builtin.pieces()) + len(models())
    assert {"teapot", "cornell-box", "wireframe-cube", "wireframe-icosphere", "first-render"} <= names
    scans = {"3dbenchy", "nefertiti", "david", "dragon", "bunny", "armadillo", "tyra", "suzanne"}
    assert scans <= models().keys()
    for name in ("wireframe-cube", "wireframe-icosphere"):
        assert [o.wireframe for o in require(name).make().objects] == [True]


def test_what_is_known_of_models() -> None:
    for name, model in models().items():
        assert model.address.startswith("https://"), name
        kind, _, digest = model.checksum.partition(":")
        assert {"sha256": 32, "git-blob": 20}[kind] == len(bytes.fromhex(digest)), name
        assert model.author, name
        assert model.licence, name
        if model.author.endswith("1994") or "Stanford" in model.title or "none stated" in model.licence:
            assert not model.commercial, name
