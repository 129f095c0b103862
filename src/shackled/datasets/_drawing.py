"""Pictures of pieces, rendered on all cores and cached."""

from __future__ import annotations

import hashlib
import io
import os
from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path

from PIL import Image as PillowImage
from PIL.PngImagePlugin import PngInfo

from ..artifacts import RENDERER, artifact
from ..chain import open_chain
from ..image import decode_bmp
from ..scene import Scene, encode, resize
from ..workers import each
from . import require
from ._cache import cache_folder, keep
from ._piece import Piece

SIZE = 128


@dataclass(frozen=True)
class Drawing:
    """A picture of a piece.

    triangles: number of triangles of its meshes.
    gas: gas of the execution, or None.
    png: the PNG file.
    """

    name: str
    triangles: int
    gas: int | None
    png: bytes


def draw(piece: Piece, size: int = SIZE) -> Drawing:
    """Return the picture of a piece, size x size pixels, from the cache or the contracts."""
    scene = resize(piece.make(), size)
    triangles = scene.triangles
    path = cache_folder() / "drawings" / f"{_key(scene)}.png"
    kept = _read(path)
    if kept is None:
        drawing = open_chain().draw(scene)
        kept = _png(drawing.bmp, scene, drawing.gas), drawing.gas
        with suppress(OSError):  # if it cannot be kept, it is drawn again next time
            keep(path, kept[0])
    return Drawing(piece.name, triangles, kept[1], kept[0])


def draw_all(pieces: Iterable[Piece], size: int = SIZE, processes: int | None = None) -> Iterator[Drawing]:
    """Yield the pictures of pieces, in the order in which they are finished.

    processes: number of worker processes; None for one per core. Pieces that are not ready are left out.
    """
    names = [piece.name for piece in pieces if piece.ready()]
    processes = min(len(names), processes or os.cpu_count() or 1)
    if processes <= 1:
        yield from (_draw_named(size, name) for name in names)
    else:
        yield from (drawing for _, drawing in each(partial(_draw_named, size), names, processes))


def _draw_named(size: int, name: str) -> Drawing:
    return draw(require(name), size)


def _key(scene: Scene) -> str:
    """Return the hash of the call and of the contracts."""
    return hashlib.sha256(_contracts() + encode(b"", scene)).hexdigest()


@cache
def _contracts() -> bytes:
    codes = b"".join(artifact(name).runtime for name in RENDERER)
    return open_chain().name.encode() + hashlib.sha256(codes).digest()


def _png(bmp: bytes, scene: Scene, gas: int | None) -> bytes:
    info = PngInfo()
    info.add_text("gas", "" if gas is None else str(gas))
    stream = io.BytesIO()
    PillowImage.fromarray(decode_bmp(bmp, scene.width, scene.height)).save(stream, "png", pnginfo=info)
    return stream.getvalue()


def _read(path: Path) -> tuple[bytes, int | None] | None:
    """Return a cached picture and its gas, or None if it is missing or damaged."""
    try:
        data = path.read_bytes()
        with PillowImage.open(io.BytesIO(data), formats=["PNG"]) as picture:
            gas = picture.info["gas"]
            picture.load()
        return data, int(gas) if gas else None
    except (OSError, ValueError, KeyError, SyntaxError):
        return None
