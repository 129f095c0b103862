"""The definition of the renderer, contracts/picture.py, draws what the contracts draw, to what they approximate."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from tools.docs import draw_rules
from tools.pages import IMAGES

import picture
from judge import judge_pixels, render
from judge.fragments import RULES
from pictures import call_data, draw, pixels_of
from random_scenes import TAME, random_scene
from shackled import Scene
from shackled.scene._in_range import in_range

FILE = Path(picture.__file__)
#: The most lines: it is read in one sitting.
LINES = 500
#: Scenes of each kind, and the most triangles of one; of one with shadows.
SCENES, TRIANGLES, SHADOWED = 5, 600, 150
#: The least share of pixels within one level: of each kind, of all.
OF_KIND, OF_ALL = 0.985, 0.995


def scenes(kind: str) -> list[Scene]:
    """The first scenes of a kind that are small enough."""
    found: list[Scene] = []
    seed = 0
    while len(found) < SCENES:
        seed += 1
        scene = in_range(random_scene(kind, seed))
        if scene.triangles <= (SHADOWED if any(light.shadow for light in scene.lights) else TRIANGLES):
            found.append(scene)
    return found


def test_it_draws_what_the_contracts_draw() -> None:
    near, total = 0, 0
    for kind in TAME:
        off = [np.abs(picture.draw(call_data("render", s)).astype(int) - draw(s)).max(axis=2) for s in scenes(kind)]
        ones, pixels = sum(int((each <= 1).sum()) for each in off), sum(each.size for each in off)
        assert ones / pixels >= OF_KIND, kind
        near, total = near + ones, total + pixels
    assert near / total >= OF_ALL


def test_it_is_short_and_stands_alone() -> None:
    text = FILE.read_text("utf-8")
    assert len(text.splitlines()) <= LINES
    assert "shackled" not in text


def test_the_command(tmp_path: Path) -> None:
    scene = scenes("plain")[0]
    call, out = tmp_path / "call", tmp_path / "picture.ppm"
    call.write_bytes(call_data("render", scene))
    done = subprocess.run([sys.executable, FILE, call, out], capture_output=True, text=True)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    pixels = np.frombuffer(out.read_bytes()[-3 * scene.width * scene.height :], np.uint8)
    assert np.array_equal(pixels.reshape(scene.height, scene.width, 3), picture.draw(call.read_bytes()))


@pytest.mark.parametrize("size", [0, 3, 4, 36, 500, -1])
def test_wrong_calldata_gets_one_line(size: int, tmp_path: Path) -> None:
    call, out = tmp_path / "call", tmp_path / "picture.ppm"
    call.write_bytes(call_data("render", scenes("plain")[0])[:size])
    done = subprocess.run([sys.executable, FILE, call, out], capture_output=True, text=True)
    assert done.returncode == 1
    assert done.stderr.count("\n") == 1
    assert "not the calldata of render(Scene)" in done.stderr
    assert not out.exists()


@pytest.mark.parametrize("rule", RULES)
def test_the_picture_of_a_rule(rule: str) -> None:
    """Only the rule explains some pixels of the contracts; none of the definition need one."""
    scene = draw_rules.SCENES[rule]()
    call = call_data("render", scene)
    drawn, defined = (judge_pixels(rule, pixels, render(call)) for pixels in (draw(scene), picture.draw(call)))
    assert drawn.faults == defined.faults == []
    assert drawn.explained[rule] > 0
    assert defined.explained.total() == 0
    shown = pixels_of(IMAGES / f"rule-{rule}.png")[:: draw_rules.SCALE, :: draw_rules.SCALE]
    assert np.array_equal(shown, draw_rules.draw(rule)), "run python -m tools.docs.draw_rules"
