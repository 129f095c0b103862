"""What a dataset holds: scenes with a name and a licence."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ..scene.scene import Scene


@dataclass(frozen=True)
class Piece:
    """One scene of a dataset.

    name: as it is typed, for instance "teapot", "icons/diamond" or "genesis/12".
    dataset: "common", "icons" or "genesis".
    title: for people. licence: of the model, as its source states it.
    commercial: whether the licence allows commercial use; what mints refuses a piece where it does not.
    make: makes the scene; raises InputError where a file is needed that has to be fetched first.
    """

    name: str
    dataset: str
    title: str
    licence: str
    make: Callable[[], Scene]
    commercial: bool = True
