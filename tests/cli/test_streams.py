"""Standard input and standard output."""

from __future__ import annotations

import io
import json
import os
import subprocess
import sys
from base64 import b64encode
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from PIL import Image as PillowImage

from shackled import Mesh, load, render
from shackled.cli.app import run
from shackled.cli.streams import stdin_file
from shackled.scene import render_call

Command = Callable[..., "subprocess.CompletedProcess[bytes]"]

TRIANGLE = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
PLY = (
    b"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    b"element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"
)
BINARY_STL = bytes(80) + (1).to_bytes(4, "little") + np.array([(0, 0, 1), *TRIANGLE], "<f4").tobytes() + bytes(2)
TEXT_STL = (
    b"solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n"
)
OBJ = b"# made by hand\n\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


def gltf() -> bytes:
    data = np.array(TRIANGLE, "<f4").tobytes()
    uri = f"data:application/octet-stream;base64,{b64encode(data).decode()}"
    document = {
        "asset": {"version": "2.0"},
        "buffers": [{"byteLength": len(data), "uri": uri}],
        "bufferViews": [{"buffer": 0, "byteLength": len(data)}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "nodes": [{"mesh": 0}],
        "scenes": [{"nodes": [0]}],
    }
    return json.dumps(document).encode()


def glb() -> bytes:
    text = gltf()
    text += b" " * (-len(text) % 4)
    words = (len(text) + 20, len(text))
    return (
        b"glTF"
        + b"".join(
            number.to_bytes(4, "little") for number in (2, words[0], words[1], int.from_bytes(b"JSON", "little"))
        )
        + text
    )


@pytest.fixture
def shell(folder: Path) -> Command:
    def start(*arguments: str, data: bytes = b"") -> subprocess.CompletedProcess[bytes]:
        command = [sys.executable, "-m", "shackled", *arguments]
        return subprocess.run(command, input=data, capture_output=True, cwd=folder, timeout=120)

    return start


def of_stdin(data: bytes, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(data)))


@pytest.mark.parametrize("output", ["-", "/dev/stdout"])
def test_a_mesh_comes_and_a_picture_goes(shell: Command, output: str) -> None:
    done = shell("render", "-", "-o", output, "--size", "20", data=Path("shape.obj").read_bytes())
    assert done.returncode == 0
    assert b"picture  standard output, 20 x 20 pixels" in done.stderr
    with PillowImage.open(io.BytesIO(done.stdout)) as picture:
        assert (np.array(picture) == render("shape.obj", 20).pixels).all()
    # with its scene
    Path("again.png").write_bytes(done.stdout)
    assert render_call(load("again.png")) == render_call(load("shape.obj", 20))
    assert not Path("-").exists()


def test_a_turntable_goes_as_png_and_json_to_stderr(shell: Command) -> None:
    done = shell("render", "shape.obj", "-o", "-", "--size", "8", "--turntable", "3", "--json")
    with PillowImage.open(io.BytesIO(done.stdout)) as film:
        assert (film.format, film.n_frames) == ("PNG", 3)  # type: ignore[attr-defined]
    assert json.loads(done.stderr.splitlines()[-1])["output"] == "-"


def test_quiet_leaves_the_picture(shell: Command) -> None:
    done = shell("render", "-", "-q", "-o", "-", "--size", "8", data=Path("shape.obj").read_bytes())
    assert (done.returncode, done.stderr) == (0, b"")
    assert done.stdout.startswith(b"\x89PNG")


def test_a_reader_that_leaves(shell: Command) -> None:
    command = f"{sys.executable} -m shackled render shape.obj -o - --size 400 | true"
    done = subprocess.run(["sh", "-c", command], capture_output=True, text=True, timeout=120)
    assert "Traceback" not in done.stderr


KINDS = {
    ".ply": PLY,
    ".obj": OBJ,
    ".off": b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
    ".gltf": gltf(),
    ".glb": glb(),
}


@pytest.mark.parametrize("data", [*KINDS.values(), BINARY_STL, TEXT_STL], ids=[*KINDS, "binary .stl", "text .stl"])
def test_formats_are_told_by_content(data: bytes, monkeypatch: pytest.MonkeyPatch) -> None:
    of_stdin(data, monkeypatch)
    assert run(["render", "-", "--size", "16", "-o", "a.png", "--unlit"]) == 0
    expected = render(Mesh(TRIANGLE, [[0, 1, 2]]), 16, unlit=True).pixels
    with PillowImage.open("a.png") as picture:
        assert picture.getbbox() is not None
        assert np.array(picture).any(axis=2).sum() == expected.any(axis=2).sum()


def test_scenes_are_told_by_content(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = load("shape.obj", 8)
    scene.save("scene.json")
    render(scene).save("scene.png")
    for name, kind in (("scene.json", ".json"), ("scene.png", ".png")):
        of_stdin(Path(name).read_bytes(), monkeypatch)
        with stdin_file(None) as path:
            assert path.suffix == kind
            assert render_call(load(path)) == render_call(scene)
        assert not path.parent.exists()


@pytest.mark.parametrize(
    ("data", "options", "message"),
    [
        (b"", [], "standard input is empty"),
        (b"something else", [], "the format of standard input is not told by its content: give --format obj|ply"),
        (PLY, ["--format", "obj"], "standard input"),
        (PLY, ["--format", "max"], "--format must be one of obj, ply, stl"),
        (b"ply\nnonsense\n", [], "standard input"),
    ],
)
def test_wrong_input(
    data: bytes, options: list[str], message: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    of_stdin(data, monkeypatch)
    assert run(["render", "-", *options]) == 2
    messages = capsys.readouterr().err
    assert message in messages
    assert "shackled-" not in messages
    assert messages.count("\n") == 1


def test_the_format_of_a_named_input_is_its_extension(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["render", "shape.obj", "--format", "obj"]) == 2
    assert "--format is for -, standard input" in capsys.readouterr().err


def test_notes_do_not_name_the_file_that_stores_it(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    data = b"mtllib no.mtl\n" + OBJ
    of_stdin(data, monkeypatch)
    assert run(["render", "-", "--size", "8"]) == 0
    told = "standard input: its materials are left out: no.mtl does not exist"
    assert capsys.readouterr().err == f"shackled: note: {told}\n"
    assert Path("picture.png").is_file()
    of_stdin(data, monkeypatch)
    assert run(["info", "-", "--no-gas", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["notes"] == [told]


@pytest.mark.skipif(not hasattr(os, "openpty"), reason="there are no terminals here")
def test_terminals_are_refused(folder: Path) -> None:
    ours, terminal = os.openpty()
    try:
        for arguments, streams, message in (
            (["shape.obj", "-o", "-"], {"stdout": terminal}, "the picture would be written to the terminal"),
            (["-"], {"stdin": terminal, "stdout": subprocess.DEVNULL}, "- reads standard input: pipe a mesh"),
        ):
            done = subprocess.run(
                [sys.executable, "-m", "shackled", "render", *arguments],
                stderr=subprocess.PIPE,
                text=True,
                timeout=60,
                **streams,  # type: ignore[call-overload]
            )
            assert done.returncode == 2
            assert message in done.stderr
    finally:
        os.close(ours)
        os.close(terminal)
