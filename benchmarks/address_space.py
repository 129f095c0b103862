"""How much longer a picture takes where the embedded EVM may not reserve its address space.

python -m benchmarks.address_space

Draws in turn with an EVM that started without a limit and with one under 2 GB, and prints the ratio of the shortest
times of the process.
"""

from __future__ import annotations

import resource
import time

import shackled
from shackled.chain import RevmChain
from shackled.scene import render_call

from . import run_main

ROUNDS, LIMIT = 9, 2 << 30


def main() -> None:
    """Print a line for each size."""
    chains: list[RevmChain] = []
    _, hard = resource.getrlimit(resource.RLIMIT_AS)
    for limit in (LIMIT, hard):
        resource.setrlimit(resource.RLIMIT_AS, (limit, hard))
        chains.insert(0, RevmChain())
        chains[0].draw(shackled.load("teapot", size=16))
    for size in (128, 512):
        call = render_call(shackled.load("teapot", size=size, antialias=False))
        shortest = [float("inf")] * 2
        for _ in range(ROUNDS):
            for index, chain in enumerate(chains):
                started = time.process_time()
                chain.call("Renderer", call)
                shortest[index] = min(shortest[index], time.process_time() - started)
        print(f"teapot, {size} x {size}: {shortest[0]:.3f} s, under a limit {shortest[1] / shortest[0]:.2f} times that")


if __name__ == "__main__":
    run_main(main)
