"""The results of an experiment, the files that it writes, their tables and plots.

Plots can be read on screens and in print: dark letters on white, colours of different brightness.
"""

from __future__ import annotations

import csv
import io
import textwrap
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

from PIL import Image as PillowImage

from ..base.whole_file import make_output_folder, write_output

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Cell = str | int | float | None

OURS, ORIGINAL, THIRD, FOURTH = "#e8743b", "#1c5aa0", "#5fb98a", "#6d3fb0"
#: Dots an inch, as journals ask for.
RESOLUTION = 300
#: Of a plot: few, so that its file is small.
COLORS = 64

STYLE: dict[Any, Any] = {
    "axes.axisbelow": True,
    "axes.grid": True,
    "axes.spines.right": False,
    "axes.spines.top": False,
    "axes.titlesize": 10,
    "font.size": 9,
    "grid.alpha": 0.25,
    "grid.color": "black",
    "legend.frameon": False,
}


@dataclass(frozen=True)
class ExperimentReport:
    """The results of an experiment.

    head, rows: of the CSV file; None leaves a cell empty. text: Markdown that explains the figures, with a table. draw:
    draws the plot. shape: its width and height in inches. pictures: rendered pictures, by the suffix of the file name.
    """

    title: str
    head: Sequence[str]
    rows: Sequence[Sequence[Cell]]
    text: str
    draw: Callable[[Figure], None]
    shape: tuple[float, float] = (6.4, 3.6)
    pictures: Mapping[str, PillowImage.Image] = field(default_factory=dict)

    def save(self, name: str, folder: Path) -> list[Path]:
        """Write NAME.csv, NAME.md, the pictures, and NAME.png if matplotlib is installed; return their paths."""
        files = {
            f"{name}.csv": self.csv().encode(),
            f"{name}.md": f"# {self.title}\n\n{wrapped(self.text)}\n".encode(),
        }
        if can_plot():
            files[f"{name}.png"] = plot(self.draw, self.shape)
        for end, picture in self.pictures.items():
            stream = io.BytesIO()
            picture.save(stream, "png", optimize=True)
            files[f"{name}-{end}.png"] = stream.getvalue()
        make_output_folder(folder)
        for file, content in files.items():
            write_output(folder / file, content)
        return [folder / file for file in files]

    def csv(self) -> str:
        """Return the rows as CSV."""
        stream = io.StringIO()
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(self.head)
        writer.writerows(self.rows)
        return stream.getvalue()


def wrapped(text: str) -> str:
    """Wrap Markdown: its paragraphs have lines of up to 120 characters; tables stay as they are."""
    blocks = text.strip().split("\n\n")
    return "\n\n".join(block if block.startswith("|") else textwrap.fill(block, 120) for block in blocks)


def table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Write a Markdown table whose columns are aligned: the first to the left, the others to the right."""
    widths = [max(map(len, column)) for column in zip(head, *rows, strict=True)]
    rule = ["-" * widths[0], *("-" * (width - 1) + ":" for width in widths[1:])]

    def line(cells: Sequence[str]) -> str:
        first, *others = zip(cells, widths, strict=True)
        return "| " + " | ".join([first[0].ljust(first[1]), *(cell.rjust(width) for cell, width in others)]) + " |"

    return "\n".join([line(head), line(rule), *map(line, rows)])


def millions(gas: float | None, digits: int = 2) -> str:
    """Write gas such as 4.93M; nothing for None."""
    return "" if gas is None else f"{gas / 1e6:,.{digits}f}M"


def ratio(a: float | None, b: float | None) -> str:
    """Write a / b, in whole numbers where it is large; nothing where either is None."""
    if not a or not b:
        return ""
    return f"{a / b:,.0f}" if a >= 20 * b else f"{a / b:.2f}"


# ---- plots ----


def plot(draw: Callable[[Figure], None], shape: tuple[float, float]) -> bytes:
    """Return the PNG of what `draw` draws; shape: width and height in inches."""
    from matplotlib import rc_context
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    stream = io.BytesIO()
    with rc_context(STYLE):
        figure = Figure(figsize=shape, layout="constrained")
        FigureCanvasAgg(figure)
        draw(figure)
        figure.savefig(stream, format="png", dpi=RESOLUTION)
    small = io.BytesIO()
    with PillowImage.open(stream) as picture:
        few = picture.convert("RGB").quantize(COLORS, PillowImage.Quantize.MEDIANCUT, dither=PillowImage.Dither.NONE)
    few.save(small, "png", optimize=True, dpi=(RESOLUTION, RESOLUTION))
    return small.getvalue()


def can_plot() -> bool:
    """Return whether matplotlib is installed."""
    return find_spec("matplotlib") is not None
