import struct
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import mesh_files
from mesh_files import corner_colors
from shackled.errors import InputError, InputWarning
from shackled.scene import Mesh, read_model
from shackled.scene._mesh import DEFAULT_COLOR

SQUARE = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0))


def header(encoding: str, vertex: str, faces: int, face: str = "") -> str:
    properties = "property float x\nproperty float y\nproperty float z\n" + vertex
    return (
        f"ply\nformat {encoding} 1.0\ncomment made by hand\nelement vertex 4\n{properties}"
        f"element face {faces}\nproperty list uchar int vertex_indices\n{face}end_header\n"
    )


def rows(more: str) -> str:
    """The lines of the vertices, each with the same numbers after its coordinates."""
    return "".join(f"{x} {y} {z} {more}\n" for x, y, z in SQUARE)


def read(folder: Path, content: str | bytes) -> Mesh:
    return mesh_files.read(folder / "model.ply", content)


def read_with_notes(folder: Path, content: str | bytes) -> tuple[Mesh, list[str]]:
    return mesh_files.read_with_notes(folder / "model.ply", content)


#: The note of a file whose faces and vertices have colours.
OF_FACES = "the colours of its vertices are left out, for its faces have colours"


VERTICES = "".join(f"{x} {y} {z}\n" for x, y, z in SQUARE)
HEADER_LINES = "known are format, element and its count, then property and its type, and comment, obj_info, end_header"
NEEDS = (
    "a mesh needs an element vertex with x, y and z, and an element face with a list vertex_indices; this file has the "
    "elements"
)
#: The left half red, the right one blue.
HALVES = Image.fromarray(np.repeat([[[255, 0, 0]] * 4 + [[0, 0, 255]] * 4], 8, axis=0).astype(np.uint8))
COLOR = "property uchar red\nproperty uchar green\nproperty uchar blue\n"
COLOR_IN_SHORT = "property uchar r\nproperty uchar g\nproperty uchar b\n"
NORMAL = "property float nx\nproperty float ny\nproperty float nz\n"
TRIANGLE = "3 0 1 2\n"


def test_text(tmp_path: Path) -> None:
    mesh = read(tmp_path, header("ascii", "", 2) + VERTICES + "3 0 1 2\n3 0 2 3\n")
    assert mesh.positions[mesh.faces].tolist() == [
        [list(SQUARE[0]), list(SQUARE[1]), list(SQUARE[2])],
        [list(SQUARE[0]), list(SQUARE[2]), list(SQUARE[3])],
    ]
    assert corner_colors(mesh) == [[list(DEFAULT_COLOR)] * 3] * 2


# the last as in a file of the package compas
@pytest.mark.parametrize("end", ["\n", "\r\n", "\r", "\r\r\n"])
@pytest.mark.parametrize("word", ["ply", "PLY"])
def test_line_ends(tmp_path: Path, end: str, word: str) -> None:
    text = header("ascii", "", 1).replace("ply", word, 1) + VERTICES + "4 0 1 2 3\n"
    assert read(tmp_path, text.replace("\n", end)).triangles == 2


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_line_ends_before_binary_data(tmp_path: Path, end: str) -> None:
    content = header("binary_little_endian", "", 1).replace("\n", end).encode()
    content += np.array(SQUARE, "<f4").tobytes() + struct.pack("<Biiii", 4, 0, 1, 2, 3)
    assert read(tmp_path, content).triangles == 2


def test_letters_that_are_not_of_ascii(tmp_path: Path) -> None:
    text = (header("ascii", "", 1).replace("by hand", "by händ") + VERTICES + "3 0 1 2\n").encode("latin-1")
    assert read(tmp_path, text).triangles == 1
    with pytest.raises(InputError, match=r"line 15 should hold an element face .*, not '3 0 1 é'"):
        read(tmp_path, text.replace(b"3 0 1 2\n", b"3 0 1 \xe9\n"))


