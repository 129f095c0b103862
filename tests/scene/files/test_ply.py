import struct
from pathlib import Path

import numpy as np
import pytest

from shackled.errors import InputError, InputWarning
from shackled.scene import DEFAULT_COLOR, Mesh, read_mesh

SQUARE = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0))


def header(encoding: str, vertex: str, faces: int, face: str = "") -> str:
    properties = "property float x\nproperty float y\nproperty float z\n" + vertex
    return (
        f"ply\nformat {encoding} 1.0\ncomment made by hand\nelement vertex 4\n{properties}"
        f"element face {faces}\nproperty list uchar int vertex_indices\n{face}end_header\n"
    )


def read(folder: Path, content: str | bytes) -> Mesh:
    path = folder / "model.ply"
    path.write_bytes(content.encode() if isinstance(content, str) else content)
    return read_mesh(path)


def corner_colors(mesh: Mesh) -> list[list[list[int]]]:
    colors: list[list[list[int]]] = mesh.colors[mesh.faces].tolist()
    return colors


VERTICES = "".join(f"{x} {y} {z}\n" for x, y, z in SQUARE)
HEADER_LINES = "known are format, element and its count, then property and its type, and comment, obj_info, end_header"
COLOR = "property uchar red\nproperty uchar green\nproperty uchar blue\n"


def test_text(tmp_path: Path) -> None:
    mesh = read(tmp_path, header("ascii", "", 2) + VERTICES + "3 0 1 2\n3 0 2 3\n")
    assert mesh.positions[mesh.faces].tolist() == [
        [list(SQUARE[0]), list(SQUARE[1]), list(SQUARE[2])],
        [list(SQUARE[0]), list(SQUARE[2]), list(SQUARE[3])],
    ]
    assert corner_colors(mesh) == [[list(DEFAULT_COLOR)] * 3] * 2


def test_windows_line_ends(tmp_path: Path) -> None:
    text = (header("ascii", "", 1) + VERTICES + "4 0 1 2 3\n").replace("\n", "\r\n")
    assert len(np.asarray(read(tmp_path, text).faces)) == 2


@pytest.mark.parametrize("encoding", ["ascii", "binary_little_endian"])
def test_line_ends_of_an_old_mac(tmp_path: Path, encoding: str) -> None:
    content = header(encoding, "", 1).replace("\n", "\r").encode()
    if encoding == "ascii":
        content += (VERTICES + "4 0 1 2 3\n").replace("\n", "\r").encode()
    else:
        content += b"".join(struct.pack("<fff", *point) for point in SQUARE) + struct.pack("<Biiii", 4, 0, 1, 2, 3)
    assert len(np.asarray(read(tmp_path, content).faces)) == 2


def test_polygons_of_several_sizes_as_text(tmp_path: Path) -> None:
    mesh = read(tmp_path, header("ascii", "", 2) + VERTICES + "\n3 0 1 2\n4 0 1 2 3\n")
    assert mesh.triangles == 3


def test_a_concave_polygon_is_filled_as_it_is(tmp_path: Path) -> None:
    """An arrow head, from a corner that does not see all of it."""
    vertices = "0 2 0\n-1 0 0\n0 1 0\n1 0 0\n"
    mesh = read(tmp_path, header("ascii", "", 1) + vertices + "4 1 2 3 0\n")
    a, b, c = np.moveaxis(mesh.positions[mesh.faces], 1, 0)
    assert sorted((np.cross(b - a, c - a)[:, 2] / 2).tolist()) == [0.5, 0.5]


def test_colors_of_vertices_come_first_if_all_faces_have_the_same(tmp_path: Path) -> None:
    rows = "".join(f"{x} {y} {z} 1 2 3\n" for x, y, z in SQUARE)
    faces = ["3 0 1 2 255 255 255\n", "3 0 2 3 255 255 255\n"]
    text = header("ascii", COLOR, 2, COLOR) + rows
    assert corner_colors(read(tmp_path, text + "".join(faces))) == [[[1, 2, 3]] * 3] * 2
    faces[1] = faces[1].replace("255", "9")
    assert corner_colors(read(tmp_path, text + "".join(faces))) == [[[255, 255, 255]] * 3, [[9, 9, 9]] * 3]


def test_a_texture_is_told(tmp_path: Path) -> None:
    text = header("ascii", "", 1).replace("made by hand", "TextureFile my wood.png") + VERTICES + "3 0 1 2\n"
    with pytest.warns(InputWarning) as told:
        read(tmp_path, text)
    assert [str(warning.message) for warning in told] == [
        f"{tmp_path / 'model.ply'}: its texture my wood.png is left out; of PLY files only colours are read"
    ]


@pytest.mark.parametrize(("encoding", "order"), [("binary_little_endian", "<"), ("binary_big_endian", ">")])
def test_binary_with_triangles_and_quads(tmp_path: Path, encoding: str, order: str) -> None:
    content = header(encoding, COLOR, 2).encode()
    for number, (x, y, z) in enumerate(SQUARE):
        content += struct.pack(order + "fffBBB", x, y, z, number, 100, 255)
    content += struct.pack(order + "Biii", 3, 0, 1, 2) + struct.pack(order + "Biiii", 4, 0, 1, 2, 3)
    mesh = read(tmp_path, content)
    assert corner_colors(mesh) == [[[a, 100, 255] for a in face] for face in ((0, 1, 2), (0, 1, 2), (0, 2, 3))]


