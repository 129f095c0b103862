"""The collection in one picture."""

from __future__ import annotations

import io
from collections.abc import Callable
from math import isqrt
from pathlib import Path

from PIL import Image as PillowImage

from ...checks import number as check_number
from ...errors import InputError
from ...whole_file import check_output_file, write_output
from .. import SIZE, draw_all
from . import COUNT, pieces

Progress = Callable[[int, int], None]


def _no_progress(done: int, total: int) -> None:
    pass


def render_sheet(
    path: str | Path,
    count: int = COUNT,
    size: int = SIZE,
    workers: int | None = None,
    progress: Progress = _no_progress,
) -> None:
    """Render the first `count` pieces, size x size pixels each, in rows, into one PNG.

    workers: number of worker processes; None for one per core. progress: called with the number of finished pieces and
    of all. Finished drawings are kept in the cache folder, so that an interrupted run continues. InputError or
    OutputError if the file cannot be written.
    """
    path = Path(path)
    if path.suffix.lower() != ".png":
        raise InputError(f"the sheet {path} must end in .png")
    check_output_file(path, "sheet")
    check_number(count, "the number of pieces of a sheet", 1, COUNT)
    check_number(size, "the size of a piece in pixels", 1, 1024)
    shown = [piece for piece, _ in zip(pieces(), range(count), strict=False)]
    places = {piece.name: place for place, piece in enumerate(shown)}
    columns = isqrt(count - 1) + 1
    rows = -(-count // columns)
    sheet = PillowImage.new("RGB", (columns * size, rows * size))
    progress(0, count)
    for done, drawing in enumerate(draw_all(shown, size, workers), 1):
        row, column = divmod(places[drawing.name], columns)
        with PillowImage.open(io.BytesIO(drawing.png)) as picture:
            sheet.paste(picture, (column * size, row * size))
        progress(done, count)
    stream = io.BytesIO()
    sheet.save(stream, "png")
    write_output(path, stream.getvalue())