def test_polygons_of_several_sizes_as_text(tmp_path: Path) -> None:
    mesh = read(tmp_path, header("ascii", "", 2) + VERTICES + "\n3 0 1 2\n4 0 1 2 3\n")
    assert mesh.triangles == 3


def test_a_concave_polygon_is_filled_as_it_is(tmp_path: Path) -> None:
    """An arrow head, from a corner that does not see all of it."""
    vertices = "0 2 0\n-1 0 0\n0 1 0\n1 0 0\n"
    mesh = read(tmp_path, header("ascii", "", 1) + vertices + "4 1 2 3 0\n")
    a, b, c = np.moveaxis(mesh.positions[mesh.faces], 1, 0)
    assert sorted((np.cross(b - a, c - a)[:, 2] / 2).tolist()) == [0.5, 0.5]


def test_a_texture_that_cannot_be_shown_is_told(tmp_path: Path) -> None:
    text = header("ascii", "", 1).replace("made by hand", "TextureFile my wood.png") + VERTICES + "3 0 1 2\n"
    missing = f"a texture is left out: {tmp_path / 'my wood.png'} does not exist"
    assert read_with_notes(tmp_path, text)[1] == [missing]
    HALVES.save(tmp_path / "my wood.png")
    assert read_with_notes(tmp_path, text)[1] == ["its texture is left out, for it has no texture coordinates"]


@pytest.mark.parametrize(("encoding", "order"), [("binary_little_endian", "<"), ("binary_big_endian", ">")])
def test_binary_with_triangles_and_quads(tmp_path: Path, encoding: str, order: str) -> None:
    content = header(encoding, COLOR, 2).encode()
    for number, (x, y, z) in enumerate(SQUARE):
        content += struct.pack(order + "fffBBB", x, y, z, number, 100, 255)
    content += struct.pack(order + "Biii", 3, 0, 1, 2) + struct.pack(order + "Biiii", 4, 0, 1, 2, 3)
    mesh = read(tmp_path, content)
    assert corner_colors(mesh) == [[[a, 100, 255] for a in face] for face in ((0, 1, 2), (0, 1, 2), (0, 2, 3))]


@pytest.mark.parametrize(
    ("vertex", "row", "face", "faces", "expected"),
    [
        ("", "", COLOR, ["255 0 0", "0 0 9"], [(255, 0, 0), (0, 0, 9)]),
        (COLOR.replace("uchar", "float"), "1 0.5 0", "", [""], [(255, 128, 0)]),
        # nearly black
        (COLOR, "1 0 1", "", [""], [(1, 0, 1)]),
        # a single face has no colour of its own beside those of its vertices, but others do, where one channel differs
        (COLOR, "9 9 9", COLOR, ["7 7 7"], [(9, 9, 9)]),
        (COLOR, "9 9 9", COLOR, ["1 2 3", "1 2 3", "1 2 4"], [(1, 2, 3), (1, 2, 3), (1, 2, 4)]),
        (COLOR, "9 9 9", COLOR, ["1 2 4", "1 2 3", "1 2 3"], [(1, 2, 4), (1, 2, 3), (1, 2, 3)]),
        (COLOR, "1 2 3", COLOR, ["255 255 255"] * 2, [(1, 2, 3)] * 2),
        # the first name of a colour counts
        (COLOR_IN_SHORT + COLOR, "1 2 3 4 5 6", "", [""], [(4, 5, 6)]),
        (COLOR + "property float s\nproperty float t\n", "1 2 3 0.5 0.5", "", [""], [(1, 2, 3)]),
    ],
)
def test_colors(
    tmp_path: Path, vertex: str, row: str, face: str, faces: list[str], expected: list[tuple[int, ...]]
) -> None:
    text = header("ascii", vertex, len(faces), face) + rows(row)
    text += "".join(f"3 0 1 {2 + (k > 1)} {each}\n" for k, each in enumerate(faces))
    mesh, notes = read_with_notes(tmp_path, text)
    assert corner_colors(mesh) == [[list(each)] * 3 for each in expected]
    left = [name for name in "rgbst" if f" {name}\n" in vertex]
    lost = [f"of its elements are left out: {', '.join(f'{name} of vertex' for name in left)}"] if left else []
    assert notes == [*lost, *([OF_FACES] if vertex and len(set(faces)) > 1 else [])]


