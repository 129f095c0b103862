"""Time the same calls in every installed EVM."""

from __future__ import annotations

import time
from dataclasses import dataclass
from functools import partial
from importlib.util import find_spec
from typing import TYPE_CHECKING

from ..artifacts import artifact
from ..chain import CHAINS, ContractChain, NodeChain, open_chain, open_node
from ..datasets import teapot
from ..errors import RenderError
from ..scene import Scene, encode, stage
from ._report import FOURTH, ORIGINAL, OURS, THIRD, Cell, ExperimentReport, millions, table
from ._runner import Runner
from .scenes import cube, equal_triangles

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: The embedded EVMs: their names in figures and in text.
ENGINES = {"revm": "revm, as WebAssembly", "pyrevm": "pyrevm", "pyevm": "py-evm"}
#: A call is repeated until the calls have taken this many seconds together; the shortest counts.
ENOUGH = 1.0


@dataclass(frozen=True)
class Run:
    """One call: seconds, execution gas, what is returned."""

    seconds: float
    gas: int
    output: bytes


def run(runner: Runner) -> ExperimentReport:
    """Time a few scenes in each EVM, one call after the other, so that the times are comparable."""
    scenes = all_scenes(runner.quick)
    engines = open_engines(runner.rpc)
    runs: dict[tuple[str, str], Run] = {}
    for engine, chain in engines.items():
        found = runner.map(engine, partial(time_engine, chain), scenes.values(), alone=True)
        runs |= {(engine, name): each for name, each in zip(scenes, found, strict=True)}
    for name in scenes:
        if len({(runs[engine, name].gas, runs[engine, name].output) for engine in engines}) != 1:
            raise RenderError(f"the engines do not agree on the scene {name}")
    rows: list[list[Cell]] = [[engine, name, each.gas, round(each.seconds, 6)] for (engine, name), each in runs.items()]

    def draw(figure: Figure) -> None:
        axes = figure.add_subplot()
        for engine, color in zip(engines, (OURS, ORIGINAL, THIRD, FOURTH), strict=False):
            points = sorted((runs[engine, name].gas / 1e6, runs[engine, name].seconds) for name in scenes)
            axes.plot(*zip(*points, strict=True), "o-", color=color, ms=4, lw=1.2, label=label_of(engine))
        axes.set(xscale="log", yscale="log", xlabel="gas of the picture, millions", ylabel="seconds")
        axes.legend()

    return ExperimentReport(
        "Engines", ["engine", "scene", "gas", "seconds"], rows, _text(list(engines), list(scenes), runs), draw
    )


def all_scenes(quick: bool) -> dict[str, Scene]:
    """Return the scenes by name, from the cheapest to the most expensive."""
    if quick:
        return {"cube, 8 x 8": cube(8)}
    return {
        "cube, 32 x 32": cube(32),
        "16 triangles, 128 x 128": equal_triangles(16),
        "cube, 128 x 128": cube(128),
        "teapot of 1,008 triangles, 128 x 128": stage(teapot(4), 128),
    }


def open_engines(rpc: str | None) -> dict[str, ContractChain | NodeChain]:
    """Open each engine that is installed, and the node at an address, by the names that the figures give them."""
    found: dict[str, ContractChain | NodeChain] = {}
    for name in ENGINES:
        if find_spec(CHAINS[name]) is not None:
            found[name] = open_chain(name)
    if rpc is not None:
        node = open_node(rpc)
        # such as anvil/v1.7.1
        found[str(node.connection.request("web3_clientVersion")).partition("/")[0].lower()] = node
    return found


def label_of(engine: str) -> str:
    """Name an engine in plots and tables."""
    return ENGINES.get(engine, f"{engine} (eth_call over HTTP)")


def time_engine(chain: ContractChain | NodeChain, scene: Scene) -> Run:
    """Time the shortest of some calls, after a first one that sets the contracts up."""
    data = encode(artifact("Renderer").selectors["render"], scene)
    result = chain.call("Renderer", data)
    assert result.gas is not None, "the node reports no gas"
    seconds: list[float] = []
    while sum(seconds) < ENOUGH:
        started = time.perf_counter()
        chain.call("Renderer", data)
        seconds.append(time.perf_counter() - started)
    return Run(min(seconds), result.gas, result.output)


def _text(engines: list[str], scenes: list[str], runs: dict[tuple[str, str], Run]) -> str:
    lines = []
    for name in scenes:
        gas = runs[engines[0], name].gas
        times = [f"{runs[engine, name].seconds * 1000:,.1f}" for engine in engines]
        lines.append([name, millions(gas), *times])
    speeds = []
    for engine in engines:
        last = runs[engine, scenes[-1]]
        speeds.append(f"{label_of(engine)} {last.gas / last.seconds / 1e6:,.{0 if last.seconds < 1 else 1}f}")
    return (
        "The same bytes for the same gas in each. The times are of the machine on which this ran, and the only figures"
        " here that differ from machine to machine. Millions of gas a second, for the last scene:"
        f" {', '.join(speeds)}.\n\n"
        + table(["scene", "gas", *(f"{label_of(engine)}, ms" for engine in engines)], lines)
    )
