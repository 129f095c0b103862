"""Editions by the command line, from the deployment to the withdrawal, seen by web3.py; and nodes that lie."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest
from PIL import Image as PillowImage

from commands import Shackled
from nodes import Node
from proxies import Liar
from shackled.artifacts import artifact
from shackled.chain import Connection
from shackled.cli.app import run
from shackled.errors import InputError, NodeError
from shackled.ethereum._encoding import to_hex
from shackled.tokens import editions_of
from shackled.tokens._collection import EDITIONS, Collection
from shackled.tokens._editions import OPEN, EditionTerms
from shackled.tokens._launch import address_of, parts_of

ROOT = Path(__file__).resolve().parents[2]
OWNER, ALICE, BOB = range(3)
PRICE = 10**16
TRIANGLE = "v 0 1 0\nv -1 -1 0\nv 1 -1 0\nf 1 2 3\n"


def pointer_of(said: Any) -> str:
    found = re.search(r"pointer  (0x\w{40})", said.out)
    assert found, said
    return found[1]


def test_the_whole_way_of_editions(
    node: Node,
    users: list[str],
    tmp_path: Path,
    shackled: Shackled,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """One test, since each step needs those before."""
    monkeypatch.chdir(tmp_path)
    Path("triangle.obj").write_text(TRIANGLE)
    edition = ("token", "edition")
    said = shackled(*edition, "list", expect=2)
    assert "no collection of editions" in said.error
    assert "shackled deploy --contracts Editions" in said.error
    shackled("deploy", "--contracts", "Editions", "--yes", user=OWNER)
    contract = node.contract("Editions", address_of("Editions"))
    assert contract.functions.name().call() == EDITIONS.title
    pointer = pointer_of(shackled("store", "triangle.obj", "--licence", "MIT", "--size", 8, "--yes", user=ALICE))

    # what cannot be drawn is reported before anything is asked
    said = shackled(*edition, "add", node.accounts[9], "Ghost", "--price", 0, "--yes", user=ALICE, expect=1)
    assert said.error == f"shackled: nothing is stored at {node.accounts[9]}"
    said = shackled(*edition, "add", pointer, "x" * 65, "--price", 0, "--yes", user=ALICE, expect=2)
    assert said.error == "shackled: the number of bytes of the name must be a whole number from 1 to 64, not 65"
    sale = ("--price", "0.01", "--supply", 3, "--royalty", 2.5, "--copies", 1, "--scale", 2, "--yes")
    said = shackled(*edition, "add", pointer, 'A "triangle" \x1b[2J', *sale, user=ALICE)
    assert "this cannot be changed later" in said.err
    assert 'edition 0: A "triangle" ?[2J' in said.out
    assert "yours: #0" in said.out
    assert contract.functions.editionAt(0).call()[0] == node.accounts[ALICE]
    open_sale = ("--price", "0", "--copies", 0, "--json", "--yes")
    added = json.loads(shackled(*edition, "add", pointer, "Free", *open_sale, user=BOB).out)
    assert (added["edition"], added["supply"], added["left"], added["tokens"]) == (1, None, None, [])

    said = shackled(*edition, "mint", 0, 3, "--yes", user=BOB, expect=1)
    assert said.error == "shackled: sold out: 3 wanted, 2 left"
    said = shackled(*edition, "mint", 2, "--yes", user=BOB, expect=1)
    assert said.error == "shackled: there is no edition 2: the collection has 2"
    said = shackled(*edition, "mint", 0, 2, "--yes", user=BOB)
    assert "price: 0.02 ether, plus about" in said.err
    assert "minted #1, #2" in said.out
    shackled(*edition, "mint", 1, "--yes", user=ALICE)
    owners = [contract.functions.ownerOf(number).call() for number in range(4)]
    assert owners == [node.accounts[user] for user in (ALICE, BOB, BOB, ALICE)]

    # what can be read of it
    listed = json.loads(shackled(*edition, "list", "--json").out)["editions"]
    assert [each["name"] for each in listed] == ['A "triangle" \x1b[2J', "Free"]
    assert [(each["minted"], each["proceeds"], each["royalty"]) for each in listed] == [(3, "0.02", 2.5), (1, "0", 5)]
    said = shackled(*edition, "list", "--artist", node.accounts[ALICE])
    assert "sold out" in said.out
    assert "Free" not in said.out
    shown = json.loads(shackled("token", "show", 3, "-c", "editions", "-o", "free.png", "--json").out)
    assert shown["traits"] == {"Edition": 1, "Artist": node.accounts[BOB], "Supply": "open"}
    with PillowImage.open("free.png") as picture:
        assert picture.size == (32, 32)
        assert len(np.unique(np.asarray(picture).reshape(-1, 3), axis=0)) > 1
    said = shackled("token", "verify", "-c", "editions")
    assert said.out.count("ok ") == len(parts_of("Editions")) + 1 + 4
    assert "WRONG" not in said.out
    shackled("token", "transfer", 3, node.accounts[BOB], "-c", address_of("Editions"), "--yes", user=ALICE)
    assert contract.functions.ownerOf(3).call() == node.accounts[BOB]
    said = shackled("token", "phase", "public", "-c", "editions", "--yes", user=OWNER, expect=2)
    assert "shackled token edition --help" in said.error
    assert "shackled token edition list" in shackled("token", "list", "-c", "editions", expect=2).error

    # a copy is named in hints; a contract with other code has the name, but takes no ether
    def copy(place: str, code: str) -> None:
        node.rpc("anvil_setCode", place, code)
        for slot in map(hex, range(8)):
            value = node.rpc("eth_getStorageAt", address_of("Editions"), slot, "latest")
            node.rpc("anvil_setStorageAt", place, f"0x{int(slot, 16):064x}", value)

    same, other = ("0x" + digits * 20 for digits in ("51", "52"))
    code = node.rpc("eth_getCode", address_of("Editions"), "latest")
    copy(same, code)
    copy(other, code + "00")
    free = ("--price", "0", "--copies", 0, "--yes")
    said = shackled(*edition, "add", pointer, "Copied", *free, "-c", same, user=BOB)
    number = re.search(rf"shackled token edition mint (\d+) -c {same}", said.out)
    assert number, said
    said = shackled(*edition, "mint", number[1], "-c", same, "--yes", user=BOB)
    assert re.search(rf"shackled token show \d+ -c {same} -o", said.out), said
    shackled(*edition, "list", "-c", other)
    for command in (("add", pointer, "Fooled", *free), ("mint", 0, "--yes")):
        said = shackled(*edition, *command, "-c", other, user=BOB, expect=1)
        assert "nothing was sent to 0x5252" in said.error
        assert "its code differs from the compiled contract" in said.error

    # a token larger than wallets like, with a model, is right all the same
    large = pointer_of(shackled("store", "triangle.obj", "--licence", "MIT", "--size", 280, "--yes", user=ALICE))
    shackled(*edition, "add", large, "Large", "--scale", 8, "--model", "--price", 0, "--yes", user=ALICE)
    assert "WRONG" not in shackled("token", "verify", 4, "-c", "editions").out

    # nodes that lie: about the edition that was added, about its price, about gas
    def lied(lies: dict[str, Any], *arguments: Any, user: int, expect: int = 1) -> str:
        with Liar(lies).before(node.url) as url:
            code = run([*map(str, (*edition, *arguments)), "--rpc", url, "--private-key-env", users[user]])
        said = capsys.readouterr()
        assert (code, "Traceback" in said.err) == (expect, False), said
        return said.err.strip().splitlines()[-1]

    def renumbered(receipt: Any, _: Any) -> Any:
        for log in (receipt or {}).get("logs", ()):
            log["topics"][1] = "0x" + "00" * 32
        return receipt

    def dearer(answer: str, parameters: Any) -> str:
        selector = to_hex(artifact("Editions").interface.encode("editionAt", 0))
        return answer.replace(f"{PRICE:064x}", f"{2 * PRICE:064x}") if parameters[0]["data"] == selector else answer

    count = contract.functions.editionCount().call()
    reported = lied({"eth_getTransactionReceipt": renumbered}, "add", pointer, "Mine", *open_sale, user=BOB)
    assert "edition 0, which the receipt" in reported
    assert reported.endswith("does not match the terms")
    assert contract.functions.editionCount().call() == count + 1
    many = {"eth_estimateGas": lambda gas, _: hex(1000 * int(gas, 16))}
    assert "more than 10 times as much" in lied(many, "add", pointer, "Mine", *open_sale, user=BOB)
    shackled(*edition, "add", pointer, "Expensive", *sale, user=BOB)
    reported = lied({"eth_call": dearer}, "mint", 0, 1, "--yes", user=ALICE)
    assert reported == "shackled: the price is 0.01 ether, but 0.02 ether was sent"
    assert contract.functions.totalSupply().call() == 6

    # the artist has the ether, and closes
    said = shackled(*edition, "withdraw", 0, "--yes", user=BOB, expect=1)
    assert "only its artist" in said.error
    before = node.balance(node.accounts[9])
    with Liar({"eth_call": dearer}).before(node.url) as url:
        key = ("--private-key-env", users[ALICE])
        assert not run([*edition, "withdraw", "--to", node.accounts[9], "--yes", "--rpc", url, *key])
    captured = capsys.readouterr()
    assert "send 0.04 ether of" in captured.err
    assert captured.out.startswith("0.02 ether sent to ")
    assert node.balance(node.accounts[9]) - before == 2 * PRICE
    assert node.balance(address_of("Editions")) == 0
    assert "nothing to withdraw" in shackled(*edition, "withdraw", "--yes", user=ALICE).out
    shackled(*edition, "close", 1, "--yes", user=BOB)
    said = shackled(*edition, "mint", 1, "--yes", user=ALICE, expect=1)
    assert said.error == "shackled: edition 1 is closed: no more tokens of it can be minted"


@pytest.mark.parametrize(
    "change",
    [
        *({"name": name} for name in ("", "é" * 33)),
        *({"supply": 0}, {"supply": OPEN + 1}, {"royalty": 1001}, {"scale": 9}),
        *({"copies": 101}, {"supply": 2, "copies": 3}),
    ],
)
def test_terms_are_checked_before_anything_is_sent(change: dict[str, Any]) -> None:
    with pytest.raises(InputError, match="must be a whole number from"):
        replace(EditionTerms("One", "0x" + "12" * 20, 1), **change)


def test_the_address_is_that_of_the_contracts() -> None:
    addresses = (ROOT / "contracts" / "src" / "Addresses.sol").read_text("utf-8")
    assert f"EDITIONS = {address_of('Editions')};" in addresses


@pytest.mark.parametrize(("count", "error"), [(2**24, LookupError), (2**24 + 1, NodeError)])
def test_the_collection_may_be_full(count: int, error: type[Exception]) -> None:
    """As many editions as the contract allows are read, and no more."""

    def call(function: str, *numbers: int) -> int:
        return {"editionCount": count}[function]

    contract, connection = SimpleNamespace(call=call), Connection("http://127.0.0.1:1")
    with pytest.raises(error, match=r"editionAt|impossible number of editions, 16,777,217"):
        editions_of(cast("Collection", SimpleNamespace(contract=contract, connection=connection)))
