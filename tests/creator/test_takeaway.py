"""What is taken home makes the same picture again."""

from __future__ import annotations

import hashlib
import io
import json
import re
import subprocess
import sys
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import requests
from PIL import Image as PillowImage
from tools import build_contracts as tool

from compiler import needs_compiler
from nodes import anvil, needs_anvil
from shackled import Image, InputError, Scene, load, render
from shackled.artifacts import RENDERER
from shackled.chain import EmbeddedChain, open_chain, returned_bytes
from shackled.cli.app import run
from shackled.creator import (
    KINDS,
    Facts,
    File,
    Size,
    Source,
    State,
    Stored,
    Subject,
    apply_look,
    contract_name,
    describe,
    make_file,
    preset,
    set_value,
    to_scene,
)
from shackled.gas import render_call
from shackled.scene import simplify_scene


def chain() -> EmbeddedChain:
    found = open_chain()
    assert isinstance(found, EmbeddedChain)
    return found


class Picture:
    """A piece, as it comes or in another look, and what is taken home of it."""

    def __init__(self, name: str, look: str = "", scene: Scene | None = None, source: Source | None = None) -> None:
        self.source = load(name) if scene is None else scene
        self.facts = describe(source or Source("piece", name), self.source, name, licence="MIT")
        self.state = State(self.facts.source)
        if look:
            self.state = dressed(self.state, self.facts, look)

    @property
    def scene(self) -> Scene:
        return to_scene(self.state, self.source, self.facts.bounds)

    @property
    def image(self) -> Image:
        return render(self.scene)

    def take(self, kind: str, **settings: Any) -> File:
        return make_file(kind, self.subject(**settings), chain())

    def subject(self, **settings: Any) -> Subject:
        return Subject(self.state, self.facts, self.source, self.scene, **settings)


def dressed(state: State, facts: Facts, look: str) -> State:
    """Everything that can be different."""
    found = preset(look)
    assert found is not None
    state = apply_look(found, state, facts)
    for path, value in {
        "camera.azimuth": 33.3,
        "camera.projection": "orthographic",
        "pose.rotation.y": 20,
        "pose.position.x": 0.1,
        "lights_follow": True,
        "size.width": 40,
        "size.height": 32,
        "antialias": True,
        "hemisphere.on": True,
        "rim.on": True,
        "fog.on": True,
        "tone.gamma": True,
        "surface.opacity": 0.7,
        "opacities.0": 0.4,
        **({"lights.0.kind": "spot", "lights.0.target.x": 0.2, "lights.0.outer_angle": 30} if found.lamps else {}),
    }.items():
        state = set_value(state, facts, path, value)
    return state


PICTURES = [
    ("tetrahedron", ""),
    ("icons/crystals", "clay"),
    ("icons/coin", "neon"),
    ("genesis/7", "xray"),
    ("cornell-box", "blueprint"),
]


@pytest.mark.parametrize("name", ["teapot", "icons/coin", "genesis/3"])
def test_an_untouched_picture_is_that_of_the_command_line(name: str, tmp_path: Path, capsys: Any) -> None:
    assert run(["render", name, "-o", str(tmp_path / "a.bmp")]) == 0
    capsys.readouterr()
    file = Picture(name).take("bmp")
    assert file.data == (tmp_path / "a.bmp").read_bytes()
    assert file.name == f"{name.replace('/', '-')}.bmp"


@pytest.mark.parametrize("scale", [1, 2, 8])
def test_a_png_is_crisp(scale: int) -> None:
    picture = Picture("tetrahedron", "clay")
    with PillowImage.open(io.BytesIO(make_file("png", picture.subject(), chain(), scale).data)) as png:
        pixels = np.asarray(png.convert("RGB"))
    assert (pixels == picture.image.pixels.repeat(scale, axis=0).repeat(scale, axis=1)).all()


@pytest.mark.parametrize("scale", [1, 8])
def test_a_png_carries_its_scene(scale: int, tmp_path: Path) -> None:
    picture = Picture("icons/coin", "gold")
    (tmp_path / "a.png").write_bytes(make_file("png", picture.subject(), chain(), scale).data)
    assert render_call(load(tmp_path / "a.png")) == render_call(picture.scene)


def test_an_svg_is_that_of_the_command(tmp_path: Path) -> None:
    picture = Picture("tetrahedron")
    render(picture.scene).save(tmp_path / "a.svg")
    assert picture.take("svg").data == (tmp_path / "a.svg").read_bytes()


