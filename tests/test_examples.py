"""The examples do what they say."""

from __future__ import annotations

import base64
import hashlib
import io
import itertools
import json
import re
import shlex
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from examples import showcase
from PIL import Image as PillowImage
from tools.examples import compile_example, picture, token_uri
from tools.ledger import World

from compiler import needs_compiler
from pictures import dynamic
from shackled import Background, Camera, Light, Material, Mesh, Object, RenderError, Scene, load, render
from shackled.chain import open_chain
from shackled.datasets._pieces import require
from shackled.image import decode_bmp
from shackled.scene._arithmetic import from_euler
from shackled.scene._codec import render_call
from shackled.scene._staging import is_closed
from shackled.studio import store_scene

ROOT = Path(__file__).resolve().parent.parent
EXAMPLES = ROOT / "examples"


#: The gas of the pictures of the documentation, among others.
FIGURES = json.loads((ROOT / "docs" / "images" / "pictures.json").read_text("utf-8"))


def run(*command: str | Path, cwd: Path) -> str:
    return subprocess.run([sys.executable, *command], cwd=cwd, check=True, capture_output=True, text=True).stdout


def test_first_picture(tmp_path: Path) -> None:
    words = run(EXAMPLES / "first_picture.py", cwd=tmp_path)
    assert "gas on embedded EVM" in words
    with PillowImage.open(tmp_path / "first_picture.png") as picture:
        assert picture.size == (192, 144)
        assert len(np.unique(np.asarray(picture).reshape(-1, 3), axis=0)) > 500


def test_the_demo_costs_what_the_readme_says(tmp_path: Path) -> None:
    """The command as it stands in the Makefile, and the picture of the documentation that is said to be the same."""
    demo = (ROOT / "Makefile").read_text("utf-8").split("\ndemo:")[1].split("\n\n")[0].replace("\\\n", " ")
    (drawing,) = (line for line in demo.splitlines() if "shackled render" in line)
    options = shlex.split(drawing)[1:]
    run(EXAMPLES / "meshes.py", "--into", "build", "teapot", cwd=tmp_path)
    report = json.loads(run("-m", "shackled", *options, "--json", cwd=tmp_path))
    said = FIGURES["teapot"]
    assert {key: report[key] for key in said} == said
    shown = PillowImage.open(ROOT / "docs" / "images" / "teapot.png").convert("RGB")
    assert hashlib.sha256(shown.tobytes()).hexdigest() == report["sha256"]


def test_scene_file(tmp_path: Path) -> None:
    run(EXAMPLES / "meshes.py", "--into", tmp_path / "meshes", cwd=tmp_path)
    run(EXAMPLES / "meshes.py", "--into", tmp_path / "one", "ball", cwd=tmp_path)
    assert [path.name for path in (tmp_path / "one").iterdir()] == ["ball.obj"]
    (tmp_path / "scene.toml").write_bytes((EXAMPLES / "scene.toml").read_bytes())
    scene = load(tmp_path / "scene.toml")
    assert (scene.width, scene.height) == (400, 300)
    assert [o.mesh.triangles for o in scene.objects] == [4032, 1148, 960, 1280, 320, 288]
    # solids bound their volume from outside, so that nothing is missing when faces that turn away are left out
    assert [is_closed(o.mesh) for o in scene.objects if o.cull] == [True, True, True, False]
    image = render(scene, size=(48, 36))
    assert (image.triangles or 0) > 5000
    assert (image.covered_pixels or 0) > 1000
    image.save(tmp_path / "scene.png", scene=True)
    assert image.scene is not None
    assert render_call(load(tmp_path / "scene.png")) == render_call(image.scene)


@pytest.mark.parametrize("name", showcase.SCENES)
def test_a_scene_of_the_showcase_is_antialiased_and_seen(name: str) -> None:
    image = render(showcase.SCENES[name](), size=(40, 30))
    assert image.scene is not None
    assert image.scene.antialias
    assert len(np.unique(image.pixels.reshape(-1, 3), axis=0)) > 30


def test_the_showcase(tmp_path: Path) -> None:
    said = FIGURES["showcase"]
    assert said.keys() == showcase.SCENES.keys()
    words = run(EXAMPLES / "showcase.py", "--into", "deep/folder", "genesis", "wires", cwd=tmp_path)
    lines = [f"{Path('deep', 'folder', name)}.png: {said[name] / 1e6:.1f} million gas" for name in ("genesis", "wires")]
    assert words.splitlines() == lines
    with PillowImage.open(tmp_path / "deep" / "folder" / "wires.png") as picture:
        assert picture.size == showcase.SIZE
    with pytest.raises(subprocess.CalledProcessError) as failed:
        run(EXAMPLES / "showcase.py", "nothing", cwd=tmp_path)
    assert failed.value.stderr.endswith(f"there is no scene nothing; the scenes are {', '.join(showcase.SCENES)}\n")