def test_normals_are_kept(tmp_path: Path) -> None:
    mesh = read(tmp_path, header("ascii", NORMAL, 1) + rows("0 1 0") + TRIANGLE)
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
        (header("ascii", "", 1) + VERTICES + "3 0 1 2\n7\n",
         "line 16 is left over behind the elements of its header: '7'"),
        (header("ascii", "", 1) + VERTICES + "3 0 1 2\n\n3 0 2 3\n",
         "line 17 is left over behind the elements of its header: '3 0 2 3'"),
        (header("ascii", "", 1) + VERTICES + "3 0 1.5 2\n", "the numbers of vertices must be whole, not 1.5"),
        (header("ascii", COLOR.replace("uchar", "float"), 1)
         + VERTICES.replace("\n", " 0 nan 1\n") + "3 0 1 2\n",
         "colour 0 must be finite numbers, not [0.0, nan, 1.0]"),
        ("ply\nformat ascii 1.0\nelement vertex 0\nend_header\n",
         "{NEEDS} vertex"),
        (header("ascii", "", 1) + "0 0 0\n1 0 0\n", "it ends before its 4 elements vertex are complete"),
        (header("ascii", "", 2) + VERTICES + "3 0 1 2\n", "it ends before its 2 elements face are complete"),
        (header("binary_little_endian", "", 1) + "short", "it ends before its 4 elements vertex are complete"),
        (header("ascii", "", 1) + VERTICES.replace("1 1", "1 x") + "3 0 1 2\n",
         "line 13 should hold an element vertex (x, y, z) and nothing else, not '1 x 0'"),
        (header("ascii", "", 1) + VERTICES.replace("1 1", "1 nan") + "3 0 1 2\n",
         "vertex 2 has a coordinate that is not a finite number: [1.0, nan, 0.0]"),
        (header("ascii", "", 1) + VERTICES + "3 0 1 4\n",
         "face 0 names the vertices [0, 1, 4], but they are numbered 0 to 3"),
        (header("ascii", "", 0) + VERTICES,
         "it has 4 points and no faces, so there is no surface to draw; a program such as MeshLab makes one of points"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_told_in_one_line(tmp_path: Path, content: str, message: str) -> None:
    with pytest.raises(InputError) as error:
        read(tmp_path, content)
    told = message.replace("{HEADER_LINES}", HEADER_LINES).replace("{NEEDS}", NEEDS)
    assert str(error.value) == f"{tmp_path / 'model.ply'}: {told}"


def test_a_count_without_bounds_ends_at_once(tmp_path: Path) -> None:
    content = header("binary_little_endian", "", 1).replace("vertex 4", "vertex 4000000000").encode() + bytes(200)
    with pytest.raises(InputError, match=r"it ends before its 4000000000 elements vertex are complete$"):
        read(tmp_path, content)


# ---- types and names ----

TYPES = {
    "i1": ("char", "int8"), "u1": ("uchar", "uint8"), "i2": ("short", "int16"), "u2": ("ushort", "uint16"),
    "i4": ("int", "int32"), "u4": ("uint", "uint32"), "f4": ("float", "float32"), "f8": ("double", "float64"),
}  # fmt: skip
NAMES = [(name, kind) for kind, names in TYPES.items() for name in names]


@pytest.mark.parametrize(("encoding", "order"), [("binary_little_endian", "<"), ("binary_big_endian", ">")])
@pytest.mark.parametrize(("name", "kind"), NAMES)
def test_types_of_numbers(tmp_path: Path, name: str, kind: str, encoding: str, order: str) -> None:
    numbers = np.finfo(kind) if kind[0] == "f" else np.iinfo(kind)
    low, high = (-1.5, 1.7e38 if kind == "f4" else 1e300) if kind[0] == "f" else (numbers.min, numbers.max)
    points = np.array([[low, 0, 1], [high, 2, 3], [4, high, 5]]).astype(order + kind)
    text = f"ply\nformat {encoding} 1.0\nelement vertex 3\n"
    text += "".join(f"property {name} {axis}\n" for axis in "xyz")
    text += "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
    mesh = read(tmp_path, text.encode() + points.tobytes() + struct.pack(order + "Biii", 3, 0, 1, 2))
    assert mesh.positions[mesh.faces[0]].tolist() == points.astype(np.float64).tolist()


@pytest.mark.parametrize(("name", "kind"), NAMES)
def test_types_of_lists(tmp_path: Path, name: str, kind: str) -> None:
    """Of the numbers in them, and of their lengths: also where these differ, so that rows are read one by one."""
    for faces in ([[0, 1, 2], [0, 2, 3]], [[0, 1, 2], [0, 1, 2, 3]]):
        content = header("binary_little_endian", "", 2).replace("uchar int", f"{name} {name}").encode()
        content += np.array(SQUARE, "<f4").tobytes()
        content += b"".join(np.array([len(face), *face], "<" + kind).tobytes() for face in faces)
        assert read(tmp_path, content).triangles == sum(len(face) - 2 for face in faces)


@pytest.mark.parametrize(
    ("name", "values", "expected"),
    [
        ("uchar", [1, 200, 255], [1, 200, 255]),
        ("char", [0, 1, 127], [0, 1, 127]),
        ("ushort", [257, 65406, 65407], [1, 254, 255]),
        ("short", [1, 200, 255], [1, 200, 255]),
        ("int", [1, 200, 255], [1, 200, 255]),
        ("uint", [1, 200, 255], [1, 200, 255]),
        # whole numbers are none of fractions, though none is above 1
        *[(name, [0, 1, 1], [0, 1, 1]) for name in ("uchar", "char", "short", "int", "uint")],
        ("ushort", [0, 1, 1], [0, 0, 0]),
        ("float", [0, 0.5, 1], [0, 128, 255]),
        ("double", [0.25, 0.5, 1], [64, 128, 255]),
    ],
)
def test_colors_by_their_type(tmp_path: Path, name: str, values: list[float], expected: list[int]) -> None:
    text = header("ascii", COLOR.replace("uchar", name), 1) + rows(" ".join(map(str, values))) + TRIANGLE
    assert corner_colors(read(tmp_path, text)) == [[expected] * 3]


@pytest.mark.parametrize(
    "names", [("red", "green", "blue"), ("diffuse_red", "diffuse_green", "diffuse_blue"), ("r", "g", "b")]
)
def test_names_of_colors(tmp_path: Path, names: tuple[str, str, str]) -> None:
    more = "".join(f"property uchar {name}\n" for name in names)
    assert corner_colors(read(tmp_path, header("ascii", more, 1) + rows("10 20 30") + TRIANGLE)) == [[[10, 20, 30]] * 3]
    # a colour that is not whole is none
    text = header("ascii", more.replace(names[2], "other"), 1) + rows("10 20 30") + TRIANGLE
    mesh, notes = read_with_notes(tmp_path, text)
    assert corner_colors(mesh) == [[list(DEFAULT_COLOR)] * 3]
    assert notes == [f"of its elements are left out: {names[0]} of vertex, {names[1]} of vertex, other of vertex"]


@pytest.mark.parametrize(("red", "other", "expected"), [("float", "uchar", 255), ("uchar", "float", 1)])
def test_the_type_of_red_tells(tmp_path: Path, red: str, other: str, expected: int) -> None:
    more = COLOR.replace("uchar", other).replace(f"{other} red", f"{red} red")
    assert corner_colors(read(tmp_path, header("ascii", more, 1) + rows("1 1 1") + TRIANGLE)) == [[[expected] * 3] * 3]


def test_both_names_of_the_list_of_a_face(tmp_path: Path) -> None:
    text = header("ascii", "", 1) + VERTICES + "3 0 1 2\n"
    whole = read(tmp_path, text)
    assert read(tmp_path, text.replace("vertex_indices", "vertex_index")) == whole
    # beside other lists, and the first name counts
    other = "property list uchar int vertex_index\nproperty list uchar float weights\n"
    text = header("ascii", "", 1, other) + VERTICES + "3 0 1 2 4 0 1 2 3 1 0.5\n"
    left = "of its elements are left out: "
    assert read_with_notes(tmp_path, text) == (whole, [left + "vertex_index of face, weights of face"])
    text = header("ascii", "", 1).replace("element face 1\n", "element face 1\nproperty list uchar float weights\n")
    text += VERTICES + "2 0.5 0.25 3 0 1 2\n"
    assert read_with_notes(tmp_path, text) == (whole, [left + "weights of face"])


@pytest.mark.parametrize(
    ("old", "new", "face"),
    [
        ("property float z", "property float w", "3 0 1 2"),
        ("property float x", "property list uchar float x", "3 0 1 2"),
        ("vertex_indices", "corners", "3 0 1 2"),
        ("list uchar int vertex_indices", "int vertex_indices", "0"),
    ],
)
def test_what_a_mesh_needs(tmp_path: Path, old: str, new: str, face: str) -> None:
    lines = VERTICES if "list uchar float" not in new else "".join(f"1 {x} {y} {z}\n" for x, y, z in SQUARE)
    with pytest.raises(InputError, match=f"{NEEDS} vertex, face$"):
        read(tmp_path, header("ascii", "", 1).replace(old, new) + lines + face + "\n")


def test_other_elements_are_passed_over(tmp_path: Path) -> None:
    """Wherever they are, with numbers and lists, as text and binary; the message names what is there."""
    edges = "element edge 2\nproperty int a\nproperty list uchar short more\n"
    for encoding in ("ascii", "binary_little_endian"):
        head = header(encoding, "", 1)
        head = head.replace("element vertex", edges + "element vertex").replace(
            "end_header", "element empty 3\nend_header"
        )
        if encoding == "ascii":
            content = (head + "7 1 5\n8 2 5 6\n" + VERTICES + "3 0 1 2\n").encode()
        else:
            content = head.encode() + struct.pack("<iBhiBhh", 7, 1, 5, 8, 2, 5, 6) + np.array(SQUARE, "<f4").tobytes()
            content += struct.pack("<Biii", 3, 0, 1, 2)
        mesh, notes = read_with_notes(tmp_path, content)
        assert mesh.triangles == 1
        assert notes == ["of its elements are left out: edge (2), empty (3)"]
    with pytest.raises(InputError, match=f"{NEEDS} edge, point$"):
        read(tmp_path, "ply\nformat ascii 1.0\nelement edge 0\nelement point 0\nend_header\n")
    with pytest.raises(InputError, match=f"{NEEDS} none$"):
        read(tmp_path, "ply\nformat ascii 1.0\nend_header\n")
    with pytest.raises(InputError, match=f"{NEEDS} face$"):
        read(tmp_path, "ply\nformat ascii 1.0\nelement face 0\nend_header\n")


# ---- headers and ends ----


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("format ascii 1.0", "format ascii"),
        ("format ascii 1.0", "format utf8 1.0"),
        ("element vertex 4", "element vertex -1"),
        ("element vertex 4", "element vertex 4 4"),
        ("property float x", "property half x"),
        ("list uchar int", "list half int"),
        ("list uchar int", "list uchar half"),
        ("property float y", "property float"),
        ("property float y", "properties float y"),
    ],
)
def test_wrong_lines_of_a_header(tmp_path: Path, old: str, new: str) -> None:
    text = header("ascii", "", 1)
    number = next(k for k, line in enumerate(text.splitlines(), 1) if old in line)
    text = text.replace(old, new)
    with pytest.raises(InputError, match=rf"line {number} of its header is '[^']*{new}[^']*'; {HEADER_LINES}$"):
        read(tmp_path, text + VERTICES + "3 0 1 2\n")


