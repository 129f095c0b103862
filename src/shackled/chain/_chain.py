"""What a chain does for a picture."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any, Protocol

from ..artifacts import artifact
from ..errors import RenderError
from ..scene import Rectangle, Scene, encode


@dataclass(frozen=True)
class CallResult:
    """What a contract returned.

    gas: of the execution alone. intrinsic_gas: what a transaction costs before it, 21,000 and 4 or 16 per byte.
    """

    output: bytes
    gas: int
    intrinsic_gas: int


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
        """What it is, for people."""

    def draw(self, scene: Scene, tile: Rectangle | None = None) -> Drawing:
        """Return the picture of a scene, or of a part of its canvas."""

    def count(self, scene: Scene, tile: Rectangle | None = None) -> tuple[int, int]:
        """Count the triangles left after culling and clipping, and the pixels of the canvas or tile that they cover."""


class ContractChain(ABC):
    """A chain that runs the contracts; a kind of chain says how to make a call."""

    name: str

    @abstractmethod
    def call(self, contract: str, data: bytes, gas_limit: int | None = None) -> CallResult:
        """Calls a contract, by the name of its artifact, with at most `gas_limit` gas for the execution.

        RenderError if the contract refuses, OutOfGasError if the gas does not suffice.
        """

    def ask(self, contract: str, function: str, *arguments: Any) -> Any:
        """Call a function of a contract by its ABI, and return its value, or a tuple of them if there are several."""
        interface = artifact(contract).interface
        return interface.decode(function, self.call(contract, interface.encode(function, *arguments)).output)

    def draw(self, scene: Scene, tile: Rectangle | None = None) -> Drawing:
        """Return the picture of a scene, or of a part of its canvas."""
        selector = artifact("Renderer").selectors["render" if tile is None else "renderTile"]
        result = self.call("Renderer", encode(selector, scene, tile))
        return Drawing(returned_bytes(result.output, 0), result.gas, result.intrinsic_gas)

    def count(self, scene: Scene, tile: Rectangle | None = None) -> tuple[int, int]:
        """Count the triangles left after culling and clipping, and the pixels of the canvas or tile that they cover."""
        return returned_counts(self.call("Renderer", count_call(scene, tile)).output)


def count_call(scene: Scene, tile: Rectangle | None = None) -> bytes:
    """Return the data of the call of the Renderer that draws a scene, or a part of its canvas, and counts."""
    selector = artifact("Renderer").selectors["renderCounted" if tile is None else "renderTileCounted"]
    return encode(selector, scene, tile)


def returned_counts(output: bytes) -> tuple[int, int]:
    """Triangles and pixels from what the call of `count_call` returned, which begins with an offset."""
    if len(output) < 96:
        raise RenderError(f"the contract returned {len(output)} bytes instead of two counts")
    return int.from_bytes(output[32:64], "big"), int.from_bytes(output[64:96], "big")


def returned_bytes(output: bytes, field: int) -> bytes:
    """Return the ABI field `field`, of type bytes, of what a function returned."""
    start = int.from_bytes(output[32 * field : 32 * field + 32], "big")
    length = int.from_bytes(output[start : start + 32], "big") if start + 32 <= len(output) else len(output)
    if start + 32 + length > len(output):
        raise RenderError(f"the contract returned {len(output)} bytes that do not hold a picture")
    return output[start + 32 : start + 32 + length]
