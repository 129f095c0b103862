"""Reading of files, with one-line errors."""

from __future__ import annotations

import os
import re
import stat
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ...errors import InputError
from ...untrusted import read_json, read_toml

#: No mesh for a contract is nearly as large; a larger file would only fill the memory.
MAX_BYTES = 256 * 2**20

#: Numbers that are none, as programs of Windows write them.
_NAN = re.compile(r"(?<!\S)[-+]?(1\.#(IND|INF|QNAN|SNAN)\d*|nan\(\w*\))(?!\S)", re.IGNORECASE)

_AT_ONCE = getattr(os, "O_NONBLOCK", 0)


def read_bytes(path: Path) -> bytes:
    """Return everything in a file that exists, is not empty and not above `MAX_BYTES`."""
    try:
        # opened before its status is read, so that an audit hook sees every file; without waiting for a pipe
        with open(path, "rb", buffering=0, opener=lambda name, flags: os.open(name, flags | _AT_ONCE)) as file:
            status = os.fstat(file.fileno())
            if stat.S_ISREG(status.st_mode) and status.st_size <= MAX_BYTES:
                data = file.readall()
    except FileNotFoundError:
        raise InputError(f"{path} does not exist") from None
    except IsADirectoryError:
        raise InputError(f"{path} is a directory; a mesh or scene file is needed") from None
    except (OSError, ValueError) as error:  # ValueError: a NUL in the path
        raise InputError(f"{path} cannot be read: {getattr(error, 'strerror', None) or error}") from None
    if not stat.S_ISREG(status.st_mode):
        raise InputError(f"{path} is not a regular file; a mesh or scene file is needed")
    if status.st_size > MAX_BYTES:
        raise InputError(f"{path} has {status.st_size / 2**20:.0f} MB; files up to {MAX_BYTES >> 20} MB are read")
    if not data.strip():
        raise InputError(f"{path} is empty")
    return data


def read_text(path: Path) -> str:
    """Return the text of a file as `plain_text` does. InputError for binary data."""
    data = read_bytes(path)
    if b"\0" in data:
        raise InputError(f"{path} is not a text file, as a {path.suffix} file should be")
    return plain_text(data)


def plain_text(data: bytes) -> str:
    """Return text, UTF-8 or else of the code page of Windows, with line ends of Unix, and nan for what is -1.#IND."""
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = data.decode("cp1252", errors="replace")
    text = text.replace("\r\n", "\n").replace("\r", "\n")
    return _NAN.sub("nan", text) if "#" in text or "(" in text else text


def parse(path: Path, text: str, kind: str) -> Mapping[str, Any]:
    """Return the object that a text of a kind, .toml or .json, holds; `path` is for messages."""
    try:
        document = read_toml(text) if kind == ".toml" else read_json(text)
    except ValueError as error:
        raise InputError(f"{path} is not valid {kind[1:].upper()}: {' '.join(str(error).split())}") from None
    if not isinstance(document, Mapping):
        raise InputError(f"{path} must hold an object with the keys of a scene, not {document!r:.60}")
    return document
