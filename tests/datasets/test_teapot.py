from collections import Counter

import numpy as np
import pytest

from shackled.datasets import teapot
from shackled.datasets._teapot import patches
from shackled.errors import InputError
from shackled.scene._staging import signed_volume

MESH = teapot(6)
POSITIONS = MESH.positions


def test_patches_are_those_of_newell() -> None:
    control_points = patches()
    assert control_points.shape == (32, 4, 4, 3)
    points = control_points.reshape(-1, 3)
    assert len(np.unique(np.round(points, 9), axis=0)) == 290
    assert [points.min(axis=0).tolist(), points.max(axis=0).tolist()] == [[-3, -2, 0], [3.525, 2, 3.15]]


@pytest.mark.parametrize("divisions", [1, 2, 5, 32])
def test_size(divisions: int) -> None:
    mesh = teapot(divisions)
    assert mesh.triangles == 64 * divisions**2 - 8 * divisions
    assert len(mesh.positions) < 65536
    assert len(np.unique(mesh.positions, axis=0)) == len(mesh.positions)


def test_it_stands_upright_on_the_ground() -> None:
    np.testing.assert_allclose(POSITIONS.min(axis=0), (-3, 0, -2), atol=1e-9)
    np.testing.assert_allclose(POSITIONS.max(axis=0), (3.43, 3.15, 2), atol=0.005)
    np.testing.assert_allclose(POSITIONS[POSITIONS[:, 1].argmax()], (0, 3.15, 0), atol=1e-9)


def test_faces_are_wound_alike_and_outward_and_open_only_at_rim_lid_handle_and_spout() -> None:
    a, b, c = POSITIONS[MESH.faces].transpose(1, 0, 2)
    assert np.linalg.norm(np.cross(b - a, c - a), axis=1).min() > 1e-6
    assert 25 < signed_volume(MESH) < 27
    edges = Counter(map(tuple, MESH.faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2).tolist()))
    assert max(edges.values()) == 1
    rims = [(start, end) for start, end in edges if (end, start) not in edges]
    # circles of four patches: the rim's inside and the lid; of two: both ends of the handle and of the spout
    assert len(rims) == 2 * 4 * 6 + 4 * 2 * 6
    assert set(Counter(vertex for edge in rims for vertex in edge).values()) == {2}


def test_normals_point_outward() -> None:
    normals = np.asarray(MESH.normals)
    np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1)
    assert (normals[POSITIONS[:, 1] > 3.149][:, 1] > 0.99).all()
    belly = (np.abs(np.hypot(POSITIONS[:, 0], POSITIONS[:, 2]) - 2) < 0.02) & (POSITIONS[:, 1] < 1.4)
    belly &= np.abs(POSITIONS[:, 2]) > 0.4  # neither handle nor spout
    assert ((normals[belly] * POSITIONS[belly] * (1, 0, 1) / 2).sum(axis=1) > 0.9).all()


@pytest.mark.parametrize("divisions", [0, 33, 2.5, True])
def test_divisions_that_are_none(divisions: int) -> None:
    with pytest.raises(InputError, match=r"^the divisions of the teapot must be a whole number from 1 to 32, not "):
        teapot(divisions)
