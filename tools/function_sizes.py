"""Which functions of the sources the bytes of a contract belong to."""

from __future__ import annotations

from bisect import bisect_right
from collections import Counter
from itertools import pairwise
from typing import Any

from shackled.gas import instruction_sources


def function_sizes(code: bytes, entries: str, sources: dict[str, Any]) -> Counter[str]:
    """Return the number of bytes of each function.

    Those in no function, such as of constants, are counted for their file, and those without a source for `compiler`.
    Functions within inline assembly belong to the function around them.

    entries: the compiler's source map of the code. sources: by its numbers, each with a `name` and its `functions`:
    name, first byte, and number of bytes, as in source-maps.json.
    """
    ordered: dict[int, tuple[str, list[list[Any]], list[int]]] = {}
    for key, source in sources.items():
        functions = sorted(source["functions"], key=lambda function: int(function[1]))
        ordered[int(key)] = source["name"], functions, [begin for _, begin, _ in functions]
    counted: Counter[str] = Counter()
    instructions = [(at, number, begin) for at, number, begin, _, _ in instruction_sources(code, entries)]
    for (at, number, begin), (end, _, _) in pairwise([*instructions, (len(code), -1, 0)]):
        file, functions, begins = ordered.get(number, ("compiler", [], []))
        # the last one that begins at or before it
        name, first, length = functions[bisect_right(begins, begin) - 1] if functions else (file, 0, 0)
        counted[name if first <= begin < first + length else file] += end - at
    return counted
