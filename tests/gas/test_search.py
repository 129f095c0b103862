"""The search for the least gas limit, and by what it differs from the gas that is used."""

from __future__ import annotations

import pytest
from attrs import evolve

from made_scenes import SMALL_SCENES
from shackled import RenderError
from shackled.chain import open_chain
from shackled.errors import OutOfGasError
from shackled.gas import measure, render_call, search, suffices
from shackled.gas._limits import KEPT, floor_gas, needed_for
from shackled.gas._search import FIRST_LIMIT, SearchStep

NAMES = tuple(SMALL_SCENES)


@pytest.mark.parametrize("least", [1, 2, 3, 1000, FIRST_LIMIT - 1, FIRST_LIMIT, FIRST_LIMIT + 1, 77_777_777])
def test_it_finds_the_least_that_is_enough(least: int) -> None:
    steps: list[SearchStep] = []
    found = search(lambda limit: limit >= least, steps.append)
    assert (found.gas, found.steps, found.calls) == (least, tuple(steps), len(steps))
    # no call is wasted
    assert len({step.limit for step in steps}) == len(steps) <= 2 + 2 * 27
    low, high = 0, None
    for step in steps:
        low, high = (low, step.limit) if step.limit >= least else (step.limit, high)
        assert step == SearchStep(step.limit, step.limit >= least, low, high)
    assert (low, high) == (least - 1, least)


def test_nothing_is_enough() -> None:
    with pytest.raises(OutOfGasError, match="30,000,000,000 gas, the most that is tried, is not enough"):
        search(lambda _: False)


def test_all_but_a_64th() -> None:
    for gas in [*range(1, 500), 3_845_517, 10**9 + 7]:
        least = needed_for(gas)
        assert least - least // KEPT >= gas
        assert (least - 1) - (least - 1) // KEPT < gas
    assert needed_for(0) == 0


@pytest.mark.parametrize("name", NAMES)
def test_the_search_and_the_exact_figure_agree(name: str) -> None:
    chain = open_chain()
    scene = SMALL_SCENES[name]
    data = render_call(scene)
    exact = measure(scene, chain)
    found = search(suffices(chain, "Renderer", data))
    assert chain.call("Renderer", data, found.gas).gas == exact.gas
    with pytest.raises(OutOfGasError):
        chain.call("Renderer", data, found.gas - 1)
    assert exact.gas <= found.gas <= needed_for(exact.gas)


def test_another_evm_needs_the_same_limit() -> None:
    pytest.importorskip("eth")
    fast, slow = open_chain(), open_chain("pyevm")
    data = render_call(SMALL_SCENES["empty"])
    least = search(suffices(fast, "Renderer", data)).gas
    enough = suffices(slow, "Renderer", data)
    assert enough(least)
    assert not enough(least - 1)


def test_a_refusal_is_not_taken_for_too_little_gas() -> None:
    chain = open_chain()
    data = render_call(evolve(SMALL_SCENES["empty"], width=5))
    zero_width = bytearray(data)
    zero_width[zero_width.index((5).to_bytes(32, "big")) + 31] = 0
    with pytest.raises(RenderError, match="refused") as caught:
        search(suffices(chain, "Renderer", bytes(zero_width)))
    assert not isinstance(caught.value, OutOfGasError)


def test_the_least_that_a_transaction_costs() -> None:
    assert floor_gas(b"") == 21000
    assert floor_gas(b"\0\0\1") == 21000 + 10 * (1 + 1 + 4)
