"""Standard input as a file to read, and standard output as one to write."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ..errors import InputError
from ..scene._files.content import MAX_BYTES, stored

#: What stands for standard input, and for standard output.
STREAM = "-"
OUTPUTS = (STREAM, "/dev/stdout")
#: The names of both in messages.
INPUT, OUTPUT = "standard input", "standard output"


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
    with stored(sys.stdin.buffer.read(MAX_BYTES + 1), INPUT) as path:
        yield path
