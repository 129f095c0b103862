"""Cleaning and simplifying meshes."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from shackled import Mesh
from shackled.datasets.common import model as find_model
from shackled.datasets.common import take
from shackled.datasets.common._clean import (
    MAX_TRIANGLES,
    capped,
    clean,
    creased,
    placed,
    prepare,
    reduce,
    without_crumbs,
)
from shackled.datasets.common._fetch import checksum
from shackled.datasets.common.shapes import cylinder, icosphere, joined, torus
from shackled.errors import InputError
from shackled.scene import FORCEFUL, components, is_closed, simplify
from shackled.scene._staging import signed_volume

SHARED = Path(os.environ.get("SHACKLED_SHARED", Path(__file__).resolve().parents[3] / "shared"))

BALL = icosphere(3)


def moved(mesh: Mesh, scale: float, by: tuple[float, float, float]) -> Mesh:
    return Mesh(scale * mesh.positions + by, mesh.faces, mesh.colors)


def count(mesh: Mesh) -> tuple[int, int]:
    return len(mesh.positions), mesh.triangles


def test_vertices_of_one_place_become_one() -> None:
    positions, faces = BALL.positions, np.asarray(BALL.faces)
    soup = Mesh(positions[faces].reshape(-1, 3), np.arange(3 * len(faces)).reshape(-1, 3))
    assert count(clean(soup)) == count(BALL)
    assert is_closed(clean(soup))


def test_what_bounds_nothing_goes() -> None:
    faces = np.asarray(BALL.faces)
    doubled = np.concatenate(
        [
            faces,
            faces[:5],  # the same again
            np.roll(faces[5:9], 1, axis=1),  # and from another corner
            [[0, 0, 1], [3, 3, 3]],  # without area
            [[1, 40, 80], [40, 1, 80]],  # back to back
        ]
    )
    assert count(clean(Mesh(BALL.positions, doubled))) == count(BALL)
    assert is_closed(clean(Mesh(BALL.positions, doubled)))


def test_one_of_two_against_one_stays() -> None:
    points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
    mesh = clean(Mesh(points, [(1, 0, 2), (0, 1, 2), (2, 0, 1)]))
    corners = mesh.positions[mesh.faces]
    assert np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]).tolist() == [[0, 0, 1]]
    mesh = clean(Mesh(points, [(1, 0, 2), (0, 1, 2), (2, 1, 0)]))
    corners = mesh.positions[mesh.faces]
    assert np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]).tolist() == [[0, 0, -1]]


def test_nothing_but_slivers_is_a_mistake() -> None:
    with pytest.raises(InputError, match="no triangle with an area"):
        clean(Mesh([(0, 0, 0), (1, 0, 0), (2, 0, 0)], [(0, 1, 2), (0, 1, 1)]))


def test_holes_are_closed() -> None:
    faces = np.asarray(BALL.faces)
    center = BALL.positions[faces].mean(axis=1)
    open_ball = clean(Mesh(BALL.positions, faces[(center[:, 1] > -0.8) & (center[:, 0] < 0.85)]))
    assert not is_closed(open_ball)
    assert is_closed(capped(open_ball))
    assert 0.8 * signed_volume(BALL) < signed_volume(capped(open_ball)) < signed_volume(BALL)
    assert capped(BALL) is BALL


def test_crumbs_go_and_parts_stay() -> None:
    crumb = Mesh([(3, 0, 0), (3.001, 0, 0), (3, 0.001, 0)], [(0, 1, 2)])
    board = Mesh([(0, 3, 0), (2, 3, 0), (2, 4, 0), (0, 4, 0)], [(0, 1, 2), (0, 2, 3)])
    whole = joined(Mesh(BALL.positions, BALL.faces), moved(BALL, 0.3, (0, 0, 3)), board)
    mesh = without_crumbs(joined(whole, crumb))
    assert count(mesh) == count(whole)
    assert len(np.unique(components(mesh.faces, len(mesh.positions)))) == 3
    assert count(without_crumbs(board)) == count(board)


def test_placing() -> None:
    mesh = placed(moved(torus(), 1000, (5, 6, 7)), (90, 0, 0))
    positions = mesh.positions
    assert np.linalg.norm(positions, axis=1).max() == pytest.approx(1)
    np.testing.assert_allclose(positions.max(axis=0), -positions.min(axis=0), atol=1e-9)
    assert np.ptp(positions, axis=0).argmin() == 2  # it stood about y, now about z


@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
def test_simplifying_keeps_the_shape_in_any_unit(scale: float) -> None:
    mesh = prepare(moved(torus(across=120, down=50), scale, (scale, 0, 0)))
    assert 1000 < count(mesh)[1] <= MAX_TRIANGLES
    assert is_closed(mesh)
    assert signed_volume(mesh) == pytest.approx(signed_volume(placed(torus())), rel=0.02)


def test_a_small_mesh_stays_as_it_is() -> None:
    assert count(prepare(icosphere(2))) == count(icosphere(2))


def test_inside_out() -> None:
    inverted = Mesh(BALL.positions, BALL.faces[:, ::-1])
    assert signed_volume(prepare(inverted)) < 0
    assert signed_volume(prepare(inverted, turn_inside_out=True)) > 0


def test_where_edges_cannot_be_collapsed_vertices_are_merged(monkeypatch: pytest.MonkeyPatch) -> None:
    def stalls(mesh: Mesh, target: int, tries: Any = FORCEFUL) -> Mesh:
        if count(mesh)[1] > 20000:
            raise InputError("too many remain")
        return simplify(mesh, target, tries)

    monkeypatch.setattr("shackled.datasets.common._clean.simplify", stalls)
    fine = torus(across=200, down=80)
    mesh = reduce(fine, 400)
    assert 300 < count(mesh)[1] <= 400
    assert signed_volume(mesh) == pytest.approx(signed_volume(fine), rel=0.1)
    monkeypatch.setattr(
        "shackled.datasets.common._clean.simplify", lambda mesh, target, tries=FORCEFUL: stalls(fine, target, tries)
    )
    with pytest.raises(InputError, match="too many remain"):
        reduce(fine, 400)


@pytest.mark.parametrize(
    ("name", "file"),
    [
        ("bunny", "stanford-bunny.obj"),
        ("dragon", "stanford-dragon.obj"),
        ("3dbenchy", "3dbenchy.3mf"),
        ("horse", "horse.ply"),
    ],
)
def test_real_models(name: str, file: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = SHARED / "meshes" / "full" / file
    if not path.is_file():
        pytest.skip("needs the meshes beside the repository")
    monkeypatch.setenv("SHACKLED_CACHE", str(tmp_path))
    model = find_model(name)
    assert checksum(path, model.checksum) == model.checksum
    assert path.stat().st_size == model.size
    assert take(model, path)
    scene = model.scene()
    mesh = scene.objects[0].mesh
    assert 1100 < count(mesh)[1] <= MAX_TRIANGLES
    assert signed_volume(mesh) > 0
    assert scene.objects[0].cull
    assert is_closed(mesh) or model.cull


def test_creases_are_sharp_and_the_rest_is_smooth() -> None:
    can = clean(cylinder())
    mesh = creased(can, 40)
    normals, corners = (
        np.asarray(mesh.normals)[mesh.faces],
        mesh.positions[mesh.faces],
    )
    flat = np.abs(corners[:, :, 1]).min(axis=1) > 0.89
    lid = flat & (np.ptp(corners[:, :, 1], axis=1) == 0)
    np.testing.assert_allclose(np.abs(normals[lid][..., 1]), 1)
    np.testing.assert_allclose(normals[~lid][..., 1], 0, atol=1e-6)
    # along the side each normal points from the axis
    side = corners[~lid] * (1, 0, 1)
    assert (np.einsum("fci,fci->fc", normals[~lid], side) > 0.75 * 0.99).all()
    assert len(np.asarray(creased(can, 180).positions)) == len(can.positions)
    assert len(np.asarray(creased(icosphere(2), 0).positions)) == 3 * 320
