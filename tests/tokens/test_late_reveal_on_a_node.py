"""Tokens that nobody revealed until the chain had forgotten their block."""

from __future__ import annotations

from pathlib import Path

import pytest

from nodes import anvil, needs_anvil
from shackled.chain import VARIABLE
from shackled.deploy import Receipt, Transactor
from shackled.ethereum import checksum_address
from shackled.tokens import (
    HEADERS_AT_ONCE,
    KINDS,
    KNOWN_BLOCKS_BEFORE,
    CollectionTerms,
    development_accounts,
    hidden_rounds,
    launch,
    perform,
    plan_launch,
    reveal_calls,
)


@needs_anvil
def test_an_old_block_is_proven_by_the_headers_after_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(VARIABLE, str(tmp_path / "addresses.json"))
    # these rules forget hashes after 256 blocks; later ones, by EIP-2935, after 8,191
    with anvil("--hardfork", "cancun") as node:
        user = Transactor(node.connection, development_accounts(1)[0])
        name = checksum_address(user.address)
        collection, _ = launch(plan_launch(user.connection, KINDS["genesis"], CollectionTerms(name, name)), user)
        contract = collection.contract
        perform(user, contract, "setPhase", 2)
        for _ in range(2):
            perform(user, contract, "mint", 1, value=contract.call("price"))
            node.rpc("anvil_mine", hex(40))
        node.rpc("anvil_mine", hex(KNOWN_BLOCKS_BEFORE + 128 + HEADERS_AT_ONCE))
        rounds = hidden_rounds(collection)
        assert len(rounds) == 2
        assert not any(any(contract.call("hashOf", each.block)) for each in rounds)
        receipts: dict[str, list[Receipt]] = {}
        for step in reveal_calls(collection, rounds):
            receipt = perform(user, contract, step.function, *step.arguments, gas=step.gas)
            assert receipt.gas <= step.gas
            receipts.setdefault(step.function, []).append(receipt)
        # one transaction does not take all headers, and the older round begins where the younger one ended
        assert len(receipts["keepHash"]) == 3
        assert len(receipts["reveal"]) == 1
        assert hidden_rounds(collection) == []
        for each in rounds:
            block = node.rpc("eth_getBlockByNumber", hex(each.block), False)
            assert contract.call("randomnessOf", each.number).hex() == block["mixHash"][2:]
