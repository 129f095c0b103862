"""Plots that read well on light and on dark pages: no background, lines and letters of middle brightness."""

from __future__ import annotations

import io
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

INK = "#848d97"
OURS, ORIGINAL, THIRD, FOURTH = "#e8743b", "#4a90d9", "#3fa672", "#a374d5"

STYLE: dict[Any, Any] = {
    "axes.edgecolor": INK,
    "axes.grid": True,
    "axes.labelcolor": INK,
    "axes.spines.right": False,
    "axes.spines.top": False,
    "axes.titlecolor": INK,
    "axes.titlesize": 10,
    "font.size": 9,
    "grid.alpha": 0.25,
    "grid.color": INK,
    "legend.frameon": False,
    "legend.labelcolor": INK,
    "text.color": INK,
    "xtick.color": INK,
    "ytick.color": INK,
}


def plot(draw: Callable[[Figure], None], shape: tuple[float, float]) -> bytes:
    """A PNG without background of what `draw` draws in a figure of width and height in inches."""
    from matplotlib import rc_context
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    stream = io.BytesIO()
    with rc_context(STYLE):
        figure = Figure(figsize=shape, layout="constrained")
        FigureCanvasAgg(figure)
        draw(figure)
        # without the version of matplotlib, so that the same plot is the same file
        figure.savefig(stream, format="png", dpi=150, transparent=True, metadata={"Software": None})
    return stream.getvalue()


def powers_of_two(axes: Axes, values: list[int]) -> None:
    """Names the values on a logarithmic axis of sides or counts."""
    axes.set_xscale("log", base=2)
    axes.set_xticks(values, [str(value) for value in values])
    axes.minorticks_off()
