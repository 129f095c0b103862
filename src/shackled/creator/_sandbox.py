"""The sandbox of the process that reads untrusted files: it opens only the upload, and no connections.

Readers of mesh files open other files that a mesh names, such as materials and textures. The audit hook below allows
only files in the folder of the upload. An audit hook cannot be removed, so the process does nothing else.
"""

from __future__ import annotations

import os
import sys
import sysconfig
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from ..artifacts import artifact

#: Largest number of pixels of a texture: 4096 x 4096.
MAX_TEXTURE = 2**24

_entered = False
_allowed: list[str] = []
_inside: str | None = None

#: Modules that readers import late, if they are installed.
_NEEDED = ("DracoPy", "fast_simplification")

#: Audit events that reading a file does not need.
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
    """A file tried to open what the sandbox forbids."""


def enter_sandbox() -> None:
    """Import what readers may need, then set the audit hook permanently. It is active only within `upload_folder`."""
    global _entered
    if _entered:
        return
    import PIL.Image

    for name in filter(find_spec, _NEEDED):
        import_module(name)
    artifact("Renderer")  # kept in memory, for the scenes of pictures
    PIL.Image.init()
    PIL.Image.MAX_IMAGE_PIXELS = MAX_TEXTURE // 2  # Pillow refuses images of twice this size
    # folders from which Python may load modules later
    paths = {*sysconfig.get_paths().values(), sys.prefix, sys.base_prefix, *sys.path}
    _allowed.extend(os.path.realpath(path) + os.sep for path in paths if path and path != os.sep)
    sys.addaudithook(_hook)
    _entered = True


@contextmanager
def upload_folder() -> Iterator[Path]:
    """Make a folder for an upload and remove it at the end; in the sandbox no other file can be opened meanwhile."""
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
        # modules may be loaded late, but not written
        reading = not arguments[2] & (os.O_WRONLY | os.O_RDWR | os.O_CREAT)
        if reading and real.endswith((".py", ".pyc", ".so", ".pyd")) and real.startswith(tuple(_allowed)):
            return
        raise ForbiddenError(f"{os.path.basename(real)} is outside the upload")
    if event.startswith(_FORBIDDEN):
        raise ForbiddenError(f"reading a file must not use {event}")
