import numpy as np
import pytest

from shackled.errors import InputError
from shackled.scene import weld

SQUARE = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
RED, BLUE = [255, 0, 0], [0, 0, 255]


def test_equal_positions_become_one_vertex() -> None:
    mesh = weld([*SQUARE, *SQUARE], [[0, 1, 2], [4, 6, 7]])
    assert len(mesh.positions) == 4
    assert mesh.faces.tolist() == [[0, 1, 2], [0, 2, 3]]


def test_negative_zero_is_zero() -> None:
    mesh = weld(
        np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [-0.0, 0.0, -0.0], [0, 1, 0], [-1, 0, 0]]), [[0, 1, 2], [3, 4, 5]]
    )
    assert len(mesh.positions) == 4


def test_a_vertex_between_two_colors_is_split() -> None:
    mesh = weld(SQUARE, [[0, 1, 2], [0, 2, 3]], [[RED] * 3, [BLUE] * 3])
    assert len(mesh.positions) == 6
    corners = mesh.colors[mesh.faces]
    assert corners.tolist() == [[RED] * 3, [BLUE] * 3]
    assert mesh.positions[mesh.faces].tolist() == [
        SQUARE[:3],
        [SQUARE[0], SQUARE[2], SQUARE[3]],
    ]


def test_a_vertex_between_two_normals_is_split() -> None:
    normals = [[[0, 0, 1]] * 3, [[0, 1, 0]] * 3]
    mesh = weld(SQUARE, [[0, 1, 2], [0, 2, 3]], normals=normals)
    assert np.asarray(mesh.normals)[mesh.faces].tolist() == normals


def test_unused_vertices_are_left_out() -> None:
    assert len(np.asarray(weld([*SQUARE, [9, 9, 9]], [[0, 1, 2]]).positions)) == 3


def test_wrong_numbers_are_refused() -> None:
    with pytest.raises(InputError, match=r"^face 1 names the vertices \[0, 1, 4\], but they are numbered 0 to 3$"):
        weld(SQUARE, [[0, 1, 2], [0, 1, 4]])
