"""Measure `tokenURI` of Genesis over random seeds, beyond those of the collection.

    python -m benchmarks.seeds            10,000 seeds; rewrites the table of docs/datasets.md, and prints it
    python -m benchmarks.seeds --count N  prints the table of N seeds

Seed number N is keccak256("random-N").
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from statistics import fmean, median

from eth_utils.crypto import keccak
from tools.pages import ROOT, update
from tools.tokens.launched import launched

from . import run_main

PAGE = ROOT / "docs" / "datasets.md"
COUNT = 10_000
#: Seeds that take more gas than this are counted.
LIMIT = 10_000_000


def uris(count: int) -> list[int]:
    """Return the execution gas of `GenesisMetadata.tokenURI` for random seeds."""
    s = launched()
    seeds = (keccak(text=f"random-{number}") for number in range(count))
    return [s.metadata.gas_of("tokenURI", number, seed, sender=s.bob) for number, seed in enumerate(seeds)]


def table(gas: list[int]) -> str:
    """Return the statistics of the gas as a table in Markdown."""
    above = sum(each > LIMIT for each in gas)
    rows = {
        "mean": f"{fmean(gas) / 1e6:.2f}M",
        "median": f"{median(gas) / 1e6:.2f}M",
        "most expensive": f"{max(gas) / 1e6:.2f}M",
        f"above {LIMIT / 1e6:.0f}M": f"{above:,}, {above / len(gas):.2%}",
    }
    lines = [f"| gas of `tokenURI` | {len(gas):,} random seeds |", "|---|---:|"]
    return "\n".join([*lines, *(f"| {name} | {value} |" for name, value in rows.items())])


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure and print; write the table if all seeds were measured."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--count", type=int, default=COUNT, help=f"how many seeds (default: {COUNT:,})")
    count: int = parser.parse_args(arguments).count
    if count < 1:
        parser.error(f"--count must be 1 or more, not {count}")
    found = table(uris(count))
    print(found)
    return update({PAGE: {"seeds": found}.get}, "python -m benchmarks.seeds") if count == COUNT else 0


if __name__ == "__main__":
    run_main(main, has_options=True)
