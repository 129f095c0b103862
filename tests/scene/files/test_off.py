import itertools
import struct
from pathlib import Path

import numpy as np
import pytest

import mesh_files
from mesh_files import corner_colors
from shackled.errors import InputError
from shackled.scene import Mesh
from shackled.scene._mesh import DEFAULT_COLOR

SQUARE = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n"


def read(folder: Path, content: str | bytes) -> Mesh:
    return mesh_files.read(folder / "model.off", content)


def read_with_notes(folder: Path, content: str | bytes) -> tuple[Mesh, list[str]]:
    return mesh_files.read_with_notes(folder / "model.off", content)


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
    mesh, notes = read_with_notes(tmp_path, "OFF\n4 1 0\n" + SQUARE + "3 0 1 2 7\n")
    assert corner_colors(mesh) == [[list(DEFAULT_COLOR)] * 3]
    assert notes == ["numbers behind faces that are no colours are left out: 1"]


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
         "an OFF file begins with OFF, or with letters before it, as in COFF, NOFF, NCOFF or STOFF"),
        ("COOF\n3 1 0\n",
         "an OFF file begins with OFF, or with letters before it, as in COFF, NOFF, NCOFF or STOFF"),
        ("nOFF\n5\n3 1 0\n", "its vertices have 5 dimensions; those of a mesh have 3"),
        ("nOFF\n", "the counts of vertices and faces are missing"),
        ("4OFF\n3 1 0\n0 0 0 1\n1 0 0 1\n0 1 0\n3 0 1 2\n",
         "line 5 should hold the 4 numbers of a vertex, not '0 1 0'"),
        ("4OFF\n3 1 0\n0 0 0 1\n1 0 0 1\n0 1 0 0\n3 0 1 2\n",
         "vertex 2 has a coordinate that is not a finite number: [nan, inf, nan]"),
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


# ---- letters of the header ----

COLORS = [[255, 0, 0, 102], [0, 255, 0, 255], [0, 0, 255, 51]]
NORMALS = [[0, 0, 1], [0, 1, 0], [1, 0, 0]]


@pytest.mark.parametrize("letters", [p for n in range(5) for p in itertools.permutations(("C", "N", "ST", "4"), n)])
def test_letters_in_any_order(tmp_path: Path, letters: tuple[str, ...]) -> None:
    """What stands for them in a row is in the order of Geomview, but for MeshLab's colours before normals in NC."""
    rows = []
    for (x, y), color, normal in zip(((0, 0), (1, 0), (0, 1)), COLORS, NORMALS, strict=True):
        parts = [[2 * x, 2 * y, 0, 2] if "4" in letters else [x, y, 0]]
        behind = [color if "C" in letters else [], normal if "N" in letters else []]
        is_meshlab = "C" in letters and "N" in letters and letters.index("N") < letters.index("C")
        parts += behind if is_meshlab else behind[::-1]
        parts += [[1, 0]] if "ST" in letters else []
        rows.append(" ".join(str(number) for part in parts for number in part))
    text = "\n".join(["".join(letters) + "OFF", "3 1 0", *rows, "3 0 1 2"])
    mesh, notes = read_with_notes(tmp_path, text)
    assert mesh.positions[mesh.faces].tolist() == [[[0, 0, 0], [1, 0, 0], [0, 1, 0]]]
    assert mesh.rgba[mesh.faces].tolist() == [COLORS if "C" in letters else [[*DEFAULT_COLOR, 255]] * 3]
    assert ("N" in letters) == (mesh.normals is not None)
    if mesh.normals is not None:
        assert mesh.normals[mesh.faces].tolist() == [NORMALS]
    note = "its texture coordinates are left out, for an OFF file names no texture"
    assert notes == ([note] if "ST" in letters else [])


def test_three_dimensions_may_be_told(tmp_path: Path) -> None:
    plain = read(tmp_path, "OFF\n4 1 0\n" + SQUARE + "4 0 1 2 3\n")
    assert read(tmp_path, "nOFF 3\n4 1 0\n" + SQUARE + "4 0 1 2 3\n") == plain
    assert read(tmp_path, "nOFF\n3 4 1 0\n" + SQUARE + "4 0 1 2 3\n") == plain


