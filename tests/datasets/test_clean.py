"""Cleaning and simplifying meshes."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from shackled import Mesh
from shackled.datasets.common._clean import MAX_TRIANGLES, capped, clean, placed, prepare, reduce
from shackled.datasets.common._fetch import fetch
from shackled.datasets.common._models import model as find_model
from shackled.datasets.common.shapes import icosphere, torus
from shackled.errors import InputError
from shackled.scene._simplify import simplify
from shackled.scene._staging import is_closed, signed_volume

SHARED = Path(os.environ.get("SHACKLED_SHARED", Path(__file__).resolve().parents[3] / "shared"))

BALL = icosphere(3)


def moved(mesh: Mesh, scale: float, by: tuple[float, float, float]) -> Mesh:
    return Mesh(scale * mesh.positions + by, mesh.faces, mesh.colors)


def test_vertices_of_one_place_become_one_and_what_bounds_nothing_goes() -> None:
    faces = BALL.faces
    more = [
        faces[:5],  # the same again
        np.roll(faces[5:9], 1, axis=1),  # and from another corner
        [[0, 0, 1], [3, 3, 3]],  # two corners in one place
        [[1, 40, 80], [40, 1, 80]],  # back to back
    ]
    points = BALL.positions[np.concatenate([faces, *more])].reshape(-1, 3)
    mesh = clean(Mesh(points, np.arange(len(points)).reshape(-1, 3)))
    assert (len(mesh.positions), mesh.triangles) == (len(BALL.positions), BALL.triangles)
    assert is_closed(mesh)


@pytest.mark.parametrize(("last", "up"), [((2, 0, 1), 1), ((2, 1, 0), -1)])
def test_one_of_two_against_one_stays(last: tuple[int, int, int], up: int) -> None:
    mesh = clean(Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(1, 0, 2), (0, 1, 2), last]))
    corners = mesh.positions[mesh.faces]
    assert np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]).tolist() == [[0, 0, up]]


def test_holes_are_closed() -> None:
    center = BALL.positions[BALL.faces].mean(axis=1)
    open_ball = clean(Mesh(BALL.positions, BALL.faces[(center[:, 1] > -0.8) & (center[:, 0] < 0.85)]))
    assert not is_closed(open_ball)
    assert is_closed(capped(open_ball))
    assert 0.8 * signed_volume(BALL) < signed_volume(capped(open_ball)) < signed_volume(BALL)
    assert capped(BALL) is BALL


@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
def test_simplifying_keeps_the_shape_in_any_unit(scale: float) -> None:
    mesh = prepare(moved(torus(across=120, down=50), scale, (scale, 0, 0)), (90, 0, 0))
    assert 1000 < mesh.triangles <= MAX_TRIANGLES
    assert is_closed(mesh)
    assert signed_volume(mesh) == pytest.approx(signed_volume(placed(torus())), rel=0.02)
    positions = mesh.positions
    assert np.linalg.norm(positions, axis=1).max() == pytest.approx(1)
    np.testing.assert_allclose(positions.max(axis=0), -positions.min(axis=0), atol=1e-9)
    assert np.ptp(positions, axis=0).argmin() == 2  # it stood about y, now about z


def test_a_small_mesh_stays_as_it_is_but_for_its_sides() -> None:
    inverted = Mesh(BALL.positions, BALL.faces[:, ::-1])
    assert prepare(icosphere(2)).triangles == 320
    assert signed_volume(prepare(inverted)) < 0 < signed_volume(prepare(inverted, inside_out=True))


def test_where_edges_cannot_be_collapsed_vertices_are_merged(monkeypatch: pytest.MonkeyPatch) -> None:
    fine = torus(across=200, down=80)
    most = 20000

    def stalls(mesh: Mesh, *arguments: Any) -> Mesh:
        if mesh.triangles > most:
            raise InputError("too many remain")
        return simplify(mesh, *arguments)

    monkeypatch.setattr("shackled.datasets.common._clean.simplify", stalls)
    monkeypatch.setattr("shackled.datasets.common._clean.CELLS", 64)
    mesh = reduce(fine, 400)
    assert 300 < mesh.triangles <= 400
    assert signed_volume(mesh) == pytest.approx(signed_volume(fine), rel=0.1)
    most = 0
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
    fetch(model, path)
    (o,) = model.scene().objects
    assert 1100 < o.mesh.triangles <= MAX_TRIANGLES
    assert signed_volume(o.mesh) > 0
    assert o.cull
    assert is_closed(o.mesh) or model.cull
    assert (o.mesh.normals is None) == (model.crease is None)
