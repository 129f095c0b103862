from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from mesh_files import corner_colors, corner_positions, read_with_notes, refusal
from mesh_files import read as read_file
from shackled.scene._files.model import TEXTURED
from shackled.scene._mesh import DEFAULT_COLOR, Mesh

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
GREY = list(DEFAULT_COLOR)


def read(folder: Path, text: str) -> Mesh:
    return read_file(folder / "model.obj", text)


@pytest.mark.parametrize(
    ("colors", "expected"),
    [
        (["1 0 0", "0 0.5 0", "0 0 0.2"], [[255, 0, 0], [0, 128, 0], [0, 0, 51]]),
        (["255 0 0", "0 17 0", "0 0 1"], [[255, 0, 0], [0, 17, 0], [0, 0, 1]]),
        (["1 0 0", "", ""], [[255, 0, 0], GREY, GREY]),
        # of those that have none, the colour is that of the material
        (["1 0 0", "1 0 0", "", "usemtl a"], [[255, 0, 0], [255, 0, 0], [255, 128, 0]]),
    ],
)
def test_colors_of_vertices(tmp_path: Path, colors: list[str], expected: list[list[int]]) -> None:
    (tmp_path / "m.mtl").write_text("newmtl a\nKd 1 0.5 0\n")
    one, two, three, *more = colors
    text = f"mtllib m.mtl\nv 0 0 0 {one}\nv 1 0 0 {two}\nv 0 1 0 {three}\n" + "\n".join([*more, "f 1 2 3\n"])
    mesh = read(tmp_path, text)
    assert (corner_colors(mesh), mesh.normals) == ([expected], None)


