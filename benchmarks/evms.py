"""Compare the EVMs that can run the contracts, in one run on one machine.

    python -m benchmarks.evms

writes benchmarks/evms.md: speeds of each EVM over nine pictures, interpreted and compiled contracts in wasmtime, Node
and chromium, and the time of commands in a new process. EVMs that are not installed are left out.
"""

from __future__ import annotations

import base64
import json
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from contextlib import ExitStack
from functools import partial
from importlib.util import find_spec
from pathlib import Path
from typing import Any
from unittest.mock import patch

from tools.anvil import Anvil, find_anvil
from tools.page_server import browser_path, chromium

from shackled import Scene, load
from shackled.chain import open_chain, open_node
from shackled.chain._chain import ContractChain
from shackled.chain._embedded import RevmChain
from shackled.chain._node import NodeChain
from shackled.chain._opening import CHAINS
from shackled.evm._module import module_bytes
from shackled.scene._codec import render_call
from shackled.scene._settings import LookOptions

from . import run_main

PAGE = Path(__file__).resolve().parent / "evms.md"
PROGRAM = str(Path(sys.executable).with_name("shackled"))

NAMES = {
    "interpreter": "revm, as WebAssembly",
    "compiled": "the same, contracts compiled (the default)",
    "pyrevm": "pyrevm",
    "pyevm": "py-evm",
    "anvil": "anvil, over HTTP",
}
PLAIN: LookOptions = {"shading": "flat", "antialias": False}
#: Nine pictures: a piece, its side in pixels, and how it looks where that is not the default.
PICTURES: dict[str, tuple[str, int, LookOptions]] = {
    "teapot, plain, 128": ("teapot", 128, PLAIN),
    "teapot, 128": ("teapot", 128, {}),
    "teapot, plain, 256": ("teapot", 256, PLAIN),
    "teapot, 256": ("teapot", 256, {}),
    "teapot, filmic, gamma, 128": ("teapot", 128, {"filmic": True, "gamma": True}),
    "teapot, shadow on the ground, 128": ("teapot", 128, {"shadow": True, "ground": "white"}),
    "teapot, wireframe, 128": ("teapot", 128, {"wireframe": True}),
    "Genesis 7, 256": ("genesis/7", 256, {}),
    "crown, 512": ("icons/crown", 512, {}),
}
#: Gas of a call in py-evm at most: more would take minutes.
SLOW_GAS = 15_000_000
ROUNDS = 7
SCRIPT = Path(__file__).with_name("evms.js")
FIRST = "revm, for the first time on a machine"
FRAMES = ("teapot", "--size", "256", "--turntable", "36")

Caller = ContractChain | NodeChain


def scene(name: str) -> Scene:
    """Return the scene of one of the nine."""
    piece, side, look = PICTURES[name]
    return load(piece, side, **look)


def revm(mode: str) -> RevmChain:
    """Return a chain whose only instance runs contracts as this value of SHACKLED_EVM says."""
    with patch.dict(os.environ, SHACKLED_EVM=mode):
        chain = RevmChain()
        chain.address("Renderer")
    return chain


def speeds() -> str:
    """Return a table of millions of gas a second, and the means of ratios."""
    calls = {name: render_call(scene(name)) for name in PICTURES}
    with ExitStack() as stack:
        evms: dict[str, Caller] = {mode: revm(mode) for mode in ("interpreter", "compiled")}
        evms |= {name: open_chain(name) for name, module in CHAINS.items() if name != "revm" and find_spec(module)}
        if (anvil := find_anvil()) is not None:
            evms["anvil"] = open_node(stack.enter_context(Anvil(anvil)).url)
        rows = {name: row(data, evms) for name, data in calls.items()}
    lines = [f"| picture | gas, millions | {' | '.join(NAMES[name] for name in evms)} | compiled by interpreted |"]
    lines.append(f"|---|---:|{'---:|' * len(evms)}---:|")
    for name, (gas, found) in rows.items():
        cells = [f"{gas / found[evm] / 1e6:,.{0 if evm != 'pyevm' else 1}f}" if evm in found else "" for evm in evms]
        ratio = found["interpreter"] / found["compiled"]
        lines.append(f"| {name} | {gas / 1e6:,.1f} | {' | '.join(cells)} | {ratio:.2f} |")
    for other in ("interpreter", "pyrevm"):
        if other in evms:
            mean = statistics.geometric_mean(found[other] / found["compiled"] for _, found in rows.values())
            lines.append(f"\nCompiled contracts are faster than in {NAMES[other]} by {mean:.2f} (geometric mean).")
    return "\n".join(lines)


