"""What is reported of many tokens: problems in few lines, and a summary for programs."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable
from typing import Any, Literal

from ._preview import Token

#: Ranges of numbers that one line shows.
MOST_RANGES = 20


def folded(tokens: Iterable[Token], kind: Literal["problems", "notes"] = "problems") -> list[tuple[str, str]]:
    """Return the problems with the numbers of the tokens that have them, such as ("16 to 255", "tokenURI fails").

    Those that differ only in the number of the token, in gas and in faces are one; the words are of the first token.
    """
    groups: dict[str, list[tuple[int, str]]] = {}
    found = [(token.number, problem) for token in tokens for problem in getattr(token, kind)]
    # equal words may have the number of one of their tokens by chance
    times = Counter(problem for _, problem in found)
    for number, problem in found:
        alike = problem if times[problem] > 1 else re.sub(rf"[\d,]+ (gas|faces?|because)\b|\b{number}\b", "#", problem)
        groups.setdefault(alike, []).append((number, problem))
    lines = []
    for group in groups.values():
        numbers, words = zip(*group, strict=True)
        lines.append((_ranges(numbers), words[0] + "; the others alike" * (len(set(words)) > 1)))
    return lines


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
        "notes": token.notes,
        "image": document.image.media_type if document.image else None,
        "animation": document.animation.media_type if document.animation else None,
        "frames": max((file.frames for file in (document.image, document.animation) if file), default=0),
    }
