"""Getting at what is in a file, with one clear line when it cannot be had."""

from __future__ import annotations

import stat
from pathlib import Path

from ...errors import InputError

#: No mesh that a contract takes comes near this size; beyond it a file would only fill the memory.
MAX_BYTES = 256 * 2**20


def read_bytes(path: Path) -> bytes:
    """Everything in a file that exists, is not empty and not above `MAX_BYTES`."""
    try:
        status = path.stat()
        if stat.S_ISREG(status.st_mode) and status.st_size <= MAX_BYTES:
            data = path.read_bytes()
    except FileNotFoundError:
        raise InputError(f"{path} does not exist") from None
    except (OSError, ValueError) as error:  # ValueError: a NUL in the path
        raise InputError(f"{path} cannot be read: {getattr(error, 'strerror', None) or error}") from None
    if not stat.S_ISREG(status.st_mode):
        kind = "a directory" if stat.S_ISDIR(status.st_mode) else "no regular file"
        raise InputError(f"{path} is {kind}; a mesh or scene file is needed")
    if status.st_size > MAX_BYTES:
        raise InputError(f"{path} has {status.st_size / 2**20:.0f} MB; files up to {MAX_BYTES >> 20} MB are read")
    if not data.strip():
        raise InputError(f"{path} is empty")
    return data


def read_text(path: Path) -> str:
    """The text of a file. Bytes that are no UTF-8, as in old comments, are replaced; binary data is refused."""
    data = read_bytes(path)
    if b"\0" in data:
        raise InputError(f"{path} is not a text file, as a {path.suffix} file should be")
    return data.decode("utf-8-sig", errors="replace")
