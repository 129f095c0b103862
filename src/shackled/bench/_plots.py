"""Plots that can be read on screens and in print: dark letters on white, colours of different brightness."""

from __future__ import annotations

import io
from collections.abc import Callable
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

from PIL import Image as PillowImage

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

INK = "#1f2328"
OURS, ORIGINAL, THIRD, FOURTH = "#e8743b", "#1c5aa0", "#5fb98a", "#6d3fb0"
#: Dots an inch, as journals ask for.
RESOLUTION = 300
#: Of a plot: few, so that its file is small.
COLORS = 64

STYLE: dict[Any, Any] = {
    "axes.axisbelow": True,
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


def powers_of_two(axes: Axes, values: list[int]) -> None:
    """Label the values on a logarithmic axis of sides or counts."""
    axes.set_xscale("log", base=2)
    axes.set_xticks(values, [str(value) for value in values])
    axes.minorticks_off()


def can_plot() -> bool:
    """Return whether matplotlib is installed."""
    return find_spec("matplotlib") is not None
