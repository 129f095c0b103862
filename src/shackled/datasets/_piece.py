"""Pieces of datasets: scenes with a name and a licence."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ..scene import Scene


def _always() -> bool:
    return True


@dataclass(frozen=True)
class Piece:
    """A scene of a dataset, with a name and a licence.

    name: for instance "teapot", "icons/diamond" or "genesis/12".
    dataset: "common", "icons" or "genesis".
    title: for display. licence: of the model, as its source states it.
    commercial: whether the licence is known to allow commercial use; otherwise a piece cannot be minted.
    make: makes the scene as it is measured, in general 128 x 128 pixels without antialiasing, which `load` changes. It
    may be slow, and raises InputError if a file has not been fetched.
    credit: the author to name with the picture, or "".
    ready: whether all files that `make` needs have been fetched.
    """

    name: str
    dataset: str
    title: str
    licence: str
    make: Callable[[], Scene]
    commercial: bool = True
    credit: str = ""
    ready: Callable[[], bool] = _always

    @property
    def notice(self) -> str:
        """The credit and the terms to show where the piece is used; "" if there are none."""
        if not self.credit and self.commercial:
            return ""
        author = f" by {self.credit}" if self.credit else ""
        terms = "" if self.commercial else "; not for commercial use"
        return f"{self.name}: {self.title}{author}; licence: {self.licence}{terms}"

    @property
    def file_stem(self) -> str:
        """The name as a file name: "genesis-12" for "genesis/12"."""
        return self.name.replace("/", "-")
