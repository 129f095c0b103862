"""What one call costs."""

from __future__ import annotations

from dataclasses import dataclass

from ..artifacts import artifact
from ..chain import ContractChain, open_chain
from ..scene.codec import encode
from ..scene.scene import Scene


@dataclass(frozen=True)
class Cost:
    """Of a render: execution gas; triangles that survive culling and clipping, pixels that any of them covers."""

    gas: int
    triangles: int
    lit_pixels: int


def cost(scene: Scene) -> Cost:
    """What the picture of a scene costs, in the fastest EVM that is installed."""
    return Cost(call(scene)[0], *evm().count(scene))


def call(scene: Scene, function: str = "render") -> tuple[int, int]:
    """Execution gas of a function of the Renderer that takes a scene, and bytes of the file that it returns."""
    result = evm().call("Renderer", encode(artifact("Renderer").selectors[function], scene))
    return result.gas, int.from_bytes(result.output[32:64], "big")


def evm() -> ContractChain:
    """The fastest one that is installed."""
    chain = open_chain()
    assert isinstance(chain, ContractChain)
    return chain
