"""Finished parts on disk, so that an interrupted job can be continued.

Each part is a file, written atomically and named by the hash of the contracts and of the call. Files are verified by
their hash when they are read; damaged ones are ignored.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

from ..artifacts import RENDERER, artifact
from ..base.whole_file import make_output_folder, write_output
from ..chain._chain import Drawing
from ..errors import ChainError, InputError
from ..image import decode_bmp
from ..scene._codec import encode_scene
from ..scene._in_range import in_range
from ..scene._scene import Scene
from ._backends import Part

SUFFIX = ".part"
#: Another render of the same output may remove the folder at any time: so often is it made again.
_TRIES = 5


def folder_of(output: Path) -> Path:
    """Return the folder for the parts of a picture that is to be written to `output`."""
    return output.with_name(output.name + ".parts")


def remove_parts(folder: Path) -> None:
    """Remove the files of a store, and the folder if nothing else is in it."""
    with suppress(OSError):
        # temporary files of writes that were interrupted begin with a dot
        for path in (*folder.glob(f"*{SUFFIX}"), *folder.glob(f".*{SUFFIX}.*")):
            path.unlink(missing_ok=True)
        folder.rmdir()


def contracts_digest() -> bytes:
    """Return a hash of the contracts that draw."""
    return hashlib.sha256(b"".join(artifact(name).creation for name in RENDERER)).digest()


class PartStore:
    """The finished parts of a job."""

    def __init__(self, folder: Path, frames: Sequence[Scene], compared: bool = True) -> None:
        """Create the folder; raise the errors of `make_output_folder`.

        compared: whether all parts are verified; such a job does not use parts of one in which they were not.
        """
        self.folder = folder
        self._frames = frames
        self._scenes = [hashlib.sha256(encode_scene(in_range(scene))).digest() for scene in frames]
        self._salt = contracts_digest() + bytes([compared])
        make_output_folder(folder)

    def read(self, part: Part) -> Drawing | None:
        """Return a finished part, or None if it is missing or damaged."""
        try:
            data = self._path(part).read_bytes()
            head, bmp = data[32:].split(b"\n", 1)
            if hashlib.sha256(data[32:]).digest() != data[:32]:
                return None
            piece = Drawing(bmp, *json.loads(head))
            decode_bmp(piece.bmp, part.tile.width, part.tile.height)
        except (OSError, ValueError, ChainError):
            return None
        return piece

    def write(self, part: Part, piece: Drawing) -> None:
        """Write a finished part; raise OutputError if that fails."""
        body = json.dumps([piece.gas, piece.intrinsic_gas]).encode() + b"\n" + piece.bmp
        for tries_left in reversed(range(_TRIES)):
            try:
                make_output_folder(self.folder)
                return write_output(self._path(part), hashlib.sha256(body).digest() + body, is_verified=True)
            except InputError:
                if not tries_left:
                    raise

    def forget(self, part: Part) -> None:
        """Delete a part that turned out to be wrong."""
        self._path(part).unlink(missing_ok=True)

    def leave(self) -> bool:
        """Return whether any part is kept for the next run; remove the folder if not."""
        is_kept = any(self.folder.glob(f"*{SUFFIX}"))
        if not is_kept:
            remove_parts(self.folder)
        return is_kept

    def _path(self, part: Part) -> Path:
        tile = part.tile
        place = f"{tile.x},{tile.y},{tile.width},{tile.height}".encode()
        return self.folder / (hashlib.sha256(self._salt + self._scenes[part.frame] + place).hexdigest() + SUFFIX)
