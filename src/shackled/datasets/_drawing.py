"""Pieces drawn by the contracts, on all cores; finished drawings and fetched models are kept in a cache folder."""

from __future__ import annotations

import hashlib
import io
import json
import os
from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from functools import cache, partial
from importlib.resources import files
from pathlib import Path
from typing import NamedTuple

from PIL import Image as PillowImage
from PIL.PngImagePlugin import PngInfo
from platformdirs import user_cache_path

from ..artifacts import RENDERER, artifact
from ..chain import open_chain
from ..errors import InputError
from ..image import decode_bmp
from ..scene import Scene, encode, resize
from ..whole_file import write_whole
from ..workers import each
from . import require
from ._piece import Piece

#: The environment variable that names the cache folder.
VARIABLE = "SHACKLED_CACHE"
#: The side of a drawing, in pixels.
SIZE = 128


@dataclass(frozen=True)
class Thumbnail:
    """A drawing of a piece.

    triangles: number of triangles of its meshes.
    gas: gas of the execution, or None.
    png: the PNG file.
    """

    name: str
    triangles: int
    gas: int | None
    png: bytes


class PieceCost(NamedTuple):
    """The triangles of a piece and the gas to render it at 128 x 128; None where they are not known."""

    triangles: int | None
    gas: int | None


# ---- the cache ----


def cache_folder() -> Path:
    """Return the folder of SHACKLED_CACHE, or else that of the system for such files; it may not exist yet."""
    chosen = os.environ.get(VARIABLE)
    if chosen:
        return Path(chosen)
    return user_cache_path("shackled")


def keep(path: Path, data: bytes) -> None:
    """Write a file of the cache, and its folder if it is not there. OSError if it cannot be written."""
    path.parent.mkdir(parents=True, exist_ok=True)
    write_whole(path, data)


# ---- what pieces cost ----


@cache
def table() -> dict[str, PieceCost]:
    """Return the costs in gas.json by the names of the pieces, as tools/dataset_costs.py measured them."""
    content = json.loads(files(__package__).joinpath("gas.json").read_text("utf-8"))
    return {name: PieceCost(*cost) for name, cost in content.items()}


def cost(piece: Piece) -> PieceCost:
    """Return the cost of a piece: measured before, or else by drawing it, if it has been fetched."""
    if piece.name in table():
        return table()[piece.name]
    if not piece.ready():
        return PieceCost(None, None)
    try:
        drawing = draw(piece)
    except InputError:  # the fetched model is damaged, which an attempt to render it reports
        return PieceCost(None, None)
    return PieceCost(drawing.triangles, drawing.gas)


# ---- drawing ----


def draw(piece: Piece, size: int = SIZE) -> Thumbnail:
    """Return the drawing of a piece, size x size pixels, from the cache or else by the contracts."""
    scene = resize(piece.make(), size)
    triangles = scene.triangles
    path = cache_folder() / "drawings" / f"{_key(scene)}.png"
    kept = _read(path)
    if kept is None:
        drawing = open_chain().draw(scene)
        kept = _png(drawing.bmp, scene, drawing.gas), drawing.gas
        with suppress(OSError):  # if it cannot be kept, it is drawn again next time
            keep(path, kept[0])
    return Thumbnail(piece.name, triangles, kept[1], kept[0])


def draw_all(pieces: Iterable[Piece], size: int = SIZE, processes: int | None = None) -> Iterator[Thumbnail]:
    """Yield the drawings of pieces in the order in which they finish; pieces that are not fetched are left out.

    processes: number of worker processes; None for one per core.
    """
    names = [piece.name for piece in pieces if piece.ready()]
    processes = min(len(names), processes or os.cpu_count() or 1)
    if processes <= 1:
        yield from (_draw_named(size, name) for name in names)
    else:
        yield from (drawing for _, drawing in each(partial(_draw_named, size), names, processes))


def _draw_named(size: int, name: str) -> Thumbnail:
    return draw(require(name), size)


def _key(scene: Scene) -> str:
    """Return a key of the call and of the contracts that answer it."""
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
    """Return a drawing and its gas, if the file exists and is not damaged."""
    try:
        data = path.read_bytes()
        with PillowImage.open(io.BytesIO(data), formats=["PNG"]) as picture:
            gas = picture.info["gas"]
            picture.load()
        return data, int(gas) if gas else None
    except (OSError, ValueError, KeyError, SyntaxError):
        return None