@pytest.mark.parametrize(("name", "look"), PICTURES)
def test_a_scene_file_loads_again(name: str, look: str, tmp_path: Path) -> None:
    picture = Picture(name, look)
    file = picture.take("scene")
    (tmp_path / file.name).write_bytes(file.data)
    assert render(load(tmp_path / file.name)).bmp == picture.image.bmp


def test_calldata() -> None:
    picture = Picture("icons/coin", "gold")
    data = bytes.fromhex(picture.take("calldata").data.decode().strip().removeprefix("0x"))
    assert returned_bytes(chain().call("Renderer", data).output, 0) == picture.image.bmp


@pytest.mark.parametrize("kind", ["cast", "cast-anywhere"])
def test_a_line_for_cast(kind: str) -> None:
    picture = Picture("icons/coin", "gold")
    line = picture.take(kind).data.decode()
    match = re.fullmatch(
        r"cast call (0x[0-9a-f]{40}) (0x[0-9a-f]+)((?: --override-code 0x[0-9a-f]{40}:0x[0-9a-f]+)*)"
        r' --gas-limit (\d+) --rpc-url "\$\{ETH_RPC_URL:-http://127.0.0.1:8545\}" \| cut -c131- \| xxd -r -p'
        r" \| head -c (\d+) > icons-coin.bmp\n",
        line,
    )
    assert match
    assert bytes.fromhex(match[1][2:]) == chain().address("Renderer")
    assert match[2] == picture.take("calldata").data.decode().strip()
    codes = dict(each.split(":") for each in match[3].split(" --override-code ")[1:])
    assert len(codes) == (0 if kind == "cast" else len(RENDERER))
    assert all(chain().codes()[bytes.fromhex(place[2:])].hex() == code[2:] for place, code in codes.items())
    # what the shell makes of the answer
    answer = "0x" + chain().call("Renderer", bytes.fromhex(match[2][2:])).output.hex()
    assert bytes.fromhex(answer[130:])[: int(match[5])] == picture.image.bmp


@needs_anvil
def test_the_line_for_cast_suffices_where_a_call_is_given_little() -> None:
    """A node gives a call that names no limit what it likes: anvil as much as a block may have."""
    picture = Picture("icons/coin", "gold")
    picture.state = set_value(
        set_value(picture.state, picture.facts, "size.width", 256), picture.facts, "size.height", 256
    )
    words = picture.take("cast-anywhere").data.decode().split()
    given = dict(pairwise(words))
    codes = [following.split(":") for word, following in pairwise(words) if word == "--override-code"]
    call = {"to": words[2], "data": words[3], "gas": hex(int(given["--gas-limit"]))}
    with anvil("--gas-limit", "10000000") as node:

        def ask(call: dict[str, str]) -> dict[str, Any]:
            parameters = [call, "latest", {place: {"code": code} for place, code in codes}]
            body: dict[str, Any] = {"jsonrpc": "2.0", "id": 1, "method": "eth_call", "params": parameters}
            answer: dict[str, Any] = requests.post(node.url, json=body, timeout=60).json()
            return answer

        assert "error" in ask({key: value for key, value in call.items() if key != "gas"})
        assert returned_bytes(bytes.fromhex(ask(call)["result"][2:]), 0) == picture.image.bmp


def test_files_of_all_kinds_lie_side_by_side() -> None:
    picture = Picture("tetrahedron")
    picture.state = set_value(set_value(picture.state, picture.facts, "size.width", 8), picture.facts, "size.height", 8)
    names = [picture.take(kind.name).name for kind in KINDS if kind.name != "file"]
    assert len(set(names)) == len(names)


@pytest.mark.parametrize(
    ("licence", "identifier"),
    [
        ("MIT", "MIT"),
        ("CC0", "CC0-1.0"),
        ("CC0-1.0", "CC0-1.0"),
        ("none stated; not to be passed on", "LicenseRef-none-stated-not-to-be-passed-on"),
        ("", "UNLICENSED"),
    ],
)
def test_meshes_keep_their_licence_in_solidity(licence: str, identifier: str) -> None:
    picture = Picture("tetrahedron")
    notice = f"tetra: by Nobody; licence: {licence}; not for commercial use" if licence.startswith("none") else ""
    picture.facts = replace(picture.facts, licence=licence, notice=notice)
    lines = picture.take("solidity").data.decode().splitlines()
    assert lines[0] == f"// SPDX-License-Identifier: {identifier}"
    beside = lines[next(number for number, line in enumerate(lines) if "bytes.concat" in line) - 1]
    if notice:
        assert beside.strip() == f"// {notice}"
    elif licence:
        assert beside.strip() == f"// The licence of this mesh: {licence}"
    else:
        assert "licence of this mesh is unknown" in "".join(lines)


