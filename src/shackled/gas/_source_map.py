"""The place in the sources of each instruction of a contract."""

from __future__ import annotations

import json
import re
from bisect import bisect_right
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any

from ..artifacts import artifact

_PUSH1, _PUSH32 = 0x60, 0x7F


@dataclass(frozen=True)
class Function:
    """A function: its name with that of its contract or file, and its range in bytes."""

    name: str
    begin: int
    end: int


@dataclass(frozen=True)
class Source:
    """A source file."""

    name: str
    text: bytes
    functions: tuple[Function, ...]
    line_begins: tuple[int, ...]

    def line(self, place: int) -> int:
        """Return the line of a byte offset, from 1."""
        return bisect_right(self.line_begins, place)

    def function(self, begin: int, end: int) -> str | None:
        """Return the function that contains a range of bytes."""
        return next((f.name for f in self.functions if f.begin <= begin and end <= f.end), None)


@dataclass(frozen=True)
class Place:
    """The place of an instruction in the sources.

    function: None for code of the compiler, such as ABI decoding.
    line: from 1.
    jump: "i" for a jump into a function, "o" for a jump out of one, "-" otherwise.
    block: whether the place is a whole block of inline assembly, which the compiler does not subdivide.
    """

    file: str
    function: str | None
    line: int
    jump: str
    block: bool


@dataclass(frozen=True)
class SourceMap:
    """The places of a contract's instructions, and the functions that begin there, by position in the code."""

    contract: str
    places: dict[int, Place]
    entries: dict[int, str]
    entry_lines: dict[int, int]


@cache
def source_map(contract: str) -> SourceMap:
    """Return the map of a contract, by the name of its artifact."""
    data = _data()["contracts"][contract]
    places: dict[int, Place] = {}
    spans: dict[int, tuple[int, int, int]] = {}
    fields = ["0", "0", "-1", "-"]
    entries = data["map"].split(";")
    for at, entry in zip(_instructions(artifact(contract).runtime), entries, strict=False):
        # begin:length:source:jump:...; an empty field repeats that of the previous entry
        for i, field in enumerate(entry.split(":")[:4]):
            fields[i] = field or fields[i]
        begin, length, number = map(int, fields[:3])
        source = _sources().get(number)
        if source is None:
            places[at] = Place("", None, 0, fields[3], False)
            continue
        spans[at] = number, begin, begin + length
        block = source.text.startswith(b"assembly", begin)
        function = source.function(begin, begin + length)
        places[at] = Place(source.name, function, source.line(begin), fields[3], block)
    names, lines = {}, {}
    for name, at in data["entries"].items():
        names[at], lines[at] = _entry(name, spans.get(at))
    return SourceMap(contract, places, names, lines)


def _entry(name: str, span: tuple[int, int, int] | None) -> tuple[str, int]:
    """Return name and line of a function of the compiler's intermediate language."""
    if span is None:
        return name, 0
    source, (_, begin, end) = _sources()[span[0]], span
    exact = next((f.name for f in source.functions if (f.begin, f.end) == (begin, end)), None)
    if exact is not None:
        return exact, source.line(begin)
    if name.startswith("usr$"):
        # a function in inline assembly; its copies have numbers
        own = re.sub(r"_\d+$", "", name.removeprefix("usr$"))
        stem = source.name.rpartition("/")[2].removesuffix(".sol")
        found = re.compile(rb"\bfunction\s+" + own.encode() + rb"\b").search(source.text, begin, end)
        return f"{stem}.{own}", source.line(found.start() if found else begin)
    return re.sub(r"_\d+$", "", name), source.line(begin)


def _instructions(code: bytes) -> list[int]:
    """Return the positions of the instructions, without pushed data."""
    places, at = [], 0
    while at < len(code):
        places.append(at)
        at += 1 + (code[at] - _PUSH1 + 1 if _PUSH1 <= code[at] <= _PUSH32 else 0)
    return places


@cache
def _data() -> dict[str, Any]:
    data: dict[str, Any] = json.loads(files("shackled.artifacts").joinpath("source-maps.json").read_text("utf-8"))
    return data


@cache
def _sources() -> dict[int, Source]:
    """Return the compiled sources, by the compiler's numbers."""
    texts: dict[str, dict[str, str]] = {}
    for group in {artifact(contract).group for contract in _data()["contracts"]}:
        request = json.loads(files("shackled.artifacts").joinpath(f"standard-input-{group}.json").read_text("utf-8"))
        texts |= request["sources"]
    sources = {}
    for number, source in _data()["sources"].items():
        # the artifacts do not contain the sources of libraries
        text = texts[source["name"]].get("content", "").encode()
        functions = tuple(Function(name, begin, begin + length) for name, begin, length in source["functions"])
        begins = (0, *(match.end() for match in re.finditer(rb"\n", text)))
        sources[int(number)] = Source(source["name"], text, functions, begins)
    return sources
