"""The renderer once more, in Python and NumPy: what the contracts must equal byte for byte.

Each file mirrors one of contracts/src and is meant to be read beside it. The numbers are those of the contract: Python
integers where it computes vertices, faces and light, NumPy arrays where it walks over the pixels of a face.
"""

from __future__ import annotations

from ..artifacts import artifact
from ..image import encode_bmp
from ..scene import Rectangle, Scene, encode
from . import coverage
from .call import read_call
from .pipeline import Picture, draw

__all__ = ["Picture", "count", "draw_call", "encode_bmp", "render", "selector"]


def render(scene: Scene, tile: Rectangle | None = None) -> bytes:
    """The picture of a scene, or of a part of its canvas, as the bytes of a BMP file.

    Raises RenderError where the contract refuses.
    """
    data = encode(selector("render" if tile is None else "renderTile"), scene, tile)
    return encode_bmp(draw_call(data).pixels)


def count(scene: Scene, tile: Rectangle | None = None) -> tuple[int, int]:
    """The triangles of a scene that survive culling and clipping, and the pixels, of its canvas or of a tile, that any
    of them covers. Nothing is shaded for it.
    """
    return coverage.count(*read_call(encode(selector("renderCounted" if tile is None else "renderTile"), scene, tile)))


def draw_call(data: bytes) -> Picture:
    """The picture that a call of `render`, `renderTile` or `renderCounted` of the Renderer contract asks for."""
    return draw(*read_call(data))


def selector(function: str) -> bytes:
    """The first four bytes of a call of a function of the Renderer contract."""
    return artifact("Renderer").selectors[function]
