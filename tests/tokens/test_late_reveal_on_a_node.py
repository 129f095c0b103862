"""Tokens that nobody revealed until the chain had forgotten their block."""

from __future__ import annotations

import json
from functools import partial
from pathlib import Path
from typing import Any

import pytest

from nodes import anvil, needs_anvil
from open_sales import open_sale
from proxies import Liar
from shackled.chain import VARIABLE
from shackled.cli.app import run
from shackled.deploy import Receipt
from shackled.tokens import hidden_rounds, reveal_calls
from shackled.tokens._contract import perform
from shackled.tokens._reveal import HEADERS_AT_ONCE, KNOWN_BLOCKS_BEFORE


@needs_anvil
def test_an_old_block_is_proven_by_the_headers_after_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv(VARIABLE, str(tmp_path / "addresses.json"))
    # these rules forget hashes after 256 blocks; later ones, by EIP-2935, after 8,191
    with anvil("--hardfork", "cancun") as node:
        user, collection = open_sale(node.connection)
        contract = collection.contract
        node.rpc("anvil_mine", hex(40))
        perform(user, contract.prepare("mint", 1, value=contract.call("price")))
        node.rpc("anvil_mine", hex(40))
        node.rpc("anvil_mine", hex(KNOWN_BLOCKS_BEFORE + 128 + HEADERS_AT_ONCE))
        rounds = hidden_rounds(collection)
        assert len(rounds) == 2
        assert not any(any(contract.call("hashOf", each.block)) for each in rounds)
        # from any wallet: what --calldata writes is sent by another account
        before = node.rpc("evm_snapshot")
        monkeypatch.chdir(tmp_path)
        assert run(["token", "reveal", "--rpc", node.url, "--calldata", "calls.json"]) == 0
        assert "any account can send them, in this order" in capsys.readouterr().err
        written = json.loads(Path("calls.json").read_text())["calls"]
        assert [call["name"].partition(" ")[0] for call in written] == ["prove"] * 3 + ["reveal"]
        assert len({call["name"] for call in written}) == 4
        for call in written:
            call.pop("name")
            digest = node.rpc("eth_sendTransaction", call | {"from": node.rpc("eth_accounts")[7]})
            receipt = user.wait(partial(node.rpc, "eth_getTransactionReceipt", digest))
            assert receipt["status"] == "0x1"
        assert hidden_rounds(collection) == []
        node.rpc("evm_revert", before)
        # a node that tells other headers of the old blocks
        for number in (rounds[0].block, rounds[1].block + 3, rounds[1].block):
            parent = node.rpc("eth_getBlockByNumber", hex(number - 1), False)
            lies: dict[str, Any] = {
                "eth_getBlockByNumber": lambda block, asked, n=number, p=parent: p if asked[0] == hex(n) else block
            }
            with Liar(lies).before(node.url) as url:
                assert run(["token", "reveal", "--rpc", url, "--calldata", "other.json"]) == 1
            assert f"returned a wrong header of block {number}: its hash is" in capsys.readouterr().err
        assert not Path("other.json").exists()
        receipts: dict[str, list[Receipt]] = {}
        for purpose, step in reveal_calls(collection, rounds).items():
            done = perform(user, step)
            assert done.gas <= step.gas
            receipts.setdefault(purpose.partition(" ")[0], []).append(done)
        # one transaction does not take all headers, and the older round begins where the younger one ended
        assert len(receipts["prove"]) == 3
        assert len(receipts["reveal"]) == 1
        assert hidden_rounds(collection) == []
        for each in rounds:
            block = node.rpc("eth_getBlockByNumber", hex(each.block), False)
            assert contract.call("randomnessOf", each.number).hex() == block["mixHash"][2:]
