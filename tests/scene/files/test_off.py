from pathlib import Path

import numpy as np
import pytest

from shackled.errors import InputError
from shackled.scene import DEFAULT_COLOR, Mesh, read_mesh

SQUARE = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n"


def read(folder: Path, text: str) -> Mesh:
    path = folder / "model.off"
    path.write_text(text)
    return read_mesh(path)


def corner_colors(mesh: Mesh) -> list[list[list[int]]]:
    colors: list[list[list[int]]] = mesh.colors[mesh.faces].tolist()
    return colors


def test_plain(tmp_path: Path) -> None:
    mesh = read(tmp_path, "OFF\n# a square\n\n4 1 0\n" + SQUARE + "4 0 1 2 3\n")
    assert mesh.faces.tolist() == [[0, 1, 2], [0, 2, 3]]
    assert corner_colors(mesh) == [[list(DEFAULT_COLOR)] * 3] * 2


def test_counts_beside_the_header(tmp_path: Path) -> None:
    assert len(np.asarray(read(tmp_path, "OFF 4 1 0\n" + SQUARE + "3 0 1 2\n").faces)) == 1


def test_the_first_count_may_stand_in_the_header(tmp_path: Path) -> None:
    assert len(np.asarray(read(tmp_path, "OFF4 1 0 # a square\n" + SQUARE + "3 0 1 2\n").faces)) == 1


def test_a_concave_polygon_is_filled_as_it_is(tmp_path: Path) -> None:
    mesh = read(tmp_path, "OFF\n4 1 0\n0 2 0\n-1 0 0\n0 1 0\n1 0 0\n4 1 2 3 0\n")
    a, b, c = np.moveaxis(mesh.positions[mesh.faces], 1, 0)
    assert sorted((np.cross(b - a, c - a)[:, 2] / 2).tolist()) == [0.5, 0.5]


def test_face_colors_in_bytes(tmp_path: Path) -> None:
    mesh = read(tmp_path, "OFF\n4 3 0\n" + SQUARE + "3 0 1 2 255 0 10\n3 0 2 3 0 0 200 255\n3 1 2 3\n")
    assert corner_colors(mesh) == [[[255, 0, 10]] * 3, [[0, 0, 200]] * 3, [list(DEFAULT_COLOR)] * 3]


def test_face_colors_in_fractions(tmp_path: Path) -> None:
    mesh = read(tmp_path, "OFF\n4 2 0\n" + SQUARE + "3 0 1 2 1.0 0.5 0\n3 0 2 3 0 0 0.2 1\n")
    assert corner_colors(mesh) == [[[255, 128, 0]] * 3, [[0, 0, 51]] * 3]


def test_a_number_into_a_color_table_is_no_color(tmp_path: Path) -> None:
    assert corner_colors(read(tmp_path, "OFF\n4 1 0\n" + SQUARE + "3 0 1 2 7\n")) == [[list(DEFAULT_COLOR)] * 3]


@pytest.mark.parametrize("header", ["COFF", "OFF"])
def test_vertex_colors(tmp_path: Path, header: str) -> None:
    mesh = read(tmp_path, f"{header}\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 0 255 0 255\n0 1 0 0 0 9 255\n3 0 1 2\n")
    assert corner_colors(mesh) == [[[255, 0, 0], [0, 255, 0], [0, 0, 9]]]


def test_normals_and_colors(tmp_path: Path) -> None:
    mesh = read(tmp_path, "CNOFF\n3 1 0\n0 0 0 0 0 1 1 0 0\n1 0 0 0 0 1 0 1 0\n0 1 0 0 1 0 0 0 1\n3 0 1 2\n")
    assert np.asarray(mesh.normals).tolist() == [[0, 0, 1], [0, 0, 1], [0, 1, 0]]
    assert corner_colors(mesh) == [[[255, 0, 0], [0, 255, 0], [0, 0, 255]]]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("OBJ\n3 1 0\n",
         "an OFF file begins with OFF, COFF, NOFF or STOFF, and is text with three coordinates a vertex"),
        ("4OFF\n3 1 0\n",
         "an OFF file begins with OFF, COFF, NOFF or STOFF, and is text with three coordinates a vertex"),
        ("OFF\n", "the counts of vertices and faces are missing"),
        ("OFF\nfour 1\n", "line 2 should hold the counts of vertices and faces, not 'four 1'"),
        ("OFF\n4 2 0\n" + SQUARE + "3 0 1 2\n", "line 2 promises 4 vertices and 2 faces, but only 5 lines follow"),
        ("OFF\n4 1 0\n" + SQUARE.replace("1 1 0", "1 x 0") + "3 0 1 2\n",
         "line 5 should hold the 3 numbers of a vertex, not '1 x 0'"),
        ("OFF\n4 1 0\n" + SQUARE + "3 0 1\n", "line 7 should hold the vertices of a face, not '3 0 1'"),
        ("OFF\n4 1 0\n" + SQUARE + "3 0 1 4\n", "face 0 names the vertices [0, 1, 4], but they are numbered 0 to 3"),
        ("OFF\n4 1 0\n" + SQUARE + "3 0 1 -1\n", "face 0 names the vertices [0, 1, -1], but they are numbered 0 to 3"),
        ("OFF\n4 0 0\n" + SQUARE, "a mesh needs vertices and faces; this one has 4 and 0"),
        ("OFF\n4 1 0\n" + SQUARE.replace("1 1 0", "1 nan 0") + "3 0 1 2\n",
         "vertex 2 has a coordinate that is not a finite number: [1.0, nan, 0.0]"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_told_in_one_line(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(InputError) as error:
        read(tmp_path, text)
    assert str(error.value) == f"{tmp_path / 'model.off'}: {message}"
