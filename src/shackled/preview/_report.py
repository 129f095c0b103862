"""What is reported of many tokens: problems in few lines, a summary for programs, and their pictures in one."""

from __future__ import annotations

import io
import re
from collections import Counter
from collections.abc import Iterable, Sequence
from math import isqrt
from pathlib import Path
from typing import Any

from PIL import Image as PillowImage

from ..errors import InputError
from ..whole_file import check_output_file, write_output
from ._document import PICTURES
from ._preview import Token

#: Ranges of numbers that one line shows.
MOST_RANGES = 20


def folded(tokens: Iterable[Token]) -> list[tuple[str, str]]:
    """Return the problems with the numbers of the tokens that have them, such as ("16 to 255", "tokenURI fails").

    Problems that differ only in the number of the token and in gas are one; the words are those of the first token.
    """
    groups: dict[str, list[tuple[int, str]]] = {}
    found = [(token.number, problem) for token in tokens for problem in token.problems]
    # equal words may have the number of one of their tokens by chance
    times = Counter(problem for _, problem in found)
    for number, problem in found:
        alike = problem if times[problem] > 1 else re.sub(rf"[\d,]+ gas\b|\b{number}\b", "#", problem)
        groups.setdefault(alike, []).append((number, problem))
    return [(_ranges([number for number, _ in group]), _words(group)) for group in groups.values()]


def _words(group: Sequence[tuple[int, str]]) -> str:
    """Return the problem of the first token, and whether others have it with other numbers."""
    words = group[0][1]
    return words if all(problem == words for _, problem in group) else f"{words}; the others alike"


def _ranges(numbers: Iterable[int]) -> str:
    """Return ascending numbers as text: 1 to 3, 5."""
    ranges: list[list[int]] = []
    for number in numbers:
        if ranges and number <= ranges[-1][1] + 1:
            ranges[-1][1] = number
        else:
            ranges.append([number, number])
    shown = [str(low) if low == high else f"{low} to {high}" for low, high in ranges]
    more = f" and {len(shown) - MOST_RANGES} more" if len(shown) > MOST_RANGES else ""
    return ", ".join(shown[:MOST_RANGES]) + more


def summary(token: Token) -> dict[str, Any]:
    """Return number, gas, name, problems, and the media types of the files."""
    document = token.document
    return {
        "number": token.number,
        "gas": token.gas,
        "bytes": token.bytes,
        "name": document.name,
        "problems": token.problems,
        "image": document.image.media_type if document.image else None,
        "animation": document.animation.media_type if document.animation else None,
        "frames": max((file.frames for file in (document.image, document.animation) if file), default=0),
    }


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