def test_long_lines_are_cut_in_messages(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=f"header is '{'x' * 60}';"):
        read(tmp_path, header("ascii", "", 1).replace("comment made by hand", "x" * 90))
    with pytest.raises(InputError, match=f"not '{'x' * 60}'$"):
        read(tmp_path, header("ascii", "", 1) + "x" * 90 + "\n")
    with pytest.raises(InputError, match=f"header: '{'x' * 60}'$"):
        read(tmp_path, header("ascii", "", 1) + VERTICES + "3 0 1 2\n" + "x" * 90 + "\n")


def test_notes_in_a_header_are_passed_over(tmp_path: Path) -> None:
    notes = "comment\ncomment TextureFiles are none\nobj_info 3 of 7\n\n  \ncomment property half x\n"
    text = header("ascii", "", 1).replace("comment made by hand\n", notes) + VERTICES + "3 0 1 2\n"
    assert read(tmp_path, text).triangles == 1


def test_blank_lines_are_passed_over(tmp_path: Path) -> None:
    text = header("ascii", "", 2) + "\n" + VERTICES.replace("\n", "\n \n") + "\n\n3 0 1 2\n\n4 0 1 2 3\n\n \n"
    assert read(tmp_path, text).triangles == 3


@pytest.mark.parametrize(
    ("faces", "line"),
    [
        ("3 0 1 2\n4 0 1 2\n", 16),
        ("3 0 1 2\n-1 0 1 2\n", 16),
        ("3 0 1 2\n\n2.5 0 1 2\n", 17),
        ("3 0 1 2\n3 0 1 2 3\n", 16),
        ("3 0 1 2\n# none\n", 16),
    ],
)
def test_wrong_lines_of_faces(tmp_path: Path, faces: str, line: int) -> None:
    words = rf"line {line} should hold an element face \(a list vertex_indices after its length\) and nothing else"
    with pytest.raises(InputError, match=words):
        read(tmp_path, header("ascii", "", 2) + VERTICES + faces)