def test_relative_numbers_count_back_from_the_line(tmp_path: Path) -> None:
    second = "v 5 0 0\nv 6 0 0\nv 5 1 0\n"
    mesh = read(tmp_path, TRIANGLE + "f -3 -2 -1\n" + second + "f -3 -2 -1\n")
    assert corner_positions(mesh) == [[[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[5, 0, 0], [6, 0, 0], [5, 1, 0]]]


@pytest.mark.parametrize("line_end", ["\n", "\r", "\r\n"])
def test_polygons_groups_comments_tabs_and_continued_lines(tmp_path: Path, line_end: str) -> None:
    text = "# a square\no one\n" + SQUARE + "g side # here\ns off\nf\t1 2 \\\n3 4 # all\ng other\nf 4 3 2\n"
    mesh = read(tmp_path, text.replace("\n", line_end))
    assert (mesh.triangles, len(mesh.positions)) == (3, 4)


def test_normals(tmp_path: Path) -> None:
    """Those of the file are kept, those that a face has not are computed; numbers may be without any vn line."""
    mesh = read(tmp_path, SQUARE + "v 0 0 1\nvn 0.6 0 0.8\nf 1//1 2//1 3//1\nf 1 3 4\nf 1 4 5\n")
    assert mesh.normals is not None
    wanted = [[[0.6, 0, 0.8]] * 3, [[0, 0, 1]] * 3, [[1, 0, 0]] * 3]
    np.testing.assert_array_equal(mesh.normals[mesh.faces], wanted)
    assert read(tmp_path, TRIANGLE + "f 1//1 2//1 3//1\n").normals is None


def test_smoothing_groups_give_normals(tmp_path: Path) -> None:
    fold = SQUARE + "v 0 0 1\n{}f 1 2 3 4\n{}f 1 4 5\n"
    assert read(tmp_path, fold.format("s off\n", "")).normals is None
    smooth = read(tmp_path, fold.format("s 1\n", "")).normals
    assert smooth is not None
    assert len(smooth) == 5
    np.testing.assert_allclose(smooth[1], [0, 0, 1])
    assert (smooth[0] > 0.1).tolist() == [True, False, True]
    for other in ("s 2\n", "s off\n"):
        hard = read(tmp_path, fold.format("s 1\n", other))
        np.testing.assert_array_equal(hard.normals, [[0, 0, 1]] * 4 + [[1, 0, 0]] * 3)


def test_materials_of_several_files(tmp_path: Path) -> None:
    """One of them is missing; faces before the first material are grey."""
    (tmp_path / "two colours.mtl").write_text("newmtl warm\nKd 1 0.5 0\nNs 3\n\nnewmtl cold one\n\tKd 0 0 1\n")
    (tmp_path / "b.mtl").write_text("newmtl b\nKd 1 0 0\n")
    text = "mtllib two colours.mtl lost.mtl b.mtl\n" + SQUARE
    text += "f 1 2 4\nusemtl warm\nf 1 2 3\nusemtl cold one\nf 1 3 4\nusemtl b\nf 2 3 4\n"
    mesh, notes = read_with_notes(tmp_path / "model.obj", text)
    assert corner_colors(mesh) == [[color] * 3 for color in (GREY, [255, 128, 0], [0, 0, 255], [255, 0, 0])]
    assert notes == [f"its materials are left out: {tmp_path / 'lost.mtl'} does not exist"]


WOOD = np.array([[[255, 0, 0], [0, 0, 255]]], dtype=np.uint8)


@pytest.mark.parametrize(
    ("image", "colors", "note"),
    [
        (WOOD, [[255, 0, 0], [0, 0, 255], [255, 0, 0]], TEXTURED),
        (WOOD[:, :1], [[255, 0, 0]] * 3, None),
        (b"no picture", [[0, 255, 0]] * 3, "a texture is left out: {folder}/wood.png is not an image that can be read"),
        # that of a material that no face has is not missed
        (None, [[0, 255, 0]] * 3, "a texture is left out: {folder}/wood.png does not exist"),
    ],
    ids=["sampled", "one colour", "broken", "missing"],
)  # fmt: skip
def test_textures_of_a_single_mesh(tmp_path: Path, image: object, colors: list[list[int]], note: str | None) -> None:
    if isinstance(image, bytes):
        (tmp_path / "wood.png").write_bytes(image)
    elif isinstance(image, np.ndarray):
        Image.fromarray(image).save(tmp_path / "wood.png")
    (tmp_path / "m.mtl").write_text("newmtl a\nKd 0 1 0\nmap_Kd wood.png\nnewmtl b\nmap_Kd ash.png\n")
    text = "mtllib m.mtl\n" + TRIANGLE + "vt 0 0\nvt 1 0\nvt 0 1\nusemtl a\nf 1/1 2/2 3/3\nusemtl b\n"
    mesh, notes = read_with_notes(tmp_path / "model.obj", text)
    assert corner_colors(mesh) == [colors]
    assert notes == ([note.format(folder=tmp_path)] if note else [])


NO_FACES = (
    "it has no faces, only {}; only faces are drawn, such as those of thin tubes in place of lines and of small "
    "balls in place of points"
)
NO_VERTEX = "the face in line 4 names a vertex that is not among the 3 of the file"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("hello\nworld\n", NO_FACES.format("0 vertices")),
        ("f 1 2 3\n", "the face in line 1 names a vertex that is not among the 0 of the file"),
        (TRIANGLE + "f 1 2 4\n", NO_VERTEX),
        (TRIANGLE + "f 0 1 2\n", NO_VERTEX),
        (TRIANGLE + "f -4 1 2\n", NO_VERTEX),
        (
            TRIANGLE + "f 1 2\np 1 2\np 3\nl 1 2 3\ncurv 0 1 1 2\nend\n",
            NO_FACES.format("3 points, 1 line, 1 incomplete face, 1 curve"),
        ),
        (TRIANGLE + "f 1 two 3\n", "line 4 is not one of an OBJ file: 'f 1 two 3'"),
        ("v 0 0\n" + TRIANGLE + "f 1 2 3\n", "line 1 is not one of an OBJ file: 'v 0 0'"),
        (
            "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
            "vertex 0 has a coordinate that is not a finite number: [0.0, 0.0, nan]",
        ),
    ],
)
def test_what_is_wrong_is_told_in_one_line(tmp_path: Path, text: str, message: str) -> None:
    assert refusal(tmp_path / "model.obj", text) == message
