"""What is rendered in one call, and what comes back."""

from __future__ import annotations

from dataclasses import dataclass

from ..chain.chain import Chain
from ..errors import RenderError
from ..scene.codec import Rectangle
from ..scene.scene import Scene


@dataclass(frozen=True)
class Part:
    """A tile of a frame; frames are numbered from 0."""

    frame: int
    tile: Rectangle


@dataclass(frozen=True)
class Piece:
    """A finished part.

    bmp: its picture. gas, intrinsic_gas: what it cost; None where none is counted.
    triangles: of the whole frame, which each of its parts finds. lit_pixels: of this part. None if not counted.
    """

    bmp: bytes
    gas: int | None
    intrinsic_gas: int | None
    triangles: int | None
    lit_pixels: int | None

    def same(self, other: Piece) -> bool:
        """Whether the other shows the same; its gas may be counted in another way, or not at all."""
        own, theirs = ((each.bmp, each.triangles, each.lit_pixels) for each in (self, other))
        return own == theirs


def draw_part(chain: Chain, scene: Scene, tile: Rectangle, count: bool) -> Piece:
    """Draws a part of a frame, and counts what is in it if that is wanted."""
    whole = (tile.width, tile.height) == (scene.width, scene.height)
    chosen = None if whole else tile
    drawing = chain.draw(scene, chosen)
    triangles, lit_pixels = chain.count(scene, chosen) if count else (None, None)
    return Piece(drawing.bmp, drawing.gas, drawing.intrinsic_gas, triangles, lit_pixels)


def check_part(piece: Piece, tile: Rectangle) -> None:
    """RenderError if a piece cannot be that part of a picture."""
    from ..image import decode_bmp

    decode_bmp(piece.bmp, tile.width, tile.height)
    if piece.lit_pixels is not None and piece.lit_pixels > tile.width * tile.height:
        raise RenderError(f"the contract counted {piece.lit_pixels:,} pixels in {tile.width} x {tile.height}")
