"""Measure what anti-aliasing costs, group by group.

    python -m benchmarks.antialiasing

measures pictures with and without it, rewrites the table of docs/measurements.md, and prints it.
"""

from __future__ import annotations

from collections.abc import Iterable
from statistics import fmean

from attrs import evolve
from tools.pages import ROOT, update

from shackled import Scene
from shackled.bench._measure import gas
from shackled.datasets import pieces
from shackled.datasets._pieces import require

from . import run_main, shared

PAGE = ROOT / "docs" / "measurements.md"

#: Limit of a transaction (EIP-7825).
TRANSACTION = 1 << 24


def groups() -> dict[str, list[Scene]]:
    """Return the scenes of each group, 128 x 128 pixels each; those of the cost table if they are there."""
    found = {
        "28 icons": [piece.make() for piece in pieces("icons")],
        "Genesis 0 to 23": [require(f"genesis/{number}").make() for number in range(24)],
    }
    if shared.is_there():
        scenes, names = shared.table_scenes(), shared.objects()
        found["15 objects of the cost table, flat"] = [scenes[name] for name in names]
        found["the same, smooth"] = [scenes[name + shared.SMOOTH_SUFFIX] for name in names]
        found["the same, unlit"] = [scenes[name + shared.UNLIT_SUFFIX] for name in names]
    return found


def table(scenes: dict[str, list[Scene]]) -> str:
    """Return the gas of each group as a table in Markdown."""
    lines = [
        "| pictures | plain, mean gas | antialiased | ratio of means | least | most | below 2^24 | twice the size |",
        "|---|" + 7 * "---:|",
    ]
    for name, each in scenes.items():
        plain, smoothed = (gas_of(each, flag) for flag in (False, True))
        doubled = gas_of([evolve(scene, width=2 * scene.width, height=2 * scene.height) for scene in each], False)
        ratios = [after / before for before, after in zip(plain, smoothed, strict=True)]
        lines.append(
            f"| {name} | {fmean(plain) / 1e6:.2f}M | {fmean(smoothed) / 1e6:.2f}M | {sum(smoothed) / sum(plain):.2f} | "
            f"{min(ratios):.2f} | {max(ratios):.2f} | {sum(cost < TRANSACTION for cost in smoothed)} of {len(each)} | "
            f"{sum(doubled) / sum(plain):.2f} |"
        )
    return "\n".join(lines)


def gas_of(scenes: Iterable[Scene], antialias: bool) -> list[int]:
    """Return the gas of each picture."""
    return [gas(evolve(scene, antialias=antialias)) for scene in scenes]


def main() -> int:
    """Measure, print and write the table."""
    scenes = groups()
    found = table(scenes)
    print(found)
    if not shared.is_there():
        print(shared.SKIPPED)
        return 0
    return update({PAGE: lambda name: found if name == "cost" else None}, "python -m benchmarks.antialiasing")


if __name__ == "__main__":
    run_main(main)
