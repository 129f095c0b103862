"""Objects that are put on chain, by the command line, seen by web3.py."""

from __future__ import annotations

import base64
import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image as PillowImage

from commands import Shackled
from nodes import Node
from pictures import frames_of, pixels_of
from shackled import load, render
from shackled.cli.app import run
from shackled.datasets._pieces import require
from shackled.tokens._icons import token_scene

OWNER, ALICE, BOB = range(3)
TRIANGLE = "v 0 1 0\nv -1 -1 0\nv 1 -1 0\nf 1 2 3\n"


@pytest.fixture(scope="module", autouse=True)
def _contracts(running_node: Node, users: list[str], tmp_path_factory: pytest.TempPathFactory) -> None:
    """Deploy the contracts, so that no test depends on what was deployed by those before."""
    chosen = ["--contracts", "Studio", "--standard-json", str(tmp_path_factory.mktemp("sources")), "--yes"]
    assert run(["deploy", *chosen, "--rpc", running_node.url, "--private-key-env", users[OWNER]]) == 0


def test_a_wallet_sends_the_transactions(node: Node, tmp_path: Path, shackled: Shackled) -> None:
    """What --calldata writes stores the object, sent by an account that the command never sees."""
    path = tmp_path / "calls.json"
    said = shackled("store", "icons/die", "--calldata", path)
    assert "nothing was sent" in said.err
    document = json.loads(path.read_text())
    assert int(document["chainId"], 16) == node.web3.eth.chain_id
    assert [each["name"] for each in document["calls"]][:1] == ["store part 1 of icons/die"]
    for each in document["calls"]:
        call = {key: each[key] for key in ("to", "value", "data", "gas")}
        digest = node.rpc("eth_sendTransaction", {"from": node.web3.eth.accounts[BOB], **call})
        assert node.web3.eth.wait_for_transaction_receipt(digest)["status"] == 1
    stored = json.loads(shackled("store", "icons/die", "--json").out)
    assert stored["gas"] == 0
    assert stored["pointer"] in said.out


def test_an_object_is_put_on_chain_once(node: Node, tmp_path: Path, shackled: Shackled) -> None:
    picture = tmp_path / "bell.png"
    said = shackled("store", "icons/bell", "-o", picture, "--json", "--yes", user=ALICE)
    stored = json.loads(said.out)
    assert "storing it:" in said.err
    assert 0 < stored["gas"] <= 1_700_000
    np.testing.assert_array_equal(pixels_of(picture), render(token_scene(require("icons/bell"))).pixels)
    # web3.py finds the same there
    studio = node.contract("Studio", stored["studio"])
    (draw,) = (f for f in studio.all_functions() if f.abi_element_identifier == "render(address)")
    assert draw(stored["pointer"]).call() == render(token_scene(require("icons/bell"))).bmp
    # the same again costs nothing, and needs no account
    said = shackled("store", "icons/bell", "--json")
    assert json.loads(said.out) | {"output": None} == stored | {"gas": 0, "output": None}
    assert "nothing was sent" in said.err
    large = tmp_path / "large.png"
    assert "bytes" in shackled("token", "picture", stored["pointer"], "-o", large, "--scale", 2).out
    assert pixels_of(large).shape == (256, 256, 3)
    vector, model, film = tmp_path / "bell.svg", tmp_path / "bell.glb", tmp_path / "film.png"
    shackled("token", "picture", stored["pointer"], "-o", vector, "--scale", 2)
    assert base64.b64encode(large.read_bytes()) in vector.read_bytes()
    shackled("token", "picture", stored["pointer"], "-o", model)
    assert model.read_bytes()[:4] == b"glTF"
    turned = ["--turntable", 3, "--scale", 1, "--duration", 40]
    shackled("token", "picture", stored["pointer"], "-o", film, "--size", 16, *turned)
    with PillowImage.open(film) as opened:
        assert (opened.size, opened.info["duration"]) == ((16, 16), 40)
        assert len(frames_of(film)) == 3
    shackled("token", "picture", stored["pointer"], "-o", film, *turned)
    assert pixels_of(film).shape == (128, 128, 3)
    for options in (["-o", vector, "--turntable", 3], ["-o", large, "--size", 8]):
        shackled("token", "picture", stored["pointer"], *options, expect=2)
    said = shackled("token", "picture", "0x" + "12" * 20, "-o", large, expect=1)
    assert "no scene is stored at 0x1212" in said.error