@pytest.mark.parametrize("missing", range(1, 40))
def test_a_binary_file_that_ends_early(tmp_path: Path, missing: int) -> None:
    """Nothing but the end of its data is told, wherever that is: in a number, a length, a list."""
    faces = struct.pack("<BiiiBiiii", 3, 0, 1, 2, 4, 0, 1, 2, 3)
    content = header("binary_little_endian", "", 2).encode() + np.array(SQUARE, "<f4").tobytes() + faces
    assert read(tmp_path, content).triangles == 3
    name, count = ("face", 2) if missing <= len(faces) else ("vertex", 4)
    with pytest.raises(InputError, match=rf"it ends before its {count} elements {name} are complete$"):
        read(tmp_path, content[:-missing])


def test_lists_may_be_empty(tmp_path: Path) -> None:
    more = "property list uchar short more\n"
    text = header("ascii", "", 2, more) + VERTICES + "3 0 1 2 0\n3 0 2 3 1 7\n"
    content = header("binary_little_endian", "", 2, more).encode() + np.array(SQUARE, "<f4").tobytes()
    content += struct.pack("<BiiiB", 3, 0, 1, 2, 0) + struct.pack("<BiiiBh", 3, 0, 2, 3, 1, 7)
    for each in (text, content):
        mesh, notes = read_with_notes(tmp_path, each)
        assert mesh.triangles == 2
        assert notes == ["of its elements are left out: more of face"]


