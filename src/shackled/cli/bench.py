"""shackled bench"""

from __future__ import annotations

import sys
from pathlib import Path

from ..base.checks import choice
from ..base.whole_file import check_output_folder
from ..bench._report import can_plot
from ..bench._runner import EXPERIMENTS, Runner
from ..errors import InputError
from .option import argument, option
from .progress import LateBar


def bench(
    names: tuple[str, ...] = argument("Experiments to run; all by default. Without -o they are listed.", "NAME"),
    output: str | None = option("-o --output", "Folder for CSV files, plots and tables.", "DIR"),
    quick: bool = option("--quick", "Use a few small scenes, as a smoke test."),
    processes: int | None = option("--processes", "Number of processes; one per core by default.", "N", min=1),
) -> None:
    """Run the experiments of the Shackled paper: gas against canvas, triangles, culling and more."""
    if not names and output is None:
        print("\n".join(f"{name:10} {text}" for name, text in EXPERIMENTS.items()))
        print("\nshackled bench NAME ... -o DIR runs them, shackled bench -o DIR runs all.")
        return
    chosen = [choice(name, "an experiment", EXPERIMENTS) for name in dict.fromkeys(names or EXPERIMENTS)]
    if output is None:
        raise InputError("the experiments need an output folder: -o DIR")
    folder = check_output_folder(Path(output))
    if not can_plot():
        print("no plots: they need matplotlib (pip install 'shackled[bench]')", file=sys.stderr)
    with LateBar("measuring") as bar:
        runner = Runner(quick, processes, lambda label, done, total: bar.set(done, total, label))
        written = [path for name in chosen for path in runner.run(name).save(name, folder)]
    print("\n".join(str(path) for path in written))
