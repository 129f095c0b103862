"""Pictures and refusals: the same bytes for the same gas in the EVM of the package, pyrevm, py-evm and a real node."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass

import pytest

from evms import Codes, Ours, pyevm_call, pyrevm_call
from nodes import anvil, needs_anvil
from pictures import call_data, words
from random_scenes import broken_call, random_case
from shackled import load
from shackled.artifacts import artifact
from shackled.chain import open_node
from shackled.chain._chain import ContractChain
from shackled.chain._embedded import EmbeddedChain, RevmChain
from shackled.chain._node import NodeChain
from shackled.datasets import pieces
from shackled.errors import ChainError
from shackled.ethereum._encoding import to_hex
from shackled.evm import _compiled
from shackled.evm._instance import Answer, Status
from shackled.gas import search, suffices
from shackled.scene import encode
from shackled.scene._codec import Rectangle
from test_bad_input_on_chain import WRONG, encoded, small_scene, values

GAS = 30_000_000_000
SELECTORS = artifact("Renderer").selectors
#: Random scenes; more in `make fuzz`.
SEEDS = 1000 if os.environ.get("HYPOTHESIS_PROFILE") == "new" else 150


@dataclass(frozen=True)
class World:
    """The contracts, and an EVM to call the Renderer in."""

    chain: EmbeddedChain
    codes: Codes
    renderer: bytes
    evm: Ours

    def agree(self, data: bytes, gas: int = GAS) -> Answer:
        """Check that pyrevm answers the same, and return the answer."""
        answer = self.evm.call(self.codes, self.renderer, data, gas)
        assert answer == pyrevm_call(self.codes, self.renderer, data, gas)
        return answer

    def agree_with_pyevm(self, data: bytes, gas: int = GAS) -> None:
        answer = self.evm.call(self.codes, self.renderer, data, gas)
        assert answer == pyevm_call(self.codes, self.renderer, data, gas)


def world_of(region: int | None, *interpreted: str) -> World:
    """A world with regions of so many instructions; the names of contracts that are not compiled."""
    chain = RevmChain()
    renderer = chain.address("Renderer")
    return World(chain, chain.codes(), renderer, Ours(region, [artifact(name).runtime for name in interpreted]))


@pytest.fixture(scope="module", params=[None, _compiled.REGION])
def world(request: pytest.FixtureRequest) -> World:
    """In the interpreter, and compiled."""
    return world_of(request.param)


def test_built_in_scenes(world: World) -> None:
    names = [piece.name for dataset in ("common", "icons") for piece in pieces(dataset) if piece.ready()]
    for name in (*names, *(f"genesis/{number}" for number in range(1, 1024, 50))):
        answer = world.agree(encode(SELECTORS["renderCounted"], load(name, 48)))
        assert answer.status == Status.SUCCESS, name


def test_random_scenes(world: World) -> None:
    for seed in range(1, 1 + SEEDS):
        case = random_case(seed)
        world.agree(call_data("renderCounted", case.scene))
        world.agree(call_data("renderTile", case.scene, case.tile))


def test_regions_of_one_instruction() -> None:
    """Which take long to compile: two engines, between contracts that are interpreted."""
    world = world_of(1, *{*artifact("Renderer").parts} - {"Engine", "AntialiasedFragmentEngine"})
    for seed in range(1, 1 + SEEDS):
        case = random_case(seed)
        world.agree(call_data("renderTile", case.scene, case.tile))


def test_broken_calls(world: World) -> None:
    calls = (broken_call(seed, call_data("render", random_case(seed).scene)) for seed in range(SEEDS))
    assert {world.agree(call).status for call in calls} == {Status.SUCCESS, Status.REVERT}


def refused() -> list[bytes]:
    """Calls that the Renderer refuses, with each of its errors."""
    calls = [b"", b"\1", b"\1\2\3\4", SELECTORS["render"], call_data("render", small_scene())[:-40]]
    tiles = (Rectangle(0, 0, 33, 1), Rectangle(2**256 - 1, 0, 2, 1))
    calls += [call_data("renderTile", small_scene(), tile) for tile in tiles]
    calls += [SELECTORS["eulerRotation"] + words(0, 2**58 + 1, 0)]
    for change, _ in WRONG:
        wrong = values()
        change(wrong)
        calls.append(encoded(wrong))
    return calls


def test_refusals(world: World) -> None:
    answers = [world.agree(call) for call in refused()]
    assert {answer.status for answer in answers} == {Status.REVERT}
    # py-evm for one call of each error
    for call in {answer.output[:4]: call for answer, call in zip(answers, refused(), strict=True)}.values():
        world.agree_with_pyevm(call)


def test_limits_of_gas(world: World) -> None:
    """The least gas that suffices, and limits below and above it."""
    data = call_data("render", small_scene())
    used = world.agree(data).gas
    needed = search(suffices(world.chain, "Renderer", data)).gas
    limits = {0, 1, 100, 2_000, used - 1, used, used + 1, needed - 1, needed, needed + 1}
    limits |= {used * part // 40 for part in range(1, 45)}
    for limit in sorted(limits):
        answer = world.agree(data, limit)
        assert (answer.status == Status.SUCCESS) == (limit >= needed)


def test_pyevm(world: World) -> None:
    for seed in (3, 5, 8):
        case = random_case(seed)
        world.agree_with_pyevm(call_data("renderTile", case.scene, Rectangle(0, 0, 3, 2)))
    data = call_data("render", small_scene(4, 4))
    for limit in (GAS, 1_000_000, 100_000, 1_000):
        world.agree_with_pyevm(data, limit)


# ---- a real node ----


@pytest.fixture(scope="module")
def node(world: World) -> Iterator[NodeChain]:
    """With the contracts where `shackled deploy` puts them."""
    with anvil() as started:
        for address, code in world.codes.items():
            started.rpc("anvil_setCode", to_hex(address), to_hex(code))
        yield open_node(started.url)


def said(chain: ContractChain | NodeChain, data: bytes, gas: int | None = None) -> tuple[bytes, int | None] | str:
    """Return the output and the gas of a call, or the message of its error."""
    try:
        result = chain.call("Renderer", data, gas)
        return result.output, result.gas
    except ChainError as error:
        return str(error)


@needs_anvil
def test_calls_of_a_node(world: World, node: NodeChain) -> None:
    scenes = [call_data("renderTile", case.scene, case.tile) for case in map(random_case, range(20, 40))]
    for call in [*scenes, *refused()]:
        assert said(node, call) == said(world.chain, call)
    data = call_data("render", small_scene())
    for limit in (0, 5_000, 100_000, 1_000_000, 2_000_000):
        assert said(node, data, limit) == said(world.chain, data, limit)
