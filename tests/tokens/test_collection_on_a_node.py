"""A Genesis collection with one token: what its owner says, what goes wrong, and what is found out."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest
from web3 import Web3

from commands import Shackled
from nodes import Node, Reply, failure, replying, serving
from pictures import pixels_of
from shackled.artifacts import artifact
from shackled.chain import Connection
from shackled.chain._address_book import AddressBook
from shackled.cli.app import run
from shackled.deploy._contract import local_chain
from shackled.errors import ChainError, NodeError
from shackled.tokens import open_collection
from shackled.tokens._allow_list import read_allow_list
from shackled.tokens._contract import Contract
from shackled.tokens._launch import immutable_places
from shackled.tokens._verify import check_collection_code, check_token

OWNER, ALICE, BOB = range(3)
PRICE = 2 * 10**17


@pytest.fixture(scope="module")
def address(running_node: Node, genesis: str) -> str:
    """The collection, closed, with one token."""
    contract, accounts = running_node.contract("GenesisCollection", genesis), running_node.accounts
    running_node.transact(contract.functions.mintReserve(accounts[ALICE], 1), accounts[OWNER])
    return genesis


def test_terms_are_those_of_the_command(node: Node, address: str) -> None:
    book = AddressBook().entries(31337)
    others = ["Genesis", "GenesisCollection", "GenesisMetadata", "PngEncoder", "Renderer"]
    assert sorted(book) == sorted([*artifact("Renderer").parts, *others]), "what is not needed is not deployed"
    ask = open_collection(node.url, address).contract.call
    assert (ask("price"), ask("reserve")) == (PRICE, 1012)
    assert ask("royaltyInfo", 0, 1000)[1] == 75
    assert {ask(name) for name in ("owner", "allowListSigner")} == {node.accounts[OWNER].lower()}
    assert any(ask("allowListRoot"))


def test_the_same_collection_is_not_deployed_twice(node: Node, address: str, shackled: Shackled) -> None:
    sale = ["--price", "0.2", "--reserve", "1012", "--royalty", "7.5", "--yes"]
    before = node.web3.eth.block_number
    said = shackled("token", "deploy", "genesis", *sale, user=OWNER)
    assert f"this collection is deployed at {address} on chain 31337 already" in said.err
    assert "nothing was sent; another --salt makes another collection" in said.err
    assert node.web3.eth.block_number == before
    assert json.loads(shackled("token", "deploy", "genesis", *sale, "--json", user=OWNER).out) == {
        "collection": "genesis",
        "address": address,
        "chain_id": 31337,
        "transaction": None,
        "gas": 0,
    }


@pytest.mark.parametrize(
    ("arguments", "code", "said"),
    [
        (("show", 999), 2, "there is no token 999 of Shackled Genesis: they are numbered 0 to"),
        (("transfer", 999, "0x" + "12" * 20, "--yes"), 2, "there is no token 999"),
        (("show", 0, "--chain-id", 1), 1, "belongs to chain 31337, not to chain 1"),
        (("show", 0, "--collection", "0x" + "12" * 20), 2, "there is no Shackled collection at 0x1212"),
        (("show", 0, "--collection", "punks"), 2, "--collection must be genesis, icons or an address, not 'punks'"),
        (("show", 0, "-o", "picture.tif"), 2, "must end in one of .png .bmp"),
        (("mint", "--yes"), 2, "nothing was sent: name an account"),
        (("phase", "open"), 2, "the phase must be one of closed, allow-list, public"),
        (("deploy", "punks"), 2, "the collection must be one of genesis, icons"),
        (("deploy", "icons", "--icons", "heart", "--supply", "0"), 2, "the supply of an icon must be"),
        (("deploy", "genesis", "--price", "much"), 2, "--price must be an amount of ether"),
        (("deploy", "genesis", "--royalty", "11"), 2, "--royalty must be a finite number from 0 to 10, not 11"),
        (("deploy", "genesis", "--reserve", "1025", "--private-key-env", "KEY_0"), 2, "whole number from 0 to 1024"),
        (("deploy", "genesis", "--allow-list", "none.csv"), 2, "the allow list none.csv cannot be read"),
    ],
)
def test_mistakes_are_reported_in_one_line(
    address: str, shackled: Shackled, arguments: tuple[object, ...], code: int, said: str
) -> None:
    result = shackled("token", *arguments, expect=code)
    assert said in result.error
    assert len(result.err.strip().splitlines()) == 1


def test_a_node_in_a_variable_sends_no_list(
    node: Node, address: str, allow_list: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The root alone is asked for, by one who has named a node for everything else."""
    root = read_allow_list(allow_list).root.hex()
    monkeypatch.setenv("SHACKLED_RPC", node.url)
    assert run(["token", "allow-list", str(allow_list)]) == 0
    assert capsys.readouterr().out.startswith(f"root 0x{root}, ")
    assert run(["token", "allow-list", str(allow_list), "--rpc", node.url]) == 2
    assert "name an account" in capsys.readouterr().err


