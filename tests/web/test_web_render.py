"""`render` of the TypeScript package gives the bytes, the gas and the errors of Python."""

from __future__ import annotations

import hashlib
import random
from pathlib import Path
from typing import Any

from node_scripts import BUNDLE, asked, needs_node
from pictures import chain, dynamic
from shackled import load
from shackled.errors import RenderError
from shackled.gas import profile, render_call
from shackled.scene._settings import LookOptions

NAMES = ("teapot", "icons/crown", "icons/diamond", "genesis/0", "genesis/7")

pytestmark = needs_node


def drawn_by_node(calls: list[bytes], folder: Path, does: str) -> Any:
    content = {"does": does, "package": str(BUNDLE.parents[1]), "calls": [call.hex() for call in calls]}
    return asked(Path(__file__).with_name("render_calls.mjs"), folder, content)


def drawn_by_python(call: bytes) -> dict[str, Any]:
    try:
        result = chain().call("Renderer", call)
    except RenderError as error:
        return {"name": "CallError", "message": str(error)}
    return {"gas": result.gas, "sha256": hashlib.sha256(dynamic(result.output)).hexdigest()}


def test_pictures_and_errors(tmp_path: Path) -> None:
    calls = [render_call(load(name, size=(64, 48))) for name in NAMES]
    chance = random.Random(1)
    for call in calls.copy():
        for _ in range(20):
            broken = bytearray(call)
            # mostly within the numbers before the mesh
            broken[chance.randrange(4, 1200)] = chance.randrange(256)
            # a canvas that is not too large for a test
            broken[36 : 36 + 30], broken[68 : 68 + 30] = bytes(30), bytes(30)
            broken[36 + 30], broken[68 + 30] = broken[36 + 30] & 1, broken[68 + 30] & 1
            calls.append(bytes(broken))
    found = drawn_by_node(calls, tmp_path, "render")
    assert found == [drawn_by_python(call) for call in calls]
    assert any("sha256" in each for each in found[len(NAMES) :])
    assert len({each.get("message") for each in found}) > 10


def test_gas_by_stage(tmp_path: Path) -> None:
    """All stages, for each engine, are those that `shackled gas` prints."""
    looks: tuple[LookOptions, ...] = (
        {"unlit": True, "antialias": False},
        {"smooth": False, "antialias": False},
        {"smooth": True, "antialias": False},
        {"smooth": True},
        {"exposure": 1.2, "gamma": True, "shadow": True, "ground": "gray"},
    )
    scenes = [load("icons/crown", size=(32, 24), **look) for look in looks]
    scenes += [load(name, size=(32, 24)) for name in NAMES]
    found = drawn_by_node([render_call(scene) for scene in scenes], tmp_path, "profile")
    assert [each["stages"] for each in found] == [profile(scene).stages() for scene in scenes]
    assert len({tuple(stage for stage, gas in each["stages"].items() if gas) for each in found}) > 2
