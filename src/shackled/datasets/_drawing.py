"""Pieces drawn by the contracts, on all cores, and shown on a page or in a contact sheet.

Finished drawings and fetched models are kept in a cache folder.
"""

from __future__ import annotations

import hashlib
import io
import json
import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cache, partial
from html import escape
from importlib.resources import files
from pathlib import Path
from string import Template
from typing import NamedTuple

from PIL import Image as PillowImage
from PIL import ImageDraw, ImageFont
from PIL.PngImagePlugin import PngInfo
from platformdirs import user_cache_path

from ..artifacts import RENDERER, artifact
from ..base.whole_file import write_whole
from ..base.workers import each
from ..chain._opening import open_chain
from ..errors import InputError
from ..image import data_uri, decode_bmp, pillow_bytes
from ..scene._codec import encode
from ..scene._look import resize
from ._pieces import Piece, require

#: The environment variable that names the cache folder.
VARIABLE = "SHACKLED_CACHE"
#: The side of a drawing, in pixels.
SIZE = 128
#: Sizes in the contact sheet, in pixels.
LABEL, GAP = 32, 8
PAPER, INK, FAINT = (250, 250, 248), (20, 22, 28), (110, 114, 122)


@dataclass(frozen=True)
class Thumbnail:
    """A drawing of a piece: the triangles of its meshes, the gas of the execution, and the PNG file."""

    name: str
    triangles: int
    gas: int | None
    png: bytes


class PieceCost(NamedTuple):
    """The triangles of a piece and the gas to render it at 128 x 128; None where they are not known."""

    triangles: int | None
    gas: int | None


def cache_folder() -> Path:
    """Return the folder of SHACKLED_CACHE, or else that of the system for such files; it may not exist yet."""
    chosen = os.environ.get(VARIABLE)
    return Path(chosen) if chosen else user_cache_path("shackled")


def keep(path: Path, data: bytes) -> None:
    """Write a file of the cache, and its folder if it is not there. OSError if it cannot be written."""
    path.parent.mkdir(parents=True, exist_ok=True)
    write_whole(path, data)


@cache
def table() -> dict[str, PieceCost]:
    """Return the costs in gas.json by the names of the pieces, as tools/dataset_costs.py measured them."""
    content = json.loads(files(__package__).joinpath("gas.json").read_text("utf-8"))
    return {name: PieceCost(*cost) for name, cost in content.items()}


def cost(piece: Piece) -> PieceCost:
    """Return the cost of a piece: measured before, or else by drawing it, if it has been fetched."""
    if piece.name in table():
        return table()[piece.name]
    # a fetched model may be damaged, which an attempt to render it reports
    with suppress(InputError):
        if piece.ready():
            drawing = draw(piece)
            return PieceCost(drawing.triangles, drawing.gas)
    return PieceCost(None, None)


def draw(piece: Piece, size: int = SIZE) -> Thumbnail:
    """Return the drawing of a piece, size x size pixels, from the cache or else by the contracts."""
    scene = resize(piece.make(), size)
    key = hashlib.sha256(_contracts() + encode(b"", scene)).hexdigest()
    path = cache_folder() / "drawings" / f"{key}.png"
    try:
        png = path.read_bytes()
        with PillowImage.open(io.BytesIO(png), formats=["PNG"]) as picture:
            picture.load()
            return Thumbnail(piece.name, scene.triangles, int(picture.info["gas"]), png)
    except (OSError, ValueError, KeyError, SyntaxError):  # not kept, or damaged
        drawing = open_chain().draw(scene)
    info = PngInfo()
    info.add_text("gas", str(drawing.gas))
    pixels = decode_bmp(drawing.bmp, scene.width, scene.height)
    png = pillow_bytes(PillowImage.fromarray(pixels), "png", pnginfo=info)
    with suppress(OSError):  # if it cannot be kept, it is drawn again next time
        keep(path, png)
    return Thumbnail(piece.name, scene.triangles, drawing.gas, png)


