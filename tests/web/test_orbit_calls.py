"""Cameras that the page of the Creator moves in a browser are those that the server moves."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from dataclasses import asdict, replace
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from node_scripts import answers
from pictures import chain
from shackled.chain import returned_bytes
from shackled.creator import Lamp, Orbit, Pose, Size, Source, State, describe, drag, filled, pan, to_scene, zoom
from shackled.datasets import require
from shackled.image import decode_bmp
from shackled.scene import fit_factor, render_call

SCRIPT = Path(__file__).with_name("orbits.mjs")
BUNDLE = files("shackled") / "web" / "live.js"

pytestmark = pytest.mark.skipif(not shutil.which("node"), reason="there is no Node")

LAMPS = (
    Lamp("directional", 20, 40),
    Lamp("point", -60, 10, 2.5, "#ff8040"),
    Lamp("spot", 80, 50, 3.0, "#4080ff", target=(0.1, 0.2, 0.0)),
)
CAMERA = Orbit((0.1, -0.05, 0.2), 3.1, 25.0, 15.0)
MOVES: list[list[Any]] = [["drag", 0.31, 0.12], ["zoom", 3.5], ["pan", 0.07, -0.11], ["drag", -0.9, 0.05]]
STATES = {
    "perspective": State(Source("piece", "teapot"), camera=CAMERA),
    "own camera": State(Source("piece", "genesis/5")),
    "exact": State(Source("piece", "tetrahedron")),
    "rolled": State(Source("piece", "teapot"), camera=replace(CAMERA, roll=35.0, fov=30.0), lights=LAMPS),
    "orthographic": State(Source("piece", "icons/diamond"), camera=replace(CAMERA, projection="orthographic")),
    "lights that follow": State(Source("piece", "teapot"), camera=CAMERA, lights=LAMPS, lights_follow=True),
    "posed": State(
        Source("piece", "icons/diamond"),
        camera=replace(CAMERA, roll=-20.0),
        lights=LAMPS,
        lights_follow=True,
        pose=Pose((0.4, 0.1, -0.2), (10, 20, 30), 0.7),
    ),
}
DO: dict[str, Callable[..., Orbit]] = {"drag": drag, "zoom": zoom, "pan": pan}


@pytest.mark.parametrize("name", STATES)
def test_a_camera_moved_in_the_browser_sees_what_the_servers_sees(name: str, tmp_path: Path) -> None:
    source = require(STATES[name].source.name).make()
    facts = describe(STATES[name].source, source, name)
    state = replace(STATES[name], size=Size(96, 80))
    camera = filled(state, facts).camera
    assert camera is not None
    scene = to_scene(replace(state, camera=camera), source)
    base = {
        "camera": asdict(camera),
        "radius": fit_factor(scene) * facts.bounds.radius,
        "follow": state.lights_follow,
    }
    cases = [[], MOVES[:1], MOVES[:2], MOVES, [["drag", 0.0, 3.0]]]
    lines = [{"call": render_call(scene).hex(), "base": base, "moves": moves} for moves in cases]
    for moves, (call, there) in zip(cases, moved(lines, tmp_path), strict=True):
        here = camera
        for do, *amounts in moves:
            here = DO[do](here, *amounts)
        for key, value in asdict(here).items():
            assert there[key] == (pytest.approx(value, rel=1e-5, abs=1e-4) if key != "projection" else value)
        expected = to_scene(replace(state, camera=here), source)
        assert difference(picture(call), picture(render_call(expected))) < 0.5


def moved(lines: list[dict[str, Any]], folder: Path) -> list[tuple[bytes, dict[str, Any]]]:
    """The calls, and the cameras."""
    found = answers(SCRIPT, BUNDLE, lines, folder)
    return [(call, json.loads(there)) for call, there in zip(found[::2], found[1::2], strict=True)]


def picture(call: bytes) -> np.ndarray[Any, Any]:
    made = decode_bmp(returned_bytes(chain().call("Renderer", call).output, 0), 96, 80)
    assert len(np.unique(made.reshape(-1, 3), axis=0)) > 4
    return made


def difference(one: np.ndarray[Any, Any], other: np.ndarray[Any, Any]) -> float:
    """The mean difference of two pictures, in levels."""
    return float(np.abs(one.astype(int) - other).mean())
