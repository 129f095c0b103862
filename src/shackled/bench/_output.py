"""What a picture takes as BMP, data URI and SVG."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ._lab import Lab
from ._measure import call_renderer
from ._original import DATA_URI_SIZE, SVG_GAS, SVG_URI_SIZE
from ._plots import FOURTH, OURS, THIRD, powers_of_two
from ._report import Cell, Report, millions, table
from .scenes import cube

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SIDES = (8, 16, 32, 64, 128, 256, 512)
QUICK_SIDES = (8, 16)

FORMATS = {"BMP": "render", "data URI": "renderDataURI", "SVG": "renderSVG"}
COLORS = {"BMP": OURS, "data URI": THIRD, "SVG": FOURTH}
#: The canvas of which the original's figures are known.
KNOWN = 128


def run(lab: Lab) -> Report:
    """The cube on each canvas in each format."""
    sides = QUICK_SIDES if lab.quick else SIDES
    tasks = [(side, name) for side in sides for name in FORMATS]
    found = dict(zip(tasks, lab.map("output", measure, tasks), strict=True))
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
    return Report(
        "Output",
        ["side", "format", "bytes", "gas", "gas_beyond_bmp"],
        rows,
        text + table(["picture", "bytes", "gas", "beyond the BMP"], lines),
        draw,
        (7.2, 3.2),
    )


def measure(task: tuple[int, str]) -> tuple[int, int]:
    """Gas and size."""
    side, name = task
    result = call_renderer(cube(side), FORMATS[name])
    return result.gas, int.from_bytes(result.output[32:64], "big")
