"""Measure what people render: default looks, anti-aliasing, several lights, large canvases, and kinds of opcodes.

    python -m benchmarks.looks

measures everything, which takes about two minutes, rewrites looks.json and the tables of docs/gas.md and
docs/parallel.md, and prints the first. Figures of meshes and scenes that are not there are kept.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import partial
from math import isnan, nan
from pathlib import Path
from statistics import fmean

from attrs import evolve
from tools.pages import ROOT, update

from shackled import Scene, load, render
from shackled.bench._measure import gas
from shackled.gas import profile
from shackled.gas._profile import KINDS
from shackled.scene._fields import Shading

from . import antialiasing, cost, read_figures, run_main, shared, write_figures
from .scenes import MORE_LIGHTS, staged_teapot

FILE = Path(__file__).with_name("looks.json")
recorded = partial(read_figures, FILE)
PAGES = (ROOT / "docs" / "gas.md", ROOT / "docs" / "parallel.md")

#: Of the meshes: those of the default look.
MODELS = ("spot", "utah-teapot", "stanford-bunny")
SIDES = (256, 128)
#: Sides of canvases that are drawn in strips.
LARGE_SIDES = (1024, 1536, 2048)
#: Groups of `antialiasing`: those of which only the ratio is of interest, and smooth objects.
RATIOS = {
    "objects": "15 objects of the cost table, flat",
    "icons": "28 icons",
    "Genesis": "Genesis 0 to 23",
}
SMOOTH = "the same, smooth"

#: Pictures of the teapot whose opcodes are counted: side, shading, anti-aliasing.
TEAPOTS: dict[str, tuple[int, Shading, bool]] = {
    "flat, 128 x 128": (128, "flat", False),
    "smooth, 128 x 128": (128, "smooth", False),
    "smooth, antialiased, 256 x 256": (256, "smooth", True),
}
#: The end of the name of a ratio.
RATIO = ", x"

#: By name: gas, or a ratio of gas.
Figures = dict[str, float]


@dataclass(frozen=True)
class Row:
    """A row of the table.

    names: its figures. before: they at commit d8a84c1, in millions of gas, or ratios; nan for what was not measured.
    """

    title: str
    names: tuple[str, ...]
    before: tuple[float, ...]


ROWS = (
    *(
        Row(f"default look, {side} px: {', '.join(MODELS)}", tuple(f"{name}, {side}" for name in MODELS), before)
        for side, before in zip(SIDES, ((49.2, 73.2, 52.1), (20.7, 33.5, 21.8)), strict=True)
    ),
    Row(
        "15 objects of the cost table, smooth, antialiased, 128 px; times plain", ("smooth", "smooth, x"), (16.0, 2.19)
    ),
    Row(
        "flat, antialiased, times plain: objects, icons, Genesis",
        tuple(f"{name}, x" for name in RATIOS),
        (2.07, 2.31, 2.15),
    ),
    Row("teapot as a wireframe, antialiased, 128 px", ("wires",), (90.1,)),
    Row(
        "spot with two, three and four directional lights, 256 px, times one",
        ("2 lights, x", "3 lights, x", "4 lights, x"),
        (2.57, nan, nan),
    ),
    Row("plain: 15 objects smooth, lit", ("smooth objects", "lit objects"), (7.31, 4.15)),
    Row(
        "cube, cube 512, most expensive transaction, most expensive Genesis `render`",
        ("cube", "cube 512", "dearest transaction", "dearest piece"),
        (2.19, 27.4, 12.8, 8.2),
    ),
    Row("Genesis `tokenURI`: mean, most expensive of 1,024", ("tokenURI, mean", "tokenURI, dearest"), (4.4, 12.0)),
    Row("spot, flat, plain, 2048 x 2048, one `shackled.render`", ("strips, 2048",), (1061,)),
)


def take() -> Figures:
    """Measure all figures for which there are meshes and scenes."""
    figures = mesh_figures({path.stem: path for path in shared.meshes() if path.stem in MODELS})
    figures |= opcode_figures() | ratios(antialiasing.groups())
    figures["wires"] = gas(staged_teapot("unlit", 128, wireframe=True, antialias=True))
    if shared.is_there():
        figures |= table_figures()
    (dearest, _), (mean, worst) = cost.piece_rows(), cost.genesis_rows()
    return figures | {"dearest piece": dearest.gas, "tokenURI, mean": mean.gas, "tokenURI, dearest": worst.gas}


def mesh_figures(paths: dict[str, Path]) -> Figures:
    """Measure the default look of meshes, a second light, and large canvases."""
    figures: Figures = {f"{name}, {side}": gas(load(path, size=side)) for side in SIDES for name, path in paths.items()}
    if "spot" in paths:
        one = load(paths["spot"])
        for count in range(1, len(MORE_LIGHTS) + 1):
            lights = [*one.lights, *MORE_LIGHTS[:count]]
            figures[f"{len(lights)} lights, x"] = gas(evolve(one, lights=lights)) / gas(one)
        for side in LARGE_SIDES:
            large = load(paths["spot"], size=side, shading="flat", antialias=False)
            image = render(large)
            assert image.gas is not None
            figures |= {f"strips, {side}": image.gas, f"calls, {side}": image.calls, f"whole, {side}": gas(large)}
    return figures


def opcode_figures() -> Figures:
    """Measure the gas of each kind of opcode in pictures of the teapot."""
    figures: Figures = {}
    for title, (side, shading, antialias) in TEAPOTS.items():
        found = profile(load("teapot", size=side, shading=shading, antialias=antialias)).opcodes()
        figures |= {f"{title}, {kind}": gas_of_kind for kind, gas_of_kind in found.items()}
    return figures


def ratios(groups: dict[str, list[Scene]]) -> Figures:
    """Measure what anti-aliasing costs in groups of scenes."""
    figures: Figures = {}
    for name, group in (RATIOS | {"smooth": SMOOTH}).items():
        if group in groups:
            plain, smoothed = (antialiasing.gas_of(groups[group], flag) for flag in (False, True))
            figures[f"{name}, x"] = sum(smoothed) / sum(plain)
            if group == SMOOTH:
                figures["smooth"] = fmean(smoothed)
    return figures


def table_figures() -> Figures:
    """Measure rows of the cost table."""
    scenes, objects = shared.table_scenes(), shared.objects()
    return {
        "smooth objects": fmean(gas(scenes[name + shared.SMOOTH_SUFFIX]) for name in objects),
        "lit objects": fmean(gas(scenes[name]) for name in objects),
        "cube": gas(scenes[shared.CUBE]),
        "cube 512": gas(scenes[shared.LARGE_CUBE]),
        "dearest transaction": cost.largest_row().gas,
    }


def table(figures: Figures) -> str:
    """Return the figures beside those of commit d8a84c1 as a table in Markdown."""
    lines = ["| execution gas | d8a84c1 | now |", "|---|---:|---:|"]
    for row in ROWS:
        now = (figures[name] / (1 if name.endswith(RATIO) else 1e6) for name in row.names)
        lines.append(f"| {row.title} | {_cell(row.names, row.before)} | {_cell(row.names, now)} |")
    return "\n".join(lines)


def _cell(names: Iterable[str], values: Iterable[float]) -> str:
    texts = []
    for name, value in zip(names, values, strict=True):
        if isnan(value):
            texts.append("-")
            continue
        places = 2 if value < 10 else 1 if value < 1000 else 0
        texts.append(f"{value:,.{places}f}{' x' if name.endswith(RATIO) else 'M'}")
    return ", ".join(texts)


def opcodes(figures: Figures) -> str:
    """Return the shares of kinds of opcodes as a table in Markdown."""
    lines = [f"| `shackled gas teapot --opcodes` | {' | '.join(TEAPOTS)} |", "|---|" + len(TEAPOTS) * "---:|"]
    sums = {title: sum(figures[f"{title}, {kind}"] for kind in KINDS) for title in TEAPOTS}
    for kind in KINDS:
        shares = (f"{100 * figures[f'{title}, {kind}'] / whole:.1f} %" for title, whole in sums.items())
        lines.append(f"| {kind} | {' | '.join(shares)} |")
    return "\n".join(lines)


def strips(figures: Figures) -> str:
    """Return what large canvases cost in one call and in strips as a table in Markdown."""
    lines = ["| `spot`, flat, plain | one call | strips | gas of all |", "|---|---:|---:|---:|"]
    for side in LARGE_SIDES:
        whole, calls, gas_of_all = (figures[f"{what}, {side}"] for what in ("whole", "calls", "strips"))
        saved = 1 - gas_of_all / whole
        lines.append(
            f"| {side} x {side} | {whole / 1e6:,.0f}M | {calls:.0f} | {gas_of_all / 1e6:,.0f}M, -{saved * 100:.0f} % |"
        )
    return "\n".join(lines)


def main() -> int:
    """Measure, print and write the figures."""
    new = {name: round(value, 4) for name, value in {**recorded(), **take()}.items()}
    print(table(new))
    if not shared.is_there() or not shared.meshes():
        print(f"{shared.SKIPPED}; their figures are kept")
    write_figures(FILE, new, sort_keys=True)
    made = {"looks": table, "opcodes": opcodes, "strips": strips}
    return update(
        {page: lambda name: made[name](new) if name in made else None for page in PAGES}, "python -m benchmarks.looks"
    )


if __name__ == "__main__":
    run_main(main)
