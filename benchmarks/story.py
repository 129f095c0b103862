"""Update benchmarks/README.md and docs/measurements.md from benchmarks/results, which `shackled bench -o` writes.

python -m benchmarks.story            writes between the marks <!-- begin NAME --> and <!-- end NAME -->
python -m benchmarks.story --check    writes nothing; fails if they are not up to date
"""

from __future__ import annotations

import argparse
import csv
from statistics import fmean

from tools.pages import DOCS, ROOT, update

from shackled.artifacts import RENDERER
from shackled.bench._original import DEPLOYMENT_GAS, original, original_gas
from shackled.bench._report import wrapped
from shackled.bench._runner import EXPERIMENTS
from shackled.bench.scenes import cube
from shackled.ethereum._encoding import intrinsic_gas
from shackled.scene import encode

from . import FOLDER, README, energy, run_main
from .original.recipe import SOURCES, digests

RESULTS = FOLDER / "results"
ESTIMATES = DOCS / "measurements.md"

#: The models in the first row of the cost table.
HEADLINE = tuple(f"obj_{name}_cull" for name in (*SOURCES, "armadillo", "beast", "benchy", "fertility", "max-planck"))

#: Of one piece, by the original's token.
MINT_GAS = 124_000


def content(name: str) -> str | None:
    """Return the text between the marks of that name: of an experiment, without its title.

    None for the measurements of this folder, which write their own.
    """
    if name == "repeated":
        return wrapped(repeated())
    if name not in EXPERIMENTS:
        return None
    path = RESULTS / f"{name}.md"
    if not path.exists():
        raise SystemExit(f"there is no {path.relative_to(ROOT)}: run `shackled bench -o benchmarks/results`")
    return path.read_text("utf-8").partition("\n\n")[2].strip()


def estimates() -> str:
    """Estimate the electricity of what the experiments have measured."""
    deployment = sum(int(row["gas"]) for row in rows("deploy") if row["contract"] in RENDERER)
    cubes = {int(row["side"]): int(row["gas"]) for row in rows("canvas") if row["projection"] == "perspective"}
    before = original_gas("cube_persp_128")
    assert before is not None
    return energy.estimates(
        {
            "deployment of the renderer": deployment,
            "deployment of the original": DEPLOYMENT_GAS,
            "mint of a piece, as in the original": MINT_GAS,
            "picture of a cube, 128 x 128": cubes[128] + intrinsic_gas(encode(bytes(4), cube(128))),
        },
        {
            "picture of a cube, 128 x 128": cubes[128],
            "the same in the original": before,
            "a piece of Genesis, on average": round(fmean(int(row["gas"]) for row in rows("genesis"))),
            "picture of a cube, 512 x 512": cubes[512],
        },
    )


def repeated() -> str:
    """Say which rows of original.csv can be measured again."""
    known, anew = original(), digests()
    others = sorted(known.keys() - anew.keys())
    models = sorted({name.removesuffix("_cull").removesuffix("_nocull") for name in others if name.endswith("cull")})
    headline = [name for name in others if name in HEADLINE]
    return (
        f"{len(anew)} of the {len(known)} scenes can be made again to the last number; a digest of each is in"
        " [scenes.json](original/scenes.json). Among them are all cubes, all triangles, all pieces of Genesis, and"
        f" {len(HEADLINE) - len(headline)} of the {len(HEADLINE)} models in the first row of the README's table."
        f" **Not repeatable from here**: the other {len(others)} scenes, of which no public file, or no way to reduce"
        f" it, is known: {', '.join(name for name in others if not name.endswith('cull'))}, and with or without culling"
        f" {', '.join(models)}. [results.md](results.md) has the means of all models of the table, and of those that"
        " can be made again."
    )


def rows(name: str) -> list[dict[str, str]]:
    """Return the figures of an experiment."""
    with (RESULTS / f"{name}.csv").open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


def main() -> int:
    """Update the pages."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="only say whether a page would change")
    return update(
        {README: content, ESTIMATES: {"energy": estimates()}.get},
        "python -m benchmarks.story",
        parser.parse_args().check,
    )


if __name__ == "__main__":
    run_main(main, has_options=True)
