"""Size and gas of BMP, data URI and SVG."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ._measure import call_renderer
from ._original import DATA_URI_SIZE, SVG_GAS, SVG_URI_SIZE
from ._report import FOURTH, OURS, THIRD, Cell, ExperimentReport, millions, powers_of_two, table
from ._runner import Runner
from .scenes import cube

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SIDES = (8, 16, 32, 64, 128, 256, 512)
QUICK_SIDES = (8, 16)

FORMATS = {"BMP": "render", "data URI": "renderDataURI", "SVG": "renderSVG"}
COLORS = {"BMP": OURS, "data URI": THIRD, "SVG": FOURTH}
#: The canvas for which figures of the original are known.
KNOWN = 128


def run(runner: Runner) -> ExperimentReport:
    """Measure the cube on each canvas in each format."""
    sides = QUICK_SIDES if runner.quick else SIDES
    tasks = [(side, name) for side in sides for name in FORMATS]
    found = dict(zip(tasks, runner.map("output", measure, tasks), strict=True))
    rows: list[list[Cell]] = [
        [side, name, size, gas, gas - found[side, "BMP"][0]] for (side, name), (gas, size) in found.items()
    ]

    def draw(figure: Figure) -> None:
        left, right = figure.subplots(1, 2)
        for name, color in COLORS.items():
            left.plot(sides, [found[side, name][1] for side in sides], "o-", color=color, ms=4, lw=1.2, label=name)
            if name != "BMP":
                more = [(found[side, name][0] - found[side, "BMP"][0]) / side**2 for side in sides]
                right.plot(sides, more, "o-", color=color, ms=4, lw=1.2, label=name)
        for axes in (left, right):
            powers_of_two(axes, list(sides))
            axes.set(xlabel="side of the canvas, pixels")
            axes.legend()
        left.set(yscale="log", ylabel="bytes")
        right.set(ylabel="gas beyond that of the BMP, per pixel", ylim=(0, None))

    lines = []
    for side in sides:
        for name in FORMATS:
            gas, size = found[side, name]
            more = gas - found[side, "BMP"][0]
            lines.append([f"{side} x {side}, {name}", f"{size:,}", millions(gas), millions(more, 3) if more else ""])
    side = sides[-1] if KNOWN not in sides else KNOWN
    uri, svg = found[side, "data URI"], found[side, "SVG"]
    bmp = found[side, "BMP"][0]
    text = (
        "A cube. The pixels are 3 bytes each, and base64 makes 4 characters of them. At"
        f" {side} x {side} the data URI costs {millions(uri[0] - bmp, 3)} beyond the BMP and has {uri[1]:,} characters,"
        f" the SVG {millions(svg[0] - bmp, 3)} and {svg[1]:,}. In the original, at {KNOWN} x {KNOWN}, the data URI has"
        f" {DATA_URI_SIZE:,}, and the SVG, whose base64 holds base64 again, {SVG_URI_SIZE:,}; the frame alone costs"
        f" {millions(SVG_GAS[0], 1)} to {millions(SVG_GAS[1], 1)}.\n\n"
    )
    return ExperimentReport(
        "Output",
        ["side", "format", "bytes", "gas", "gas_beyond_bmp"],
        rows,
        text + table(["picture", "bytes", "gas", "beyond the BMP"], lines),
        draw,
        (7.2, 3.2),
    )


def measure(task: tuple[int, str]) -> tuple[int, int]:
    """Return gas and size of a picture."""
    side, name = task
    result = call_renderer(cube(side), FORMATS[name])
    return result.gas, int.from_bytes(result.output[32:64], "big")
