"""Gas figures. Gas is exact: a figure needs one call."""

from __future__ import annotations

from shackled import Scene
from shackled.artifacts import artifact
from shackled.bench.deploy import deployment_gas
from shackled.chain import CallResult, ContractChain, open_chain
from shackled.deploy.contract import STANDARD
from shackled.scene.codec import Rectangle, encode


def measure(scene: Scene, function: str = "render", tile: Rectangle | None = None) -> CallResult:
    """The result of a function of the Renderer that takes a scene."""
    return call("Renderer", encode(artifact("Renderer").selectors[function], scene, tile))


def gas(scene: Scene, function: str = "render", tile: Rectangle | None = None) -> int:
    """Execution gas of a function of the Renderer that takes a scene."""
    return measure(scene, function, tile).gas


def call(contract: str, data: bytes) -> CallResult:
    """The result of a call in the fastest EVM that is installed."""
    chain = open_chain()
    assert isinstance(chain, ContractChain)
    return chain.call(contract, data)


def contract_figures() -> dict[str, int]:
    """For each contract that `shackled deploy` puts on a chain the bytes of its code and the gas of its deployment."""
    figures = {}
    for name in sorted(STANDARD):
        figures[f"{name} code size"] = len(artifact(name).runtime)
        figures[f"{name} deployment"] = deployment_gas(name)
    return figures
