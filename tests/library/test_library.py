"""The library on chain, and its pictures at web3:// addresses: contracts, table, commands."""

from __future__ import annotations

import io
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from eth_abi.abi import decode as decode_abi
from eth_utils.crypto import keccak
from PIL import Image as PillowImage
from tools.docs.draw_library import Shelf

import gltf_reader
from nodes import KEY, anvil, needs_anvil
from shackled import render
from shackled.artifacts import artifact
from shackled.cli.app import run
from shackled.errors import InputError
from shackled.ethereum._encoding import word
from shackled.evm._instance import Status
from shackled.image import decode_bmp
from shackled.library import chosen_items, items
from shackled.scene._codec import encode_scene
from shackled.scene._in_range import in_range

#: The first byte of a pointer to a mesh (contracts/src/mesh/Kinds.sol).
POINTED = 0x12
STORED = ("ethereum", "coin", "cube")


@pytest.fixture(scope="module")
def shelf() -> Shelf:
    return Shelf(chosen_items(STORED))


def call(shelf: Shelf, contract: str, function: str, *values: Any) -> Any:
    """Call a contract by its name."""
    interface = artifact(contract).interface
    return interface.decode(function, shelf.call(shelf.addresses[contract], interface.encode(function, *values)))


def ask(shelf: Shelf, path: str, **parameters: str) -> tuple[int, bytes, dict[str, str]]:
    """Send a request as a web3:// browser does."""
    return shelf.ask(shelf.addresses["Web"], path, **parameters)


def test_items_by_name(shelf: Shelf) -> None:
    assert call(shelf, "Library", "names") == tuple(each.name for each in items())
    assert sum(each.is_icon for each in items()) == 28
    assert {"teapot", "cube", "torus", "cone"} < {each.name for each in items()}
    for each in items():
        scene, meshes, low, high, triangles, is_icon = call(shelf, "Library", "find", each.name)
        assert bytes.fromhex(scene[2:]) == each.pointer
        assert [bytes.fromhex(mesh[2:]) for mesh in meshes] == each.meshes
        assert (low, high) == (tuple(each.low), tuple(each.high))
        assert (triangles, is_icon) == (each.scene.triangles, each.is_icon)
        assert call(shelf, "Library", "isStored", each.name) == (each.name in STORED)


@pytest.mark.parametrize("name", STORED)
def test_objects_that_fit(shelf: Shelf, name: str) -> None:
    """The longest side is as long as it was asked to be, the middle at the origin; materials are those of the scene."""
    (item,) = chosen_items([name])
    objects = call(shelf, "Library", "objects", name, 100 << 32)
    interface = artifact("Renderer").interface
    struct = interface.parameter_type("render")
    (scene,) = decode_abi([struct], word(32) + encode_scene(in_range(item.scene)))
    assert [each[0] for each in objects] == [bytes([POINTED]) + mesh for mesh in item.meshes]
    for (_, position, rotation, scale, material, flags), expected in zip(objects, scene[-2], strict=True):
        sides = (item.high - item.low) * scale / 2**32
        assert 99.9 < sides.max() <= 100
        assert np.allclose((item.low + item.high) / 2 * scale + position, 0, atol=scale)
        assert rotation == (0, 0, 0, 1 << 32)
        assert np.allclose(material, expected[4], atol=1)
        assert flags == 1


def test_errors_of_the_library(shelf: Shelf) -> None:
    for function, values, message in (
        ("find", ["Crown"], "UnknownName(name=Crown)"),
        ("isStored", [""], "UnknownName(name=)"),
        ("objects", ["crown", 1 << 32], "NotStored(name=crown, pointer=0x"),
        ("objects", ["cube", 0], "SizeOutOfRange(size=0)"),
        ("objects", ["cube", 1 << 52], "SizeOutOfRange(size="),
        # not in Q32: its objects would be invisible
        ("objects", ["cube", 100], "SizeOutOfRange(size=100)"),
    ):
        with pytest.raises(LookupError) as raised:
            call(shelf, "Library", function, *values)
        assert str(raised.value).startswith(message)
    with pytest.raises(InputError, match="no 'pot' in the library; its items are ethereum, coin"):
        chosen_items(["pot"])


