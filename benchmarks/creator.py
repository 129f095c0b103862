"""Measure the Creator's page with many visitors at once: pictures a second, and their delay.

    python -m benchmarks.creator [--visitors 20] [--seconds 10] [--piece NAME] [--write]
    python -m benchmarks.creator --pool [--longest 128] [--workers N]

Each visitor opens the page and its WebSocket as a browser does, and turns the object all the time: 30 movements a
second. The delay of a movement is the time from when it is sent until the first picture that shows it has arrived.
Server, workers and visitors share this machine. With --pool there is no page: each visitor asks the workers for the
next picture as soon as the last one is there.
"""

from __future__ import annotations

import argparse
import asyncio
import json
import os
import re
import subprocess
import sys
import time
import urllib.request
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from datetime import date
from pathlib import Path

import numpy as np
from tools.pages import update
from websockets.asyncio.client import connect

from shackled.creator import Pool, Source, State, drag, front

PAGE = Path(__file__).parent.parent / "docs" / "creator.md"

#: Seconds between two movements.
PACE = 1 / 30
#: Movements of the first seconds do not count: the sizes of the moving pictures have to settle.
WARM_UP = 2.0


@dataclass
class Orbiting:
    """The pictures of a visitor. delays: of movements, in seconds. sides: of the moving pictures, in pixels."""

    pictures: int = 0
    delays: list[float] = field(default_factory=list)
    sides: list[int] = field(default_factory=list)


async def orbit(address: str, seconds: float, seen: Orbiting) -> None:
    """Simulate one visitor."""
    await asyncio.to_thread(lambda: urllib.request.urlopen(address).read())
    async with connect(f"{address.replace('http', 'ws', 1)}live", max_size=2**24, compression=None) as socket:
        begun = time.perf_counter()
        sent: list[float] = []

        async def look() -> None:
            shown = 0
            async for message in socket:
                if isinstance(message, str):
                    continue
                now, length = time.perf_counter(), int.from_bytes(message[:4], "big")
                head = json.loads(message[4 : 4 + length])
                if now - begun > WARM_UP:
                    seen.pictures += 1
                    seen.delays += [now - at for at in sent[shown : head["moves"]] if at - begun > WARM_UP]
                    seen.sides.append(int.from_bytes(message[22 + length : 26 + length], "little"))
                shown = head["moves"]

        watching = asyncio.create_task(look())
        while time.perf_counter() - begun < WARM_UP + seconds:
            sent.append(time.perf_counter())
            await socket.send(json.dumps({"do": "orbit", "x": 0.01, "y": 0.002 if len(sent) % 60 < 30 else -0.002}))
            await asyncio.sleep(PACE)
        watching.cancel()


async def measure(address: str, visitors: int, seconds: float) -> list[Orbiting]:
    """Return what each of some simultaneous visitors saw."""
    seen = [Orbiting() for _ in range(visitors)]
    await asyncio.gather(*(orbit(address, seconds, each) for each in seen))
    return seen


async def measure_pool(visitors: int, seconds: float, piece: str, longest: int, workers: int | None) -> list[Orbiting]:
    """Do the same without the page."""
    seen = [Orbiting() for _ in range(visitors)]
    async with Pool(workers) as pool:
        facts = await pool.open(Source("piece", piece))
        until = time.perf_counter() + seconds

        async def orbit(visitor: str, each: Orbiting) -> None:
            camera = front(facts)
            while (asked := time.perf_counter()) < until:
                camera = drag(camera, 0.01, 0.002 if each.pictures % 60 < 30 else -0.002)
                frame = await pool.render(visitor, replace(State(facts.source), camera=camera), longest, count=False)
                assert frame is not None
                each.pictures += 1
                each.delays.append(time.perf_counter() - asked)
                each.sides.append(max(frame.width, frame.height))

        await asyncio.gather(*(orbit(f"visitor {number}", each) for number, each in enumerate(seen)))
    return seen


def report(seen: Sequence[Orbiting], seconds: float) -> str:
    """Return the figures as a table in Markdown."""
    each = np.array([one.pictures / seconds for one in seen])
    delays = 1000 * np.concatenate([one.delays for one in seen])
    sides = np.concatenate([one.sides for one in seen])
    rows = {
        "measured": f"{date.today()}",
        "visitors, cores": f"{len(seen)}, {os.cpu_count()}",
        "pictures a second, all together": f"{each.sum():.0f}",
        "pictures a second of a visitor": f"{np.median(each):.1f} ({each.min():.1f} to {each.max():.1f})",
        "delay, median": f"{np.median(delays):.0f} ms",
        "delay, 95th percentile": f"{np.percentile(delays, 95):.0f} ms",
        "side of the moving pictures, median": f"{np.median(sides):.0f} pixels",
    }
    return "\n".join(["| | |", "|---|---:|", *(f"| {name} | {value} |" for name, value in rows.items())])


def main() -> None:
    """Run the command."""
    parser = argparse.ArgumentParser(description="The Creator with many visitors at once.")
    parser.add_argument("--visitors", type=int, default=20)
    parser.add_argument("--seconds", type=float, default=10)
    parser.add_argument("--piece", default="icons/shackle")
    parser.add_argument("--write", action="store_true", help="put the figures into docs/creator.md")
    parser.add_argument("--pool", action="store_true", help="ask the workers alone")
    parser.add_argument("--longest", type=int, default=128, help="side of the pictures of --pool")
    parser.add_argument("--workers", type=int, help="processes of --pool; else one for each core")
    options = parser.parse_args()
    if options.pool:
        seen = asyncio.run(
            measure_pool(options.visitors, options.seconds, options.piece, options.longest, options.workers)
        )
        print(report(seen, options.seconds))
        return
    command = [sys.executable, "-m", "shackled", "creator", "--no-browser", "--port", "0", options.piece]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server:
        try:
            assert server.stdout is not None
            found = re.search(r"http://\S+", server.stdout.readline())
            assert found, "the Creator did not start"
            seen = asyncio.run(measure(found[0], options.visitors, options.seconds))
        finally:
            server.terminate()
    table = report(seen, options.seconds)
    print(table)
    if options.write:
        update({PAGE: lambda _: table}, "python -m benchmarks.creator --write")


if __name__ == "__main__":
    main()
