"""Gas against triangles and against pixels, as pictures for the documentation."""

from __future__ import annotations

from pathlib import Path

from shackled.bench.fits import fit
from shackled.bench.linear import LOOKS

from .linearity import series
from .shared import ROOT

FOLDER = ROOT / "docs" / "images"

PLOTS = {
    "gas-triangles.png": ("squares", "triangles", "triangles of a square of fixed size"),
    "gas-pixels.png": ("cubes", "pixels", "pixels of the canvas of a cube"),
}


def draw() -> list[Path]:
    """Writes the plots; the measured points, and dotted the line that fits them best."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    FOLDER.mkdir(parents=True, exist_ok=True)
    for name, (kind, quantity, label) in PLOTS.items():
        figure, axes = pyplot.subplots(figsize=(5, 3.2), layout="constrained")
        for number, look in enumerate(LOOKS):
            figures = series(kind, look)
            x, y = getattr(figures, quantity), figures.gas / 1e6
            axes.plot(x, y, "o", color=f"C{number}", markersize=3.5, label=look)
            constant, slope = fit([x], y).coefficients
            axes.plot(x, constant + slope * x, ":", color=f"C{number}", linewidth=1)
        axes.set(xlabel=label, ylabel="gas, millions", xlim=(0, None), ylim=(0, None))
        axes.spines[["top", "right"]].set_visible(False)
        axes.legend(frameon=False)
        # without the version of matplotlib, so that the same plot is the same file
        figure.savefig(FOLDER / name, dpi=110, metadata={"Software": None})
        pyplot.close(figure)
    return [FOLDER / name for name in PLOTS]
