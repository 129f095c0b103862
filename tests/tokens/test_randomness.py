"""Where a Genesis collection is not deployed: chains whose seeds are known before, or can never be revealed."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from nodes import KEY, Node, anvil, needs_anvil
from proxies import Liar
from shackled.chain import Connection
from shackled.chain._address_book import VARIABLE
from shackled.cli.app import run
from shackled.errors import InputError, TransactionError
from shackled.tokens._reveal import check_randomness

NODE_OPTIONS = ("--chain-id", "42161")


@pytest.fixture
def layer_2(node: Node) -> Node:
    node.mine(20)
    return node


def test_unknown_chains_are_refused_unless_they_are_asked_for(
    layer_2: Node, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv(VARIABLE, str(tmp_path / "addresses.json"))
    monkeypatch.setenv("SOME_KEY", KEY)
    arguments = ["token", "deploy", "genesis", "--rpc", layer_2.url, "--private-key-env", "SOME_KEY"]
    before = layer_2.rpc("eth_blockNumber")
    assert run([*arguments, "--yes"]) == 2
    assert capsys.readouterr().err.startswith("shackled: chain 42161 is neither Ethereum nor one of its test networks")
    # its blocks are in order, so that it could be deployed
    assert run([*arguments, "--any-chain"]) == 2
    assert "at most" in capsys.readouterr().err
    assert layer_2.rpc("eth_blockNumber") == before


def lie(change: dict[str, Any]) -> Any:
    return {"eth_getBlockByNumber": lambda block, _: block | change}


@pytest.mark.parametrize(
    ("lies", "words"),
    [
        (lie({"mixHash": "0x" + 64 * "1"}), "some of the last 16 blocks of chain 42161 have the same randomness"),
        (lie({"mixHash": None}), "have the same randomness"),
        (lie({"extraData": "0x99"}), "whose headers have other fields than Ethereum's: that of block 19 has the hash"),
        (
            {"eth_call": lambda answer, parameters: "0x" + 64 * "3" if "to" not in parameters[0] else answer},
            "its contracts see 0x3333.* as the hash of block 19, which has 0x",
        ),
    ],
    ids=["constant", "none", "header", "hash"],
)
def test_chains_that_cannot_draw_seeds(layer_2: Node, lies: Any, words: str) -> None:
    check_randomness(layer_2.connection, any_chain=True)
    with Liar(lies).before(layer_2.url) as url, pytest.raises(TransactionError, match=words):
        check_randomness(Connection(url), any_chain=True)


@needs_anvil
def test_a_chain_without_blocks_is_taken() -> None:
    with anvil() as node:
        check_randomness(node.connection)
        for _ in range(3):
            node.rpc("evm_mine")
            check_randomness(node.connection)
        with (
            pytest.raises(InputError, match="`any_chain`"),
            Liar({"eth_chainId": lambda *_: "0xa"}).before(node.url) as url,
        ):
            check_randomness(Connection(url))