def test_pictures_at_paths(shelf: Shelf) -> None:
    assert call(shelf, "Web", "resolveMode") == b"5219".ljust(32, b"\0")
    coin, cube = chosen_items(["coin", "cube"])
    for path, item in (("/icons/coin.png", coin), ("/objects/cube.png", cube)):
        status, body, headers = ask(shelf, path)
        assert (status, headers["Content-Type"]) == (200, "image/png")
        assert "immutable" in headers["Cache-Control"]
        pixels = decode_bmp(render(item.scene).bmp, 128, 128)
        with PillowImage.open(io.BytesIO(body)) as opened:
            assert np.array_equal(np.asarray(opened), pixels.repeat(4, 0).repeat(4, 1))
    with PillowImage.open(io.BytesIO(ask(shelf, "/icons/coin.png", scale="1", other="x")[1])) as opened:
        assert opened.size == (128, 128)
    status, body, headers = ask(shelf, "/objects/cube.glb")
    assert (status, headers["Content-Type"]) == (200, "model/gltf-binary")
    assert len(gltf_reader.read(body)) == cube.scene.triangles


def test_pieces_of_genesis_at_paths(shelf: Shelf) -> None:
    seed = keccak(text="shackled-12")
    numbered, named = ask(shelf, "/genesis/12.png"), ask(shelf, f"/genesis/0x{seed.hex()}.png")
    assert numbered == named
    pixels = decode_bmp(call(shelf, "Genesis", "render", seed), 128, 128)
    with PillowImage.open(io.BytesIO(numbered[1])) as opened:
        assert np.array_equal(np.asarray(opened)[::4, ::4], pixels)


def test_too_little_gas_is_no_answer(shelf: Shelf) -> None:
    """A gateway may keep an answer, so a piece that exists is never reported as missing."""
    data = artifact("Web").interface.encode("request", ["genesis", "12.png"], [])
    for gas in range(200_000, 5_000_000, 400_000):
        assert shelf.evm.call(shelf.addresses["Web"], data, gas).status != Status.SUCCESS


@pytest.mark.parametrize("path", ["", "/"])
def test_the_page(shelf: Shelf, path: str) -> None:
    status, body, headers = ask(shelf, path)
    text = body.decode()
    assert (status, headers["Content-Type"]) == (200, "text/html")
    assert "immutable" not in headers["Cache-Control"]
    assert '<a href="/icons/coin.png">' in text
    assert '<a href="/objects/cube.png">' in text
    assert "<p>crown: not stored on this chain yet</p>" in text
    assert text.count("<h2>") == 3
    assert text.count("/genesis/") == 24


@pytest.mark.parametrize(
    "path",
    [
        *("/icons", "/icons/", "/icons/coin.gif", "/icons/coin", "/icons/.png", "/icons/coin.png/more"),
        # not stored; an object; an icon
        *("/icons/crown.png", "/icons/cube.png", "/objects/coin.png"),
        *("/genesis/12.glb", "/genesis/-1.png", "/genesis/0x12.png", f"/genesis/0x{'g' * 64}.png", "/genesis/.png"),
        *(f"/genesis/{'9' * 78}.png", f"/genesis/0x{'a' * 65}.png", f"/genesis/1x{'a' * 64}.png"),
        *("/../icons/coin.png", "/" + "a" * 1000),
    ],
)
def test_paths_where_nothing_is(shelf: Shelf, path: str) -> None:
    status, body, headers = ask(shelf, path)
    assert (status, headers) == (404, {"Content-Type": "text/plain"})
    assert body.decode("ascii").endswith(".")


@pytest.mark.parametrize("scale", ["0", "9", "", "44", "x"])
def test_scales_that_are_none(shelf: Shelf, scale: str) -> None:
    assert ask(shelf, "/icons/coin.png", scale=scale)[0] == 400


@needs_anvil
def test_the_commands(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setenv("SIGNER", KEY)
    with anvil() as node:
        words = ["library", "store", "cube", "ethereum", "--rpc", node.url]
        paid = [*words, "--private-key-env", "SIGNER", "--yes"]
        assert run([*words, "--calldata", str(tmp_path / "calls.json"), "--json"]) == 0
        document = json.loads(capsys.readouterr().out)
        assert [each["name"] for each in document["calls"]][-1] == "ethereum, scene"
        assert run(paid) == 0
        assert capsys.readouterr().out.count("0x") == 2
        assert run(paid) == 0
        assert "all items are stored already: nothing was sent" in capsys.readouterr().err
        assert run(["library", "list", "--rpc", node.url, "--json"]) == 0
        listed = {each["name"]: each["stored"] for each in json.loads(capsys.readouterr().out)["items"]}
        assert [name for name, stored in listed.items() if stored] == ["ethereum", "cube"]