def test_a_list_of_less_than_nothing(tmp_path: Path) -> None:
    content = header("binary_little_endian", "", 1).replace("uchar int", "char int").encode()
    content += np.array(SQUARE, "<f4").tobytes() + struct.pack("<b", -1) + bytes(40)
    with pytest.raises(InputError, match=r"it ends before its 1 elements face are complete$"):
        read(tmp_path, content)


# ---- what is not as it should be ----


@pytest.mark.parametrize("number", ["nan", "inf", "-1.#IND", "-nan(ind)"])
def test_normals_that_are_no_numbers_are_computed(tmp_path: Path, number: str) -> None:
    text = header("ascii", NORMAL, 1)
    note = "normals that are not finite numbers are computed: "
    one = rows("0 1 0").replace("1 0 0 0 1 0", f"1 0 0 0 {number} 0", 1)
    mesh, notes = read_with_notes(tmp_path, text + one + TRIANGLE)
    assert notes == [note + "1"]
    assert np.asarray(mesh.normals)[mesh.faces].tolist() == [[[0, 1, 0], [0, 0, 1], [0, 1, 0]]]
    mesh, notes = read_with_notes(tmp_path, text + rows(f"{number} 0 0") + TRIANGLE)
    assert (mesh.normals, notes) == (None, [note + "4"])


