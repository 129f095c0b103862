import re
import struct
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import mesh_files
from mesh_files import corner_colors
from shackled.errors import InputError, InputWarning
from shackled.scene._files.mesh_file import read_model
from shackled.scene._files.model import MeshPart
from shackled.scene._mesh import DEFAULT_COLOR, Mesh

SQUARE = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0))
GREY = list(DEFAULT_COLOR)


def header(encoding: str, vertex: str, faces: int, face: str = "") -> str:
    properties = "property float x\nproperty float y\nproperty float z\n" + vertex
    return (
        f"ply\nformat {encoding} 1.0\ncomment made by hand\nelement vertex 4\n{properties}"
        f"element face {faces}\nproperty list uchar int vertex_indices\n{face}end_header\n"
    )


def rows(more: str = "") -> str:
    """The lines of the vertices, each with the same numbers after its coordinates."""
    return "".join(f"{x} {y} {z} {more.format(x=x, y=y)}\n" for x, y, z in SQUARE)


def properties(kind: str, *names: str) -> str:
    return "".join(f"property {kind} {name}\n" for name in names)


def read(folder: Path, content: str | bytes) -> Mesh:
    return mesh_files.read(folder / "model.ply", content)


def read_with_notes(folder: Path, content: str | bytes) -> tuple[Mesh, list[str]]:
    return mesh_files.read_with_notes(folder / "model.ply", content)


#: The note of a file whose faces and vertices have colours.
OF_FACES = "the colours of its vertices are left out, for its faces have colours"
LEFT = "of its elements are left out: "
KNOWN = "known are format, element and its count, then property and its type, and comment, obj_info, end_header"
NEEDS = (
    "a mesh needs an element vertex with x, y and z, and an element face with a list vertex_indices; this file has the "
    "elements"
)
NO_FACES = "it has 4 points and no faces, so there is no surface to draw; a program such as MeshLab makes one of points"
LINE_OF_FACE = "line {} should hold an element face (a list vertex_indices after its length) and nothing else, not {!r}"
RGB = properties("uchar", "red", "green", "blue")
NORMAL = properties("float", "nx", "ny", "nz")
PLAIN, POINTS = header("ascii", "", 1), rows()
TRIANGLE = "3 0 1 2\n"
BINARY = header("binary_little_endian", "", 1).encode()
BINARY_POINTS = np.array(SQUARE, "<f4").tobytes()


# the last as in a file of the package compas
@pytest.mark.parametrize("end", ["\n", "\r\n", "\r", "\r\r\n"])
def test_line_ends(tmp_path: Path, end: str) -> None:
    notes = "comment\ncomment TextureFiles are none\nobj_info 3 of 7\n\n  \ncomment property half x\n"
    head = header("ascii", "", 2).replace("ply", "PLY", 1).replace("comment made by hand\n", notes)
    text = head + "\n" + POINTS.replace("\n", "\n \n") + "\n\n3 0 1 2\n\n4 0 1 2 3\n\n \n"
    assert read(tmp_path, text.replace("\n", end)).triangles == 3
    if end != "\r\r\n":
        content = BINARY.replace(b"\n", end.encode()) + BINARY_POINTS + struct.pack("<Biiii", 4, 0, 1, 2, 3)
        assert read(tmp_path, content).triangles == 2


def test_letters_that_are_not_of_ascii(tmp_path: Path) -> None:
    text = (PLAIN.replace("by hand", "by händ") + POINTS + TRIANGLE).encode("latin-1")
    assert read(tmp_path, text).triangles == 1
    with pytest.raises(InputError, match=r"line 15 should hold an element face .*, not '3 0 1 é'"):
        read(tmp_path, text.replace(b"3 0 1 2\n", b"3 0 1 \xe9\n"))


