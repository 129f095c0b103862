from collections import Counter

import numpy as np
import pytest

from shackled.datasets import teapot
from shackled.datasets._teapot import patches
from shackled.errors import InputError
from shackled.scene._staging import signed_volume


def test_patches_are_those_of_newell() -> None:
    control_points = patches()
    assert control_points.shape == (32, 4, 4, 3)
    assert len(np.unique(np.round(control_points.reshape(-1, 3), 9), axis=0)) == 290
    assert control_points.reshape(-1, 3).min(axis=0).tolist() == [-3, -2, 0]
    assert control_points.reshape(-1, 3).max(axis=0).tolist() == [3.525, 2, 3.15]


@pytest.mark.parametrize("divisions", [1, 2, 5, 6, 32])
def test_size(divisions: int) -> None:
    mesh = teapot(divisions)
    assert mesh.triangles == 64 * divisions**2 - 8 * divisions
    assert len(mesh.positions) < 65536
    assert len(np.unique(mesh.positions, axis=0)) == len(mesh.positions)


def test_it_stands_upright_on_the_ground() -> None:
    positions = np.asarray(teapot(6).positions)
    np.testing.assert_allclose(positions.min(axis=0), (-3, 0, -2), atol=1e-9)
    np.testing.assert_allclose(positions.max(axis=0), (3.43, 3.15, 2), atol=0.005)
    top = positions[positions[:, 1].argmax()]
    np.testing.assert_allclose(top, (0, 3.15, 0), atol=1e-9)


def test_triangles_have_an_area() -> None:
    mesh = teapot(6)
    a, b, c = mesh.positions[mesh.faces].transpose(1, 0, 2)
    assert np.linalg.norm(np.cross(b - a, c - a), axis=1).min() > 1e-6


def test_faces_are_wound_alike_and_outward() -> None:
    mesh = teapot(6)
    faces = mesh.faces
    edges = Counter(map(tuple, faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2).tolist()))
    assert max(edges.values()) == 1
    assert 25 < signed_volume(mesh) < 27
    assert (np.asarray(mesh.normals)[mesh.positions[:, 1] > 3.149][:, 1] > 0.99).all()


def test_the_only_open_edges_are_at_rim_lid_handle_and_spout() -> None:
    faces = np.asarray(teapot(6).faces)
    edges = Counter(tuple(sorted(edge)) for edge in faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2).tolist())
    rims = [edge for edge, count in edges.items() if count == 1]
    assert set(edges.values()) == {1, 2}
    # circles of four patches: the rim's inside and the lid; of two: both ends of the handle and of the spout
    assert len(rims) == 2 * 4 * 6 + 4 * 2 * 6
    ends = Counter(vertex for edge in rims for vertex in edge)
    assert set(ends.values()) == {2}


def test_normals_point_outward_from_the_body() -> None:
    mesh = teapot(6)
    positions, normals = mesh.positions, np.asarray(mesh.normals)
    np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1)
    belly = (np.abs(np.hypot(positions[:, 0], positions[:, 2]) - 2) < 0.02) & (positions[:, 1] < 1.4)
    belly &= np.abs(positions[:, 2]) > 0.4  # neither handle nor spout
    outward = positions[belly] * (1, 0, 1) / 2
    assert ((normals[belly] * outward).sum(axis=1) > 0.9).all()


@pytest.mark.parametrize("divisions", [0, 33, 2.0, True])
def test_divisions_that_are_none(divisions: int) -> None:
    with pytest.raises(InputError, match=r"^the divisions of the teapot must be a whole number from 1 to 32, not "):
        teapot(divisions)