def test_points_without_faces(tmp_path: Path) -> None:
    text = header("ascii", "", 0) + VERTICES
    without = text.replace("element face 0\nproperty list uchar int vertex_indices\n", "")
    for each in (text, without):
        with pytest.raises(InputError, match="it has 4 points and no faces, so there is no surface to draw; a program"):
            read(tmp_path, each)


def strips(numbers: str, count: int = 1) -> str:
    return header("ascii", "", count).replace("element face", "element tristrips") + VERTICES + numbers


def test_strips_of_triangles(tmp_path: Path) -> None:
    """Every other triangle of a strip is wound the other way; -1 ends a strip, as the end of the list does."""
    square = [[list(SQUARE[k]) for k in face] for face in ((0, 1, 3), (3, 1, 2))]
    mesh = read(tmp_path, strips("4 0 1 3 2\n"))
    assert [sorted(face) for face in mesh.positions[mesh.faces].tolist()] == [sorted(face) for face in square]
    a, b, c = np.moveaxis(mesh.positions[mesh.faces], 1, 0)
    assert (np.cross(b - a, c - a)[:, 2] > 0).all()
    for same in ("5 0 1 3 2 -1\n", "9 0 1 3 -1 3 1 2 -1 0\n", "6 0 1 3 3 1 2\n"):
        other = read(tmp_path, strips(same))
        assert sorted(map(sorted, other.faces.tolist())) == sorted(map(sorted, mesh.faces.tolist()))
    assert read(tmp_path, strips("3 0 1 3\n3 3 1 2\n", 2)).triangles == 2
    with pytest.raises(InputError, match=r"face 1 names the vertices \[3, 1, 7\]"):
        read(tmp_path, strips("4 0 1 3 7\n"))


# ---- textures ----


def textured(vertex: str, face: str = "", count: int = 1, names: tuple[str, ...] = ("t.png",)) -> str:
    comments = "".join(f"comment TextureFile {name}\n" for name in names)
    return header("ascii", vertex, count, face).replace("comment made by hand\n", comments)


@pytest.mark.parametrize("names", [("s", "t"), ("u", "v"), ("texture_u", "texture_v")])
def test_texture_coordinates_of_vertices(tmp_path: Path, names: tuple[str, str]) -> None:
    HALVES.save(tmp_path / "t.png")
    more = "".join(f"property float {name}\n" for name in names)
    lines = "".join(f"{x} {y} {z} {x} {y}\n" for x, y, z in SQUARE)
    (tmp_path / "model.ply").write_text(textured(more) + lines + "4 0 1 2 3\n")
    (part,) = read_model(tmp_path / "model.ply")
    assert part.material["texture"].pixels.tolist() == np.asarray(HALVES).tolist()
    assert part.mesh.colors.tolist() == [[255, 255, 255]] * 4
    # the rows of textures begin at the top
    assert np.asarray(part.mesh.uvs).tolist() == [[x, 1 - y] for x, y, _ in part.mesh.positions.tolist()]


