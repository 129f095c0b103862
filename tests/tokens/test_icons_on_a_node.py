"""A collection of icons from its deployment to its last token, by the command line, seen by web3.py."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from commands import Shackled
from nodes import Node
from pictures import pixels_of
from shackled import render
from shackled.chain._address_book import AddressBook
from shackled.cli.app import run
from shackled.datasets._pieces import require
from shackled.ethereum._encoding import checksum_address
from shackled.tokens._icons import token_scene
from shackled.tokens._launch import parts_of
from shackled.tokens._metadata import read_data_uri
from token_checks import document

OWNER, ALICE, BOB = range(3)
PRICE = 10**16


@pytest.fixture(scope="module")
def address(running_node: Node, users: list[str]) -> str:
    """The collection, which is not sealed: two icons, one a common object; 3 tokens of each, of which 1 is kept."""
    sale = ["--icons", "diamond,tetrahedron", "--price", "0.01", "--supply", "3", "--reserve", "1", "--yes"]
    account = ["--rpc", running_node.url, "--private-key-env", users[OWNER]]
    assert run(["token", "deploy", "icons", *sale, *account]) == 0
    found = AddressBook().find(31337, "IconsCollection")
    assert found is not None
    return checksum_address(found)


def test_the_whole_way_of_icons(node: Node, address: str, tmp_path: Path, shackled: Shackled) -> None:
    """One test, since each step needs those before."""
    contract = node.contract("IconsCollection", address)
    icons = ("-c", "icons", "--yes")
    assert contract.functions.iconCount().call() == 2
    assert contract.functions.iconAt(0).call()[0] == "Diamond"
    assert "no token" in shackled("token", "show", 0, "-c", "icons", expect=2).error

    # nothing is sold before the set is fixed
    said = shackled("token", "phase", "public", *icons, user=OWNER, expect=1)
    assert "the owner has to seal the collection first" in said.error
    said = shackled("token", "add", "heart", "--yes", user=OWNER, expect=2)
    assert "icons/heart is not on the chain yet; run: shackled store icons/heart" in said.error
    # nor is anything added that cannot be drawn
    said = shackled("token", "add", "Ghost", contract.functions.studio().call(), "--yes", user=OWNER, expect=1)
    assert "do not belong to that address" in said.error
    assert contract.functions.iconCount().call() == 2
    shackled("store", "icons/heart", "--yes", user=ALICE)
    said = shackled("token", "add", "heart", "--price", "0.01", "--supply", 3, "--yes", user=ALICE, expect=1)
    assert "only the owner may do this" in said.error
    shackled("token", "add", "heart", "--price", "0.01", "--supply", 3, "--yes", user=OWNER)
    assert "is sealed with 3 icons" in shackled("token", "seal", "--yes", user=OWNER).out
    said = shackled("token", "add", "heart", "--yes", user=OWNER, expect=1)
    assert said.error == "shackled: the set of icons is sealed: none can be added"
    shackled("token", "phase", "public", *icons, user=OWNER)

    # sold out, kind by kind
    said = shackled("token", "mint", 1, *icons, user=ALICE, expect=2)
    assert "--icon is missing" in said.error
    said = shackled("token", "mint", 1, "--icon", "rocket", *icons, user=ALICE, expect=2)
    assert "there is no icon 'rocket' in Shackled Icons; its icons are 0 Diamond, 1 Tetrahedron, 2 Heart" in said.error
    said = shackled("token", "mint", 2, "--icon", "diamond", *icons, user=ALICE)
    assert "price: 0.02 ether, plus about" in said.err
    assert "minted #0, #1" in said.out
    said = shackled("token", "mint", 1, "--icon", "0", *icons, user=BOB, expect=1)
    assert said.error == "shackled: sold out: 1 wanted, none left"
    shackled("token", "mint", 1, "--icon", "icons/heart", *icons, user=BOB)
    shackled("token", "mint", 1, "--icon", "diamond", "--reserve-to", node.accounts[8], *icons, user=OWNER)
    owners = [contract.functions.ownerOf(number).call() for number in range(4)]
    assert owners == [node.accounts[user] for user in (ALICE, ALICE, BOB, 8)]
    assert node.balance(address) == 3 * PRICE

    # what they show
    heart = tmp_path / "heart.png"
    shown = json.loads(shackled("token", "show", 2, "-c", "icons", "-o", heart, "--json").out)
    assert shown["traits"] == {"Icon": "Heart", "Supply": 3}
    drawn = render(token_scene(require("icons/heart")))
    np.testing.assert_array_equal(pixels_of(heart)[::4, ::4], drawn.pixels)
    found = document(contract.functions.tokenURI(2).call())
    assert read_data_uri(found["image"], "it") == ("image/png", heart.read_bytes())
    listed = json.loads(shackled("token", "list", "-c", "icons", "--json").out)
    assert [each["traits"]["Icon"] for each in listed["tokens"]] == ["Diamond", "Diamond", "Heart", "Diamond"]
    assert [each["left"] for each in listed["icons"]] == [0, 2, 1]
    assert "there is nothing to reveal" in shackled("token", "reveal", "-c", "icons", user=BOB, expect=2).error
    said = shackled("token", "verify", "-c", "icons")
    assert said.out.count("ok ") == len(parts_of("IconsCollection")) + 1 + 4
    assert "WRONG" not in said.out

    # they change hands, and the owner has the ether
    shackled("token", "transfer", 2, node.accounts[ALICE], *icons, user=BOB)
    assert contract.functions.ownerOf(2).call() == node.accounts[ALICE]
    shackled("token", "withdraw", *icons, user=OWNER)
    assert node.balance(address) == 0

    # bytes that were changed are found
    scene = contract.functions.iconAt(0).call()[1]
    code = bytes(node.web3.eth.get_code(scene))
    try:
        node.rpc("anvil_setCode", scene, "0x" + code[:-1].hex() + f"{code[-1] ^ 1:02x}")
        said = shackled("token", "verify", 0, "-c", "icons", expect=1)
    finally:
        node.rpc("anvil_setCode", scene, "0x" + code.hex())
    assert "WRONG  Shackled Icons #0" in said.out
