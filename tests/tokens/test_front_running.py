"""Somebody else sends the creation of a collection first: it is the same collection, and its owner goes on."""

from __future__ import annotations

from pathlib import Path

import pytest

from nodes import Node
from shackled.chain._address_book import VARIABLE, AddressBook
from shackled.cli.app import run
from shackled.deploy import Transactor
from shackled.ethereum._encoding import checksum_address
from shackled.tokens._collection import KINDS, Collection
from shackled.tokens._demo import development_accounts
from shackled.tokens._icons import icons_of
from shackled.tokens._launch import CollectionTerms, launch, plan_launch

KIND = KINDS["icons"]
Pair = tuple[Transactor, Transactor, CollectionTerms]


@pytest.fixture
def pair(node: Node, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Pair:
    """The owner, somebody else, and the terms."""
    monkeypatch.setenv(VARIABLE, str(tmp_path / "addresses.json"))
    monkeypatch.setenv("KEY", development_accounts()[0].key.hex())
    owner, other = (Transactor(node.connection, account) for account in development_accounts(2))
    return owner, other, CollectionTerms(checksum_address(owner.address), checksum_address(owner.address))


def test_the_owner_goes_on(node: Node, pair: Pair, capsys: pytest.CaptureFixture[str]) -> None:
    _, other, terms = pair
    plan = plan_launch(node.connection, KIND, terms)
    launch(plan, other)
    AddressBook().path.unlink()
    collection = Collection(node.connection, KIND, plan.address)
    arguments = ["token", "deploy", "icons", "--icons", "tetrahedron", "--rpc", node.url, "--private-key-env", "KEY"]
    arguments += ["--signer", str(development_accounts()[5].address)]
    assert run([*arguments, "--yes"]) == 0
    said = capsys.readouterr()
    assert f"this collection is deployed at {plan.address} on chain 31337 already" in said.err
    assert f"Shackled Icons: {plan.address}\n" in said.out
    assert [icon.name for icon in icons_of(collection)] == ["Tetrahedron"]
    assert collection.contract.account("allowListSigner") == development_accounts()[5].address
    assert AddressBook().find(31337, KIND.contract) == bytes.fromhex(plan.address[2:])
    # and again where it stopped
    blocks = node.rpc("eth_blockNumber")
    assert run(arguments) == 0
    assert "nothing is missing, and nothing was sent" in capsys.readouterr().err
    assert node.rpc("eth_blockNumber") == blocks


def test_between_the_price_and_the_transaction(node: Node, pair: Pair) -> None:
    owner, other, terms = pair
    plan = plan_launch(node.connection, KIND, terms)
    launch(plan_launch(node.connection, KIND, terms), other)
    before = owner.balance()
    collection, receipt = launch(plan, owner)
    assert (collection.address, receipt) == (plan.address, None)
    assert owner.balance() == before
    assert collection.contract.account("owner") == terms.owner
