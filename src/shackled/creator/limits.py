"""What a visitor may ask for, so that one does not take everything from the others."""

from __future__ import annotations

from dataclasses import dataclass

MEGABYTE = 2**20


@dataclass(frozen=True)
class Limits:
    """Bounds of the Creator; what is beyond them is refused with a clear message.

    gas: of one call. seconds, slow_seconds, reading_seconds: that a live picture, a piece of long work, and reading a
    file may take. memory: bytes of address space of a worker. upload: bytes of a file; unpacked: of what is in an
    archive, entries: how many files. triangles: of each mesh of a file; more are simplified. all_triangles: of all
    meshes together. stored: bytes of all files that are kept, the least recently used of which go first. waiting:
    requests in line. traced_gas: of pictures whose gas is traced. gif_pixels: of all frames together.
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
    traced_gas: int = 150_000_000
    gif_frames: int = 120
    gif_pixels: int = 24_000_000
