"""The common objects that need no file."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest
from attrs import evolve

import shackled
from shackled import Mesh
from shackled.datasets import Piece
from shackled.datasets.common import builtin, models, shapes
from shackled.datasets.common._cornell_box import EYE, HEIGHT, cornell_box
from shackled.datasets.common._models import find
from shackled.scene import is_closed
from shackled.scene._staging import signed_volume

CLOSED = {
    "tetrahedron": (shapes.tetrahedron, 4, 8 * 3**0.5 / 27),
    "octahedron": (shapes.octahedron, 8, 4 / 3),
    "icosahedron": (shapes.icosahedron, 20, 2.53615),
    "dodecahedron": (shapes.dodecahedron, 36, 2.78516),
    "cube": (shapes.cube, 12, 1.2**3),
    "icosphere": (shapes.icosphere, 320, 4.0471),
    "sphere": (shapes.sphere, 960, 4.12194),
    "torus": (shapes.torus, 1152, 2 * np.pi**2 * 0.72 * 0.28**2 * 0.970),
    "torus-knot": (shapes.torus_knot, 1176, None),
    "spring": (shapes.spring, 1136, None),
    "superellipsoid": (shapes.superellipsoid, 1080, None),
    "cylinder": (shapes.cylinder, 160, 1.8 * 40 / 2 * np.sin(2 * np.pi / 40) * 0.75**2),
    "cone": (shapes.cone, 80, 1.8 / 3 * 40 / 2 * np.sin(2 * np.pi / 40) * 0.85**2),
    "menger-sponge": (shapes.menger_sponge, 2112, 1.3**3 * (20 / 27) ** 2),
}


def edges(mesh: Mesh) -> Counter[tuple[int, int]]:
    number = np.unique(mesh.positions, axis=0, return_inverse=True)[1].reshape(-1)
    faces = number[mesh.faces]
    return Counter(map(tuple, np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]).tolist()))


@pytest.mark.parametrize("name", CLOSED)
def test_closed_shapes(name: str) -> None:
    make, triangles, volume = CLOSED[name]
    mesh = make()
    assert mesh.triangles == triangles
    assert is_closed(mesh)
    if volume is not None:
        assert signed_volume(mesh) == pytest.approx(volume, rel=2e-3)
    a, b, c = mesh.positions[mesh.faces].transpose(1, 0, 2)
    assert np.linalg.norm(np.cross(b - a, c - a), axis=1).min() > 1e-6


@pytest.mark.parametrize("name", ["sphere", "torus", "torus-knot", "spring", "superellipsoid", "cylinder", "cone"])
def test_normals_point_out(name: str) -> None:
    mesh = CLOSED[name][0]()
    normals = np.asarray(mesh.normals)[mesh.faces]
    a, b, c = mesh.positions[mesh.faces].transpose(1, 0, 2)
    assert np.linalg.norm(normals, axis=2) == pytest.approx(1)
    assert (np.einsum("fcd,fd->fc", normals, np.cross(b - a, c - a)) > 0).all()


@pytest.mark.parametrize("depth", [0, 1, 2])
def test_the_sponge(depth: int) -> None:
    mesh = shapes.menger_sponge(depth)
    assert mesh.triangles == 2 * (2 * 20**depth + 4 * 8**depth)
    assert signed_volume(mesh) == pytest.approx(1.3**3 * (20 / 27) ** depth)


@pytest.mark.parametrize("make", [shapes.moebius_strip, shapes.klein_bottle])
def test_one_sided_surfaces_have_faces_on_both_sides(make: object) -> None:
    mesh = make()  # type: ignore[operator]
    found = edges(mesh)
    assert all(found[b, a] >= 1 for a, b in found)  # the back of an edge is an edge of the back
    normals = mesh.normals
    half = len(normals) // 2
    assert (normals[:half] == -normals[half:]).all()


def test_the_moebius_strip_has_half_a_turn() -> None:
    points = np.asarray(shapes.moebius_strip(60, 5).positions)[: 61 * 6].reshape(61, 6, 3)
    np.testing.assert_allclose(points[-1], points[0, ::-1], atol=1e-9)
    assert not np.allclose(points[-1], points[0])


def test_the_cube_has_the_colour_of_each_corner() -> None:
    mesh = shapes.cube()
    np.testing.assert_array_equal(mesh.colors, np.where(mesh.positions > 0, 255, 0))


def test_the_cornell_box_has_the_published_measures() -> None:
    room, short, tall, lamp = (o.mesh.positions for o in cornell_box().objects)
    assert room.max(axis=0).tolist() == [556, 548.8, 559.2]
    assert room.min(axis=0).tolist() == [0, 0, 0]
    assert short[:, 1].max() == 165
    assert tall[:, 1].max() == 330
    assert (lamp[:, 1] == HEIGHT).all()
    assert (np.ptp(lamp, axis=0) == [130, 0, 105]).all()
    assert (np.asarray(cornell_box().camera.eye) == EYE).all()
    for block, height in ((short, 165), (tall, 330)):
        ground = np.unique(block[block[:, 1] == 0], axis=0)
        assert len(ground) == 4
        # about 165 wide, as the sides of both blocks are
        assert np.sort(np.linalg.norm(ground - ground[0], axis=1))[1:3] == pytest.approx([165, 165], rel=0.05), height


def test_the_cornell_box_looks_as_it_should() -> None:
    pixels = shackled.render("cornell-box", size=128).pixels.astype(int)
    assert (pixels[64, 10] - pixels[64, 10].min() > [80, -1, -1]).all()  # the red wall is at the left
    assert pixels[64, 118, 1] > pixels[64, 118, 0] + 40  # the green one at the right
    assert (pixels[18, 64] > 220).all()  # the lamp
    assert (pixels[40, 64] > 150).all()  # the back wall


def test_the_box_covers_each_pixel_within_it_once() -> None:
    scene = cornell_box()
    assert all(o.cull for o in scene.objects)
    pixels = shackled.render(scene).pixels
    assert (pixels[4:-4, 4:-4].max(axis=2) > 20).all()


def test_the_first_render_has_the_points_of_the_paper() -> None:
    mesh = builtin.first_render().objects[0].mesh
    points = mesh.positions[mesh.faces].tolist()
    assert points == [[[-1, 0, 0], [-1, 2, 0], [0, 2, 0]], [[1, 0, 5], [1, -2, 5], [0, -2, 5]]]


PIECES = builtin.pieces()


@pytest.mark.parametrize("piece", PIECES, ids=lambda piece: piece.name)
def test_every_piece_makes_a_picture(piece: Piece) -> None:
    assert (piece.dataset, piece.licence, piece.commercial) == ("common", "MIT", True)
    image = shackled.render(piece.make())
    covered = (image.covered_pixels or 0) / 128**2
    assert 0.02 < covered <= 1
    if piece.name != "cornell-box":  # which fills its picture
        background = shackled.render(evolve(piece.make(), objects=[])).pixels
        rows, columns = np.nonzero((image.pixels != background).any(axis=2))
        for side in (rows, columns):
            assert side.min() >= 4
            assert side.max() < 124
            assert (side.min() + side.max()) / 2 == pytest.approx(63.5, abs=3)


def test_names() -> None:
    names = [piece.name for piece in builtin.pieces()]
    assert len(set(names) | set(models())) == len(names) + len(models())
    paper = {"teapot", "cornell-box", "wireframe-cube", "wireframe-icosphere", "first-render"}
    scans = {"3dbenchy", "nefertiti", "david", "dragon", "bunny", "armadillo", "tyra", "suzanne"}
    assert paper <= set(names)
    assert scans <= set(models())
    assert find("teapot") is not None
    assert find("teapo") is None


def test_wireframes_show_edges_only() -> None:
    for name in ("wireframe-cube", "wireframe-icosphere"):
        piece = find(name)
        assert piece is not None
        scene = piece.make()
        assert [o.wireframe for o in scene.objects] == [True]
        assert 500 < (shackled.render(scene).covered_pixels or 0) < 5000


@pytest.mark.parametrize("name", sorted(models()))
def test_what_is_known_of_models(name: str) -> None:
    model = models()[name]
    assert model.addresses
    assert all(address.startswith("https://") for address in model.addresses)
    kind, _, digest = model.checksum.partition(":")
    assert {"sha256": 64, "git-blob": 40}[kind] == len(bytes.fromhex(digest)) * 2
    assert model.author
    assert model.licence
    if model.author.endswith("1994") or "Stanford" in model.title or "none stated" in model.licence:
        assert not model.commercial
