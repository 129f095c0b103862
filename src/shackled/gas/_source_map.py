"""Map the instructions of a contract to its sources."""

from __future__ import annotations

import json
import re
from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any

from ..artifacts import artifact
from ..artifacts import source as text_of
from ..ethereum._encoding import instructions


@dataclass(frozen=True)
class SourceFile:
    """A file of the sources. functions: names, with that of contract or file, and ranges of bytes."""

    name: str
    text: bytes
    functions: tuple[tuple[str, int, int], ...]
    line_begins: tuple[int, ...]

    def line(self, place: int) -> int:
        """Return the line of a byte, from 1."""
        return bisect_right(self.line_begins, place)

    def function(self, begin: int, end: int) -> str | None:
        """Return the function that contains these bytes."""
        return next((name for name, first, last in self.functions if first <= begin and end <= last), None)


@dataclass(frozen=True)
class SourceLocation:
    """Where an instruction comes from.

    function: None if it is the compiler's own, such as decoding the ABI. line: from 1. jump: "i" where a function is
    entered, "o" where one is left, "-" otherwise. block: whether the location is a whole block of inline assembly,
    which the compiler does not divide.
    """

    file: str
    function: str | None
    line: int
    jump: str
    block: bool


@dataclass(frozen=True)
class SourceMap:
    """The locations of a contract's instructions, and the functions that begin at them, by position in the code."""

    places: dict[int, SourceLocation]
    entries: dict[int, str]
    entry_lines: dict[int, int]


@cache
def source_map(contract: str) -> SourceMap:
    """Return the map of a contract, by the name of its artifact."""
    data = _data()["contracts"][contract]
    places: dict[int, SourceLocation] = {}
    entries = {at: name for name, at in data["entries"].items()}
    names, lines = {}, {}
    for at, number, begin, end, jump in instruction_sources(artifact(contract).runtime, data["map"]):
        source = _sources().get(number)
        places[at] = SourceLocation("", None, 0, jump, False)
        if source is not None:
            block = source.text.startswith(b"assembly", begin)
            places[at] = SourceLocation(source.name, source.function(begin, end), source.line(begin), jump, block)
        if at in entries:
            names[at], lines[at] = (entries[at], 0) if source is None else _entry(entries[at], source, begin, end)
    return SourceMap(places, names, lines)


def instruction_sources(code: bytes, entries: str) -> Iterator[tuple[int, int, int, int, str]]:
    """Yield position, number of the source (-1: none), begin, end and jump of each instruction of a source map."""
    fields = ["0", "0", "-1", "-"]
    for at, entry in zip(instructions(code), entries.split(";"), strict=False):
        # begin:length:source:jump:..., where empty fields repeat the entry before
        for i, field in enumerate(entry.split(":")[:4]):
            fields[i] = field or fields[i]
        begin, length, number = map(int, fields[:3])
        yield at, number, begin, begin + length, fields[3]


def _entry(name: str, source: SourceFile, begin: int, end: int) -> tuple[str, int]:
    """Name and line of a function of the compiler's intermediate language."""
    exact = next((each for each, *place in source.functions if place == [begin, end]), None)
    # copies of functions are numbered
    own = re.sub(r"_\d+$", "", name.removeprefix("usr$"))
    if exact is not None or not name.startswith("usr$"):
        return exact or own, source.line(begin)
    # a function within inline assembly
    stem = source.name.rpartition("/")[2].removesuffix(".sol")
    found = re.compile(rb"\bfunction\s+" + own.encode() + rb"\b").search(source.text, begin, end)
    return f"{stem}.{own}", source.line(found.start() if found else begin)


@cache
def _data() -> dict[str, Any]:
    data: dict[str, Any] = json.loads(files("shackled.artifacts").joinpath("source-maps.json").read_text("utf-8"))
    return data


@cache
def _sources() -> dict[int, SourceFile]:
    """Return the source files by the compiler's numbers."""
    found = {}
    for number, source in _data()["sources"].items():
        # libraries may not be installed
        text = (text_of(source["name"]) or "").encode()
        functions = tuple((name, begin, begin + length) for name, begin, length in source["functions"])
        begins = (0, *(match.end() for match in re.finditer(rb"\n", text)))
        found[int(number)] = SourceFile(source["name"], text, functions, begins)
    return found
