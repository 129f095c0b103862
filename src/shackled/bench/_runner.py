"""Run experiments by name, in several processes.

An experiment is a function of a module of this package.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from importlib import import_module
from typing import TypeVar

from ..base.workers import each
from ._report import ExperimentReport

Item = TypeVar("Item")
Result = TypeVar("Result")
#: Shows the progress of several calls.
Show = Callable[[str, int, int], None]

#: In the order of the paper.
EXPERIMENTS = {
    "canvas": "a cube on canvases of 8 x 8 to 512 x 512 pixels, both projections",
    "triangles": "1 to 16 equal triangles",
    "genesis": "the 1024 pieces of Genesis: gas against triangles",
    "culling": "the common objects, with and without backface culling",
    "deploy": "gas and bytes of every contract",
    "linear": "how well straight lines fit gas against triangles and pixels",
}


class Runner:
    """What experiments run in."""

    def __init__(self, quick: bool = False, processes: int | None = None, show: Show | None = None) -> None:
        """Start nothing yet.

        quick: whether to use a few small scenes, as a check that everything works. processes: how many; None is one
        for each core, since embedded EVMs hold the interpreter's lock. show: called with a label, and how many calls
        of it are done, of how many.
        """
        self.quick = quick
        self.processes = processes or os.cpu_count() or 1
        self._show = show

    def run(self, name: str) -> ExperimentReport:
        module = "linear" if name == "triangles" else name
        report: ExperimentReport = getattr(import_module(f"._{module}", __package__), name)(self)
        return report

    def map(self, label: str, function: Callable[[Item], Result], items: Iterable[Item]) -> list[Result]:
        """Return the results of a function for each item, in their order.

        Function and items are pickled and sent to worker processes, unless there is only one process.
        """
        items = list(items)
        results: dict[int, Result] = {}
        for place, result in each(function, items, self.processes):
            results[place] = result
            if self._show is not None:
                self._show(label, len(results), len(items))
        return [results[place] for place in range(len(items))]
