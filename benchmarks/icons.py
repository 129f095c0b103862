"""Measure `tokenURI` of every icon, plain and antialiased.

    python -m benchmarks.icons

measures everything, rewrites icons.json, the table of docs/datasets.md, and the list of the icons whose tokens are
antialiased: src/shackled/tokens/antialiased.json.
"""

from __future__ import annotations

from functools import partial
from pathlib import Path

from attrs import evolve
from tools.pages import ROOT
from tools.tokens.launched import PRICE, launched, store_scene
from tools.tokens.world import Refused

from shackled.datasets import pieces
from shackled.ethereum._encoding import intrinsic_gas
from shackled.scene._look import resize
from shackled.tokens._icons import SCALE

from . import publish, read_figures, run_main, write_figures

FILE = Path(__file__).with_name("icons.json")
recorded = partial(read_figures, FILE)
PAGE = ROOT / "docs" / "datasets.md"
LIST = ROOT / "src" / "shackled" / "tokens" / "antialiased.json"

#: The gas of a transaction (EIP-7825), which some nodes give a call, too.
LIMIT = 1 << 24
SIDE = 128

#: By the name of an icon: the gas of its plain picture and of the antialiased one, and whether a call of LIMIT suffices
#: for either. That is a little less than LIMIT, since a contract hands on 63 of 64 parts of its gas.
Figures = dict[str, dict[str, int | bool]]


def take() -> Figures:
    """Measure the collection of all icons, each once plain and once antialiased."""
    s = launched()
    collection = s.world.deploy("IconsCollection", s.studio, (s.owner, 10, s.owner, 500), sender=s.owner)
    icons = list(pieces("icons"))
    for piece in icons:
        for antialias in (False, True):
            pointer = store_scene(s.studio, evolve(resize(piece.make(), (SIDE, SIDE)), antialias=antialias))
            collection.send("add", piece.title, pointer, SCALE, PRICE, 100, 1, sender=s.owner)
    collection.send("seal", sender=s.owner)
    for number in range(2 * len(icons)):
        collection.send("mintReserve", number, s.owner, 1, sender=s.owner)

    def fits(token: int) -> bool:
        _, data = collection.encode("tokenURI", (token,))
        gas = LIMIT - intrinsic_gas(data)
        try:
            s.world.run(s.owner, collection.address, data, 0, gas, False, collection.abi)
        except Refused:
            return False
        return True

    figures: Figures = {}
    for number, piece in enumerate(icons):
        plain, smooth = 2 * number, 2 * number + 1
        figures[piece.name.partition("/")[2]] = {
            "plain": collection.gas_of("tokenURI", plain),
            "antialiased": collection.gas_of("tokenURI", smooth),
            "plain fits": fits(plain),
            "antialiased fits": fits(smooth),
        }
    return figures


def fitting(figures: Figures) -> list[str]:
    """Return the pieces whose tokens can be antialiased."""
    return sorted(f"icons/{name}" for name, each in figures.items() if each["antialiased fits"])


def table(figures: Figures) -> str:
    """Return the figures as a table in Markdown, the cheapest first."""
    lines = ["| icon | plain, gas | antialiased, gas | its tokens are |", "|---|---:|---:|---|"]
    for name, each in sorted(figures.items(), key=lambda item: item[1]["antialiased"]):
        used = "antialiased" if each["antialiased fits"] else "plain"
        lines.append(f"| {name} | {each['plain']:,} | {each['antialiased']:,} | {used} |")
    lines.append(f"\n{len(fitting(figures))} of {len(figures)} are antialiased.")
    return "\n".join(lines)


def main() -> int:
    """Measure, print and write the figures."""
    figures = take()
    write_figures(LIST, fitting(figures))
    return publish("icons", figures, table(figures), PAGE)


if __name__ == "__main__":
    run_main(main)
