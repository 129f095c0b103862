"""The limits of requests, and the uploaded files in memory."""

from __future__ import annotations

from collections import OrderedDict
from dataclasses import dataclass

from ..errors import InputError
from ._scene import Facts

MEGABYTE = 2**20


@dataclass(frozen=True)
class Limits:
    """Bounds of the Creator. A request beyond one of them is refused with an InputError or a PoolError.

    gas: of one call.
    seconds, slow_seconds, reading_seconds: time limits of a live picture, of a long task, and of reading a file.
    memory: bytes that a worker process may write.
    upload: bytes of an uploaded file. unpacked, entries: bytes and number of the files in an archive.
    triangles: of each mesh of a file; larger meshes are simplified. all_triangles: of all meshes together.
    stored: bytes of all uploads in memory; the least recently used ones are dropped.
    waiting: jobs in each queue.
    gif_frames, gif_pixels: number of frames of a GIF, and pixels of all its frames together.
    """

    gas: int = 4_000_000_000
    seconds: float = 30
    slow_seconds: float = 120
    reading_seconds: float = 20
    memory: int = 1536 * MEGABYTE
    upload: int = 8 * MEGABYTE
    unpacked: int = 48 * MEGABYTE
    entries: int = 64
    triangles: int = 20_000
    all_triangles: int = 60_000
    stored: int = 256 * MEGABYTE
    waiting: int = 1000
    gif_frames: int = 120
    gif_pixels: int = 24_000_000


@dataclass(frozen=True)
class Stored:
    """An uploaded file after it was read.

    name: cleaned file name. scene: the scene, pickled by one of our workers. facts: of the scene. simplified_to: number
    of triangles to which each mesh was simplified, or None. data: the file itself.
    """

    name: str
    scene: bytes
    facts: Facts
    simplified_to: int | None
    data: bytes

    @property
    def size(self) -> int:
        """Number of bytes in memory."""
        return len(self.scene) + len(self.data)


class Store:
    """Uploaded files by the SHA-256 of their bytes."""

    def __init__(self, bound: int) -> None:
        """Keep nothing yet. bound: bytes of all files together."""
        self._bound = bound
        self._files: OrderedDict[str, Stored] = OrderedDict()

    def put(self, sha256: str, stored: Stored) -> None:
        """Keep a file; drop the least recently used ones where the bound is exceeded."""
        self._files[sha256] = stored
        self._files.move_to_end(sha256)
        while self.size > self._bound and len(self._files) > 1:
            self._files.popitem(last=False)

    def get(self, sha256: str) -> Stored:
        """Return a file. InputError if it is not in memory."""
        if sha256 not in self._files:
            raise InputError(
                f"the file of this picture (SHA-256 {sha256[:12]}…) is not in the memory of this server: open it again"
            )
        self._files.move_to_end(sha256)
        return self._files[sha256]

    def __contains__(self, sha256: str) -> bool:
        return sha256 in self._files

    def __len__(self) -> int:
        return len(self._files)

    @property
    def size(self) -> int:
        """Number of bytes of all files."""
        return sum(stored.size for stored in self._files.values())
