"""Where a picture fits."""

from __future__ import annotations

from shackled import load
from shackled.chain import EmbeddedChain, open_chain
from shackled.creator import by_trying, headline, places
from shackled.gas import limits, measure, render_call, search, suffices
from shackled.scene import resize


def test_a_small_picture_fits_everywhere() -> None:
    found = places(5_000_000, 100_000, bytes(10_000))
    assert all(fit.fits for fit in found)
    assert [fit.limit for fit in found] == sorted(limit.gas for limit in limits())
    assert headline(found) == "fits one transaction, and any node's read call"


def test_a_large_one_fits_fewer_places() -> None:
    found = places(60_000_000, 100_000, bytes(10_000))
    assert 0 < sum(fit.fits for fit in found) < len(found)
    assert "kinds of nodes" in headline(found)
    assert all(fit.fits == (fit.share <= 1) for fit in found)


def test_the_largest_fits_nowhere() -> None:
    assert headline(places(10**10, 100_000, b"")).startswith("fits no usual node")


def test_too_many_bytes_for_a_transaction() -> None:
    found = places(1_000_000, 2_000_000, bytes(140_000))
    transaction = next(fit for fit in found if fit.kind == "transaction")
    assert not transaction.fits
    assert "140,000 bytes" in transaction.reason
    assert all(fit.fits for fit in found if fit.kind == "call")


def test_between_the_bounds_the_call_is_tried() -> None:
    limit = next(each for each in limits() if each.kind == "transaction")
    gas = limit.gas - 100_000  # fits if a call needed no more than it uses, but not by the bound
    asked: list[int] = []

    def enough(given: int) -> bool:
        asked.append(given)
        return True

    assert not places(gas, 50_000, b"")[0].fits
    assert places(gas, 50_000, b"", enough)[0].fits
    assert asked == [limit.gas - 50_000]
    assert not places(gas, 50_000, b"", lambda given: False)[0].fits


def test_the_bound_is_enough_and_close() -> None:
    chain = open_chain()
    assert isinstance(chain, EmbeddedChain)
    scene = resize(load("icosahedron"), 32)
    exact, data = measure(scene, chain), render_call(scene)
    needed = search(suffices(chain, "Renderer", data)).gas
    (fit, *_) = places(exact.gas, exact.intrinsic_gas, data)
    assert exact.limit(needed) <= fit.needed <= exact.limit(needed) * 1.02
    works = by_trying(lambda gas: chain.call("Renderer", data, gas))
    assert works(needed)
    assert not works(needed - 1)
