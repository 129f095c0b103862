from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from mesh_files import corner_colors, corner_positions
from mesh_files import read as read_file
from shackled.errors import InputError, InputWarning
from shackled.scene import Mesh, read_mesh, write_obj
from shackled.scene._files.model import TEXTURED
from shackled.scene._mesh import DEFAULT_COLOR

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"


def read(folder: Path, text: str) -> Mesh:
    return read_file(folder / "model.obj", text)


def messages(told: pytest.WarningsRecorder) -> list[str]:
    return [str(warning.message) for warning in told]


def test_without_colors_it_is_grey(tmp_path: Path) -> None:
    mesh = read(tmp_path, TRIANGLE + "f 1 2 3\n")
    assert corner_positions(mesh) == [[[0, 0, 0], [1, 0, 0], [0, 1, 0]]]
    assert corner_colors(mesh) == [[list(DEFAULT_COLOR)] * 3]
    assert mesh.normals is None


def test_vertex_colors_in_fractions(tmp_path: Path) -> None:
    mesh = read(tmp_path, "v 0 0 0 1 0 0\nv 1 0 0 0 0.5 0\nv 0 1 0 0 0 0.2\nf 1 2 3\n")
    assert corner_colors(mesh) == [[[255, 0, 0], [0, 128, 0], [0, 0, 51]]]


def test_vertex_colors_in_bytes(tmp_path: Path) -> None:
    mesh = read(tmp_path, "v 0 0 0 255 0 0\nv 1 0 0 0 17 0\nv 0 1 0 0 0 1\nf 1 2 3\n")
    assert corner_colors(mesh) == [[[255, 0, 0], [0, 17, 0], [0, 0, 1]]]


