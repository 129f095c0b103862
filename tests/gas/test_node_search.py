"""The search over a real node that is asked for nothing but `eth_call`."""

from __future__ import annotations

import pytest

from shackled import RenderError, Scene
from shackled.artifacts import artifact
from shackled.bench.anvil import AnvilChain, find_anvil
from shackled.chain import ContractChain, open_chain
from shackled.gas.exact import measure, render_call
from shackled.gas.search import search, suffices

ANVIL = find_anvil()


@pytest.mark.skipif(ANVIL is None, reason="anvil is not installed: npm ci in contracts/")
def test_a_node_that_only_answers_calls_gives_the_same(scenes: dict[str, Scene]) -> None:
    pytest.importorskip("pyrevm")
    assert ANVIL is not None
    scene = scenes["smooth"]
    data = render_call(scene)
    (out_of_gas,) = (selector for selector, (name, _) in artifact("Renderer").errors.items() if name == "OutOfGas")
    refusals: list[str] = []
    with AnvilChain(ANVIL) as node:

        def enough(limit: int) -> bool:
            try:
                node.read("Renderer", data, limit)
            except RenderError as error:
                refusals.append(str(error))
                return False
            return True

        on_node = search(enough)
    # of the Renderer's own gas, or, as it says itself, of the Engine's
    assert refusals
    assert all("OutOfGas" in text or "out of gas" in text.lower() or out_of_gas.hex() in text for text in refusals)
    chain = open_chain("pyrevm")
    assert isinstance(chain, ContractChain)
    assert on_node == search(suffices(chain, "Renderer", data))
    assert on_node.gas > measure(scene, chain).gas
