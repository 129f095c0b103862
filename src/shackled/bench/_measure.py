"""Measure the gas of a call. It is exact, so that one call is enough."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..artifacts import artifact
from ..chain._chain import CallResult
from ..chain._opening import open_chain
from ..image import decode_bmp
from ..scene._codec import Rectangle, encode
from ..scene._scene import Scene


@dataclass(frozen=True)
class RenderCost:
    """The cost of a render: execution gas; triangles after culling and clipping; pixels that any of them covers."""

    gas: int
    triangles: int
    lit_pixels: int


def call(contract: str, data: bytes) -> CallResult:
    """Call a contract."""
    return open_chain().call(contract, data)


def call_renderer(scene: Scene, function: str = "render", tile: Rectangle | None = None) -> CallResult:
    """Call a function of the Renderer that takes a scene."""
    return call("Renderer", encode(artifact("Renderer").selectors[function], scene, tile))


def gas(scene: Scene, function: str = "render", tile: Rectangle | None = None) -> int:
    """Measure the execution gas of a function of the Renderer that takes a scene."""
    return call_renderer(scene, function, tile).gas


def cost(scene: Scene) -> RenderCost:
    """Measure what the picture of a scene costs."""
    return RenderCost(gas(scene), *open_chain().count(scene))


def picture(scene: Scene) -> NDArray[np.uint8]:
    """Draw a scene: (H, W, 3)."""
    return decode_bmp(open_chain().draw(scene).bmp, scene.width, scene.height)
