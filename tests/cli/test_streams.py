"""Standard input and standard output."""

from __future__ import annotations

import io
import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from PIL import Image as PillowImage
from trimesh.exchange.gltf import export_gltf

from commands import Shackled
from shackled import Mesh, load, render
from shackled.cli.streams import stdin_file
from shackled.scene._codec import render_call

Command = Callable[..., "subprocess.CompletedProcess[bytes]"]

TRIANGLE: Any = trimesh.Trimesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
OBJ = "# made by hand\n\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
KINDS: dict[str, str | bytes] = {kind: TRIANGLE.export(file_type=kind) for kind in ("ply", "off", "glb", "stl")}
KINDS |= {"text stl": TRIANGLE.export(file_type="stl_ascii"), "obj": OBJ}
KINDS["gltf"] = export_gltf(trimesh.Scene(TRIANGLE), embed_buffers=True)["model.gltf"]  # type: ignore[no-untyped-call]


@pytest.fixture
def shell(folder: Path) -> Command:
    def start(*arguments: str, data: bytes = b"") -> subprocess.CompletedProcess[bytes]:
        command = [sys.executable, "-m", "shackled", *arguments]
        return subprocess.run(command, input=data, capture_output=True, cwd=folder, timeout=120)

    return start


def of_stdin(data: str | bytes, monkeypatch: pytest.MonkeyPatch) -> None:
    content = data.encode() if isinstance(data, str) else data
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(content)))


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


@pytest.mark.parametrize("data", KINDS.values(), ids=KINDS)
def test_formats_are_told_by_content(data: str | bytes, monkeypatch: pytest.MonkeyPatch, shackled: Shackled) -> None:
    of_stdin(data, monkeypatch)
    shackled("render - --size 16 -o a.png --unlit")
    expected = render(Mesh(TRIANGLE.vertices, TRIANGLE.faces), 16, unlit=True).pixels
    with PillowImage.open("a.png") as picture:
        assert picture.getbbox() is not None
        assert np.array(picture).any(axis=2).sum() == expected.any(axis=2).sum()


def test_scenes_are_told_by_content(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = load("shape.obj", 8)
    scene.save("scene.json")
    render(scene).save("scene.png")
    for name, kind in (("scene.json", ".json"), ("scene.png", ".png")):
        of_stdin(Path(name).read_bytes(), monkeypatch)
        with stdin_file() as path:
            assert path.suffix == kind
            assert render_call(load(path)) == render_call(scene)
        assert not path.parent.exists()


@pytest.mark.parametrize(
    ("data", "message"),
    [
        ("", "standard input is empty"),
        ("something else", "the format of standard input is not told by its content: give a file with its extension"),
        ("ply\nnonsense\n", "standard input"),
    ],
)
def test_wrong_input(data: str, message: str, monkeypatch: pytest.MonkeyPatch, shackled: Shackled) -> None:
    of_stdin(data, monkeypatch)
    messages = shackled("render -", expect=2).err
    assert message in messages
    assert "shackled-" not in messages
    assert messages.count("\n") == 1


def test_notes_do_not_name_the_file_that_stores_it(monkeypatch: pytest.MonkeyPatch, shackled: Shackled) -> None:
    of_stdin("mtllib no.mtl\n" + OBJ, monkeypatch)
    told = "standard input: its materials are left out: no.mtl does not exist"
    assert shackled("render - --size 8").err == f"shackled: note: {told}\n"
    assert Path("picture.png").is_file()
    of_stdin("mtllib no.mtl\n" + OBJ, monkeypatch)
    assert shackled("info - --no-gas --json").json["notes"] == [told]


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
