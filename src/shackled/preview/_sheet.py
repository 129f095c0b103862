"""The pictures of all tokens in one."""

from __future__ import annotations

import io
from collections.abc import Sequence
from math import isqrt
from pathlib import Path

from PIL import Image as PillowImage

from ..errors import InputError
from ..whole_file import check_output_file, write_output
from ._document import PICTURES
from ._preview import Token

#: The side of a picture, in pixels.
SIDE = 128


def check_sheet(path: Path) -> None:
    """Raise InputError if the sheet cannot be written there."""
    if path.suffix.lower() != ".png":
        raise InputError(f"the sheet {path} must end in .png")
    check_output_file(path, "sheet")


def write_sheet(path: Path, tokens: Sequence[Token]) -> int:
    """Write the pictures in rows into one PNG, and return how many there are.

    Tokens without a picture, and those with an SVG, leave their places empty.
    """
    drawn = 0
    columns = isqrt(max(0, len(tokens) - 1)) + 1
    rows = -(-len(tokens) // columns)
    sheet = PillowImage.new("RGBA", (columns * SIDE, rows * SIDE))
    for number, token in enumerate(tokens):
        image = token.document.image
        if image is None or image.media_type not in PICTURES:
            continue
        drawn += 1
        row, column = divmod(number, columns)
        with PillowImage.open(io.BytesIO(image.content)) as picture:
            small = picture.convert("RGBA")
            small.thumbnail((SIDE, SIDE), PillowImage.Resampling.BOX)
        sheet.paste(small, (column * SIDE + (SIDE - small.width) // 2, row * SIDE + (SIDE - small.height) // 2))
    stream = io.BytesIO()
    sheet.save(stream, "png")
    write_output(path, stream.getvalue())
    return drawn
