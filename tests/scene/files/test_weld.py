import numpy as np
import pytest

from shackled.errors import InputError
from shackled.scene._mesh import weld

SQUARE = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
RED, BLUE = [255, 0, 0], [0, 0, 255]


def test_equal_positions_become_one_vertex() -> None:
    mesh = weld([*SQUARE, *SQUARE, [9, 9, 9]], [[0, 1, 2], [4, 6, 7]])
    assert mesh.positions.tolist() == SQUARE
    assert mesh.faces.tolist() == [[0, 1, 2], [0, 2, 3]]
    points: list[list[float]] = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [-0.0, 0.0, -0.0], [0, 1, 0], [-1, 0, 0]]
    assert len(weld(points, [[0, 1, 2], [3, 4, 5]]).positions) == 4


def test_a_vertex_between_two_colors_or_normals_is_split() -> None:
    colors, normals = [[RED] * 3, [BLUE] * 3], [[[0, 0, 1]] * 3, [[0, 1, 0]] * 3]
    mesh = weld(SQUARE, [[0, 1, 2], [0, 2, 3]], colors)
    assert len(mesh.positions) == 6
    assert mesh.colors[mesh.faces].tolist() == colors
    assert mesh.positions[mesh.faces].tolist() == [SQUARE[:3], [SQUARE[0], SQUARE[2], SQUARE[3]]]
    mesh = weld(SQUARE, [[0, 1, 2], [0, 2, 3]], normals=normals)
    assert np.asarray(mesh.normals)[mesh.faces].tolist() == normals


def test_wrong_numbers_are_refused() -> None:
    with pytest.raises(InputError, match=r"^face 1 names the vertices \[0, 1, 4\], but they are numbered 0 to 3$"):
        weld(SQUARE, [[0, 1, 2], [0, 1, 4]])
