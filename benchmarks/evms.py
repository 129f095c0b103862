"""Compare the EVMs that can run the contracts, in one run on one machine.

    python -m benchmarks.evms

writes benchmarks/evms.md: speeds of each EVM over some scenes, and the time of a command in a new process. EVMs that
are not installed are left out.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from contextlib import ExitStack
from functools import partial
from importlib.util import find_spec
from pathlib import Path

from tools.anvil import Anvil, find_anvil

from shackled import Scene, load
from shackled.artifacts import artifact
from shackled.chain import open_chain, open_node
from shackled.chain._chain import ContractChain
from shackled.chain._node import NodeChain
from shackled.chain._opening import CHAINS
from shackled.scene import encode
from shackled.scene._settings import LookOptions

from . import run_main

PAGE = Path(__file__).resolve().parent / "evms.md"
PROGRAM = str(Path(sys.executable).with_name("shackled"))

NAMES = {
    "revm": "revm, as WebAssembly (the default)",
    "pyrevm": "pyrevm",
    "pyevm": "py-evm",
    "anvil": "anvil, over HTTP",
}
#: Pieces, and how they look; sides of all pictures in pixels.
SCENES: dict[str, tuple[str, LookOptions]] = {
    "cube": ("cube", {}),
    "icons/crown": ("icons/crown", {}),
    "genesis/7": ("genesis/7", {}),
    "teapot": ("teapot", {}),
    "teapot, flat, antialiased": ("teapot", {"shading": "flat", "antialias": True}),
    "teapot, smooth, antialiased": ("teapot", {"smooth": True, "antialias": True}),
    "teapot, filmic, gamma": ("teapot", {"filmic": True, "gamma": True}),
}
SIZE = 128
#: Gas of a call in py-evm at most: more would take minutes.
SLOW_GAS = 15_000_000
ROUNDS = 7
FIRST = "revm, for the first time on a machine"

Caller = ContractChain | NodeChain


def speeds() -> str:
    """Return a table of millions of gas a second."""
    scenes = {name: load(piece, SIZE, **look) for name, (piece, look) in SCENES.items()}
    with ExitStack() as stack:
        evms: dict[str, Caller] = {name: open_chain(name) for name, module in CHAINS.items() if find_spec(module)}
        if (anvil := find_anvil()) is not None:
            evms["anvil"] = open_node(stack.enter_context(Anvil(anvil)).url)
        rows = {name: row(scene, evms) for name, scene in scenes.items()}
    lines = [f"| scene | gas, millions | {' | '.join(NAMES[name] for name in evms)} | revm by pyrevm |"]
    lines.append(f"|---|---:|{'---:|' * len(evms)}---:|")
    for name, (gas, found) in rows.items():
        cells = [f"{gas / found[evm] / 1e6:,.{0 if evm != 'pyevm' else 1}f}" if evm in found else "" for evm in evms]
        ratio = f"{found['pyrevm'] / found['revm']:.2f}" if "pyrevm" in found else ""
        lines.append(f"| {name} | {gas / 1e6:,.1f} | {' | '.join(cells)} | {ratio} |")
    return "\n".join(lines)


def row(scene: Scene, evms: dict[str, Caller]) -> tuple[int, dict[str, float]]:
    """Return the gas of a picture, and the seconds that it takes in each EVM, the shortest of some rounds.

    The EVMs take turns, so that other work of the machine slows all of them. Of those in this process only the time of
    the processor counts.
    """
    data = encode(artifact("Renderer").selectors["render"], scene)
    results = {name: evm.call("Renderer", data) for name, evm in evms.items() if name != "pyevm"}
    gas = results["revm"].gas
    assert gas is not None
    assert {(each.output, each.gas) for each in results.values()} == {(results["revm"].output, gas)}
    seconds: dict[str, float] = {}
    for number in range(ROUNDS):
        for name, evm in evms.items():
            if name == "pyevm" and (number or gas > SLOW_GAS):
                continue
            clock = time.perf_counter if name == "anvil" else time.thread_time
            taken = timed(partial(evm.call, "Renderer", data), clock)
            seconds[name] = min(seconds.get(name, taken), taken)
    return gas, seconds


def starts() -> str:
    """Return a table of the seconds of new processes: what the command needs to start, beside NumPy, and pictures."""
    lines = ["| command | EVM | seconds |", "|---|---|---:|"]
    light = {"`import numpy`": [sys.executable, "-c", "import numpy"], "`shackled --help`": [PROGRAM, "--help"]}
    rounds = [{name: timed(partial(run, command)) for name, command in light.items()} for _ in range(ROUNDS)]
    lines += [f"| {name} | | {min(each[name] for each in rounds):.2f} |" for name in light]
    cases = {"revm, cached": "revm", FIRST: "revm", "pyrevm": "pyrevm"}
    if not find_spec("pyrevm"):
        del cases["pyrevm"]
    with tempfile.TemporaryDirectory() as folder:
        for command in (("cube",), ("teapot", "--size", "256", "--smooth")):
            found: dict[str, list[float]] = {name: [] for name in cases}
            for number in range(ROUNDS + 1):
                for name, chain in cases.items():
                    cache = Path(folder, f"{command[0]}-{number}" if name == FIRST else name)
                    found[name].append(timed(partial(start, command, chain, cache)))
            # the first round fills the cache
            lines += [
                f"| `shackled render {' '.join(command)}` | {name} | {min(found[name][1:]):.2f} |" for name in cases
            ]
    return "\n".join(lines)


def start(command: tuple[str, ...], chain: str, cache: Path) -> None:
    """Render in a new process, with this folder as the user's cache."""
    output = str(cache.with_suffix(".png"))
    run([PROGRAM, "render", *command, "--evm", chain, "-o", output], XDG_CACHE_HOME=str(cache))


def run(command: list[str], **variables: str) -> None:
    """Run a program to its end, with these variables in its environment."""
    subprocess.run(command, env=os.environ | variables, check=True, capture_output=True)


def timed(work: Callable[[], object], clock: Callable[[], float] = time.perf_counter) -> float:
    """Return the seconds that a function takes, by a clock."""
    started = clock()
    work()
    return clock() - started


def main() -> None:
    """Write the page."""
    PAGE.write_text(
        "# EVMs\n\n"
        "Written by `python -m benchmarks.evms`. All return the same bytes for the same gas. The times are of one"
        f" machine with {os.cpu_count()} cores; of each figure the best of {ROUNDS}, the EVMs taking turns.\n\n"
        f"Millions of gas a second, pictures of {SIZE} x {SIZE} pixels:\n\n{speeds()}\n\n"
        f"A command in a new process, from start to end:\n\n{starts()}\n\n"
        "Platforms with binary wheels: [docs/install.md](../docs/install.md#platforms).\n",
        "utf-8",
    )
    print(PAGE.read_text("utf-8"))


if __name__ == "__main__":
    run_main(main)
