"""What is wrong with many tokens, in few lines."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Sequence

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
