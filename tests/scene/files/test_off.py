import itertools
from pathlib import Path

import pytest

import mesh_files
from mesh_files import corner_colors
from shackled.scene._mesh import DEFAULT_COLOR, Mesh

SQUARE = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
BEGINS = "an OFF file begins with OFF, or with letters before it, as in COFF, NOFF, NCOFF or STOFF"


def read(folder: Path, content: str) -> Mesh:
    return mesh_files.read(folder / "model.off", content)


@pytest.mark.parametrize("head", ["OFF\n# a square\n\n4 1 0\n", "OFF 4 1 0\n", "OFF4 1 0 # a square\n"])
def test_counts_may_stand_beside_the_header(tmp_path: Path, head: str) -> None:
    assert read(tmp_path, head + SQUARE + "4 0 1 2 3\n").faces.tolist() == [[0, 1, 2], [0, 2, 3]]


@pytest.mark.parametrize(
    ("faces", "expected"),
    [
        (["255 0 10", "0 0 200 255", ""], [[255, 0, 10, 255], [0, 0, 200, 255], [*DEFAULT_COLOR, 255]]),
        (["1.0 0.5 0", "0 0 0.2 1"], [[255, 128, 0, 255], [0, 0, 51, 255]]),
        (["255 0 9 51", "0 9 0"], [[255, 0, 9, 51], [0, 9, 0, 255]]),
        # zeros are those of writers that know no transparency
        (["255 0 0 0"], [[255, 0, 0, 255]]),
    ],
)
def test_colors_of_faces(tmp_path: Path, faces: list[str], expected: list[list[int]]) -> None:
    rows = "".join(f"3 0 1 {2 + number % 2} {color}\n" for number, color in enumerate(faces))
    mesh = read(tmp_path, f"OFF\n4 {len(faces)} 0\n{SQUARE}{rows}")
    assert mesh.rgba[mesh.faces].tolist() == [[color] * 3 for color in expected]


def test_colors_of_vertices_need_no_letter(tmp_path: Path) -> None:
    mesh = read(tmp_path, "OFF\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 0 255 0 255\n0 1 0 0 0 9 255\n3 0 1 2\n")
    assert corner_colors(mesh) == [[[255, 0, 0], [0, 255, 0], [0, 0, 9]]]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("OBJ\n3 1 0\n", BEGINS),
        ("4OFF\n3 1 0\n", BEGINS),
        ("OFF\n", "line 1 should hold the counts of vertices and faces, not ''"),
        ("OFF\nfour 1\n", "line 2 should hold the counts of vertices and faces, not 'four 1'"),
        ("OFF\n4 -1 0\n" + SQUARE, "line 2 should hold the counts of vertices and faces, not '4 -1 0'"),
        ("OFF\n4 2 0\n" + SQUARE + "3 0 1 2\n", "line 2 promises 6 vertices and faces, but 5 lines follow"),
        ("OFF BINARY\n\0\0\0\4", " is not a text file, as a .off file should be"),
        ("OFF\n4 1 0\n" + SQUARE.replace("1 1 0", "1 x 0") + "3 0 1 2\n",
         "line 5 should hold the 3 numbers of a vertex, not '1 x 0'"),
        ("NOFF\n4 1 0\n" + SQUARE, "line 2 promises 5 vertices and faces, but 4 lines follow"),
        ("OFF\n4 1 0\n" + SQUARE + "3 0 1\n", "line 7 should hold the vertices of a face, not '3 0 1'"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_told_in_one_line(tmp_path: Path, text: str, message: str) -> None:
    assert mesh_files.refusal(tmp_path / "model.off", text) == message


COLORS = [[255, 0, 0, 102], [0, 255, 0, 255], [0, 0, 255, 51]]
NORMALS = [[0, 0, 1], [0, 1, 0], [1, 0, 0]]


@pytest.mark.parametrize("letters", [p for n in range(4) for p in itertools.permutations(("C", "N", "ST"), n)])
def test_letters_in_any_order(tmp_path: Path, letters: tuple[str, ...]) -> None:
    """What stands for them in a row is in the order of Geomview, but for MeshLab's colours before normals in NC."""
    rows = []
    for point, color, normal in zip(((0, 0, 0), (1, 0, 0), (0, 1, 0)), COLORS, NORMALS, strict=True):
        behind = [color if "C" in letters else [], normal if "N" in letters else []]
        is_meshlab = "C" in letters and "N" in letters and letters.index("N") < letters.index("C")
        parts = [point, *(behind if is_meshlab else behind[::-1]), [1, 0] if "ST" in letters else []]
        rows.append(" ".join(str(number) for part in parts for number in part))
    text = "\n".join(["".join(letters) + "OFF", "3 1 0", *rows, "3 0 1 2"])
    mesh, notes = mesh_files.read_with_notes(tmp_path / "model.off", text)
    assert mesh.positions[mesh.faces].tolist() == [[[0, 0, 0], [1, 0, 0], [0, 1, 0]]]
    assert mesh.rgba[mesh.faces].tolist() == [COLORS if "C" in letters else [[*DEFAULT_COLOR, 255]] * 3]
    assert ("N" in letters) == (mesh.normals is not None)
    if mesh.normals is not None:
        assert mesh.normals[mesh.faces].tolist() == [NORMALS]
    note = "its texture coordinates are left out, for an OFF file names no texture"
    assert notes == ([note] if "ST" in letters else [])


def test_normals_that_are_no_numbers_are_computed(tmp_path: Path) -> None:
    text = "NOFF\n3 1 0\n0 0 0 0 1 0\n1 0 0 -1.#IND 0 0\n0 1 0 0 1 0\n3 0 1 2\n"
    _, notes = mesh_files.read_with_notes(tmp_path / "model.off", text)
    assert notes == ["normals that are not finite numbers are computed: 1"]
