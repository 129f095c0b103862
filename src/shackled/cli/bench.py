"""shackled bench"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

import typer

from ..errors import InputError
from ..whole_file import check_output_folder


def bench(
    names: Annotated[
        list[str] | None,
        typer.Argument(help="Experiments to run; all by default. Without -o they are listed.", metavar="[NAME]..."),
    ] = None,
    output: Annotated[
        str | None, typer.Option("--output", "-o", help="Folder for CSV files, plots and tables.", metavar="DIR")
    ] = None,
    everything: Annotated[bool, typer.Option("--all", help="Run all experiments.")] = False,
    quick: Annotated[bool, typer.Option("--quick", help="Use a few small scenes, as a smoke test.")] = False,
    processes: Annotated[
        int | None,
        typer.Option("--processes", min=1, help="Number of processes; one per core by default.", metavar="N"),
    ] = None,
    rpc: Annotated[str | None, typer.Option("--rpc", help="Node that `engines` measures, too.", metavar="URL")] = None,
) -> None:
    """Run the experiments of the Shackled paper: gas against canvas, triangles, culling and more."""
    from ..bench import EXPERIMENTS, Runner, can_plot, check_names

    if not names and not everything and output is None:
        print("\n".join(f"{name:10} {text}" for name, text in EXPERIMENTS.items()))
        print("\nshackled bench NAME ... -o DIR runs them, shackled bench -o DIR runs all.")
        return
    chosen = list(EXPERIMENTS) if everything or not names else list(dict.fromkeys(names))
    check_names(chosen)
    if output is None:
        raise InputError("the experiments need an output folder: -o DIR")
    folder = check_output_folder(Path(output))
    if not can_plot():
        print("no plots: they need matplotlib (pip install 'shackled[bench]')", file=sys.stderr)
    with Runner(quick, processes, rpc) as runner:
        written = [path for name in chosen for path in runner.run(name).save(name, folder)]
    print("\n".join(str(path) for path in written))
