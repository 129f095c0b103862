"""A process that reads files of strangers: it opens nothing but what it was given, and reaches nobody.

The readers of mesh files follow names that stand in the files, of materials and textures for instance. Whatever those
names are, the audit hook below lets no file be opened outside the folder of the upload. It cannot be removed, which is
why the process does nothing else.
"""

from __future__ import annotations

import os
import sys
import sysconfig
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from pathlib import Path
from typing import Any

#: Pixels of a texture, at most: 4096 x 4096.
MAX_TEXTURE = 2**24

_guarded = False
_allowed: list[str] = []
_inside: str | None = None

#: What readers import when they need it.
_NEEDED = ("fast_simplification",)

#: Events that have no place in reading a file.
_FORBIDDEN = (
    "socket.",
    "subprocess.",
    "os.system",
    "os.exec",
    "os.fork",
    "os.posix_spawn",
    "os.remove",
    "os.rename",
    "os.symlink",
    "os.link",
    "shutil.",
    "ctypes.dlopen",
    "urllib.",
    "ftplib.",
    "http.",
)


class ForbiddenError(PermissionError):
    """A file tried to reach what it must not."""


def prepare_guard() -> None:
    """Imports what reading may need, for good, then sets the hook. It bites only within `folder`."""
    global _guarded
    if _guarded:
        return
    import PIL.Image

    for name in _NEEDED:
        import_module(name)
    PIL.Image.init()
    PIL.Image.MAX_IMAGE_PIXELS = MAX_TEXTURE // 2  # Pillow refuses what is twice as large
    # what Python itself loads later, from where it and its packages are
    paths = {*sysconfig.get_paths().values(), sys.prefix, sys.base_prefix, *sys.path}
    _allowed.extend(os.path.realpath(path) + os.sep for path in paths if path and path != os.sep)
    sys.addaudithook(_hook)
    _guarded = True


@contextmanager
def folder() -> Iterator[Path]:
    """A new folder for an upload, removed at the end. In a guarded process nothing else is to be had meanwhile."""
    global _inside
    with tempfile.TemporaryDirectory(prefix="shackled-") as made:
        _inside = os.path.realpath(made) + os.sep
        try:
            yield Path(made)
        finally:
            _inside = None


def _hook(event: str, arguments: tuple[Any, ...]) -> None:
    if _inside is None:
        return
    if event == "open":
        path = arguments[0]
        if isinstance(path, int) or path is None:
            return
        real = os.path.realpath(os.fsdecode(path))
        if real.startswith(_inside):
            return
        # modules that are loaded late may be read, never written
        reading = not arguments[2] & (os.O_WRONLY | os.O_RDWR | os.O_CREAT)
        if reading and real.endswith((".py", ".pyc", ".so", ".pyd")) and real.startswith(tuple(_allowed)):
            return
        raise ForbiddenError(f"{os.path.basename(real)} lies outside of the upload")
    if event.startswith(_FORBIDDEN):
        raise ForbiddenError("a file must not do that")