def test_texture_coordinates_of_corners(tmp_path: Path) -> None:
    """A face with a list of another length has none, and keeps its colour."""
    HALVES.save(tmp_path / "t.png")
    text = textured("", "property list uchar float texcoord\n", 2) + VERTICES
    (tmp_path / "model.ply").write_text(text + "3 0 1 2 6 0 0 1 0 1 1\n3 0 2 3 0\n")
    plain, shown = read_model(tmp_path / "model.ply")
    assert plain.material == {}
    assert plain.mesh.colors.tolist() == [list(DEFAULT_COLOR)] * 3
    assert np.asarray(shown.mesh.uvs).tolist() == [[0, 1], [1, 1], [1, 0]]


def test_textures_by_number(tmp_path: Path) -> None:
    """Faces of a number without a texture, and those that show one colour of theirs, need none."""
    HALVES.save(tmp_path / "a.png")
    HALVES.rotate(90).save(tmp_path / "b.png")
    HALVES.save(tmp_path / "c.png")
    face = "property list uchar float texcoord\nproperty int texnumber\n"
    text = textured("", face, 4, ("a.png", "b.png", "c.png")) + VERTICES
    uvs = "6 0 0 1 0 1 1"
    faces = f"3 0 1 2 {uvs} 1\n3 0 2 3 {uvs} 0\n3 0 1 3 {uvs} 3\n3 1 2 3 6 0.9 0.1 0.9 0.2 0.8 0.1 2\n"
    (tmp_path / "model.ply").write_text(text + faces)
    plain, a, b = read_model(tmp_path / "model.ply")
    assert corner_colors(plain.mesh) == [[list(DEFAULT_COLOR)] * 3, [[0, 0, 255]] * 3]
    assert a.material["texture"].pixels.tolist() == np.asarray(HALVES).tolist()
    assert b.material["texture"].pixels.tolist() == np.asarray(HALVES.rotate(90)).tolist()


def test_a_texture_comes_before_colors(tmp_path: Path) -> None:
    HALVES.save(tmp_path / "t.png")
    more = COLOR + "property uchar alpha\nproperty float s\nproperty float t\n"
    lines = "".join(f"{x} {y} {z} 1 2 3 51 {x} {y}\n" for x, y, z in SQUARE)
    (tmp_path / "model.ply").write_text(textured(more) + lines + "4 0 1 2 3\n")
    with pytest.warns(InputWarning, match="2 triangles drawn in the colours of a texture, not in their own$"):
        (part,) = read_model(tmp_path / "model.ply")
    assert part.mesh.rgba.tolist() == [[255, 255, 255, 51]] * 4


@pytest.mark.parametrize("name", ["T.PNG", "C:\\scans\\t.png", "/some/place/t.png", "parts/t.png"])
def test_a_texture_is_looked_for_beside_the_file(tmp_path: Path, name: str) -> None:
    """By its last part, in any letter case, as those of material files are."""
    HALVES.save(tmp_path / "t.png")
    lines = "".join(f"{x} {y} {z} {x} {y}\n" for x, y, z in SQUARE)
    header = textured("property float s\nproperty float t\n", names=(name,))
    (tmp_path / "model.ply").write_text(header + lines + "4 0 1 2 3\n")
    (part,) = read_model(tmp_path / "model.ply")
    assert part.material["texture"].pixels.tolist() == np.asarray(HALVES).tolist()


def test_texture_coordinates_that_are_no_numbers(tmp_path: Path) -> None:
    HALVES.save(tmp_path / "t.png")
    lines = "".join(f"{x} {y} {z} nan {y}\n" for x, y, z in SQUARE)
    (tmp_path / "model.ply").write_text(textured("property float s\nproperty float t\n") + lines + "4 0 1 2 3\n")
    with pytest.warns(InputWarning, match="texture coordinates that are not finite numbers; they are taken as 0$"):
        read_model(tmp_path / "model.ply")
