"""The search over a real node that is asked for nothing but `eth_call`."""

from __future__ import annotations

from tools.anvil import AnvilChain

from nodes import ANVIL, needs_anvil
from shackled import ChainError, Scene
from shackled.artifacts import artifact
from shackled.chain import ContractChain, open_chain
from shackled.errors import OutOfGasError, RevertError
from shackled.gas import measure, render_call, search, suffices


@needs_anvil
def test_a_node_that_only_answers_calls_gives_the_same(scenes: dict[str, Scene]) -> None:
    assert ANVIL is not None
    scene = scenes["smooth"]
    data = render_call(scene)
    (out_of_gas,) = (selector for selector, (name, _) in artifact("Renderer").errors.items() if name == "OutOfGas")
    refusals: list[ChainError] = []
    with AnvilChain(ANVIL) as node:

        def enough(limit: int) -> bool:
            try:
                node.read("Renderer", data, limit)
            except ChainError as error:
                refusals.append(error)
                return False
            return True

        on_node = search(enough)
    # of the Renderer's own gas, or, as it says itself, of the Engine's
    assert refusals
    for refused in refusals:
        assert isinstance(refused, OutOfGasError) or (isinstance(refused, RevertError) and refused.data == out_of_gas)
    chain = open_chain()
    assert isinstance(chain, ContractChain)
    assert on_node == search(suffices(chain, "Renderer", data))
    assert on_node.gas > measure(scene, chain).gas
