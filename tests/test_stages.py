"""The pictures of the pipeline."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from pictures import pixels_of
from shackled import Background, Camera, Light, Material, Mesh, Object, Scene, render
from shackled.cli.app import run
from shackled.datasets import teapot
from shackled.scene import stage
from shackled.stages import Stage, draw_stages, nothing, strip

TRIANGLE = Mesh([(-1, -1, 0), (1, -1, 0), (-1, 1, 0)], [(0, 1, 2)], [(255, 0, 0), (0, 255, 0), (0, 0, 255)])


def scene(**changes: object) -> Scene:
    """A lit triangle; the corners fall on (8, 24), (24, 24) and (8, 8) of 32 x 32 pixels."""
    given: dict[str, object] = {
        "objects": [Object(TRIANGLE, (0, 0, -2), material=Material("flat", 0.3, 0.6, 0))],
        "camera": Camera(projection="orthographic", half_height=2),
        "lights": [Light("directional", (0, 0, 1))],
        "background": Background((0, 0, 90), (0, 0, 160)),
        "width": 32,
        "height": 32,
    }
    return Scene(**(given | changes))  # type: ignore[arg-type]


def drawn(picture: Stage, of: Scene) -> np.ndarray:
    """Where a stage shows something."""
    shown: np.ndarray = (picture.pixels != nothing(of)).any(axis=2)
    return shown


def test_a_triangle_becomes_a_picture() -> None:
    of = scene()
    points, projected, triangles, filled, lit, picture = draw_stages(of)
    # the corners, and nothing in the middle
    seen = drawn(projected, of)
    for column, row in ((8, 24), (24, 24), (8, 8)):
        assert seen[row - 1 : row + 1, column - 1 : column + 1].any()
    assert not seen[15:20, 11:14].any()
    assert drawn(points, of).sum() < 100
    # edges, and what they enclose
    inside = drawn(filled, of)
    assert not drawn(triangles, of)[18, 12]
    assert inside[18, 12]
    assert drawn(triangles, of)[8:24, 7:9].any(axis=1).all()
    # 16 x 16 / 2, by the fill rule
    assert inside.sum() == render(of).covered_pixels
    assert (drawn(lit, of) == inside).all()
    # light darkens, and the picture is light over the background
    assert lit.pixels[inside].sum() < filled.pixels[inside].sum() * 2.3
    assert (picture.pixels[inside] == lit.pixels[inside]).all()
    assert (picture.pixels[~inside] == render(scene(objects=[])).pixels[~inside]).all()


def test_the_picture_is_the_one_that_render_makes() -> None:
    of = stage(teapot(2), (48, 40), invert=True)
    stages = draw_stages(of)
    image = render(of)
    assert (stages[-1].pixels == image.pixels).all()
    assert f"{image.gas:,} gas" in stages[-1].detail
    assert f"{image.triangles:,} triangles" in stages[2].detail
    assert f"{image.covered_pixels:,} pixels" in stages[3].detail
    assert len({each.pixels.tobytes() for each in stages}) == 6
    # inversion belongs to the last stage
    inside = drawn(stages[4], of)
    assert (stages[4].pixels[inside] == 255 - image.pixels[inside]).all()


def test_points_behind_the_eye_are_not_projected() -> None:
    behind = Object(TRIANGLE, (0, 0, 5), material=Material("unlit"))
    of = scene(objects=[behind], camera=Camera(near=0.1))
    stages = draw_stages(of)
    assert drawn(stages[0], of).any()
    assert [drawn(each, of).any() for each in stages[1:5]] == [False] * 4
    assert stages[1].detail == "0 points on the canvas"


def test_the_first_stage_knows_place_scale_and_rotation() -> None:
    # a quarter turn about z takes +x to +y
    point = Mesh([(0, 0, 0), (1, 0, 0), (0, 0, 0)], [(0, 1, 2)], [(255, 0, 0), (0, 255, 0), (255, 0, 0)])
    of = scene(objects=[Object(point, (7, -3, 0), (0, 0, 0.5**0.5, 0.5**0.5), 2.0)])
    pixels = draw_stages(of)[0].pixels.astype(int)
    red, green = (np.argwhere(pixels[:, :, one] - pixels[:, :, 1 - one] > 50).mean(axis=0) for one in (0, 1))
    assert green[0] < red[0] - 15
    assert green[1] == pytest.approx(red[1], abs=1)


def test_an_empty_scene_has_stages() -> None:
    of = scene(objects=[], lights=[])
    stages = draw_stages(of)
    assert not any(drawn(each, of).any() for each in stages[:5])
    assert strip(stages).size[0] > strip(stages).size[1]


def test_the_command_writes_pictures(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = tmp_path / "stages"
    look = ["--size", "32", "--light", "point:1,2,3:#ff8800", "--background", "#102030,#405060", "--orthographic"]
    assert run(["stages", "teapot", "-o", str(folder), *look]) == 0
    names = ["1-vertices", "2-projected", "3-triangles", "4-filled", "5-lit", "6-picture", "strip"]
    assert sorted(path.stem for path in folder.iterdir()) == names
    assert "compositing, 32 x 32 pixels" in capsys.readouterr().out
    pictures = {name: pixels_of(folder / f"{name}.png") for name in names}
    assert {pictures[name].shape for name in names[:-1]} == {(32, 32, 3)}
    assert pictures["strip"].shape[1] > 6 * 224
    assert run(["render", "teapot", "-o", str(tmp_path / "whole.png"), *look]) == 0
    assert (pixels_of(tmp_path / "whole.png") == pictures["6-picture"]).all()