def test_only_some_vertices_have_colors(tmp_path: Path) -> None:
    mesh = read(tmp_path, "v 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    assert corner_colors(mesh) == [[[255, 0, 0], list(DEFAULT_COLOR), list(DEFAULT_COLOR)]]


def test_relative_numbers_count_back_from_the_line(tmp_path: Path) -> None:
    second = "v 5 0 0\nv 6 0 0\nv 5 1 0\n"
    mesh = read(tmp_path, TRIANGLE + "f -3 -2 -1\n" + second + "f -3 -2 -1\n")
    assert corner_positions(mesh) == [[[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[5, 0, 0], [6, 0, 0], [5, 1, 0]]]


def test_polygons_groups_comments_tabs_and_continued_lines(tmp_path: Path) -> None:
    mesh = read(
        tmp_path, "# a square\no one\n" + SQUARE + "g side # here\ns off\nf\t1 2 \\\n3 4 # all\ng other\nf 4 3 2\n"
    )
    assert mesh.triangles == 3
    assert len(mesh.positions) == 4


def test_normals_of_the_file_are_kept(tmp_path: Path) -> None:
    mesh = read(tmp_path, TRIANGLE + "vn 0 0 1\nvn 0 1 0\nf 1//1 2//1 3//2\n")
    assert np.asarray(mesh.normals).tolist() == [[0, 0, 1], [0, 0, 1], [0, 1, 0]]


def test_normals_that_not_every_face_has_are_completed(tmp_path: Path) -> None:
    mesh = read(tmp_path, SQUARE + "v 0 0 1\nvn 0.6 0 0.8\nf 1//1 2//1 3//1\nf 1 3 4\nf 1 4 5\n")
    assert mesh.normals is not None
    given, near, across = mesh.normals[mesh.faces]
    np.testing.assert_array_equal(given, [[0.6, 0, 0.8]] * 3)
    np.testing.assert_array_equal(near, [[0, 0, 1]] * 3)
    np.testing.assert_array_equal(across, [[1, 0, 0]] * 3)


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


def test_materials_color_their_faces(tmp_path: Path) -> None:
    (tmp_path / "two colours.mtl").write_text("newmtl warm\nKd 1 0.5 0\nNs 3\n\nnewmtl cold one\n\tKd 0 0 1\n")
    mesh = read(tmp_path, "mtllib two colours.mtl\n" + SQUARE + "usemtl warm\nf 1 2 3\nusemtl cold one\nf 1 3 4\n")
    assert corner_colors(mesh) == [[[255, 128, 0]] * 3, [[0, 0, 255]] * 3]
    assert len(mesh.positions) == 6


def test_faces_before_a_material_and_missing_materials_are_grey(tmp_path: Path) -> None:
    with pytest.warns(InputWarning) as told:
        mesh = read(tmp_path, "mtllib no where.mtl\n" + SQUARE + "f 1 2 3\nusemtl lost\nf 1 3 4\n")
    assert messages(told) == [
        f"{tmp_path / 'model.obj'}: its materials are left out: {tmp_path / 'no where.mtl'} does not exist"
    ]
    assert corner_colors(mesh) == [[list(DEFAULT_COLOR)] * 3] * 2


def test_vertex_colors_come_before_materials(tmp_path: Path) -> None:
    (tmp_path / "m.mtl").write_text("newmtl a\nKd 0 0 1\n")
    mesh = read(tmp_path, "mtllib m.mtl\nv 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n")
    assert corner_colors(mesh) == [[[255, 0, 0], [255, 0, 0], [0, 0, 255]]]


def test_textures_are_sampled(tmp_path: Path) -> None:
    image = Image.new("RGB", (2, 1), (255, 0, 0))
    image.putpixel((1, 0), (0, 0, 255))
    image.save(tmp_path / "wood.png")
    (tmp_path / "m.mtl").write_text("newmtl a\nKd 0.1 0.1 0.1\nmap_Kd -s 1 1 1 wood.png\n")
    with pytest.warns(InputWarning) as told:
        mesh = read(tmp_path, "mtllib m.mtl\n" + TRIANGLE + "vt 0 0\nvt 1 0\nvt 0 1\nusemtl a\nf 1/1 2/2 3/3\n")
    assert messages(told) == [f"{tmp_path / 'model.obj'}: {TEXTURED}"]
    assert corner_colors(mesh) == [[[255, 0, 0], [0, 0, 255], [255, 0, 0]]]


def test_a_broken_texture_leaves_the_color(tmp_path: Path) -> None:
    (tmp_path / "wood.png").write_bytes(b"not a picture")
    (tmp_path / "m.mtl").write_text("newmtl a\nKd 0 1 0\nmap_Kd wood.png\n")
    with pytest.warns(InputWarning) as told:
        mesh = read(tmp_path, "mtllib m.mtl\n" + TRIANGLE + "vt 0 0\nusemtl a\nf 1/1 2/1 3/1\n")
    assert corner_colors(mesh) == [[[0, 255, 0]] * 3]
    assert messages(told) == [
        f"{tmp_path / 'model.obj'}: a texture is left out: {tmp_path / 'wood.png'} is not an image that can be read"
    ]


def test_several_files_of_materials_one_of_them_missing(tmp_path: Path) -> None:
    (tmp_path / "a.mtl").write_text("newmtl a\nKd 1 0 0\n")
    (tmp_path / "b.mtl").write_text("newmtl b\nKd 0 0 1\n")
    with pytest.warns(InputWarning) as told:
        mesh = read(tmp_path, "mtllib a.mtl lost.mtl b.mtl\n" + SQUARE + "usemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\n")
    assert corner_colors(mesh) == [[[255, 0, 0]] * 3, [[0, 0, 255]] * 3]
    assert messages(told) == [
        f"{tmp_path / 'model.obj'}: its materials are left out: {tmp_path / 'lost.mtl'} does not exist"
    ]


def test_a_missing_texture_is_told_if_a_face_needs_it(tmp_path: Path) -> None:
    (tmp_path / "m.mtl").write_text("newmtl a\nKd 0 1 0\nmap_Kd oak.png\nnewmtl b\nmap_Kd ash.png\n")
    with pytest.warns(InputWarning) as told:
        read(tmp_path, "mtllib m.mtl\n" + TRIANGLE + "vt 0 0\nusemtl a\nf 1/1 2/1 3/1\nusemtl b\n")
    assert messages(told) == [f"{tmp_path / 'model.obj'}: a texture is left out: {tmp_path / 'oak.png'} does not exist"]


def test_a_texture_of_one_color_loses_nothing(tmp_path: Path) -> None:
    Image.new("RGB", (2, 2), (255, 0, 9)).save(tmp_path / "wood.png")
    (tmp_path / "m.mtl").write_text("newmtl a\nmap_Kd wood.png\n")
    mesh = read(tmp_path, "mtllib m.mtl\n" + TRIANGLE + "vt 0 0\nusemtl a\nf 1/1 2/1 3/1\n")
    assert corner_colors(mesh) == [[[255, 0, 9]] * 3]


def test_normals_that_are_numbered_and_left_out(tmp_path: Path) -> None:
    mesh = read(tmp_path, TRIANGLE + "f 1//1 2//1 3//1\n")
    assert corner_positions(mesh) == [[[0, 0, 0], [1, 0, 0], [0, 1, 0]]]
    assert mesh.normals is None


@pytest.mark.parametrize("line_end", ["\r", "\r\n"])
def test_line_ends_of_other_systems(tmp_path: Path, line_end: str) -> None:
    text = (SQUARE + "# all\nf 1 2 \\\n3 4\n").replace("\n", line_end)
    (tmp_path / "a.obj").write_bytes(text.encode())
    assert len(np.asarray(read_mesh(tmp_path / "a.obj").faces)) == 2


def test_a_concave_polygon_is_filled_as_it_is(tmp_path: Path) -> None:
    """A square with a square corner cut out, from a corner that does not see all of it."""
    mesh = read(tmp_path, "v 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 0\nv 2 0 0\nf 6 1 2 3 4 5\n")
    a, b, c = np.moveaxis(np.array(corner_positions(mesh)), 1, 0)
    areas = np.cross(b - a, c - a)[:, 2] / 2
    assert areas.min() >= 0
    assert areas.sum() == 3


def test_written_files_read_back(tmp_path: Path) -> None:
    colors = [[0, 1, 2], [127, 128, 129], [253, 254, 255]]
    mesh = Mesh(
        np.array([[0, 0.25, 1e-3], [1 / 3, 0, 0], [0, 1, 7]]), [[0, 1, 2]], colors, [[0, 0, 1], [0, 1, 0], [1, 0, 0]]
    )
    write_obj(mesh, tmp_path / "out.obj")
    back = read_mesh(tmp_path / "out.obj")
    np.testing.assert_allclose(back.positions, mesh.positions, rtol=1e-8)
    assert back.colors.tolist() == colors
    assert np.asarray(back.normals).tolist() == np.asarray(mesh.normals).tolist()
    assert back.faces.tolist() == [[0, 1, 2]]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (TRIANGLE, "it has no faces (3 vertices)"),
        ("hello\nworld\n", "it has no faces (0 vertices)"),
        (TRIANGLE + "f 1 2 4\n", "the face in line 4 names a vertex that does not exist; there are v lines 1 to 3"),
        (TRIANGLE + "f 0 1 2\n", "the face in line 4 names a vertex that does not exist; there are v lines 1 to 3"),
        (TRIANGLE + "f -4 1 2\n", "the face in line 4 names a vertex that does not exist; there are v lines 1 to 3"),
        (
            TRIANGLE + "f 1 2\np 1 2\np 3\nl 1 2 3\ncurv 0 1 1 2\nend\n",
            "it has no faces, only 3 points, 1 line, 1 face of fewer than 3 corners, 1 curve; only faces are drawn, "
            "such as those of thin tubes in place of lines and of small balls in place of points",
        ),
        (
            "v 0.1 0 0\nv 0.3 0.6 0\nv 0.7 1.8 0\nf 1 2 3\nf 1 1 2\n",
            "there is nothing to see: its 2 triangles have no area",
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
    with pytest.raises(InputError) as error:
        read(tmp_path, text)
    assert str(error.value) == f"{tmp_path / 'model.obj'}: {message}"
