"""No pixel and no gas of tests/support/golden.json may change unnoticed."""

from __future__ import annotations

import pytest
from attrs import evolve

import golden
from pictures import chain
from shackled.artifacts import artifact
from shackled.chain._embedded import RevmChain
from shackled.chain._engines import engines
from shackled.gas._trace import places
from shackled.scene._codec import render_call


@pytest.mark.usefixtures("each_evm")
def test_pixels_and_gas() -> None:
    new = golden.take()
    changed = golden.differences(golden.recorded(), new)
    title = f"{len(changed)} of {len(new)} scenes differ from golden.json; if this is meant, run `make golden`:"
    assert not changed, "\n  ".join([title, *changed])


def test_every_engine_draws_some_of_them() -> None:
    drawing: list[str] = []
    for scene in golden.scenes().values():
        # the engines are those of a picture of any size, and counting takes long
        data = render_call(evolve(scene, width=4, height=3))
        called = called_by(data)
        # those that a creation call brings are among them
        assert called <= {*engines(data[36:], chain())}
        drawing += called
    parts = [name for name in artifact("Renderer").parts if name.endswith("Engine")]
    assert len(parts) == 6
    assert min(drawing.count(name) for name in parts) > 20


def called_by(data: bytes) -> set[str]:
    """Return the names of the contracts that a call of the Renderer calls."""
    # no position has a description, so that the functions of a profile are the contracts
    _, names, table = RevmChain().profile("Renderer", data, lambda name: bytes(len(places(name).tobytes())))
    functions = table[1 : 1 + 3 * int(table[0])].reshape(-1, 3)
    return {names[number] for number in functions[:, 1]} - {"Renderer"}


def test_what_changed_is_told() -> None:
    old = {"a": ("00", 1000), "b": ("00", 1000), "c": ("00", 1000), "d": ("00", 0), "e": ("OutOfGasError", 0)}
    new = {"a": ("01", 1000), "b": ("00", 990), "c": ("00", 1000), "e": ("00", 5), "f": ("00", 0)}
    assert golden.differences(old, new) == [
        "a: pixels 00 -> 01",
        "d: is not made any more",
        "e: pixels OutOfGasError -> 00, gas 0 -> 5 (+5)",
        "f: is not recorded yet",
        "b: gas 1,000 -> 990 (-10, -1.00%)",
    ]
    assert golden.differences(new, new) == []
