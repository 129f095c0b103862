"""What is rendered in one call, and what comes back."""

from __future__ import annotations

from dataclasses import dataclass

from ..chain import Chain, Drawing
from ..scene import Rectangle, Scene


@dataclass(frozen=True)
class Part:
    """A tile of a frame; frames are numbered from 0."""

    frame: int
    tile: Rectangle


def draw_part(chain: Chain, scene: Scene, tile: Rectangle) -> Drawing:
    """Draws a part of a frame."""
    whole = (tile.width, tile.height) == (scene.width, scene.height)
    return chain.draw(scene, None if whole else tile)


def check_part(piece: Drawing, tile: Rectangle) -> None:
    """RenderError if a piece cannot be that part of a picture."""
    from ..image import decode_bmp

    decode_bmp(piece.bmp, tile.width, tile.height)
