"""Where a picture fits, and the gas limits that are documented elsewhere."""

from __future__ import annotations

from datetime import date

import pytest

from shackled import load
from shackled.chain import open_chain
from shackled.gas import fits_of, headline, limits, measure, render_call, search, suffices
from shackled.scene import resize


def test_every_limit_has_a_source_and_a_date() -> None:
    found = limits()
    assert [limit.gas for limit in found] == sorted(limit.gas for limit in found)
    assert len({limit.name for limit in found}) == len(found) >= 6
    for limit in found:
        assert limit.kind in ("transaction", "call")
        assert limit.name.startswith(f"eth_call, {limit.node}") if limit.kind == "call" else limit.node == ""
        assert limit.source.startswith("https://")
        assert date(2015, 7, 30) < date.fromisoformat(limit.date)

    (transaction,) = (limit for limit in found if limit.kind == "transaction")
    assert (transaction, transaction.gas) == (found[0], 2**24)


@pytest.mark.parametrize(
    ("gas", "size", "words"),
    [
        (5_000_000, 10_000, "fits one transaction, and any node's read call"),
        (60_000_000, 10_000, "fits calls of Nethermind, Besu and Alchemy; no transaction"),
        (200_000_000, 0, "fits calls of Alchemy; no transaction"),
        (10**10, 0, "fits no usual node: take fewer pixels or triangles"),
        # too many bytes for a transaction
        (1_000_000, 140_000, "fits any node's read call; no transaction"),
    ],
)
def test_where_pictures_fit(gas: int, size: int, words: str) -> None:
    found = fits_of(gas, bytes(size))
    assert headline(found) == words
    assert [fit.limit for fit in found] == list(limits())
    for fit in found:
        is_long = size > 128 * 1024 and fit.limit.kind == "transaction"
        assert fit.fits == (fit.needed <= fit.limit.gas and not is_long)
        assert ("140,000 bytes" in fit.reason) == is_long


def test_between_the_bounds_the_call_is_tried() -> None:
    limit = next(each for each in limits() if each.kind == "transaction")
    gas = limit.gas - 100_000  # fits if a call needed no more than it uses, but not by the bound
    asked: list[int] = []

    def enough(given: int) -> bool:
        asked.append(given)
        return True

    assert not fits_of(gas, b"")[0].fits
    assert fits_of(gas, b"", enough)[0].fits
    assert asked == [limit.gas - 21_000]
    assert not fits_of(gas, b"", lambda given: False)[0].fits


def test_the_bound_is_enough_and_close() -> None:
    chain = open_chain()
    scene = resize(load("icosahedron"), 32)
    exact, data = measure(scene, chain), render_call(scene)
    needed = search(suffices(chain, "Renderer", data)).gas
    (fit, *_) = fits_of(exact.gas, data)
    assert exact.limit(needed) <= fit.needed <= exact.limit(needed) * 1.02
