"""How the Creator's workers do with many visitors at once: pictures a second, and how late they are.

    python -m benchmarks.creator_pool [--visitors 20] [--seconds 10] [--piece NAME] [--longest 128] [--workers N]

Each visitor turns the object all the time and asks for the next picture as soon as the last one is there, as the page
does while somebody drags. The delay is the time from the question to the picture. `benchmarks.creator` measures the
same through the page.
"""

from __future__ import annotations

import argparse
import asyncio
import os
import time
from dataclasses import dataclass, field, replace

import numpy as np

from shackled.creator.orbit import drag, front
from shackled.creator.pool import Pool
from shackled.creator.scene import Facts
from shackled.creator.state import Source, State


@dataclass
class Seen:
    """What a visitor saw: the gas of each picture, and how many seconds after the question it was there."""

    gas: list[int] = field(default_factory=list)
    delays: list[float] = field(default_factory=list)


async def orbit(pool: Pool, visitor: str, facts: Facts, longest: int, until: float, seen: Seen) -> None:
    """One visitor."""
    camera = front(facts)
    while time.perf_counter() < until:
        camera = drag(camera, 0.01, 0.002 if len(seen.delays) % 60 < 30 else -0.002)
        asked = time.perf_counter()
        frame = await pool.render(visitor, replace(State(facts.source), camera=camera), longest, count=False)
        assert frame is not None
        assert frame.gas is not None
        seen.delays.append(time.perf_counter() - asked)
        seen.gas.append(frame.gas)


async def measure(
    visitors: int, seconds: float, piece: str, longest: int, workers: int | None = None
) -> tuple[list[Seen], float]:
    """What all visitors saw, and the seconds that it took."""
    seen = [Seen() for _ in range(visitors)]
    async with Pool(workers) as pool:
        facts = await pool.open(Source("piece", piece))
        begun = time.perf_counter()
        until = begun + seconds
        await asyncio.gather(
            *(orbit(pool, f"visitor {number}", facts, longest, until, each) for number, each in enumerate(seen))
        )
        return seen, time.perf_counter() - begun


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description="The workers of the Creator with many visitors at once.")
    parser.add_argument("--visitors", type=int, default=20)
    parser.add_argument("--seconds", type=float, default=10)
    parser.add_argument("--piece", default="teapot")
    parser.add_argument("--longest", type=int, default=128)
    parser.add_argument("--workers", type=int)
    options = parser.parse_args()
    seen, seconds = asyncio.run(
        measure(options.visitors, options.seconds, options.piece, options.longest, options.workers)
    )
    rates = np.array([len(each.delays) for each in seen]) / seconds
    delays = 1000 * np.concatenate([each.delays for each in seen])
    gas = np.concatenate([each.gas for each in seen])
    print(f"{options.piece} at {options.longest} pixels, {gas.mean() / 1e6:.1f} million gas a picture")
    print(f"visitors {options.visitors}, cores {os.cpu_count()}, {seconds:.1f} seconds")
    print(
        f"pictures a second: {rates.sum():.0f} in all, {np.median(rates):.1f} a visitor"
        f" ({rates.min():.1f} to {rates.max():.1f})"
    )
    print(
        f"delay, milliseconds: median {np.median(delays):.0f}, 95th percentile {np.percentile(delays, 95):.0f},"
        f" worst {delays.max():.0f}"
    )


if __name__ == "__main__":
    main()
