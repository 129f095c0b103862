"""Where a picture fits, and the gas limits that are documented elsewhere."""

from __future__ import annotations

from datetime import date

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


def test_a_transaction_has_the_smallest() -> None:
    (transaction,) = (limit for limit in limits() if limit.kind == "transaction")
    assert transaction.gas == 2**24
    assert limits()[0] == transaction


def test_a_small_picture_fits_everywhere() -> None:
    found = fits_of(5_000_000, 100_000, bytes(10_000))
    assert all(fit.fits for fit in found)
    assert [fit.limit.gas for fit in found] == sorted(limit.gas for limit in limits())
    assert headline(found) == "fits one transaction, and any node's read call"


def test_a_large_one_fits_fewer_places() -> None:
    found = fits_of(60_000_000, 100_000, bytes(10_000))
    assert 0 < sum(fit.fits for fit in found) < len(found)
    assert headline(found) == "fits calls of Nethermind, Besu and Alchemy; no transaction"
    assert headline(fits_of(200_000_000, 0, b"")) == "fits calls of Alchemy; no transaction"
    assert all(fit.fits == (fit.share <= 1) for fit in found)


def test_the_largest_fits_nowhere() -> None:
    assert headline(fits_of(10**10, 100_000, b"")).startswith("fits no usual node")


def test_too_many_bytes_for_a_transaction() -> None:
    found = fits_of(1_000_000, 2_000_000, bytes(140_000))
    transaction = next(fit for fit in found if fit.limit.kind == "transaction")
    assert not transaction.fits
    assert "140,000 bytes" in transaction.reason
    assert all(fit.fits for fit in found if fit.limit.kind == "call")
    assert headline(found) == "fits any node's read call; no transaction"


def test_between_the_bounds_the_call_is_tried() -> None:
    limit = next(each for each in limits() if each.kind == "transaction")
    gas = limit.gas - 100_000  # fits if a call needed no more than it uses, but not by the bound
    asked: list[int] = []

    def enough(given: int) -> bool:
        asked.append(given)
        return True

    assert not fits_of(gas, 50_000, b"")[0].fits
    assert fits_of(gas, 50_000, b"", enough)[0].fits
    assert asked == [limit.gas - 50_000]
    assert not fits_of(gas, 50_000, b"", lambda given: False)[0].fits


def test_the_bound_is_enough_and_close() -> None:
    chain = open_chain()
    scene = resize(load("icosahedron"), 32)
    exact, data = measure(scene, chain), render_call(scene)
    needed = search(suffices(chain, "Renderer", data)).gas
    (fit, *_) = fits_of(exact.gas, exact.intrinsic_gas, data)
    assert exact.limit(needed) <= fit.needed <= exact.limit(needed) * 1.02
