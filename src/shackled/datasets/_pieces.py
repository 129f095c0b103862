"""Pieces, and how they are found by name. Each dataset is a module with `pieces()`, imported on first use."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from difflib import get_close_matches
from importlib import import_module
from typing import Any

from ..errors import InputError
from ..scene._scene import Scene

#: The datasets, with their modules; the names of pieces begin with them and a slash, except those of the common ones.
DATASETS = {"common": ".common._models", "icons": ".icons._icons", "genesis": ".genesis"}
#: How alike a name must be, from 0 to 1, to be what was meant.
CLOSE = 0.7


@dataclass(frozen=True)
class Piece:
    """A scene of a dataset, with a name and a licence.

    name: for instance "teapot", "icons/diamond" or "genesis/12".
    dataset: "common", "icons" or "genesis".
    title: for display. licence: of the model, as its source states it.
    commercial: whether the licence is known to allow commercial use; otherwise a piece cannot be stored on a chain.
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
    ready: Callable[[], bool] = lambda: True

    @property
    def terms(self) -> str:
        """The licence, with a note if it does not allow commercial use."""
        return self.licence if self.commercial else f"{self.licence} (not for commercial use)"

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


def pieces(dataset: str | None = None) -> Iterator[Piece]:
    """Yield the pieces of one dataset, or of all in `DATASETS`."""
    for each in DATASETS if dataset is None else (dataset,):
        yield from _module(each).pieces()


def find(name: str) -> Piece | None:
    """Return the piece of that name; None if there is none. `genesis/` takes 64 hexadecimal digits of any seed, too."""
    dataset, _, rest = name.partition("/")
    if dataset == "genesis" and rest:
        found: Piece | None = _module("genesis").find(rest)
        return found
    return next((piece for piece in pieces("icons" if dataset == "icons" else "common") if piece.name == name), None)


def require(name: str) -> Piece:
    """Return the piece of that name; InputError, with similar names, if there is none."""
    piece = find(name)
    if piece is not None:
        return piece
    if name.startswith("genesis/"):
        known = "0 to 1023, or the 64 hexadecimal digits of a seed"
        raise InputError(f"there is no piece {name!r}; after genesis/ comes a number from {known}")
    if name.startswith("showcase/"):
        raise InputError(f"there is no piece {name!r}: it is a scene of examples/showcase.py")
    # without prefixes, which are alike; a name without one may be of any dataset
    chosen = ["icons"] if name.startswith("icons/") else ["common", "icons"]
    names = {each.name.rpartition("/")[2]: each.name for dataset in chosen for each in pieces(dataset)}
    close = [names[each] for each in get_close_matches(name.lower().rpartition("/")[2], names, n=3, cutoff=CLOSE)]
    hint = f"did you mean {' or '.join(close)}? " if close else ""
    raise InputError(f"there is no piece {name!r}; {hint}`shackled datasets list` shows all")


def _module(dataset: str) -> Any:
    return import_module(DATASETS[dataset], __package__)
