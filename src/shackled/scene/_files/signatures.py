"""What a file is by its content: the rows of signatures.toml."""

from __future__ import annotations

import re
import tomllib
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Any, NamedTuple

#: Byte order marks of UTF-8 and UTF-16.
UTF8, UTF16 = b"\xef\xbb\xbf", (b"\xff\xfe", b"\xfe\xff")
#: So much of a file is compared with the signatures.
HEAD = 1 << 16
#: The count of facets in a binary STL file ends here, and so long is a facet.
_STL_HEADER, _STL_FACET = 84, 50
#: U+FFFD in UTF-8.
_REPLACEMENT = b"\xef\xbf\xbd"


class Signature(NamedTuple):
    """A row of the table: what a file is that begins so. format: as which it is read; do: what to do instead."""

    name: str
    begins: re.Pattern[str]
    text: bool = False
    format: str | None = None
    do: str | None = None


BINARY_STL = Signature("a binary STL file", re.compile(""), format=".stl")


@cache
def _table() -> Any:
    return tomllib.loads(files(__package__).joinpath("signatures.toml").read_text("utf-8"))


@cache
def signatures() -> list[Signature]:
    """Return the rows of the table."""
    rows = []
    for row in _table()["signature"]:
        flags = re.ASCII if row.get("case", True) else re.ASCII | re.IGNORECASE
        begins = re.compile(row["begins"], flags)
        rows.append(Signature(row["name"], begins, row.get("text", False), row.get("format"), row.get("do")))
    return rows


def formats() -> list[str]:
    """Return the extensions of the formats of inputs."""
    return list(dict.fromkeys(row.format for row in signatures() if row.format and not row.do))


def signature_of(data: bytes, size: int | None = None) -> Signature | None:
    """Return what a file is by how it begins, if that is known. size: of the file, if the data is not all of it."""
    if _STL_HEADER <= (size or len(data)) == _STL_HEADER + _STL_FACET * int.from_bytes(data[80:84], "little"):
        return BINARY_STL
    data = data[:HEAD].rstrip(b"\0")
    head = data.decode("utf-16", "ignore") if data.startswith(UTF16) else data.removeprefix(UTF8).decode("latin-1")
    return next((row for row in signatures() if row.begins.match(head) and not (row.text and "\0" in head)), None)


def damage_of(data: bytes) -> Signature | None:
    """Return what all of a file is if it is binary data that was damaged when it was copied as text; else None."""
    damaged = _table()["damaged"]
    if b"\0" not in data or data.count(_REPLACEMENT) < damaged["least"]:
        return None
    try:
        data.decode()
    except UnicodeDecodeError:
        return None
    return Signature(damaged["name"], re.compile(""), do=damaged["do"])


def format_by_name(path: Path) -> str:
    """Return the extension of the format that the name of a file tells, in lower case; .gz is passed over."""
    suffix = path.suffix.lower()
    suffix = Path(path.stem).suffix.lower() if suffix == ".gz" else suffix
    return ".glb" if suffix == ".vrm" else suffix
