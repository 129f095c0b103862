"""Standard input as a file to read, and standard output as one to write."""

from __future__ import annotations

import os
import re
import sys
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from ..errors import InputError, InputWarning
from ..scene import MAX_BYTES, PICTURE, READERS, SCENES
from ..untrusted import read_json

#: What stands for standard input, and for standard output.
STREAM = "-"
OUTPUTS = (STREAM, "/dev/stdout")
#: The names of both in messages.
INPUT, OUTPUT = "standard input", "standard output"

#: How files of these formats begin. The other formats are told by what follows.
_BEGINNINGS = {
    ".png": rb"\x89PNG\r\n\x1a\n",
    ".glb": rb"glTF",
    ".ply": rb"ply\s",
    ".off": rb"\s*(?:ST)?C?N?C?4?n?OFF\b",
    ".stl": rb"\s*solid\b[^\0]*?\bfacet\b",
    ".obj": rb"(?:\s*#[^\n]*\n)*\s*(?:v|vn|vt|o|g|s|mtllib|usemtl)[ \t]",
}


def is_output(path: str | None) -> bool:
    """Return whether a picture is to be written to standard output. InputError if that is a terminal."""
    if path not in OUTPUTS:
        return False
    if sys.stdout.isatty():
        raise InputError(f"the picture would be written to the terminal: redirect {OUTPUT}, or name a file")
    return True


def write_stdout(data: bytes) -> None:
    """Write a file to standard output."""
    sys.stdout.buffer.write(data)
    sys.stdout.buffer.flush()


@contextmanager
def stdin_file() -> Iterator[Path]:
    """Store standard input in a temporary file, whose extension is that of its format, and yield its path."""
    if sys.stdin is None or sys.stdin.isatty():
        raise InputError(f"{STREAM} reads {INPUT}: pipe a mesh or scene file into the command")
    data = sys.stdin.buffer.read(MAX_BYTES + 1)
    if len(data) > MAX_BYTES:
        raise InputError(f"{INPUT} has more than {MAX_BYTES >> 20} MB, which is the most that is read")
    if not data.strip():
        raise InputError(f"{INPUT} is empty")
    with TemporaryDirectory(prefix="shackled-") as folder:
        path = Path(folder) / f"stdin{_extension(data)}"
        path.write_bytes(data)
        yield path


@contextmanager
def as_stdin(path: str) -> Iterator[None]:
    """Let messages about a file, and about what is beside it, not name where standard input is stored."""

    def rename(text: object) -> str:
        return str(text).replace(path, INPUT).replace(f"{Path(path).parent}{os.sep}", "")

    show = warnings.showwarning

    def renamed(message: Warning | str, *place: Any, **more: Any) -> None:
        show(InputWarning(rename(message)) if isinstance(message, InputWarning) else message, *place, **more)

    warnings.showwarning = renamed
    try:
        yield
    except (InputError, InputWarning) as error:
        raise type(error)(rename(error)) from None
    finally:
        warnings.showwarning = show


def _extension(data: bytes) -> str:
    """Return the extension of the format of a file. InputError if its content does not tell it."""
    if len(data) >= 84 and len(data) == 84 + 50 * int.from_bytes(data[80:84], "little"):
        return ".stl"
    for extension, pattern in _BEGINNINGS.items():
        if re.match(pattern, data.removeprefix(b"\xef\xbb\xbf")):
            return extension
    if data.lstrip().startswith(b"{"):
        try:
            document = read_json(data.decode("utf-8-sig"))
        except ValueError:
            document = None
        return ".gltf" if isinstance(document, dict) and "asset" in document else ".json"
    known = " ".join((*READERS, *SCENES, PICTURE))
    raise InputError(f"the format of {INPUT} is not told by its content: give a file with its extension, {known}")