@cache
def _contracts() -> bytes:
    """Return what tells the contracts that draw from others."""
    codes = b"".join(artifact(name).runtime for name in RENDERER)
    return open_chain().name.encode() + hashlib.sha256(codes).digest()


def draw_all(pieces: Iterable[Piece], size: int = SIZE, processes: int | None = None) -> Iterator[Thumbnail]:
    """Yield the drawings of pieces in the order in which they finish; pieces that are not fetched are left out.

    processes: number of worker processes; None for one per core.
    """
    names = [piece.name for piece in pieces if piece.ready()]
    processes = min(len(names), processes or os.cpu_count() or 1)
    yield from (drawing for _, drawing in each(partial(_draw_named, size), names, processes))


def _draw_named(size: int, name: str) -> Thumbnail:
    return draw(require(name), size)


def page(pieces: Sequence[Piece], drawings: Mapping[str, Thumbnail]) -> str:
    """Return a self-contained HTML page. Pieces without a drawing are shown with the command that fetches them."""
    template = Template(files(__package__).joinpath("gallery.html").read_text("utf-8"))
    datasets = list(dict.fromkeys(piece.dataset for piece in pieces))
    return template.substitute(
        count=len(pieces),
        choices="\n".join(f'<option value="{escape(name)}">{escape(name)}</option>' for name in datasets),
        cards="\n".join(_card(piece, drawings.get(piece.name)) for piece in pieces),
    )


def sheet(pieces: Sequence[Piece], drawings: Mapping[str, Thumbnail]) -> bytes:
    """Return a PNG of the drawings in rows, a label under each; pieces without one are left out."""
    drawn = [drawings[piece.name] for piece in pieces if piece.name in drawings]
    columns = max(1, min(len(drawn), round((len(drawn) * (SIZE + LABEL) / SIZE) ** 0.5) + 1))
    rows = max(1, -(-len(drawn) // columns))
    width, height = SIZE + GAP, SIZE + LABEL + GAP
    picture = PillowImage.new("RGB", (columns * width + GAP, rows * height + GAP), PAPER)
    pen, font = ImageDraw.Draw(picture), ImageFont.load_default(11)
    for number, drawing in enumerate(drawn):
        x, y = GAP + number % columns * width, GAP + number // columns * height
        with PillowImage.open(io.BytesIO(drawing.png)) as small:
            picture.paste(small, (x, y))
        pen.text((x, y + SIZE + 2), drawing.name, INK, font)
        pen.text((x, y + SIZE + 15), _figures(drawing, "tri."), FAINT, font)
    return pillow_bytes(picture, "png")


def _card(piece: Piece, drawing: Thumbnail | None) -> str:
    if drawing is None:
        command = f"shackled datasets fetch {piece.name}"
        image, caption = f'<div class="absent"><code>{escape(command)}</code></div>', "not fetched"
    else:
        image = f'<img src="{data_uri("image/png", drawing.png)}" alt="{escape(piece.title)}" loading="lazy">'
        caption = _figures(drawing)
    credit = f'<p class="credit">{escape(piece.credit)}</p>' if piece.credit else ""
    words = escape(" ".join((piece.name, piece.title, piece.licence, piece.credit)).lower())
    return (
        f'<figure data-dataset="{escape(piece.dataset)}" data-words="{words}">{image}<figcaption>'
        f"<h2>{escape(piece.title)}</h2><code>{escape(piece.name)}</code><p>{escape(caption)}</p>{credit}"
        f'<p class="licence">{escape(piece.terms)}</p></figcaption></figure>'
    )


def _figures(drawing: Thumbnail, triangles: str = "triangles") -> str:
    """Return the triangles and the gas of a drawing in words."""
    gas = "" if drawing.gas is None else f", {drawing.gas / 1e6:.1f} M gas"
    return f"{drawing.triangles:,} {triangles}{gas}"
