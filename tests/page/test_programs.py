"""Programs and commands that the Creator writes make the same picture again."""

from __future__ import annotations

import base64
import io
import json
import re
import runpy
from pathlib import Path
from typing import Any

import pytest
from eth_abi.abi import encode as encode_abi
from PIL import Image as PillowImage
from tools import build_contracts as tool

from compiler import needs_compiler
from node_scripts import asked, needs_web
from pictures import local
from shackled import load, render
from shackled.artifacts import RENDERER
from shackled.chain._chain import returned_bytes
from shackled.gas import render_call
from shackled.scene._codec import extensions
from shackled.scene._in_range import in_range
from shackled.scene._packed import pack
from shackled.web._page import asset

LOCAL, LINK = "http://127.0.0.1:8000/creator.html#1abc", "https://pictures.example/creator/#1abc"
LOOK = {
    "hemisphere": {"sky": "#336699", "ground": "#221100"},
    "rim": {"color": "#ffcc88", "power": 4},
    "fog": {"color": "#8892a2", "near": 1.5, "far": 9},
    "tone": {"exposure": 1.25, "filmic": True, "gamma": False},
    "antialias": True,
    "width": 40,
    "height": 32,
    "lights": [
        {"kind": "spot", "position": [2, 3, 3], "direction": [-2, -3, -3], "color": "#ffeecc", "innerAngle": 5,
         "outerAngle": 30, "shadow": False},
        {"kind": "directional", "direction": [0.3, 1, 0.5], "color": "#ffffff", "shadow": True},
        {"kind": "point", "position": [-2, 1, 2], "color": "#4060ff", "shadow": False},
    ],
    "ground": {"color": "#a09080", "height": -1.2, "radius": 4, "center": [0, 0], "inner": 1},
}  # fmt: skip
SMALL = {"width": 32, "height": 32}
CASES: dict[str, dict[str, Any]] = {
    "plain": {"piece": "tetrahedron", "changes": SMALL},
    "everything": {"piece": "icons/coin", "changes": {**LOOK, "title": "A 'coin', \"gold\"\n# of Zoë"},
                   "item": {"color": "#d4af37", "opacity": 0.7, "rotation": [10, 20.5, -30], "scale": 0.9}},
    "creased": {"piece": "icons/crystals", "changes": SMALL, "item": {"crease": 40, "material": {"shading": "smooth"}}},
    "smooth": {"piece": "icosahedron", "changes": SMALL, "item": {"material": {"shading": "smooth"}, "cull": False}},
    "several": {"piece": "cornell-box", "changes": {**SMALL, "invert": True}, "item": {"wireframe": True}},
    "simplified": {"piece": "icosphere", "changes": SMALL, "item": {"maxTriangles": 200}},
    "opened": {"piece": "tetrahedron", "changes": {**SMALL, "title": "3d.glb"}, "opened": True, "link": LINK},
    "opened, large": {"piece": "icosphere", "changes": {**SMALL, "title": "Scene"}, "opened": True},
    "given meshes": {"piece": "icosahedron", "changes": LOOK, "most": 0},
}  # fmt: skip

pytestmark = needs_web


@pytest.fixture(scope="module")
def programs(tmp_path_factory: pytest.TempPathFactory) -> dict[str, dict[str, Any]]:
    """All programs of all cases."""
    content = {
        "pieces": {name: json.loads(load(name).encode()) for name in {c["piece"] for c in CASES.values()}},
        "cases": [{"item": {}, "opened": False, "link": LOCAL, **case} for case in CASES.values()],
        "evm": base64.b64encode(asset("evm.wasm")).decode(),
        "contracts": json.loads(asset("contracts.json")),
    }
    script = Path(__file__).with_name("programs.ts")
    return dict(zip(CASES, asked(script, tmp_path_factory.mktemp("programs"), content), strict=True))


