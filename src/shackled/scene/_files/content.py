"""Reading of files, with one-line errors, and what a file is by its content: signatures.toml."""

from __future__ import annotations

import os
import re
import stat
import zlib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from ...base.untrusted import read_json, read_toml
from ...errors import InputError, renaming, warn
from .signatures import BINARY_STL, HEAD, UTF8, UTF16, Signature, damage_of, format_by_name, formats, signature_of

#: No mesh for a contract is nearly as large; a larger file would only fill the memory.
MAX_BYTES = 256 * 2**20

#: Numbers that are none, as programs of Windows write them.
_NAN = re.compile(r"(?<!\S)[-+]?(1\.#(IND|INF|QNAN|SNAN)\d*|nan\(\w*\))(?!\S)", re.IGNORECASE)

_AT_ONCE = getattr(os, "O_NONBLOCK", 0)

#: What a file of .gz may unpack to, and how it begins.
MAX_UNPACKED = 64 * 2**20
_GZIP = b"\x1f\x8b\x08"
#: Numbers with a decimal comma.
_COMMA = re.compile(r"(?<!\S)([-+]?\d+),(\d+(?:[eE][-+]?\d+)?)(?!\S)")


def format_of(path: Path, with_note: bool = False) -> str:
    """Return the extension of the format of a file: by its content, or else by its name.

    with_note: whether an InputWarning tells if the name is that of another format. InputError, which says what it is
    and what to do, for what is known not to be a mesh or a scene.
    """
    named = format_by_name(path)
    try:
        with open(path, "rb", opener=_open_at_once) as file:
            status = os.fstat(file.fileno())
            head, size = file.read(HEAD) if stat.S_ISREG(status.st_mode) else b"", status.st_size
            if head.startswith(_GZIP):
                file.seek(-4, os.SEEK_END)
                size = int.from_bytes(file.read(4), "little")
                head = zlib.decompressobj(31).decompress(head, HEAD)
    except (OSError, ValueError, zlib.error):
        return named  # reading it reports what is wrong
    found = signature_of(head, size)
    if found is not None and found.do is not None:
        raise InputError(f"{path} is {found.name}: {found.do}")
    if found is None or found.format is None:
        return named
    if named not in formats():
        return found.format
    # any JSON or TOML begins as a scene file does, and all of glTF has one reader
    if found.format in (named, ".json", ".toml") or {found.format, named} == {".glb", ".gltf"}:
        return named
    if found.format == ".png":
        raise InputError(f"{path} is {found.name}: one that carries a scene must have a name in .png")
    if with_note:
        warn(f"{path} is {found.name}, and is read as one")
    return found.format


def _open_at_once(name: str, flags: int) -> int:
    """Open a file without waiting for whoever writes to a pipe."""
    return os.open(name, flags | _AT_ONCE)


def read_bytes(path: Path) -> bytes:
    """Return everything in a file that exists, is not empty and not above `MAX_BYTES`."""
    try:
        # opened before its status is read, so that an audit hook sees every file
        with open(path, "rb", buffering=0, opener=_open_at_once) as file:
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


def read_content(path: Path) -> bytes:
    """Return everything in a mesh or scene file, or one of materials: unpacked, and UTF-8 if it is text with a byte
    order mark. InputError as in `read_bytes`, and for what is damaged or known to be something else.
    """
    data, found = _identified(read_bytes(path), path)
    if data.startswith(UTF16) and found is not BINARY_STL:
        try:
            return data.decode("utf-16").encode()
        except UnicodeDecodeError:
            return data
    return data.removeprefix(UTF8)


def _identified(data: bytes, name: Path | str) -> tuple[bytes, Signature | None]:
    """Return data, unpacked, and what it is by its content. InputError if it is empty, damaged or nothing to read."""
    data = _unpacked(data, name)
    if not data.strip():
        raise InputError(f"{name} is empty")
    found = damage_of(data) or signature_of(data)
    if found is not None and found.format is None:
        raise InputError(f"{name} is {found.name}: {found.do}")
    return data, found


def _unpacked(data: bytes, name: Path | str) -> bytes:
    """Return data, or what a file of .gz holds, of which no more is unpacked than is read."""
    if not data.startswith(_GZIP):
        return data
    unpacked = b""
    try:
        while data.startswith(_GZIP):  # one part, or several
            opener = zlib.decompressobj(31)
            unpacked += opener.decompress(data, MAX_UNPACKED + 1 - len(unpacked))
            if len(unpacked) > MAX_UNPACKED:
                raise InputError(f"{name} unpacks to more than {MAX_UNPACKED >> 20} MB: unpack it first")
            if not opener.eof:
                raise InputError(f"{name} is cut off: it ends before all of it is unpacked")
            data = opener.unused_data
    except zlib.error:
        raise InputError(f"{name} is a damaged gzip file") from None
    return unpacked


def is_pipe(path: str | os.PathLike[str]) -> bool:
    """Return whether a path is that of a pipe, such as /dev/stdin or what <(...) of a shell makes."""
    try:
        return stat.S_ISFIFO(os.stat(path).st_mode)
    except (OSError, ValueError):
        return False


def read_pipe(path: str | os.PathLike[str]) -> bytes:
    """Return all that is written to a pipe, up to `MAX_BYTES` and one more; nothing if nobody writes to it."""
    with open(path, "rb", opener=_open_at_once) as file:
        os.set_blocking(file.fileno(), True)
        return file.read(MAX_BYTES + 1)


@contextmanager
def stored(data: bytes, name: str) -> Iterator[Path]:
    """Store data that has no file in a temporary one, with the extension of its format, and yield its path.

    Messages meanwhile call it by a name. InputError if it is empty, too long, or if its content does not tell a format.
    """
    if len(data) > MAX_BYTES:
        raise InputError(f"{name} has more than {MAX_BYTES >> 20} MB, which is the most that is read")
    data, found = _identified(data, name)
    if found is None:
        known = " ".join(formats())
        raise InputError(f"the format of {name} is not told by its content: give a file with its extension, {known}")
    with TemporaryDirectory(prefix="shackled-") as folder:
        path = Path(folder) / f"input{found.format}"
        path.write_bytes(data)
        with renaming(str(path), name):
            yield path


def with_points(path: Path, text: str, lines: str = r"[^\s#]*") -> str:
    """Return a text with points for decimal commas in lines that begin with a keyword, of which an InputWarning tells.

    lines: a regular expression for the keywords, by default any. What is behind # stays.
    """
    if "," not in text:
        return text
    found = re.sub(rf"(?m)^[ \t]*(?:{lines})(?!\S)[^\n#]*", lambda line: _COMMA.sub(r"\1.\2", line[0]), text)
    if found != text:
        warn(f"{path}: its numbers have decimal commas, which are read as points")
    return found


def read_text(path: Path) -> str:
    """Return the text of a file as `plain_text` does. InputError for binary data."""
    data = read_content(path).rstrip(b"\0")  # that some programs leave behind the text
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
