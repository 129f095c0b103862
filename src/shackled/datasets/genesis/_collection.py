"""The Genesis collection, the pieces of other seeds, and all of them in one picture."""

from __future__ import annotations

import io
import re
from collections.abc import Callable, Iterator
from itertools import islice
from math import isqrt
from pathlib import Path

from PIL import Image as PillowImage

from ...checks import whole
from ...errors import InputError
from ...ethereum import keccak256
from ...image import pillow_bytes
from ...whole_file import check_output_file, write_output
from .. import SIZE, Piece, draw_all
from ._contract import generate

COUNT = 1024

#: Called with the number of finished pieces, and of all.
Progress = Callable[[int, int], object]


def seed_of(number: int) -> bytes:
    """Return the seed of a piece of the collection, from 0 to 1023."""
    if not 0 <= number < COUNT:
        raise InputError(f"the pieces of the collection are numbered from 0 to {COUNT - 1}, not {number}")
    return keccak256(f"shackled-{number}".encode("ascii"))


def parse_seed(text: str) -> bytes:
    """Return the seed of 64 hexadecimal digits, with or without 0x, or of the number of a piece."""
    if re.fullmatch(r"(0[xX])?[0-9a-fA-F]{64}", text):
        return bytes.fromhex(text[-64:])
    if re.fullmatch(r"0|[1-9][0-9]{0,3}", text) and int(text) < COUNT:
        return seed_of(int(text))
    raise InputError(
        f"a seed must be 64 hexadecimal digits, with or without 0x, or a number from 0 to {COUNT - 1}, not {text!r:.80}"
    )


def pieces() -> Iterator[Piece]:
    """Return the pieces of the collection."""
    return (_piece(str(number), seed_of(number)) for number in range(COUNT))


def find(name: str) -> Piece | None:
    """Return the piece of a number or seed, as `parse_seed` reads it; None if it is neither."""
    try:
        seed = parse_seed(name)
    except InputError:
        return None
    return _piece(name if len(name) < 64 else seed.hex(), seed)


def _piece(label: str, seed: bytes) -> Piece:
    title = f"Genesis {label if len(label) < 64 else label[:8]}"
    return Piece(f"genesis/{label}", "genesis", title, "MIT", lambda: generate(seed).scene())


def render_sheet(
    path: str | Path,
    count: int = COUNT,
    size: int = SIZE,
    workers: int | None = None,
    progress: Progress = lambda done, total: None,
) -> None:
    """Render the first `count` pieces, size x size pixels each, in rows, into one PNG.

    workers: number of worker processes; None for one per core. Finished drawings are kept in the cache folder, so that
    an interrupted run continues. InputError or OutputError if the file cannot be written.
    """
    path = Path(path)
    if path.suffix.lower() != ".png":
        raise InputError(f"the sheet {path} must end in .png")
    check_output_file(path, "sheet")
    whole(count, "the number of pieces of a sheet", 1, COUNT)
    whole(size, "the size of a piece in pixels", 1, 1024)
    shown = list(islice(pieces(), count))
    places = {piece.name: place for place, piece in enumerate(shown)}
    columns = isqrt(count - 1) + 1
    sheet = PillowImage.new("RGB", (columns * size, -(-count // columns) * size))
    progress(0, count)
    for done, drawing in enumerate(draw_all(shown, size, workers), 1):
        row, column = divmod(places[drawing.name], columns)
        with PillowImage.open(io.BytesIO(drawing.png)) as picture:
            sheet.paste(picture, (column * size, row * size))
        progress(done, count)
    write_output(path, pillow_bytes(sheet, "png"))
