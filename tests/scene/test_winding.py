"""Fronts of faces, and which are culled."""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np
import pytest
import trimesh

from shackled import Mesh, Object, load
from shackled.datasets.common.shapes import joined
from shackled.errors import InputWarning
from shackled.scene._staging import is_closed, signed_volume

BALL = trimesh.creation.icosphere(subdivisions=2)
SHEET = np.array([[-2, -2, -2], [-2, -2, 2], [2, -2, 2], [2, -2, -2]], dtype=float)


def ball(scale: float = 1.0, inverted: bool = False) -> Mesh:
    return Mesh(scale * BALL.vertices, BALL.faces[:, ::-1] if inverted else BALL.faces)


def only(mesh: Mesh) -> Object:
    """The object that is made of it, without a warning."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        (found,) = load(mesh).objects
    return found


def test_a_closed_mesh_that_is_inside_out_is_turned_with_a_note(tmp_path: Path) -> None:
    path = tmp_path / "ball.off"
    trimesh.Trimesh(BALL.vertices, BALL.faces[:, ::-1], process=False).export(path)
    with pytest.warns(InputWarning) as notes:
        (thing,) = load(path).objects
    assert [str(note.message) for note in notes] == [f"{path}: 1 closed part wound inside out, now turned"]
    assert is_closed(thing.mesh)
    assert thing.cull
    assert signed_volume(thing.mesh) == pytest.approx(signed_volume(ball()))


@pytest.mark.parametrize("side", [1, -1])
def test_normals_of_a_turned_part_point_to_its_front(side: int) -> None:
    with pytest.warns(InputWarning, match="1 closed part wound inside out"):
        (thing,) = load(Mesh(BALL.vertices, BALL.faces[:, ::-1], normals=side * BALL.vertices)).objects
    assert thing.mesh.normals is not None
    np.testing.assert_allclose(thing.mesh.normals, thing.mesh.positions, atol=1e-6)


def test_faces_that_disagree_stay_as_they_are_and_are_as_smooth_as_others() -> None:
    wrong = np.arange(len(BALL.faces)) % 3 == 0
    mixed = Mesh(BALL.vertices, np.where(wrong[:, None], BALL.faces[:, ::-1], BALL.faces))
    thing = only(mixed)
    assert not thing.cull
    assert thing.mesh.normals is not None
    found = thing.mesh.positions[thing.mesh.faces]
    np.testing.assert_array_equal(found, mixed.positions[mixed.faces])
    outward = np.where(wrong, -1, 1)[:, None] * (thing.mesh.normals[thing.mesh.faces] * found).sum(axis=2)
    assert outward.min() > 0.99


def test_an_open_mesh_stays_as_it_is_wound() -> None:
    """Seen from inside, as a room is, or with a face the other way."""
    room = BALL.faces[:-5, ::-1]
    for faces in (room, np.concatenate([room[:-1], room[-1:, ::-1]])):
        kept = only(Mesh(BALL.vertices, faces))
        np.testing.assert_array_equal(kept.mesh.positions[kept.mesh.faces], BALL.vertices[faces])
        assert not kept.cull


def test_a_doubled_sheet_is_culled_and_not_turned() -> None:
    for faces in ([(0, 1, 2), (0, 2, 1)], [(0, 2, 1), (0, 1, 2)]):
        thing = only(Mesh(SHEET, faces))
        assert (thing.cull, thing.mesh.faces.tolist()) == (True, [list(face) for face in faces])
    # twice the same side
    assert not only(Mesh(SHEET, [(0, 1, 2), (0, 1, 2)])).cull


def test_the_wall_of_a_hollow_is_not_inside_out() -> None:
    hollow = joined(ball(), ball(0.5, inverted=True))
    thing = only(hollow)
    assert thing.mesh.triangles == hollow.triangles
    assert signed_volume(thing.mesh) == pytest.approx(signed_volume(hollow))


def test_a_moebius_strip_is_left_as_it_is() -> None:
    turns = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    ring = np.stack([np.cos(turns), 0 * turns, np.sin(turns)], axis=1)
    across = 0.3 * np.stack([np.cos(turns / 2)] * 3, axis=1) * ring + np.array([0, 0.3, 0]) * np.sin(turns / 2)[:, None]
    quads = [(i, i + 1, 24 + i + 1, 24 + i) for i in range(23)] + [(23, 24, 0, 47)]
    faces = [face for a, b, c, d in quads for face in ((a, b, c), (a, c, d))]
    strip = Mesh(np.concatenate([ring + across, ring - across]), faces)
    thing = only(strip)
    assert thing.mesh.triangles == strip.triangles
    assert not thing.cull


def test_closed_parts_are_culled_and_open_ones_are_not() -> None:
    both = joined(ball(), Mesh(SHEET, [(0, 1, 2), (0, 2, 3)]))
    closed, opened = load(both).objects
    assert (closed.cull, closed.mesh.triangles, len(closed.mesh.positions)) == (True, 320, 162)
    assert (opened.cull, opened.mesh.triangles, len(opened.mesh.positions)) == (False, 2, 4)
    # one object where it must be
    for look in ({"cull": True}, {"cull": False}, {"max_triangles": 1000}):
        (thing,) = load(both, **look).objects
        assert thing.cull is look.get("cull", False)
    assert not only(Mesh(both.positions, both.faces, opacities=np.full(len(both.positions), 0.5))).cull
    # a small closed part is not worth another object
    box = trimesh.creation.box()
    assert not only(joined(Mesh(box.vertices, box.faces), Mesh(SHEET, [(0, 1, 2)]))).cull