@pytest.mark.parametrize(("encoding", "order"), [("binary_little_endian", "<"), ("binary_big_endian", ">")])
def test_binary_with_triangles_and_quads(tmp_path: Path, encoding: str, order: str) -> None:
    content = header(encoding, RGB, 2).encode()
    for number, (x, y, z) in enumerate(SQUARE):
        content += struct.pack(order + "fffBBB", x, y, z, number, 100, 255)
    content += struct.pack(order + "Biii", 3, 0, 1, 2) + struct.pack(order + "Biiii", 4, 0, 1, 2, 3)
    mesh = read(tmp_path, content)
    assert corner_colors(mesh) == [[[a, 100, 255] for a in face] for face in ((0, 1, 2), (0, 1, 2), (0, 2, 3))]


# ---- colours and normals ----


@pytest.mark.parametrize(
    ("vertex", "row", "face", "faces", "expected"),
    [
        ("", "", RGB, ["255 0 0", "0 0 9"], [(255, 0, 0), (0, 0, 9)]),
        # a single face has no colour of its own beside those of its vertices, but others do, where one channel differs
        (RGB, "9 9 9", RGB, ["7 7 7"], [(9, 9, 9)]),
        (RGB, "9 9 9", RGB, ["1 2 3", "1 2 3", "1 2 4"], [(1, 2, 3), (1, 2, 3), (1, 2, 4)]),
        (RGB, "1 2 3", RGB, ["255 255 255"] * 2, [(1, 2, 3)] * 2),
        # other names, of which the first counts, if it is whole
        (properties("uchar", "diffuse_red", "diffuse_green", "diffuse_blue"), "10 20 30", "", [""], [(10, 20, 30)]),
        (properties("uchar", "r", "g", "b"), "10 20 30", "", [""], [(10, 20, 30)]),
        (properties("uchar", "r", "g", "b") + RGB, "1 2 3 4 5 6", "", [""], [(4, 5, 6)]),
        (properties("uchar", "r", "g", "red"), "10 20 30", "", [""], [DEFAULT_COLOR]),
        (RGB + properties("float", "s", "t"), "1 2 3 0.5 0.5", "", [""], [(1, 2, 3)]),
    ],
)
def test_colors(
    tmp_path: Path, vertex: str, row: str, face: str, faces: list[str], expected: list[tuple[int, ...]]
) -> None:
    text = header("ascii", vertex, len(faces), face) + rows(row)
    text += "".join(f"3 0 1 {2 + (k > 1)} {each}\n" for k, each in enumerate(faces))
    mesh, notes = read_with_notes(tmp_path, text)
    assert corner_colors(mesh) == [[list(each)] * 3 for each in expected]
    names = [line.split()[-1] for line in vertex.splitlines()]
    left = [name for name in names if (len(name) == 1 and names != ["r", "g", "b"]) or names == ["r", "g", "red"]]
    lost = [LEFT + ", ".join(f"{name} of vertex" for name in left)] if left else []
    assert notes == [*lost, *([OF_FACES] if vertex and len(set(faces)) > 1 else [])]


@pytest.mark.parametrize(
    ("name", "values", "expected"),
    [
        ("uchar", [1, 200, 255], [1, 200, 255]),
        ("char", [0, 1, 127], [0, 1, 127]),
        ("ushort", [257, 65406, 65407], [1, 254, 255]),
        ("short", [1, 200, 255], [1, 200, 255]),
        # whole numbers are none of fractions, though none is above 1
        *[(name, [0, 1, 1], [0, 1, 1]) for name in ("uchar", "char", "short", "int", "uint")],
        ("ushort", [0, 1, 1], [0, 0, 0]),
        ("float", [0, 0.5, 1], [0, 128, 255]),
        ("double", [0.25, 0.5, 1], [64, 128, 255]),
    ],
)
def test_colors_by_their_type(tmp_path: Path, name: str, values: list[float], expected: list[int]) -> None:
    text = header("ascii", RGB.replace("uchar", name), 1) + rows(" ".join(map(str, values))) + TRIANGLE
    assert corner_colors(read(tmp_path, text)) == [[expected] * 3]