def test_face_colors(tmp_path: Path) -> None:
    mesh = read(tmp_path, header("ascii", "", 2, COLOR) + VERTICES + "3 0 1 2 255 0 0\n3 0 2 3 0 0 9\n")
    assert corner_colors(mesh) == [[[255, 0, 0]] * 3, [[0, 0, 9]] * 3]


def test_vertex_colors_beside_texture_coordinates(tmp_path: Path) -> None:
    more = COLOR + "property float s\nproperty float t\n"
    rows = "".join(f"{x} {y} {z} 1 2 3 0.5 0.5\n" for x, y, z in SQUARE)
    assert corner_colors(read(tmp_path, header("ascii", more, 1) + rows + "3 0 1 2\n")) == [[[1, 2, 3]] * 3]


def test_colors_as_fractions(tmp_path: Path) -> None:
    more = COLOR.replace("uchar", "float")
    rows = "".join(f"{x} {y} {z} 1 0.5 0\n" for x, y, z in SQUARE)
    assert corner_colors(read(tmp_path, header("ascii", more, 1) + rows + "3 0 1 2\n")) == [[[255, 128, 0]] * 3]


def test_a_nearly_black_color_in_bytes_stays_so(tmp_path: Path) -> None:
    rows = "".join(f"{x} {y} {z} 1 0 1\n" for x, y, z in SQUARE)
    assert corner_colors(read(tmp_path, header("ascii", COLOR, 1) + rows + "3 0 1 2\n")) == [[[1, 0, 1]] * 3]


def test_normals_are_kept(tmp_path: Path) -> None:
    more = "property float nx\nproperty float ny\nproperty float nz\n"
    rows = "".join(f"{x} {y} {z} 0 1 0\n" for x, y, z in SQUARE)
    mesh = read(tmp_path, header("ascii", more, 1) + rows + "3 0 1 2\n")
    assert np.asarray(mesh.normals).tolist() == [[0, 1, 0]] * 3


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("plx\n", "a PLY file begins with the line ply"),
        ("ply\nformat ascii 1.0\n", "its header has no line end_header"),
        ("ply\nend_header\n", "its header has no line format"),
        ("ply\nformat ascii 1.0\nelement vertex many\nend_header\n",
         "line 3 of its header is 'element vertex many'; {HEADER_LINES}"),
        ("ply\nformat ascii 1.0\nproperty float x\nend_header\n",
         "line 3 of its header is 'property float x'; {HEADER_LINES}"),
        (header("ascii", "", 1).replace("comment made", "made"),
         "line 3 of its header is 'made by hand'; {HEADER_LINES}"),
        (header("ascii", "", 1) + VERTICES + "3 0 1 2 1 0 0\n",
         "line 15 should hold an element face (a list vertex_indices after its length) and nothing else, "
         "not '3 0 1 2 1 0 0'"),
        (header("ascii", "", 2) + VERTICES + "3 0 1\n2 3 0 2 3\n",
         "line 15 should hold an element face (a list vertex_indices after its length) and nothing else, not '3 0 1'"),
        (header("ascii", "", 1) + VERTICES + "3 0 1 2\n\n3 0 2 3\n",
         "line 17 is left over behind the elements of its header: '3 0 2 3'"),
        (header("ascii", "", 1) + VERTICES + "3 0 1.5 2\n", "the numbers of vertices must be whole, not 1.5"),
        (header("ascii", COLOR.replace("uchar", "float"), 1)
         + VERTICES.replace("\n", " 0 nan 1\n") + "3 0 1 2\n",
         "colour 0 must be three finite numbers, not [0.0, nan, 1.0]"),
        ("ply\nformat ascii 1.0\nelement vertex 0\nend_header\n",
         "a mesh needs the elements vertex and face; this file has vertex"),
        (header("ascii", "", 1) + "0 0 0\n1 0 0\n", "it ends before its 4 elements vertex are complete"),
        (header("ascii", "", 2) + VERTICES + "3 0 1 2\n", "it ends before its 2 elements face are complete"),
        (header("binary_little_endian", "", 1) + "short", "it ends before its 4 elements vertex are complete"),
        (header("ascii", "", 1) + VERTICES.replace("1 1", "1 x") + "3 0 1 2\n",
         "line 13 should hold an element vertex (x, y, z) and nothing else, not '1 x 0'"),
        (header("ascii", "", 1) + VERTICES.replace("1 1", "1 nan") + "3 0 1 2\n",
         "vertex 2 has a coordinate that is not a finite number: [1.0, nan, 0.0]"),
        (header("ascii", "", 1) + VERTICES + "3 0 1 4\n",
         "face 0 names the vertices [0, 1, 4], but they are numbered 0 to 3"),
        (header("ascii", "", 0) + VERTICES, "a mesh needs vertices and faces; this one has 4 and 0"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_told_in_one_line(tmp_path: Path, content: str, message: str) -> None:
    with pytest.raises(InputError) as error:
        read(tmp_path, content)
    told = message.replace("{HEADER_LINES}", HEADER_LINES)
    assert str(error.value) == f"{tmp_path / 'model.ply'}: {told}"


def test_a_count_without_bounds_ends_at_once(tmp_path: Path) -> None:
    content = header("binary_little_endian", "", 1).replace("vertex 4", "vertex 4000000000").encode() + bytes(200)
    with pytest.raises(InputError, match=r"it ends before its 4000000000 elements vertex are complete$"):
        read(tmp_path, content)
