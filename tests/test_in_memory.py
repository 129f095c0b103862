"""What is handed in without a file of its own: bytes, open files, pipes, and meshes of other libraries."""

from __future__ import annotations

import gzip
import io
import os
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import trimesh
from PIL import Image

import case_files
import shackled
from shackled import InputError, Texture, load, render
from shackled.cli.app import run

V, F = case_files.CORNERS, np.array(case_files.FACES)
OBJ = case_files.SQUARE.encode()
LOOK = {"size": 16, "unlit": True, "background": "black"}


def picture(thing: Any, **look: Any) -> Any:
    return render(thing, **{**LOOK, **look}).pixels


@pytest.fixture(autouse=True)
def _in_a_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def test_content_of_files() -> None:
    expected = picture((V, F))
    assert expected.any()
    with open("square.obj", "wb+") as file:
        file.write(OBJ)
        file.seek(0)
        contents = [
            OBJ,
            bytearray(OBJ),
            memoryview(OBJ),
            io.BytesIO(OBJ),
            io.StringIO(OBJ.decode()),
            gzip.compress(OBJ, mtime=0),
        ]
        for thing in (*contents, case_files.ply(), file):
            assert (picture(thing) == expected).all()
    with open("square.obj") as text:
        assert (picture(text) == expected).all()
    assert len(load([OBJ, io.BytesIO(case_files.ply())]).objects) == 2
    scene = load("cube", 8)
    scene.save("scene.json")
    assert load(Path("scene.json").read_bytes()) == load("scene.json")


def test_an_open_file_finds_what_is_beside_it(tmp_path: Path) -> None:
    case_files.written(tmp_path, case_files.FILES["comma_materials"])
    Path("m.mtl").write_text("newmtl a\nKd 1 0 0\n")
    with open("x.obj", "rb") as file:
        assert [*np.unique(picture(file).reshape(-1, 3), axis=0)[-1]] == [255, 0, 0]
    with pytest.warns(match=r"^the data: its materials are left out: m\.mtl does not exist$"):
        load(Path("x.obj").read_bytes())


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "the data is empty"),
        (b"some words", "the format of the data is not told by its content"),
        (b"PK\3\4" + bytes(99), "the data is a zip archive: unpack it"),
        (gzip.compress(OBJ, mtime=0)[:-9], "the data is cut off"),
        (b"v 0 0 0\nv 1 0 0\nf 1 2 3 x\n", "the data: line 3"),
    ],
)
def test_wrong_content(content: bytes, message: str) -> None:
    for thing in (content, io.BytesIO(content)):
        with pytest.raises(InputError) as error:
            load(thing)
        assert str(error.value).startswith(message)
        assert "/" not in str(error.value)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no pipes with names here")
def test_pipes(capsys: pytest.CaptureFixture[str]) -> None:
    def pipe(content: bytes) -> str:
        reader, writer = os.pipe()
        os.write(writer, content)
        os.close(writer)
        return f"/dev/fd/{reader}"

    assert (picture(pipe(OBJ)) == picture((V, F))).all()
    place = pipe(b"mtllib no.mtl\n" + gzip.decompress(gzip.compress(OBJ, mtime=0)))
    assert run(["render", place, "-q", "--size", "8"]) == 0
    assert Path("picture.png").is_file()
    place = pipe(b"PK\3\4" + bytes(99))
    assert run(["render", place]) == 2
    assert capsys.readouterr().err.startswith(f"shackled: {place} is a zip archive: ")
    os.mkfifo("nobody.obj")  # into which nobody writes
    with pytest.raises(InputError, match=r"nobody\.obj is empty$"):
        load("nobody.obj")


class Mixed(SimpleNamespace):
    """As PyVista has it: faces of different sizes in one row, and no regular ones."""

    @property
    def regular_faces(self) -> None:
        raise ValueError("Mesh has irregular faces.")


def cells(**blocks: Any) -> Any:
    return [SimpleNamespace(type=kind, data=np.array(data)) for kind, data in blocks.items()]