def test_the_type_of_red_tells(tmp_path: Path) -> None:
    for red, other, expected in (("float", "uchar", 255), ("uchar", "float", 1)):
        head = header("ascii", RGB.replace("uchar", other).replace(f"{other} red", f"{red} red"), 1)
        assert corner_colors(read(tmp_path, head + rows("1 1 1") + TRIANGLE)) == [[[expected] * 3] * 3]


@pytest.mark.parametrize("number", ["nan", "inf", "-1.#IND", "-nan(ind)"])
def test_normals_are_kept_unless_they_are_no_numbers(tmp_path: Path, number: str) -> None:
    text, note = header("ascii", NORMAL, 1), "normals that are not finite numbers are computed: "
    assert np.asarray(read(tmp_path, text + rows("0 1 0") + TRIANGLE).normals).tolist() == [[0, 1, 0]] * 3
    one = rows("0 1 0").replace("1 0 0 0 1 0", f"1 0 0 0 {number} 0", 1)
    mesh, notes = read_with_notes(tmp_path, text + one + TRIANGLE)
    assert notes == [note + "1"]
    assert np.asarray(mesh.normals)[mesh.faces].tolist() == [[[0, 1, 0], [0, 0, 1], [0, 1, 0]]]
    mesh, notes = read_with_notes(tmp_path, text + rows(f"{number} 0 0") + TRIANGLE)
    assert (mesh.normals, notes) == (None, [note + "4"])


# ---- what is wrong ----


def changed(old: str, new: str) -> str:
    return PLAIN.replace(old, new) + POINTS + TRIANGLE