def test_a_file_is_put_on_chain_with_its_licence(tmp_path: Path, shackled: Shackled) -> None:
    mesh, picture = tmp_path / "own.obj", tmp_path / "own.png"
    mesh.write_text(TRIANGLE)
    assert "yourself, and state it with --licence" in shackled("store", mesh, "--yes", user=ALICE, expect=2).error
    said = shackled("store", mesh, "--licence", "CC BY-NC 4.0", "--yes", user=ALICE, expect=2)
    assert "is not known to allow commercial use" in said.error
    shackled("store", mesh, "--licence", "my own work", "--size", "40x20", "-o", picture, "--yes", user=ALICE)
    np.testing.assert_array_equal(pixels_of(picture), render(mesh, (40, 20), antialias=False).pixels)


def test_what_one_contract_cannot_hold_is_kept_in_parts(tmp_path: Path, shackled: Shackled) -> None:
    side = 60
    heights = np.random.default_rng(1).random((side, side))
    lines = [f"v {x} {heights[y, x]:.4f} {-y}" for y in range(side) for x in range(side)]
    for y in range(side - 1):
        for x in range(side - 1):
            a = y * side + x + 1
            lines += [f"f {a} {a + 1} {a + side + 1}", f"f {a} {a + side + 1} {a + side}"]
    mesh, picture = tmp_path / "rocks.obj", tmp_path / "rocks.png"
    mesh.write_text("\n".join(lines))
    said = shackled("store", mesh, "--licence", "MIT", "--size", 48, "-o", picture, "--yes", user=ALICE)
    assert "mesh 1, part 2 of" in said.err
    assert "mesh 1, joined" in said.err
    np.testing.assert_array_equal(pixels_of(picture), render(load(mesh, antialias=False), 48).pixels)


@pytest.mark.parametrize(
    ("arguments", "code", "said"),
    [
        (("store", "bunny", "--yes"), 2, "bunny must not be stored: its licence (Stanford 3D Scanning Repository"),
        (("store", "icons/heart", "--licence", "MIT"), 2, "--licence is for files"),
        (("store", "icons/rocket"), 2, "nothing was sent: name an account"),
        (("store", "icons/none"), 2, "there is no piece 'icons/none'"),
        (("store", "icons/rocket", "--position-bits", 3), 2, "4 to 16 bits"),
        (("store", "icons/rocket", "-o", "a.txt"), 2, "must end in one of"),
        (("token", "picture", "0x" + "12" * 20, "-o", "a.gif"), 2, "must end in .png"),
        (("token", "deploy", "icons", "--icons", "heart,heart"), 2, "icons/heart is named twice"),
        (("token", "deploy", "icons", "--supply", "1", "--reserve", "2"), 2, "the reserve of an icon must be"),
        (("token", "deploy", "genesis", "--icons", "heart"), 2, "--icons and --supply are for collections of icons"),
        (("token", "mint", "--icon", "heart", "-c", "genesis"), 2, "the address book has no genesis collection"),
    ],
)
def test_mistakes_are_reported_in_one_line(
    shackled: Shackled, arguments: tuple[object, ...], code: int, said: str
) -> None:
    result = shackled(*arguments, expect=code)
    assert said in result.error
    assert len(result.err.strip().splitlines()) <= 4
    assert ("price: about " in result.err) == (said == "nothing was sent: name an account")