@pytest.mark.parametrize(
    "thing",
    [
        SimpleNamespace(vertices=V, triangles=F, vertex_colors=np.zeros((0, 3)), vertex_normals=np.zeros((0, 3))),
        SimpleNamespace(vertices=V.tolist(), faces=F.tolist()),
        SimpleNamespace(points=V, regular_faces=F),
        SimpleNamespace(points=V, faces=np.array([4, 0, 1, 2, 3])),
        Mixed(points=np.vstack([V, V[:1]]), faces=np.array([3, 0, 1, 2, 3, 4, 2, 3])),
        SimpleNamespace(points=V[:, :2], cells=cells(quad=[[0, 1, 2, 3]]), read=None),
        SimpleNamespace(points=V, cells=cells(triangle=F[:1], triangle6=[[0, 2, 3, 1, 1, 1]])),
    ],
)
def test_meshes_of_other_libraries(thing: Any) -> None:
    assert (picture(thing) == picture((V, F))).all()
    assert len(load([thing, (V, F)]).objects) == 2


def test_colours_and_cells_of_other_libraries() -> None:
    red = SimpleNamespace(vertices=V, triangles=F, vertex_colors=np.array([(1.0, 0, 0)] * 4))
    assert (picture(red) == picture((V, F, "red"))).all()
    both = SimpleNamespace(points=V, cells=cells(line=[[0, 1]], triangle=F))
    with pytest.warns(match=r"^cells of the mesh are left out, for they are no surface: line$"):
        assert (picture(both) == picture((V, F))).all()
    for thing, message in (
        (SimpleNamespace(points=V, cells=cells(tetra=[[0, 1, 2, 3]])), r"only cells of the kinds tetra"),
        (SimpleNamespace(points=V, extract_surface=None), r"mesh\.extract_surface\(\)"),
        (SimpleNamespace(points=V, faces=np.array([3, 0, 1])), r"must each follow their number of corners, not 3"),
        (SimpleNamespace(points=V), r"a mesh of PyVista, Open3D or meshio$"),
    ):
        with pytest.raises(InputError, match=message):
            load(thing)


def test_a_mesh_of_trimesh_that_is_hidden() -> None:
    hidden, shown = (trimesh.Trimesh(V, F, process=False, face_colors=(255, 0, 0, alpha)) for alpha in (0, 255))
    with pytest.warns(match=r"^the mesh: its opacity is 0 everywhere"):
        assert (picture(hidden) == picture(shown)).all()
    with pytest.warns(match=r"^the scene: its opacity is 0 everywhere"):
        load(trimesh.Scene([hidden]))
    # what is given as arrays is meant
    assert not picture((V, F, [(255, 0, 0, 0)] * 4)).any()


def test_textures_and_pictures() -> None:
    stream = io.BytesIO()
    Image.new("RGB", (4, 4), "red").save(stream, "PNG")
    expected = Texture.open(Image.new("RGB", (4, 4), "red"))
    Path("a.png").write_bytes(stream.getvalue())
    with open("a.png", "rb") as file:
        assert Texture.open(stream.getvalue()) == Texture.open(stream) == Texture.open(file) == expected
    for wrong in (b"no image", 5, None):
        with pytest.raises(InputError, match=r"^the image is not an image that can be read$"):
            Texture.open(wrong)  # type: ignore[arg-type]
    Path("b.png").write_bytes(b"version https://git-lfs.github.com/spec/v1\n")
    with pytest.raises(InputError, match=r"^b\.png is not an image that can be read: it is a Git LFS pointer"):
        Texture.open("b.png")
    made, saved = render("cube", 8), io.BytesIO()
    made.save(saved, format="PNG")
    assert saved.getvalue() == made.encode(".png")
    shackled.Animation([made, made]).save(saved := io.BytesIO(), format="gif")
    assert saved.getvalue().startswith(b"GIF89a")


def test_lit_pixels_differ_from_the_background() -> None:
    made = render((V, F), size=16, unlit=True, margin=0.5, antialias=False)
    assert made.visible_pixels == made.covered_pixels
    assert 0 < (made.covered_pixels or 0) < 256
    alike: dict[str, Any] = {"color": "#102030", "background": "#102030"}
    faded = render((V, F), size=16, unlit=True, margin=0.5, antialias=False, **alike)
    assert (faded.visible_pixels, faded.covered_pixels) == (0, made.covered_pixels)
    clear = render((V, F), size=16, transparent=True)
    assert clear.alpha is not None
    assert clear.visible_pixels == np.count_nonzero(clear.alpha)
