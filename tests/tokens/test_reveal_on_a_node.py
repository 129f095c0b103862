"""Tokens revealed on real nodes: by headers as nodes make them, early and late, and by a wallet, with --calldata."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from eth_abi.abi import encode
from web3 import Web3

from commands import Shackled
from forged_blocks import forged
from nodes import Node, anvil, needs_anvil
from open_sales import open_sale
from proxies import Liar
from shackled.chain._address_book import VARIABLE
from shackled.cli.app import run
from shackled.errors import RevertError
from shackled.ethereum._encoding import encode_header
from shackled.tokens._collection import Collection
from shackled.tokens._contract import perform
from shackled.tokens._reveal import HEADERS_AT_ONCE, KNOWN_BLOCKS_BEFORE, hidden_rounds
from token_checks import document, traits

WALLET = 5


@pytest.fixture(scope="module")
def collection(running_node: Node, users: list[str]) -> Collection:
    """A collection with a token of round 0, minted in the last block."""
    return open_sale(running_node.connection)[1]


@pytest.fixture(autouse=True)
def _folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def written() -> Any:
    return json.loads(Path("calls.json").read_text())


def mine_until(node: Node, collection: Collection, missing: int) -> int:
    """Makes blocks until so many are missing; the block of round 0."""
    block = int(collection.contract.call("blockOf", 0))
    node.mine(block + 1 - missing - int(node.rpc("eth_blockNumber"), 16))
    return block


def send(node: Node, call: dict[str, str]) -> int:
    """Sends it as a wallet does; the gas that it used."""
    fields = {key: call[key] for key in ("to", "value", "data", "gas")}
    digest = node.rpc("eth_sendTransaction", {"from": node.accounts[WALLET], **fields})
    receipt = node.web3.eth.wait_for_transaction_receipt(digest)
    assert receipt["status"] == 1
    return receipt["gasUsed"]


@pytest.mark.parametrize("delay", [1, 2, 255, 256, 257, 400])
def test_soon_and_late(node: Node, collection: Collection, delay: int) -> None:
    """Headers as a node makes them, and hashes of blocks that are less than 256 blocks old."""
    genesis = node.contract("GenesisCollection", collection.address)
    call = genesis.functions
    block = call.blockOf(call.roundOf(0).call()).call()
    assert traits(document(call.tokenURI(0).call())) == {"Revealed": "No"}
    # the transaction is in the next block; nodes estimate its gas as if it were in the last one
    node.mine(block + delay - 1 - node.web3.eth.block_number)
    header = encode_header(node.connection.block(block))
    sent = call.reveal([0], [header]).transact({"from": node.accounts[2], "gas": 500_000})
    assert node.web3.eth.wait_for_transaction_receipt(sent)["blockNumber"] == block + delay
    randomness = bytes(node.web3.eth.get_block(block)["mixHash"])
    assert call.randomnessOf(0).call() == randomness
    drawn = bytes(Web3.keccak(randomness + encode(["address", "uint256"], [genesis.address, 0])))
    assert call.seedOf(0).call() == drawn
    # at the node's own limit on gas
    assert f"Seed 0x{drawn.hex()}." in document(call.tokenURI(0).call())["description"]


def test_a_wallet_reveals(node: Node, collection: Collection, shackled: Shackled) -> None:
    block = mine_until(node, collection, 0)
    said = shackled("token", "reveal", "--calldata", "calls.json")
    assert "nothing was sent: calls.json has 1 transaction" in said.err
    document = written()
    (call,) = document["calls"]
    assert int(document["chainId"], 16) == 31337
    assert (call["name"], call["value"]) == ("reveal 1 round, 0", "0x0")
    assert call["to"] == collection.address
    # web3.py reads the same call in it
    genesis = node.contract("GenesisCollection", collection.address)
    function, arguments = genesis.decode_function_input(call["data"])
    assert function.fn_name == "reveal"
    assert arguments == {"rounds": [0], "headers": [encode_header(node.connection.block(block))]}
    assert send(node, call) <= int(call["gas"], 16)
    assert genesis.functions.randomnessOf(0).call() == node.web3.eth.get_block(block)["mixHash"]
    # there is nothing more
    Path("calls.json").unlink()
    said = shackled("token", "reveal", "--calldata", "calls.json", expect=2)
    assert said.error == "shackled: there is nothing to reveal: calls.json was not written"
    assert not Path("calls.json").exists()
    assert json.loads(shackled("token", "reveal", "--json").out) == {"rounds": [], "transactions": [], "gas": 0}


def test_with_json_only_json_is_printed(node: Node, collection: Collection, shackled: Shackled) -> None:
    mine_until(node, collection, 0)
    said = shackled("token", "reveal", "--calldata", "calls.json", "--json")
    assert json.loads(said.out) == written()
    reported = json.loads(shackled("token", "reveal", "--json", "--yes", user=WALLET).out)
    receipt = node.web3.eth.get_transaction_receipt(reported["transactions"][0])
    assert (reported["rounds"], reported["gas"]) == ([0], receipt["gasUsed"])


def test_a_block_to_come_is_reported_or_waited_for(
    node: Node, collection: Collection, shackled: Shackled, monkeypatch: pytest.MonkeyPatch
) -> None:
    for missing, words in ((3, "3 more blocks"), (1, "1 more block")):
        block = mine_until(node, collection, missing)
        said = shackled("token", "reveal", "--calldata", "calls.json", expect=2)
        assert said.error == (
            f"shackled: block {block} determines the next seeds, and the chain is at {block + 1 - missing}: "
            f"wait for {words}, or add --wait"
        )
        assert not Path("calls.json").exists()
    # one block less would do for the contract, but no node would simulate the call
    with pytest.raises(RevertError):
        collection.contract.call("reveal", [0], [encode_header(node.connection.block(block))])
    pauses: list[float] = []

    def one_block(seconds: float) -> None:
        pauses.append(seconds)
        node.mine(1)

    monkeypatch.setattr("time.sleep", one_block)
    said = shackled("token", "reveal", "--calldata", "calls.json", "--wait")
    assert len(pauses) == 1
    assert f"waiting for block {block}: 1 more block" in said.err
    send(node, written()["calls"][0])
    assert any(collection.contract.call("randomnessOf", 0))


def forging(**changes: str) -> dict[str, Any]:
    """A lie about old blocks: another header, with the hash that belongs to it."""
    return {"eth_getBlockByNumber": lambda block, asked: block if asked[0] == "latest" else forged(block, **changes)}


def test_nodes_that_lie_get_nothing_written(
    node: Node, collection: Collection, capsys: pytest.CaptureFixture[str]
) -> None:
    """Each header that they tell has the hash that they tell: only the collection says that the block has another."""
    block = mine_until(node, collection, 0)
    parent, right = (node.rpc("eth_getBlockByNumber", hex(number), False) for number in (block - 1, block))

    def reported(lies: dict[str, Any]) -> str:
        with Liar(lies).before(node.url) as url:
            assert run(["token", "reveal", "--calldata", "calls.json", "--rpc", url]) == 1
        assert not Path("calls.json").exists()
        return capsys.readouterr().err.splitlines()[-1]

    for lies in (
        forging(mixHash="0x" + "77" * 32),
        forging(extraData="0x00"),
        {"eth_getBlockByNumber": lambda block, asked: block if asked[0] == "latest" else parent},
    ):
        error = reported(lies)
        assert f"returned a wrong header of block {block}: its hash is 0x" in error
        assert f"that of the block is {right['hash']}" in error
    # one that lies about the hash too is caught by the simulation
    lies = forging(mixHash="0x" + "77" * 32)
    other = lies["eth_getBlockByNumber"](right, [hex(block), False])["hash"]
    asked = "0x" + collection.contract.interface.encode("hashOf", block).hex()
    lies["eth_call"] = lambda answer, parameters: other if parameters[0]["data"] == asked else answer
    assert "WrongHeader" in reported(lies)


@needs_anvil
def test_an_old_block_is_proven_by_the_headers_after_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Tokens that nobody revealed until the chain had forgotten their block."""
    monkeypatch.setenv(VARIABLE, str(tmp_path / "addresses.json"))
    # these rules forget hashes after 256 blocks; later ones, by EIP-2935, after 8,191
    with anvil("--hardfork", "cancun") as node:
        user, collection = open_sale(node.connection)
        contract = collection.contract
        node.mine(40)
        perform(user, contract.prepare("mint", 1, value=contract.call("price")))
        node.mine(40 + KNOWN_BLOCKS_BEFORE + 128 + HEADERS_AT_ONCE)
        rounds = hidden_rounds(collection)
        assert len(rounds) == 2
        assert not any(any(contract.call("hashOf", each.block)) for each in rounds)
        # a node that tells other headers of the old blocks
        for number in (rounds[0].block, rounds[1].block + 3, rounds[1].block):
            parent = node.rpc("eth_getBlockByNumber", hex(number - 1), False)
            lies: dict[str, Any] = {
                "eth_getBlockByNumber": lambda block, asked, n=number, p=parent: p if asked[0] == hex(n) else block
            }
            with Liar(lies).before(node.url) as url:
                assert run(["token", "reveal", "--rpc", url, "--calldata", "calls.json"]) == 1
            assert f"returned a wrong header of block {number}: its hash is" in capsys.readouterr().err
        assert not Path("calls.json").exists()
        assert run(["token", "reveal", "--rpc", node.url, "--calldata", "calls.json"]) == 0
        assert "any account can send them, in this order" in capsys.readouterr().err
        # one transaction does not take all headers, and the older round begins where the younger one ended
        assert [call["name"].partition(" ")[0] for call in written()["calls"]] == ["prove"] * 3 + ["reveal"]
        assert len({call["name"] for call in written()["calls"]}) == 4
        for call in written()["calls"]:
            send(node, call)
        assert hidden_rounds(collection) == []
        for each in rounds:
            block = node.rpc("eth_getBlockByNumber", hex(each.block), False)
            assert contract.call("randomnessOf", each.number).hex() == block["mixHash"][2:]