@pytest.mark.parametrize("name", CASES)
def test_the_scene_file_and_the_python_program_make_the_picture(
    programs: dict[str, dict[str, Any]], name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    made = programs[name]
    stem, text, picture = made["stem"], made["python"], base64.b64decode(made["bmp"])
    assert stem == {"everything": "a-coin-gold-of-zoe", "opened": "3d"}.get(name, stem)
    monkeypatch.chdir(tmp_path)
    Path("a.json").write_text(made["scene"])
    scene = load("a.json")
    assert render_call(scene).hex() == made["call"][2:]
    assert render(scene).bmp == picture
    Path(f"{stem}.py").write_text(text)
    if ".json" in text:
        Path("a.json").rename(f"{stem}.json")
    runpy.run_path(f"{stem}.py")
    with PillowImage.open(f"{stem}.png") as ours, PillowImage.open(io.BytesIO(picture)) as theirs:
        assert ours.convert("RGB").tobytes() == theirs.convert("RGB").tobytes()
    assert (".json" in text) == (name in ("simplified", "opened, large"))
    assert ("The link works on this computer only." in text) == (CASES[name].get("link") != LINK)
    Path("other.py").write_text(text.replace("half_height=", "half_height=2 * "))
    with pytest.raises(AssertionError):
        runpy.run_path("other.py")


@pytest.mark.parametrize(
    ("name", "licence", "beside"),
    [
        ("plain", "CC0-1.0", "The licence of this mesh: CC0"),
        ("everything", "MIT", "The licence of this mesh: MIT"),
        ("opened", "UNLICENSED", "do not publish the mesh without permission"),
        ("given meshes", "MIT", ""),
    ],
)
def test_meshes_keep_their_licence(programs: dict[str, dict[str, Any]], name: str, licence: str, beside: str) -> None:
    lines = programs[name]["solidity"].splitlines()
    assert lines[0] == f"// SPDX-License-Identifier: {licence}"
    literals = [number for number, line in enumerate(lines) if "mesh: bytes.concat" in line]
    assert bool(literals) == bool(beside)
    # a ground, the last one, is nobody's work
    assert all(beside in lines[number - 1] for number in literals[: 1 if name == "everything" else None])


@needs_compiler
def test_the_solidity_programs_make_the_picture(programs: dict[str, dict[str, Any]], tmp_path: Path) -> None:
    """Compiled as from the npm package; of the last scene the caller brings the meshes and the extensions."""
    names = ("plain", "everything", "opened", "given meshes")
    interfaces = tool.follow_imports(["interfaces/IRenderer.sol"])
    sources = {f"shackled-contracts/{name}": text for name, text in interfaces.items()}
    sources |= {name: programs[name]["solidity"] for name in names}
    compiled = tool.compile_once(
        tool.request(sources, tool.settings(200, True), {name: {"*": tool.OUTPUTS} for name in names})
    )
    evm, place = local(), b"\x7e" * 20
    for name in names:
        made = programs[name]
        (contract,) = compiled[name].values()
        assert len(contract["evm"]["deployedBytecode"]["object"]) / 2 <= tool.MAX_RUNTIME_SIZE
        ((signature, selector),) = (
            each for each in contract["evm"]["methodIdentifiers"].items() if each[0].startswith("bitmap(")
        )
        kinds = signature.partition("(")[2][:-1]
        (tmp_path / "a.json").write_text(made["scene"])
        fitted = in_range(load(tmp_path / "a.json"))
        meshes = [pack(o.mesh, smooth=o.material.shading == "smooth") for o in fitted.objects]
        arguments = encode_abi(kinds.split(","), [meshes, extensions(fitted)]) if kinds else b""
        assert bool(kinds) == (name == "given meshes")
        creation = bytes.fromhex(contract["evm"]["bytecode"]["object"])
        evm._codes[place] = evm.create("Picture", creation + evm.address("Renderer").rjust(32, b"\0"))
        try:
            answer = evm._run(place, bytes.fromhex(selector) + arguments, 10**9).output
        finally:
            del evm._codes[place]
        assert returned_bytes(answer) == base64.b64decode(made["bmp"])


@pytest.mark.parametrize(("kind", "codes"), [("cast", 0), ("anywhere", len(RENDERER))])
def test_commands_for_cast(programs: dict[str, dict[str, Any]], kind: str, codes: int) -> None:
    made, evm = programs["everything"], local()
    match = re.fullmatch(
        r"cast call (0x[0-9a-f]{40}) (0x[0-9a-f]+)((?: --override-code 0x[0-9a-f]{40}:0x[0-9a-f]+)*)"
        r' --gas-limit (\d+) --rpc-url "\$\{ETH_RPC_URL:-http://127.0.0.1:8545\}" \| cut -c131- \| xxd -r -p'
        r" \| head -c (\d+) > a-coin-gold-of-zoe.bmp\n",
        made[kind],
    )
    assert match
    assert bytes.fromhex(match[1][2:]) == evm.address("Renderer")
    assert match[2] == made["call"]
    sent = dict(each.split(":") for each in match[3].split(" --override-code ")[1:])
    assert len(sent) == codes
    assert all(evm.codes()[bytes.fromhex(place[2:])].hex() == code[2:] for place, code in sent.items())
    # with no more gas than that; and what the shell makes of the answer
    result = evm.call("Renderer", bytes.fromhex(made["call"][2:]), made["needed"])
    assert made["needed"] * 1.24 < int(match[4]) < made["needed"] * 1.26
    assert (result.gas, bytes.fromhex(result.output.hex()[128:])[: int(match[5])]) == (
        made["gas"],
        base64.b64decode(made["bmp"]),
    )
