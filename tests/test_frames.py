"""The frames of animations of glTF files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image as PillowImage
from PIL import ImageSequence

from animated_gltf import write
from shackled import InputError, animate, load
from shackled._load import load_frames
from shackled.cli.app import run

#: A look in which the model is red on black, whatever the light.
PLAIN: dict[str, Any] = {"size": 48, "unlit": True, "antialias": False, "azimuth": 0, "elevation": 0}
PLAIN |= {"orthographic": True, "background": "black", "margin": 0}


@pytest.fixture
def file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    write(Path("walk.gltf"))
    return Path("walk.gltf")


def columns(pixels: np.ndarray) -> list[int]:
    """Return the first and the last column that is red."""
    found = np.flatnonzero((pixels == (255, 0, 0)).all(axis=2).any(axis=0))
    return [int(found[0]), int(found[-1])]


def test_the_frames_are_equal_steps_for_a_camera_that_stands_still(file: Path) -> None:
    film = animate(file, 4, **PLAIN)
    # at 0, 0.5, 1 and 1.5 s the middle is at -6, -3, 0 and 3: a width of 11, in 48 pixels
    expected = [[48 / 11 * (x + 6), 48 / 11 * (x + 8) - 1] for x in (-6, -3, 0, 3)]
    np.testing.assert_allclose([columns(frame.pixels) for frame in film.frames], expected, atol=1)
    assert film.duration == 500  # at the pace of the file
    assert animate(file, 4, duration=30, **PLAIN).duration == 30
    scenes, length = load_frames(file, 3, animation="Spin")
    assert length == 4
    assert len({(each.camera.eye.tolist() == scenes[0].camera.eye.tolist()) for each in scenes}) == 1
    assert animate(file, 200, **{**PLAIN, "size": 2}).duration == 20  # as fast as viewers show


def test_a_look_is_that_of_all_frames(file: Path) -> None:
    scenes, _ = load_frames(file, 4, 40, ground="tan", fog="white", color="blue", animation=1)
    assert {(each.width, each.objects[0].mesh.colors.tolist()[0][2]) for each in scenes} == {(40, 255)}
    assert len({each.ground for each in scenes}) == len({each.fog for each in scenes}) == 1
    ground = scenes[0].ground
    assert ground is not None
    assert ground.height is not None
    assert ground.height < min(float(each.bounds[0][1]) for each in scenes)
    turned = load(file, 40, animation=1, time=1).objects[0].mesh.positions
    np.testing.assert_allclose(scenes[1].objects[0].mesh.positions, turned)
    transparent = animate(file, 2, transparent=True, **PLAIN)
    assert transparent.frames[0].alpha is not None


def test_the_camera_of_a_file(file: Path) -> None:
    camera = {"type": "orthographic", "orthographic": {"xmag": 8, "ymag": 8, "znear": 0.1, "zfar": 9}}
    nodes = [{"mesh": 0}, {"camera": 0, "translation": [0, 0, 5]}]
    write(file, cameras=[camera], nodes=nodes, scenes=[{"nodes": [0, 1]}])
    film = animate(file, 2, 32, use_camera=0, unlit=True, antialias=False, background="black")
    assert [columns(frame.pixels) for frame in film.frames] == [[2, 5], [14, 17]]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"frames": 1}, "the number of frames of an animation must be a whole number from 2 to 720, not 1"),
        ({"frames": 2.5}, "the number of frames of an animation must be a whole number from 2 to 720, not 2.5"),
        ({"time": 1}, "`time` is for one picture: frames take all times of an animation"),
        ({"animation": "Run"}, "walk.gltf: it has no animation 'Run'; it has 0 Slide, 1 Spin"),
        ({"thing": "cube"}, "cube has no animation: those of glTF files are read, .glb or .gltf"),
    ],
)
def test_what_has_no_frames(file: Path, arguments: dict[str, Any], message: str) -> None:
    with pytest.raises(InputError) as error:
        animate(**{"thing": file, "frames": 2, **arguments})
    assert str(error.value) == message


def test_the_command(file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    options = ["--size=24", "--unlit", "--no-antialias", "--azimuth=0", "--elevation=0", "--orthographic"]
    options += ["--background=black", "--margin=0"]
    expected = animate(file, 4, **{**PLAIN, "size": 24}).pixels
    assert run(["render", "walk.gltf", "--frames", "4", *options]) == 0
    assert "walk.gif, 4 frames of 24 x 24 pixels" in capsys.readouterr().out
    with PillowImage.open("walk.gif") as film:
        found = [(np.array(each.convert("RGB")), each.info["duration"]) for each in ImageSequence.Iterator(film)]
    assert [time for _, time in found] == [500] * 4
    assert (np.stack([pixels for pixels, _ in found]) == expected).all()
    for output, is_there in (("a.png", Path("a.png")), ("a.webp", Path("a.webp")), ("b", Path("b/003.png"))):
        assert run(["render", "walk.gltf", "--frames=4", "--animation=Spin", *options, "-o", output, "-q"]) == 0
        assert is_there.is_file()
    write(Path("other.gltf"))
    assert run(["render", "walk.gltf", "other.gltf", "--frames=2", "-o", "{stem}.mp4", *options, "--duration=90"]) == 0
    assert Path("other.mp4").is_file()


def test_info_names_the_animations(file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["info", "walk.gltf", "--no-gas"]) == 0
    assert "animated  0 Slide (2 s), 1 Spin (4 s)\n" in capsys.readouterr().out


def test_a_file_without_animations_says_so(file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(Path("still.gltf"), animations=[])
    assert run(["render", "still.gltf", "--frames", "3"]) == 2
    assert capsys.readouterr().err == "shackled: still.gltf: it has no animations\n"