def test_without_a_signer_nobody_permits(node: Node, address: str, shackled: Shackled) -> None:
    contract = node.contract("GenesisCollection", address)
    root = contract.functions.allowListRoot().call()
    node.transact(contract.functions.setAllowList(root, "0x" + "00" * 20), node.accounts[OWNER])
    said = shackled("token", "permit", node.accounts[BOB], 1, user=OWNER, expect=2)
    assert said.error.startswith("shackled: the collection accepts no permissions yet")


def test_strangers_may_say_anything(node: Node, address: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Also contracts that have the name; and only an answer of another contract means that there is no collection."""
    collection = open_collection(node.url, address)
    monkeypatch.setattr(collection.contract, "call", lambda _: 7)
    with pytest.raises(NodeError, match="returned an unknown phase of its sale, 7"):
        collection.phase()
    with serving(lambda _: failure("0x is not a known tag")) as url, pytest.raises(NodeError, match="a known tag"):
        open_collection(url, address)


def test_the_owner_changes_in_two_steps(node: Node, address: str, shackled: Shackled) -> None:
    contract = node.contract("GenesisCollection", address)
    assert "is not offered to anyone" in shackled("token", "accept-ownership", "--yes", user=ALICE, expect=2).error
    shackled("token", "transfer-ownership", node.accounts[ALICE], "--yes", user=OWNER)
    assert contract.functions.owner().call() == node.accounts[OWNER]
    said = shackled("token", "accept-ownership", "--yes", user=BOB, expect=2)
    assert f"is offered to {node.accounts[ALICE]}, not to {node.accounts[BOB]}" in said.error
    shackled("token", "accept-ownership", "--yes", user=ALICE)
    assert contract.functions.owner().call() == node.accounts[ALICE]


def test_royalties_are_changed_by_the_owner(node: Node, address: str, shackled: Shackled) -> None:
    contract = node.contract("GenesisCollection", address)
    assert "only the owner" in shackled("token", "royalty", 2, "--yes", user=BOB, expect=1).error
    shackled("token", "royalty", 2.5, "--receiver", node.accounts[6], "--yes", user=OWNER)
    assert contract.functions.royaltyInfo(0, 1000).call() == [node.accounts[6], 25]
    shackled("token", "royalty", 7.5, "--receiver", node.accounts[OWNER], "--yes", user=OWNER)
    assert contract.functions.royaltyInfo(0, 1000).call() == [node.accounts[OWNER], 75]


def test_changed_code_is_found(node: Node, address: str, shackled: Shackled) -> None:
    """Anywhere, and in every place of an immutable value."""
    collection = open_collection(Connection(node.url), address)
    code = bytes(node.web3.eth.get_code(Web3.to_checksum_address(address)))
    places = immutable_places(artifact("GenesisCollection").runtime)
    elsewhere = next(at for at in range(1000, len(code)) if all(not p <= at < p + 32 for p in places))
    changes = {at + 31: "its code has 0x" for at in places}
    changes[elsewhere] = f"differs from the compiled contract at byte {elsewhere:,}"
    check_collection_code(collection)
    for at, complaint in changes.items():
        changed = code[:at] + bytes([code[at] ^ 1]) + code[at + 1 :]
        node.rpc("anvil_setCode", address, "0x" + changed.hex())
        with pytest.raises(ChainError, match=complaint):
            check_collection_code(collection)
    said = shackled("token", "verify", 0, expect=1)
    assert f"WRONG  GenesisCollection at {address}" in said.out
    assert said.error == "shackled: 1 of the checks failed"


@pytest.mark.parametrize(
    "refusal",
    [failure("out of gas"), failure("Transaction reverted without a reason string", -32603, "0x")],
    ids=["out of gas", "a revert that says nothing"],
)
def test_what_a_node_does_not_let_be_read_is_not_wrong(
    node: Node, address: str, shackled: Shackled, capsys: pytest.CaptureFixture[str], refusal: Reply
) -> None:
    """Some nodes give a call less gas than a tokenURI takes, and say of it only that it was reverted."""
    data = Contract(node.connection, "GenesisCollection", address).interface.encode("tokenURI", 0).hex()
    with replying(node.url, eth_call=lambda request: refusal if data in json.dumps(request) else None) as url:
        assert run(["token", "show", "0", "--rpc", url]) == 1
        assert "too little gas for tokenURI" in capsys.readouterr().err
        assert run(["token", "verify", "0", "--rpc", url]) == 1
    said = capsys.readouterr()
    assert "WRONG" not in said.out
    assert re.search("^unread Shackled Genesis #0: the node.*too little gas for tokenURI", said.out, re.M)
    assert said.err.startswith("shackled: no check failed, but 1 of the tokens could not be read")


def test_another_randomness_than_that_of_the_block_is_found(
    node: Node, address: str, shackled: Shackled, monkeypatch: pytest.MonkeyPatch
) -> None:
    contract = node.contract("GenesisCollection", address)
    node.transact(contract.functions.setPhase(2), node.accounts[OWNER])
    node.mine(40)
    node.transact(contract.functions.mint(1), node.accounts[BOB], PRICE)
    token = contract.functions.totalSupply().call() - 1
    node.mine(200)
    shackled("token", "reveal", "--yes", user=BOB)
    assert "WRONG" not in shackled("token", "verify", token).out
    number = contract.functions.roundOf(token).call()
    randomness = contract.functions.randomnessOf(number).call()
    # where the mapping keeps it: the slot of the mapping is one of the first
    places = [Web3.keccak(number.to_bytes(32, "big") + slot.to_bytes(32, "big")) for slot in range(40)]
    (place,) = (
        each for each in places if node.web3.eth.get_storage_at(contract.address, int.from_bytes(each)) == randomness
    )
    node.rpc("anvil_setStorageAt", address, "0x" + place.hex(), "0x" + Web3.keccak(b"chosen").hex())
    said = shackled("token", "verify", token, expect=1)
    assert f"WRONG  Shackled Genesis #{token}: the randomness of its round differs from that of block" in said.out
    # what cannot be compared is not said to be right
    collection = open_collection(Connection(node.url), address)
    ask = collection.connection.request
    monkeypatch.setattr(
        collection.connection,
        "request",
        lambda method, *rest: None if method == "eth_getBlockByNumber" else ask(method, *rest),
    )
    with pytest.raises(NodeError, match="does not have block"):
        check_token(collection, token, local_chain())


def test_a_picture_file_may_be_of_another_kind(address: str, tmp_path: Path, shackled: Shackled) -> None:
    files = tmp_path / "a.png", tmp_path / "a.bmp"
    for each in files:
        shackled("token", "show", 0, "-o", each)
    one, other = (pixels_of(each) for each in files)
    np.testing.assert_array_equal(one, other)