def test_a_contract_without_the_meshes_is_ours(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shackled.creator._solidity.MAX_CONSTANT", 0)
    picture = Picture("tetrahedron")
    picture.facts = replace(picture.facts, licence="")
    text = picture.take("solidity").data.decode()
    assert text.startswith("// SPDX-License-Identifier: MIT\n")
    assert 'hex"' not in text


def test_the_link_says_where_it_works() -> None:
    picture = Picture("tetrahedron")
    for kind in ("python", "solidity"):
        for link, alone in (
            ("http://127.0.0.1:8080/?p=1abc", True),
            ("http://localhost:8080/?p=1abc", True),
            ("http://[::1]:8080/?p=1abc", True),
            ("https://shackled.example/?p=1abc", False),
            ("http://192.168.1.20:8080/?p=1abc", False),
        ):
            text = picture.take(kind, link=link).data.decode()
            assert link in text
            assert ("The link works on this computer only." in text) == alone


def test_a_line_that_no_shell_takes(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shackled.creator._programs.MAX_ARGUMENT", 10_001)
    with pytest.raises(InputError, match="bytes, too many for a command line, which takes 4,999"):
        Picture("icons/coin").take("cast")


@pytest.mark.parametrize(("name", "look"), PICTURES)
def test_the_python_snippet_makes_the_picture(name: str, look: str, tmp_path: Path) -> None:
    picture = Picture(name, look)
    file = picture.take("python", link="http://127.0.0.1/#1abc")
    assert file.data.startswith(b"# http://127.0.0.1/#1abc\n# The link works on this computer only.\nimport hashlib\n")
    (tmp_path / file.name).write_bytes(file.data)
    subprocess.run([sys.executable, file.name], cwd=tmp_path, check=True, capture_output=True)
    with PillowImage.open(tmp_path / file.name.replace(".py", ".png")) as png:
        assert (np.asarray(png.convert("RGB")) == picture.image.pixels).all()


def test_the_python_snippet_of_an_upload(tmp_path: Path) -> None:
    mesh = load("icosphere").objects[0].mesh
    name = "a 'b' \"c\".obj"
    rows = [f"v {x} {y} {z}" for x, y, z in mesh.positions.tolist()]
    rows += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in mesh.faces.tolist()]
    data = "\n".join(rows).encode()
    (tmp_path / name).write_bytes(data)
    scene = simplify_scene(load(tmp_path / name), 200)
    source = Source("upload", hashlib.sha256(data).hexdigest())
    picture = Picture(name, scene=scene, source=source)
    picture.state = set_value(picture.state, picture.facts, "max_triangles", 90)
    stored = Stored(name, b"", picture.facts, 200, data)
    assert picture.take("file", stored=stored) == File(name, "application/octet-stream", data)
    file = picture.take("python", stored=stored)
    assert file.name == "a-b-c.py"
    (tmp_path / "a.py").write_bytes(file.data)
    subprocess.run([sys.executable, "a.py"], cwd=tmp_path, check=True, capture_output=True)
    changed = (tmp_path / "a.py").read_text().replace("max_triangles=90", "max_triangles=80")
    (tmp_path / "b.py").write_text(changed)
    assert subprocess.run([sys.executable, "b.py"], cwd=tmp_path, check=False, capture_output=True).returncode != 0


def test_the_python_snippet_of_an_archive_takes_the_scene_file(tmp_path: Path) -> None:
    picture = Picture("icons/coin", "neon", source=Source("upload", "ab" * 32))
    stored = Stored("coins.zip", b"", picture.facts, None, b"")
    for kind in ("python", "scene"):
        file = picture.take(kind, stored=stored)
        (tmp_path / file.name).write_bytes(file.data)
    (program,) = tmp_path.glob("*.py")
    subprocess.run([sys.executable, program.name], cwd=tmp_path, check=True, capture_output=True)


@pytest.mark.parametrize(
    ("stem", "name"), [("icons-coin", "IconsCoin"), ("3d", "Picture3d"), ("scene", "PictureScene"), ("a-1", "A1")]
)
def test_names_of_contracts(stem: str, name: str) -> None:
    assert contract_name(stem) == name


@needs_compiler
def test_the_solidity_snippets_make_the_picture(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of a scene that a contract holds, and of two of which the caller brings the meshes, or the extensions, too."""
    pictures = [Picture("icosahedron", "neon"), Picture("first-render"), Picture("icosahedron", "neon")]
    sources = []
    for picture, most in zip(pictures, (10**9, 0, 0), strict=True):
        monkeypatch.setattr("shackled.creator._solidity.MAX_CONSTANT", most)
        sources.append(picture.take("solidity", link="http://127.0.0.1/#1abc").data.decode())
    evm, place = chain(), b"\x7e" * 20
    for picture, (creation, selectors) in zip(pictures, compiled(sources), strict=True):
        ((signature, selector),) = ((key, value) for key, value in selectors.items() if key.startswith("bitmap("))
        arguments = parts(picture.scene, signature.partition("(")[2][:-1].split(",")) if "bytes" in signature else b""
        evm._codes[place] = evm.create("Picture", creation + evm.address("Renderer").rjust(32, b"\0"))
        try:
            output = evm._run(place, bytes.fromhex(selector) + arguments, 10**9).output
        finally:
            del evm._codes[place]
        assert returned_bytes(output, 0) == picture.image.bmp
    assert ["bytes[] calldata" in source for source in sources] == [False, True, True]
    assert ["bytes calldata" in source for source in sources] == [False, True, True]


def parts(scene: Scene, kinds: list[str]) -> bytes:
    """The packed meshes as an argument of type bytes[], and the extensions as another of type bytes."""
    from eth_abi.abi import encode

    from shackled.scene import extensions, fit, pack

    packed = [pack(o.mesh, smooth=o.material.shading == "smooth") for o in fit(scene).objects]
    return encode(kinds, [packed, extensions(fit(scene))][: len(kinds)])


def compiled(contracts: list[str]) -> list[tuple[bytes, dict[str, str]]]:
    """Creation code and selectors of the contract in each source, compiled as a user would, from the npm package."""
    found = tool.follow_imports(["interfaces/IRenderer.sol"])
    sources = {f"shackled-contracts/{name}": text for name, text in found.items()}
    names = [f"{number}.sol" for number in range(len(contracts))]
    sources |= dict(zip(names, contracts, strict=True))
    request = tool.request(sources, tool.settings(200, True), {name: {"*": tool.OUTPUTS} for name in names})
    output = tool.run_compiler(json.dumps(request))["contracts"]
    made = []
    for name in names:
        (contract,) = output[name].values()
        assert len(contract["evm"]["deployedBytecode"]["object"]) / 2 <= tool.MAX_RUNTIME_SIZE
        selectors = contract["evm"]["methodIdentifiers"]
        made.append((bytes.fromhex(contract["evm"]["bytecode"]["object"]), selectors))
    return made


def test_what_is_not_there() -> None:
    picture = Picture("tetrahedron")
    with pytest.raises(InputError, match="there is no download of the kind 'gold'; there are png, bmp, svg"):
        picture.take("gold")
    with pytest.raises(InputError, match="not of an uploaded file"):
        picture.take("file")
    with pytest.raises(InputError, match="the scale of a PNG must be from 1 to 8, not 9"):
        make_file("png", picture.subject(), chain(), 9)
    picture.state = set_value(picture.state, picture.facts, "size.width", 600)
    with pytest.raises(InputError, match="up to 4,096 pixels a side: choose a scale below 8"):
        make_file("png", picture.subject(), chain(), 8)


def test_each_kind_is_made() -> None:
    picture = Picture("tetrahedron")
    picture.state = set_value(picture.state, picture.facts, "size.width", 8)
    picture.state = set_value(picture.state, picture.facts, "size.height", 8)
    assert picture.state.size == Size(8, 8)
    for kind in KINDS:
        if kind.name != "file":
            file = picture.take(kind.name)
            assert file.name == f"tetrahedron{kind.extension}"
            assert file.media_type == kind.media_type
            assert not kind.is_text or file.data.decode("ascii").endswith("\n")


def test_a_page_that_shows_the_picture() -> None:
    picture = Picture("icons/crown", "clay")
    file = picture.take("page")
    assert (file.name, file.media_type) == ("icons-crown.html", "text/html")
    assert f"<code>{picture.image.sha256}</code>" in file.data.decode()