@pytest.mark.parametrize(("color", "expected"), [("255 0 0 102", 102), ("1.0 0 0 0.4", 102), ("255 0 0 0", 255)])
def test_alpha_of_faces(tmp_path: Path, color: str, expected: int) -> None:
    """Zeros are those of writers that know no transparency."""
    mesh = read(tmp_path, "OFF\n4 1 0\n" + SQUARE + f"3 0 1 2 {color}\n")
    assert mesh.rgba.tolist() == [[255, 0, 0, expected]] * 3


def test_an_alpha_that_only_some_faces_have(tmp_path: Path) -> None:
    mesh = read(tmp_path, "OFF\n4 2 0\n" + SQUARE + "3 0 1 2 255 0 9 51\n3 0 2 3 0 9 0\n")
    assert mesh.rgba[mesh.faces].tolist() == [[[255, 0, 9, 51]] * 3, [[0, 9, 0, 255]] * 3]


def test_normals_that_are_no_numbers_are_computed(tmp_path: Path) -> None:
    mesh, notes = read_with_notes(tmp_path, "NOFF\n3 1 0\n0 0 0 0 1 0\n1 0 0 -1.#IND 0 0\n0 1 0 0 1 0\n3 0 1 2\n")
    assert np.asarray(mesh.normals)[mesh.faces].tolist() == [[[0, 1, 0], [0, 0, 1], [0, 1, 0]]]
    assert notes == ["normals that are not finite numbers are computed: 1"]


def test_lines_behind_the_faces_are_told(tmp_path: Path) -> None:
    text = "OFF\n4 1 2\n" + SQUARE + "3 0 1 2\n0 1\n1 2\n"
    assert read_with_notes(tmp_path, text)[1] == ["the lines behind its faces are left out: 2"]


# ---- binary ----


def binary(letters: str = "", more: bytes = b"") -> bytes:
    """A square of a triangle with a colour and one without."""
    content = f"{letters}OFF BINARY\n".encode() + (struct.pack(">i", 3) if "n" in letters else b"")
    content += struct.pack(">3i", 4, 2, 0)
    for point in ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)):
        content += struct.pack(">3f", *point)
        if "N" in letters:
            content += struct.pack(">3f", 0, 1, 0)
        if "C" in letters:
            content += struct.pack(">4f", 0, 1, 0, 0.4)
    return content + struct.pack(">i3ii3f", 3, 0, 1, 2, 3, 1, 0, 0) + struct.pack(">i3ii", 3, 0, 2, 3, 0) + more


@pytest.mark.parametrize("letters", ["", "C", "CN", "n"])
def test_binary(tmp_path: Path, letters: str) -> None:
    mesh = read(tmp_path, binary(letters))
    assert mesh.positions[mesh.faces].tolist() == [[[0, 0, 0], [1, 0, 0], [1, 1, 0]], [[0, 0, 0], [1, 1, 0], [0, 1, 0]]]
    other = [0, 255, 0, 102] if "C" in letters else [*DEFAULT_COLOR, 255]
    assert mesh.rgba[mesh.faces].tolist() == [[[255, 0, 0, 255]] * 3, [other] * 3]
    if "N" in letters:
        assert np.asarray(mesh.normals)[0].tolist() == [0, 1, 0]


def test_binary_that_ends_early(tmp_path: Path) -> None:
    """Wherever that is."""
    whole = binary()
    start = whole.index(b"\n") + 1
    assert read(tmp_path, whole).triangles == 2
    for end in range(start, len(whole)):
        counts = end < start + 12
        message = "counts of vertices and faces are missing" if counts else "ends before its 4 vertices and 2 faces are"
        with pytest.raises(InputError, match=message):
            read(tmp_path, whole[:end])


def test_bytes_behind_binary_faces_are_told(tmp_path: Path) -> None:
    assert read_with_notes(tmp_path, binary("", bytes(8)))[1] == ["what is behind its faces is left out: 8 bytes"]


def test_wrong_counts_in_binary(tmp_path: Path) -> None:
    head = b"OFF BINARY\n"
    for counts in ((-1, 1, 0), (2**31 - 1, 1, 0), (1, 2**31 - 1, 0)):
        with pytest.raises(InputError, match=rf"ends before its {counts[0]} vertices and {counts[1]} faces"):
            read(tmp_path, head + struct.pack(">3i3f", *counts, 0, 0, 0))
    with pytest.raises(InputError, match="its vertices have 4 dimensions; those of a mesh have 3"):
        read(tmp_path, b"n" + head + struct.pack(">4i", 4, 0, 0, 0))
