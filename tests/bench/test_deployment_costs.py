"""What deploying and storing cost, now and after EIP-8037 (benchmarks.deployment)."""

from __future__ import annotations

import pytest
from benchmarks import deployment
from tools.pages import filled

from shackled.deploy import deployments
from shackled.evm._instance import Instance, Status


def test_the_tables_are_up_to_date() -> None:
    tables = deployment.tables()
    text = deployment.PAGE.read_text("utf-8")
    assert filled(deployment.PAGE, tables.get) == text, "run python -m benchmarks.deployment"
    assert all(f"<!-- begin {name} -->" in text for name in tables)


@pytest.mark.parametrize(("gas", "size", "counted"), [(624_645, 2_618, 4_265_177), (1_481_016, 6_574, 10_383_772)])
def test_the_formula(gas: int, size: int, counted: int) -> None:
    """An EVM with drafts of the rules, @ethereumjs/vm 10.1.3, counted so much for storing a crown and a teapot."""
    assert deployment.transaction_cost(gas, size).repriced == pytest.approx(counted, abs=500)


def test_storage_is_found() -> None:
    """The collection keeps its name and its symbol; the others keep nothing. A new slot costs 87,920 gas more."""
    found = deployments(["Editions"])
    slots = deployment.new_slots(found)
    assert slots == dict.fromkeys((each.name for each in found), 0) | {"Editions": 2}
    without, with_slot = (deployment.transaction_cost(1_000_000, 1_000, count).repriced for count in (0, 1))
    assert with_slot - without == 64 * 1_530 - 20_000 + 10_000
    evm = Instance()
    # PUSH1 7 PUSH1 3 SSTORE
    address = evm.deploy(bytes.fromhex("6007600355"), 100_000)
    assert address.status == Status.SUCCESS
    evm.put(address.output, deployment.READ_SLOT)
    words = [evm.call(address.output, slot.to_bytes(32, "big"), 100_000).output for slot in (3, 4)]
    assert [int.from_bytes(word, "big") for word in words] == [7, 0]
