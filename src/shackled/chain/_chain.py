"""Interfaces of the places where pictures are made, and the contract calls that they share."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any, Protocol

from ..artifacts import artifact
from ..errors import RenderError
from ..ethereum._encoding import intrinsic_gas
from ..scene._codec import Rectangle, encode
from ..scene._scene import Scene


@dataclass(frozen=True)
class NodeResult:
    """The result of a contract call. gas: of the execution alone; None if it could not be measured."""

    output: bytes
    gas: int | None


@dataclass(frozen=True)
class CallResult(NodeResult):
    """The result of a contract call on a chain that counts gas."""

    gas: int


@dataclass(frozen=True)
class Drawing:
    """A picture as BMP bytes, with its gas; None where no gas is counted."""

    bmp: bytes
    gas: int | None
    intrinsic_gas: int | None


class Chain(Protocol):
    """A place where pictures are made."""

    @property
    def name(self) -> str:
        """Description for reports."""

    def draw(self, scene: Scene, tile: Rectangle | None = None) -> Drawing:
        """Render a scene, or a tile of its canvas."""

    def count(self, scene: Scene, tile: Rectangle | None = None) -> tuple[int, int]:
        """Count the triangles left after culling and clipping, and the pixels of the canvas or tile that they cover."""


class ContractCaller(ABC):
    """A chain that calls the contracts; subclasses implement the call."""

    @abstractmethod
    def call(self, contract: str, data: bytes, gas_limit: int | None = None) -> NodeResult:
        """Call a contract, by the name of its artifact, with at most `gas_limit` gas for the execution.

        Raises RenderError if the contract reverts, OutOfGasError if the gas does not suffice.
        """

    def ask(self, contract: str, function: str, *arguments: Any) -> Any:
        """Call a function of a contract by its ABI, and return its value, or a tuple of several."""
        interface = artifact(contract).interface
        return interface.decode(function, self.call(contract, interface.encode(function, *arguments)).output)

    def draw(self, scene: Scene, tile: Rectangle | None = None) -> Drawing:
        """Render a scene, or a tile of its canvas."""
        data = encode(artifact("Renderer").selectors["render" if tile is None else "renderTile"], scene, tile)
        result = self.call("Renderer", data)
        return Drawing(returned_bytes(result.output), result.gas, intrinsic_gas(data))

    def count(self, scene: Scene, tile: Rectangle | None = None) -> tuple[int, int]:
        """Count the triangles left after culling and clipping, and the pixels of the canvas or tile that they cover."""
        selector = artifact("Renderer").selectors["renderCounted" if tile is None else "renderTileCounted"]
        output = self.call("Renderer", encode(selector, scene, tile)).output
        if len(output) < 96:
            raise RenderError(f"the contract returned {len(output)} bytes instead of two counts")
        # after the offset of the picture
        return int.from_bytes(output[32:64], "big"), int.from_bytes(output[64:96], "big")


class ContractChain(ContractCaller):
    """A chain that counts the gas of every call."""

    name: str

    @abstractmethod
    def call(self, contract: str, data: bytes, gas_limit: int | None = None) -> CallResult:
        """Call a contract, as `ContractCaller.call`."""


def returned_bytes(output: bytes) -> bytes:
    """Return the first ABI field, of type bytes; unlike `Interface.decode`, it copies the bytes once only."""
    start = int.from_bytes(output[:32], "big")
    length = int.from_bytes(output[start : start + 32], "big") if start + 32 <= len(output) else len(output)
    if start + 32 + length > len(output):
        raise RenderError(f"the contract returned {len(output)} bytes that do not hold a picture")
    return output[start + 32 : start + 32 + length]
