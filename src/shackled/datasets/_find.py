"""Pieces by name. Each dataset is a package with `pieces()` and `find(name)`, imported on first use."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import get_close_matches
from importlib import import_module
from typing import Any

from ..errors import InputError
from ._piece import Piece

#: The datasets, and the prefixes of the names of their pieces.
DATASETS = {"common": "", "icons": "icons/", "genesis": "genesis/"}
#: The same of what is found by name only: scenes that show the renderer's options.
PREFIXES = {**DATASETS, "showcase": "showcase/"}
#: How alike a name must be, from 0 to 1, to be what was meant.
CLOSE = 0.7


def pieces(dataset: str | None = None) -> Iterator[Piece]:
    """Yield the pieces of one dataset, or of all in `DATASETS`."""
    for each in DATASETS if dataset is None else (dataset,):
        yield from _module(each).pieces()


def find(name: str) -> Piece | None:
    """Return the piece of that name; None if there is none. `genesis/` takes 64 hexadecimal digits of any seed, too."""
    dataset, prefix = _dataset_of(name)
    piece: Piece | None = _module(dataset).find(name.removeprefix(prefix))
    return piece


def require(name: str) -> Piece:
    """Return the piece of that name; InputError, with similar names, if there is none."""
    piece = find(name)
    if piece is not None:
        return piece
    if name.startswith("genesis/"):
        known = "0 to 1023, or the 64 hexadecimal digits of a seed"
        raise InputError(f"there is no piece {name!r}; after genesis/ comes a number from {known}")
    # without prefixes, which are alike; a name without one may be of any dataset
    chosen = ["icons"] if name.startswith("icons/") else ["common", "icons"]
    names = {each.name.rpartition("/")[2]: each.name for dataset in chosen for each in pieces(dataset)}
    close = [names[each] for each in get_close_matches(name.lower().rpartition("/")[2], names, n=3, cutoff=CLOSE)]
    hint = f"did you mean {' or '.join(close)}? " if close else ""
    raise InputError(f"there is no piece {name!r}; {hint}`shackled datasets list` shows all")


def _dataset_of(name: str) -> tuple[str, str]:
    for dataset, prefix in PREFIXES.items():
        if prefix and name.startswith(prefix):
            return dataset, prefix
    return "common", ""


def _module(dataset: str) -> Any:
    return import_module(f".{dataset}", __package__)