def row(data: bytes, evms: dict[str, Caller]) -> tuple[int, dict[str, float]]:
    """Return the gas of a picture, and the seconds that it takes in each EVM, the median of some rounds.

    The EVMs take turns, so that other work of the machine slows all of them. Of those in this process only the time of
    the processor counts.
    """
    results = {name: evm.call("Renderer", data) for name, evm in evms.items() if name != "pyevm"}
    gas = results["compiled"].gas
    assert gas is not None
    assert {(each.output, each.gas) for each in results.values()} == {(results["compiled"].output, gas)}
    seconds: dict[str, list[float]] = {}
    for number in range(ROUNDS):
        for name, evm in evms.items():
            if name == "pyevm" and (number or gas > SLOW_GAS):
                continue
            clock = time.perf_counter if name == "anvil" else time.thread_time
            seconds.setdefault(name, []).append(timed(partial(evm.call, "Renderer", data), clock))
    return gas, {name: statistics.median(all_) for name, all_ in seconds.items()}


def javascript() -> str:
    """Return a table of the same pictures in the engines of JavaScript that are there: milliseconds, and ratios."""
    chain = RevmChain()
    to = chain.address("Renderer")
    work: dict[str, Any] = {
        "evm": base64.b64encode(module_bytes()).decode(),
        "codes": {address.hex(): code.hex() for address, code in chain.codes().items()},
        "to": to.hex(),
        "calls": {name: render_call(scene(name)).hex() for name in PICTURES},
        "rounds": ROUNDS,
    }
    found: dict[str, dict[str, Any]] = {}
    if node := shutil.which("node"):
        script = f"{SCRIPT.read_text('utf-8')}\nconsole.log(JSON.stringify(await measure({json.dumps(work)})))"
        command = [node, "--input-type=module"]
        found["Node"] = json.loads(
            subprocess.run(command, input=script, capture_output=True, text=True, check=True).stdout
        )
    if browser_path():
        with chromium() as browser:
            tab = browser.new_page()
            tab.set_default_timeout(0)
            tab.add_script_tag(content=SCRIPT.read_text("utf-8"))
            found["chromium"] = tab.evaluate("measure", work)
    lines = ["| picture | engine | interpreted, ms | compiled, ms | ratio |", "|---|---|---:|---:|---:|"]
    for engine, pictures in found.items():
        ratios = []
        for name, (gas, interpreted, compiled) in pictures.items():
            assert gas == chain.run(to, bytes.fromhex(work["calls"][name])).gas
            ratios.append(statistics.median(interpreted) / statistics.median(compiled))
            times = f"{statistics.median(interpreted):.1f} | {statistics.median(compiled):.1f}"
            lines.append(f"| {name} | {engine} | {times} | {ratios[-1]:.2f} |")
        lines.append(f"| geometric mean | {engine} | | | {statistics.geometric_mean(ratios):.2f} |")
    return "\n".join(lines)


def frames() -> str:
    """Return a sentence about an animation in a new process, after a first run that compiled the contracts."""
    with tempfile.TemporaryDirectory() as folder:

        def draw(mode: str) -> None:
            output = Path(folder, f"frames-{mode}.png")
            # Python keeps bytecode, as where the package is installed
            kept = {"PYTHONDONTWRITEBYTECODE": "", "PYTHONPYCACHEPREFIX": folder, "XDG_CACHE_HOME": folder}
            run([PROGRAM, "render", *FRAMES, "-o", str(output)], SHACKLED_EVM=mode, **kept)

        draw("compiled")
        taken: dict[str, list[float]] = {"interpreter": [], "": []}
        for _ in range(ROUNDS):
            for mode, each in taken.items():
                each.append(timed(partial(draw, mode)))
        assert Path(folder, "frames-.png").read_bytes() == Path(folder, "frames-interpreter.png").read_bytes()
    interpreted, default = (statistics.median(each) for each in taken.values())
    return (
        f"`shackled render {' '.join(FRAMES)}` takes {interpreted:.2f} seconds with SHACKLED_EVM=interpreter, and "
        f"{default:.2f} by default, after a first run: {interpreted / default:.2f} times as fast."
    )


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
        f" machine with {os.cpu_count()} cores, of {ROUNDS} rounds in which all take turns: medians, but for commands,"
        " of which the best is shown.\n\n"
        "Millions of gas a second. The names of the pictures end with their sides in pixels; plain is flat without"
        f" antialiasing.\n\n{speeds()}\n\n"
        f"Interpreted and compiled contracts in other engines:\n\n{javascript()}\n\n"
        f"An animation: {frames()}\n\n"
        f"A command in a new process, from start to end:\n\n{starts()}\n\n"
        "Platforms with binary wheels: [docs/install.md](../docs/install.md#platforms).\n",
        "utf-8",
    )
    print(PAGE.read_text("utf-8"))


if __name__ == "__main__":
    run_main(main)
