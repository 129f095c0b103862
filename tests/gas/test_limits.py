"""The gas limits that are documented elsewhere."""

from __future__ import annotations

from datetime import date

from shackled.gas import limits


def test_every_limit_has_a_source_and_a_date() -> None:
    found = limits()
    assert [limit.gas for limit in found] == sorted(limit.gas for limit in found)
    assert len({limit.name for limit in found}) == len(found) >= 6
    for limit in found:
        assert limit.kind in ("transaction", "call")
        assert limit.name.startswith(f"eth_call, {limit.node}") if limit.kind == "call" else limit.node == ""
        assert limit.source.startswith("https://")
        assert date(2015, 7, 30) < date.fromisoformat(limit.date)


def test_a_transaction_has_the_smallest() -> None:
    (transaction,) = (limit for limit in limits() if limit.kind == "transaction")
    assert transaction.gas == 2**24
    assert limits()[0] == transaction
