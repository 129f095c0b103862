"""Tokens revealed by an account that the command never sees: --calldata writes the transaction, a wallet sends it."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from commands import Shackled
from forged_blocks import forged
from nodes import Node
from open_sales import open_sale
from proxies import Liar
from shackled.cli.app import run
from shackled.errors import RevertError
from shackled.ethereum import encode_header
from shackled.tokens import Collection

OWNER, WALLET = 0, 5


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
