"""The reference renderer, in Python and NumPy: the contracts must equal it byte for byte.

Each file mirrors one of contracts/src and is meant to be read beside it. The numbers are those of the contract: Python
integers where it computes vertices, faces and light, NumPy arrays where it walks over the pixels of a face.
"""

from __future__ import annotations

from ..artifacts import artifact
from ..errors import RenderError
from ..image import encode_bmp
from ..scene import Rectangle, Scene, encode
from . import coverage, extensions
from .call import read_call
from .pipeline import Picture, assemble, draw

__all__ = ["Picture", "count", "draw_call", "encode_bmp", "engines", "render", "selector", "shadows_of"]


def render(scene: Scene, tile: Rectangle | None = None) -> bytes:
    """Render a scene, or a tile of its canvas, as the bytes of a BMP file.

    Raises RenderError where the contract refuses.
    """
    data = encode(selector("render" if tile is None else "renderTile"), scene, tile)
    return encode_bmp(draw_call(data).pixels)


def count(scene: Scene, tile: Rectangle | None = None) -> tuple[int, int]:
    """Return the number of triangles of a scene after culling and clipping, and of the pixels of its canvas, or of a
    tile, that any of them covers. Nothing is shaded.
    """
    return coverage.count(*read_call(encode(selector("renderCounted" if tile is None else "renderTile"), scene, tile)))


def draw_call(data: bytes) -> Picture:
    """Render what a call of `render`, `renderTile` or `renderCounted` of the Renderer asks for."""
    return draw(*read_call(data))


def engines(data: bytes) -> list[str]:
    """Return the contracts that draw what a call of the Renderer asks for; those of plain scenes if it has none."""
    try:
        scene, _ = read_call(data)
        records = extensions.read_records(scene.extensions)
    except RenderError:
        records = {}
    if extensions.has_effects(records):
        return ["EffectsEngine", "Effects"]
    prefix = "Antialiased" if extensions.is_antialiased(records) else ""
    return [prefix + "Engine", prefix + "FragmentEngine"]


def shadows_of(data: bytes) -> bytes:
    """Return the shadows that the contract Effects finds for the scene of a call of the Renderer."""
    shadows = assemble(*read_call(data))[0].shadows
    return b"" if shadows is None else shadows.encode()


def selector(function: str) -> bytes:
    """Return the first four bytes of a call of a function of the Renderer."""
    return artifact("Renderer").selectors[function]
