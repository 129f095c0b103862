"""What a dataset holds: scenes with a name and a licence."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ..scene import Scene


def _always() -> bool:
    return True


@dataclass(frozen=True)
class Piece:
    """One scene of a dataset.

    name: as it is typed, for instance "teapot", "icons/diamond" or "genesis/12".
    dataset: "common", "icons" or "genesis".
    title: for people. licence: of the model, as its source states it.
    commercial: whether the licence is known to allow commercial use; what mints refuses a piece where it is not.
    make: makes the scene. It may take a while, and raises InputError where a file is needed that has to be fetched
        first.
    credit: whom to name with the picture, if anybody.
    ready: whether `make` has all it needs, so that nothing has to be fetched first.
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
        """What to say where the piece is used, if anybody is to be named or anything is not allowed; otherwise ""."""
        if not self.credit and self.commercial:
            return ""
        author = f" by {self.credit}" if self.credit else ""
        terms = "" if self.commercial else "; not for commercial use"
        return f"{self.name}: {self.title}{author}; licence: {self.licence}{terms}"

    @property
    def file_stem(self) -> str:
        """The name for files: "genesis/12" is "genesis-12"."""
        return self.name.replace("/", "-")
