"""Where a picture fits, and the gas limits that are documented elsewhere."""

from __future__ import annotations

from datetime import date

import pytest

from shackled import load
from shackled.chain import open_chain
from shackled.gas import known_chains, limits, measure, render_call, search, suffices
from shackled.gas._limits import fits_as_json, fits_of, headline
from shackled.scene._look import resize

MOST = "free to read on most nodes"
TOO_MUCH = "too much for a contract to draw inside a transaction"


def test_every_limit_has_a_source_and_a_date() -> None:
    found = limits()
    assert [limit.gas for limit in found] == sorted(limit.gas for limit in found)
    assert len({limit.name for limit in found}) == len({limit.place for limit in found}) == len(found) >= 12
    for limit in found:
        assert limit.kind in ("transaction", "call")
        start = "eth_call, " if limit.kind == "call" else "one transaction on "
        assert limit.name.startswith(f"{start}{limit.place}")
        assert limit.source.startswith("https://")
        assert date(2015, 7, 30) < date.fromisoformat(limit.date)
    assert (found[0].place, found[0].gas) == ("Ethereum", 2**24)


def test_chains() -> None:
    chains = known_chains()
    assert len({each.id for each in chains}) == len({each.number for each in chains}) == len(chains)
    assert {each.name: each.gas for each in chains if each.gas != 2**24} == {
        "Monad": 30_000_000,
        "Arbitrum One": 32_000_000,
        "Polygon": 32_000_000,
    }
    for each in chains:
        assert 2 <= len(each.currency) <= 6
        # wallets are told the nodes of test networks only
        assert bool(each.node) == each.is_test
        assert each.explorer.startswith("https://") or each.id == "development"
    of_transactions = {limit.place for limit in limits() if limit.kind == "transaction"}
    assert of_transactions == {each.name for each in chains if not each.is_test}


@pytest.mark.parametrize(
    ("gas", "size", "words"),
    [
        (5_000_000, 10_000, f"{MOST}; a contract can draw it inside a transaction"),
        (27_000_000, 10_000, f"{MOST}; a contract can draw it inside a transaction on Monad, Arbitrum One and Polygon"),
        (31_000_000, 10_000, f"{MOST}; a contract can draw it inside a transaction on Arbitrum One and Polygon"),
        (40_000_000, 10_000, f"{MOST}; {TOO_MUCH}"),
        (60_000_000, 10_000, "free to read on Nethermind, Besu and Alchemy; on other nodes in tiles"),
        (200_000_000, 0, "free to read on Alchemy; on other nodes in tiles"),
        (10**10, 0, "too much for a read call of any usual node: draw it in tiles, or with fewer pixels or triangles"),
        # too many bytes for a transaction
        (1_000_000, 140_000, f"{MOST}; {TOO_MUCH}"),
    ],
)
def test_where_pictures_fit(gas: int, size: int, words: str) -> None:
    found = fits_of(gas, bytes(size))
    assert headline(found) == words
    assert [fit.limit for fit in found] == list(limits())
    for kind in ("transaction", "call"):
        places = [fit.limit.place for fit in found if fit.fits and fit.limit.kind == kind]
        assert fits_as_json(found)[f"{kind}s"] == places
    for fit in found:
        is_long = size > 128 * 1024 and fit.limit.kind == "transaction"
        assert fit.fits == (fit.needed <= fit.limit.gas and not is_long)
        assert ("140,000 bytes" in fit.reason) == is_long


def test_between_the_bounds_the_call_is_tried() -> None:
    limit = limits()[0]
    gas = limit.gas - 100_000  # fits if a call needed no more than it uses, but not by the bound
    asked: list[int] = []

    def enough(given: int) -> bool:
        asked.append(given)
        return True

    assert not fits_of(gas, b"")[0].fits
    assert fits_of(gas, b"", enough)[0].fits
    # of all that have this limit
    assert asked == [limit.gas - 21_000] * sum(each.gas == limit.gas for each in limits())
    assert not fits_of(gas, b"", lambda given: False)[0].fits


def test_the_bound_is_enough_and_close() -> None:
    chain = open_chain()
    scene = resize(load("icosahedron"), 32)
    exact, data = measure(scene, chain), render_call(scene)
    needed = search(suffices(chain, "Renderer", data)).gas
    (fit, *_) = fits_of(exact.gas, data)
    assert exact.limit(needed) <= fit.needed <= exact.limit(needed) * 1.02