def of_header(number: int, line: str) -> str:
    return f"line {number} of its header is {line!r}; {KNOWN}"


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("plx\n", "a PLY file begins with the line ply"),
        ("ply\nformat ascii 1.0\n", "its header has no line end_header"),
        ("ply\nend_header\n", "its header has no line format"),
        ("ply\nformat ascii 1.0\nproperty float x\nend_header\n", of_header(3, "property float x")),
        (changed("comment made", "made"), of_header(3, "made by hand")),
        (changed("comment made by hand", "x" * 90), of_header(3, "x" * 60)),
        (changed("format ascii 1.0", "format ascii"), of_header(2, "format ascii")),
        (changed("format ascii 1.0", "format utf8 1.0"), of_header(2, "format utf8 1.0")),
        (changed("vertex 4", "vertex -1"), of_header(4, "element vertex -1")),
        (changed("vertex 4", "vertex many"), of_header(4, "element vertex many")),
        (changed("float x", "half x"), of_header(5, "property half x")),
        (changed("uchar int", "half int"), of_header(9, "property list half int vertex_indices")),
        (changed("uchar int", "uchar half"), of_header(9, "property list uchar half vertex_indices")),
        (changed("float y", "float"), of_header(6, "property float")),
        *(
            (PLAIN.replace("face 1", "face 2") + POINTS + faces, LINE_OF_FACE.format(line, wrong))
            for faces, line, wrong in (
                ("3 0 1 2 1 0 0\n3 0 1 2\n", 15, "3 0 1 2 1 0 0"), ("3 0 1\n3 0 2 3\n", 15, "3 0 1"),
            )
        ),
        (PLAIN + "x" * 90, f"line 11 should hold an element vertex (x, y, z) and nothing else, not {'x' * 60!r}"),
        (PLAIN + POINTS + TRIANGLE + "\n" + "7" * 90 + "\n",
         f"line 17 is left over behind the elements of its header: {'7' * 60!r}"),
        (PLAIN + POINTS + "3 0 1.5 2\n", "the numbers of vertices must be whole, not 1.5"),
        (header("ascii", RGB.replace("uchar", "float"), 1) + rows("0 nan 1") + TRIANGLE,
         "colour 0 must be finite numbers, not [0.0, nan, 1.0]"),
        (PLAIN + "0 0 0\n1 0 0\n", "it ends before its 4 elements vertex are complete"),
        (BINARY.decode().replace("vertex 4", "vertex 4000000000") + " " * 200,
         "it ends before its 4000000000 elements vertex are complete"),
        (header("ascii", "", 0) + POINTS, NO_FACES),
        (PLAIN.partition("element face")[0] + "end_header\n" + POINTS, NO_FACES),
        # what a mesh needs
        *(
            (f"ply\nformat ascii 1.0\n{elements}end_header\n", f"{NEEDS} {names}")
            for elements, names in (
                ("element vertex 0\n", "vertex"), ("element edge 0\nelement point 0\n", "edge, point"), ("", "none")
            )
        ),
        (changed("float z", "float w"), f"{NEEDS} vertex, face"),
        (changed("vertex_indices", "corners"), f"{NEEDS} vertex, face"),
        (PLAIN.replace("list uchar int", "int") + POINTS + "0\n", f"{NEEDS} vertex, face"),
        (PLAIN.replace("float x", "list uchar float x") + re.sub("(?m)^", "1 ", POINTS.strip()) + "\n" + TRIANGLE,
         f"{NEEDS} vertex, face"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_told_in_one_line(tmp_path: Path, content: str, message: str) -> None:
    assert mesh_files.refusal(tmp_path / "model.ply", content) == message


REST = "1 of its 2 elements face and all behind left out: {}"


@pytest.mark.parametrize(
    ("faces", "line", "wrong"),
    [
        ("3 0 1 2\n4 0 1 2\n", 16, "4 0 1 2"),
        ("3 0 1 2\n-1 0 1 2\n", 16, "-1 0 1 2"),
        ("3 0 1 2\n\n2.5 0 1 2\n", 17, "2.5 0 1 2"),
        ("3 0 1 2\n# none\n", 16, "# none"),
        ("3 0 1 2\n", None, None),
    ],
)
def test_faces_before_one_that_is_wrong(tmp_path: Path, faces: str, line: int | None, wrong: str | None) -> None:
    mesh, notes = read_with_notes(tmp_path, PLAIN.replace("face 1", "face 2") + POINTS + faces)
    told = LINE_OF_FACE.format(line, wrong) if line else "it ends before its 2 elements face are complete"
    assert (mesh.triangles, notes) == (1, [REST.format(told)])


@pytest.mark.parametrize("missing", range(1, 40))
def test_a_binary_file_that_ends_early(tmp_path: Path, missing: int) -> None:
    """Nothing but the end of its data is told, wherever that is: in a number, a length, a list. Whole faces are drawn.

    A face takes 17 bytes.
    """
    faces = struct.pack("<BiiiBiiii", 3, 0, 1, 2, 4, 0, 1, 2, 3)
    content = header("binary_little_endian", "", 2).encode() + BINARY_POINTS + faces
    if missing <= 17:
        mesh, notes = read_with_notes(tmp_path, content[:-missing])
        assert (mesh.triangles, notes) == (1, [REST.format("it ends before its 2 elements face are complete")])
        return
    name, count = ("face", 2) if missing <= len(faces) else ("vertex", 4)
    with pytest.raises(InputError, match=rf"it ends before its {count} elements {name} are complete$"):
        read(tmp_path, content[:-missing])


def test_a_list_of_less_than_nothing(tmp_path: Path) -> None:
    content = BINARY.replace(b"uchar int", b"char int") + BINARY_POINTS + struct.pack("<b", -1) + bytes(40)
    with pytest.raises(InputError, match=r"it ends before its 1 elements face are complete$"):
        read(tmp_path, content)


# ---- types, names and other elements ----

TYPES = {
    "i1": ("char", "int8"), "u1": ("uchar", "uint8"), "i2": ("short", "int16"), "u2": ("ushort", "uint16"),
    "i4": ("int", "int32"), "u4": ("uint", "uint32"), "f4": ("float", "float32"), "f8": ("double", "float64"),
}  # fmt: skip


@pytest.mark.parametrize(("name", "kind"), [(name, kind) for kind, names in TYPES.items() for name in names])
def test_types(tmp_path: Path, name: str, kind: str) -> None:
    """Of numbers, of those in lists, and of their lengths; where these differ, rows are read one by one."""
    numbers = np.finfo(kind) if kind[0] == "f" else np.iinfo(kind)
    low, high = (-1.5, 1.7e38 if kind == "f4" else 1e300) if kind[0] == "f" else (numbers.min, numbers.max)
    for encoding, order in (("binary_little_endian", "<"), ("binary_big_endian", ">")):
        points = np.array([[low, 0, 1], [high, 2, 3], [4, high, 5]]).astype(order + kind)
        text = header(encoding, "", 1).replace("vertex 4", "vertex 3").replace("float", name)
        mesh = read(tmp_path, text.encode() + points.tobytes() + struct.pack(order + "Biii", 3, 0, 1, 2))
        assert mesh.positions[mesh.faces[0]].tolist() == points.astype(np.float64).tolist()
    for faces in ([[0, 1, 2], [0, 2, 3]], [[0, 1, 2], [0, 1, 2, 3]]):
        head = header("binary_little_endian", "", 2).replace("uchar int", f"{name} {name}").encode()
        lists = b"".join(np.array([len(face), *face], "<" + kind).tobytes() for face in faces)
        assert read(tmp_path, head + BINARY_POINTS + lists).triangles == sum(len(face) - 2 for face in faces)


def test_both_names_of_the_list_of_a_face(tmp_path: Path) -> None:
    text = PLAIN + POINTS + TRIANGLE
    whole = read(tmp_path, text)
    assert read(tmp_path, text.replace("vertex_indices", "vertex_index")) == whole
    # beside other lists, which may be empty, and the first name counts
    other = "property list uchar int vertex_index\nproperty list uchar float weights\n"
    text = header("ascii", "", 1, other) + POINTS + "3 0 1 2 4 0 1 2 3 0\n"
    assert read_with_notes(tmp_path, text) == (whole, [LEFT + "vertex_index of face, weights of face"])
    text = PLAIN.replace("element face 1\n", "element face 1\nproperty list uchar float weights\n")
    assert read_with_notes(tmp_path, text + POINTS + "2 0.5 0.25 3 0 1 2\n") == (whole, [LEFT + "weights of face"])


@pytest.mark.parametrize("encoding", ["ascii", "binary_little_endian"])
def test_other_elements_are_passed_over(tmp_path: Path, encoding: str) -> None:
    """Wherever they are, with numbers and lists, as text and binary."""
    edges = "element edge 2\nproperty int a\nproperty list uchar short more\nelement vertex"
    head = header(encoding, "", 1).replace("element vertex", edges).replace("end_", "element empty 3\nend_").encode()
    content = head + ("7 1 5\n8 2 5 6\n" + POINTS + TRIANGLE).encode()
    if encoding != "ascii":
        content = head + struct.pack("<iBhiBhh", 7, 1, 5, 8, 2, 5, 6) + BINARY_POINTS + struct.pack("<Biii", 3, 0, 1, 2)
    mesh, notes = read_with_notes(tmp_path, content)
    assert (mesh.triangles, notes) == (1, [LEFT + "edge (2), empty (3)"])


def strips(numbers: str, count: int = 1) -> str:
    return header("ascii", "", count).replace("element face", "element tristrips") + POINTS + numbers


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
    mesh, notes = read_with_notes(tmp_path, strips("4 0 1 3 7\n"))
    assert (mesh.triangles, notes) == (1, ["1 face left out, with vertices that do not exist"])


# ---- textures ----

#: The left half red, the right one blue.
HALVES = Image.fromarray(np.repeat([[[255, 0, 0]] * 4 + [[0, 0, 255]] * 4], 8, axis=0).astype(np.uint8))
ST = properties("float", "s", "t")


def textured(
    folder: Path, vertex: str, lines: str, face: str = "", count: int = 1, name: str = "t.png"
) -> list[MeshPart]:
    """The parts of a file with an image; lines: of vertices and faces."""
    HALVES.save(folder / "t.png")
    head = header("ascii", vertex, count, face).replace("comment made by hand", f"comment TextureFile {name}")
    (folder / "model.ply").write_text(head + lines)
    return read_model(folder / "model.ply")


def is_halves(part: MeshPart, degrees: int = 0) -> bool:
    return bool(np.array_equal(part.material["texture"].pixels, np.asarray(HALVES.rotate(degrees))))


@pytest.mark.parametrize("names", [("s", "t"), ("u", "v"), ("texture_u", "texture_v")])
def test_texture_coordinates_of_vertices(tmp_path: Path, names: tuple[str, str]) -> None:
    """The image is looked for beside the file, as those of material files are."""
    name = "C:\\scans\\T.PNG" if names == ("s", "t") else "t.png"
    (part,) = textured(tmp_path, properties("float", *names), rows("{x} {y}") + "4 0 1 2 3\n", name=name)
    assert is_halves(part)
    assert part.mesh.colors.tolist() == [[255, 255, 255]] * 4
    # the rows of textures begin at the top
    assert np.asarray(part.mesh.uvs).tolist() == [[x, 1 - y] for x, y, _ in part.mesh.positions.tolist()]


def test_texture_coordinates_of_corners(tmp_path: Path) -> None:
    """A face with a list of another length has none, and keeps its colour."""
    lines = POINTS + "3 0 1 2 6 0 0 1 0 1 1\n3 0 2 3 0\n"
    plain, shown = textured(tmp_path, "", lines, "property list uchar float texcoord\n", 2)
    assert plain.material == {}
    assert plain.mesh.colors.tolist() == [GREY] * 3
    assert np.asarray(shown.mesh.uvs).tolist() == [[0, 1], [1, 1], [1, 0]]


def test_textures_by_number(tmp_path: Path) -> None:
    """Faces of a number without a texture, and those that show one colour of theirs, need none."""
    HALVES.rotate(90).save(tmp_path / "b.png")
    face = "property list uchar float texcoord\nproperty int texnumber\n"
    uvs = "6 0 0 1 0 1 1"
    faces = f"3 0 1 2 {uvs} 1\n3 0 2 3 {uvs} 0\n3 0 1 3 {uvs} 3\n3 1 2 3 6 0.9 0.1 0.9 0.2 0.8 0.1 2\n"
    names = "t.png\ncomment TextureFile b.png\ncomment TextureFile t.png"
    plain, a, b = textured(tmp_path, "", POINTS + faces, face, 4, names)
    assert corner_colors(plain.mesh) == [[GREY] * 3, [[0, 0, 255]] * 3]
    assert is_halves(a)
    assert is_halves(b, 90)


@pytest.mark.parametrize(
    ("vertex", "row", "note"),
    [
        (ST, "nan {y}", "has texture coordinates that are not finite numbers; they are replaced by 0"),
        ("", "", "its texture is left out, for it has no texture coordinates"),
        (RGB + "property uchar alpha\n" + ST, "1 2 3 51 {x} {y}",
         "2 triangles drawn in the colours of a texture, not in their own"),
    ],
)  # fmt: skip
def test_textures_that_are_told_of(tmp_path: Path, vertex: str, row: str, note: str) -> None:
    with pytest.warns(InputWarning, match=f"{re.escape(note)}$"):
        (part,) = textured(tmp_path, vertex, rows(row) + "4 0 1 2 3\n")
    if "alpha" in vertex:
        assert part.mesh.rgba.tolist() == [[255, 255, 255, 51]] * 4