@needs_compiler
def test_call_from_contract() -> None:
    chain = open_chain()
    creation, selectors = compile_example("examples/call_from_contract/Tetrahedron.sol")
    parts = (chain.address(name).rjust(32, b"\0") for name in ("Renderer", "PngEncoder"))
    code = chain.create("Tetrahedron", creation + b"".join(parts))
    address = b"\x7e" * 20
    chain._codes[address] = code
    try:
        turn = (-25).to_bytes(32, "big", signed=True)
        calls = (selectors[f"{name}(int256)"] + turn for name in ("bitmap", "image"))
        bitmap, uri = (dynamic(chain._run(address, call, 10**9).output) for call in calls)
    finally:
        del chain._codes[address]
    pixels = decode_bmp(bitmap, 64, 64)
    image = render(tetrahedron_scene(-25))
    assert (image.covered_pixels or 0) > 500
    # the mesh and the numbers of a scene are rounded in another way here
    difference = np.abs(pixels.astype(int) - image.pixels)
    assert np.mean(difference.max(axis=2) > 2) < 0.01
    png = base64.b64decode(uri.removeprefix(b"data:image/png;base64,"), validate=True)
    with PillowImage.open(io.BytesIO(png)) as opened:
        assert np.array_equal(np.asarray(opened), pixels.repeat(4, 0).repeat(4, 1))


def tetrahedron_scene(degrees: float) -> Scene:
    """What the contract describes."""
    mesh = Mesh(
        [[120, 120, 120], [-120, -120, 120], [-120, 120, -120], [120, -120, -120]],
        [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
        [[0xE0, 0x50, 0x3C], [0xE0, 0xB0, 0x40], [0x3F, 0x8F, 0xB5], [0x58, 0xB3, 0x68]],
    )
    solid = Object(
        mesh, rotation=from_euler((0, degrees, 0)), scale=0.01, material=Material("flat", 0.25, 0.75, 1 / 3, 20)
    )
    return Scene(
        [solid],
        Camera((0, 2, 6), (0, 0, 0), half_height=0.4, near=1),
        [Light("directional", (-1, 2, 3), (0xFF, 0xF1, 0xDC))],
        Background("#1d2433", "#8794ad"),
        width=64,
        height=64,
    )


@needs_compiler
def test_a_token_with_a_picture_of_the_studio() -> None:
    world = World()
    studio = world.address("Studio")
    for storing in store_scene(require("icons/diamond").make(), studio):
        world.run(studio, storing.data, created=True)
    source = "examples/tokens/PictureToken.sol"
    assert len((ROOT / source).read_text("utf-8").splitlines()) <= 40
    creation, _ = compile_example(source)
    token = world.deploy(creation, b"".join(address.rjust(32, b"\0") for address in (studio, storing.pointer)))
    first, second = (picture(token_uri(world, token, number, 3)) for number in (0, 2))
    assert first.shape == (512, 512, 3)
    expected = render(require("icons/diamond").make(), size=128).pixels.repeat(4, 0).repeat(4, 1)
    # the first one is not turned
    assert np.array_equal(first, expected)
    assert 0.05 < (first != second).any(axis=2).mean() < 0.6
    with pytest.raises(RenderError):
        token_uri(world, token, 3, 3)


@needs_compiler
def test_a_token_that_builds_its_scene() -> None:
    world = World()
    creation, _ = compile_example("examples/tokens/SkylineToken.sol")
    token = world.deploy(creation, world.address("Studio").rjust(32, b"\0"))
    first, second = (picture(token_uri(world, token, number, 3)) for number in (0, 2))
    assert first.shape == (512, 512, 3)
    for each in (first, second):
        assert each[0, 0].tolist() == [0x27, 0x40, 0x6B]
        # the houses: a fifth of the picture or more is not the sky, which is the same all along a row
        assert (each != each[:, :1]).any(axis=2).mean() > 0.2
        assert len(np.unique(each.reshape(-1, 3), axis=0)) > 140
    assert (first != second).any(axis=2).mean() > 0.05


def test_the_tutorial_prints_what_it_says(tmp_path: Path) -> None:
    """What stands below a command of the tutorial, but for the time that it took and the EVM that was there."""
    run(EXAMPLES / "meshes.py", "--into", tmp_path / "build", "teapot", cwd=tmp_path)
    text = (ROOT / "docs" / "tutorial.md").read_text()
    blocks = re.findall(r"^```\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
    shown = [(before, after) for before, after in itertools.pairwise(blocks) if after.startswith("picture ")]
    assert shown
    assert len(re.findall(r"^gas ", text, re.MULTILINE)) == len(shown)
    for command, printed in shown:
        program, *arguments = shlex.split(command)
        assert program == "shackled"
        found = run("-c", "from shackled.cli import main; main()", *arguments, cwd=tmp_path)
        assert rows(found) == rows(printed), f"docs/tutorial.md must show\n{found}"


def rows(printed: str) -> dict[str, str]:
    parts = [line.split(maxsplit=1) for line in printed.splitlines()]
    return {name: value for name, value in parts if name in ("picture", "drawn", "gas")}
