"""The files that visitors have handed in, in memory only: the least recently used make room for new ones."""

from __future__ import annotations

from collections import OrderedDict
from dataclasses import dataclass

from ..errors import InputError
from .scene import Facts


@dataclass(frozen=True)
class Stored:
    """A file as it was read.

    name: of the file, tidied. scene: pickled by one of our workers. facts: of the scene. simplified_to: the triangles
    that each mesh was brought down to, or None. data: the file itself, for whoever takes the picture home.
    """

    name: str
    scene: bytes
    facts: Facts
    simplified_to: int | None
    data: bytes

    @property
    def size(self) -> int:
        """In bytes."""
        return len(self.scene) + len(self.data)


class Store:
    """Files by the SHA-256 of their bytes."""

    def __init__(self, bound: int) -> None:
        """`bound`: bytes of all together."""
        self._bound = bound
        self._files: OrderedDict[str, Stored] = OrderedDict()

    def put(self, sha256: str, stored: Stored) -> None:
        """Keeps a file, and forgets others if need be."""
        self._files[sha256] = stored
        self._files.move_to_end(sha256)
        while self.size > self._bound and len(self._files) > 1:
            self._files.popitem(last=False)

    def get(self, sha256: str) -> Stored:
        """The file; InputError if it is not kept, or no more."""
        if sha256 not in self._files:
            raise InputError(
                f"the file of this picture (SHA-256 {sha256[:12]}…) is not here, or no more: hand it in again"
            )
        self._files.move_to_end(sha256)
        return self._files[sha256]

    def __contains__(self, sha256: str) -> bool:
        return sha256 in self._files

    def __len__(self) -> int:
        return len(self._files)

    @property
    def size(self) -> int:
        """Bytes of all files."""
        return sum(stored.size for stored in self._files.values())
