"""Say what a transaction that draws a picture costs in dollars, on mainnet and on a rollup, at assumed prices.

    python -m benchmarks.money [--date DAY] [--ether USD] [--mainnet GWEI] [--rollup GWEI] [--blob GWEI]

rewrites money.json, which keeps the prices, and the table of benchmarks/README.md. The prices are parameters: without
options they are those that money.json has. A read call (`eth_call`) costs nothing and is not listed.

On mainnet a transaction pays its gas: execution and calldata, at least the floor of EIP-7623. On a rollup it pays
the gas of its execution there, and its share of a blob of mainnet: its bytes, compressed, at the price of blob gas, 1 a
byte.
"""

from __future__ import annotations

import argparse
import zlib
from dataclasses import asdict, dataclass, fields
from pathlib import Path

from shackled import Scene, load
from shackled.artifacts import artifact
from shackled.bench._measure import call_renderer
from shackled.bench._report import table
from shackled.bench.scenes import cube
from shackled.ethereum._encoding import intrinsic_gas
from shackled.scene import encode

from . import publish, read_figures, run_main

FILE = Path(__file__).with_name("money.json")
#: Limit of a transaction (EIP-7825).
MOST = 1 << 24


@dataclass(frozen=True)
class Prices:
    """Prices of a day: of ether in dollars; of gas on mainnet and on the rollup, and of blob gas, in gwei."""

    date: str
    ether: float
    mainnet: float
    rollup: float
    blob: float


@dataclass(frozen=True)
class Work:
    """A transaction that draws a picture.

    gas: of its execution. intrinsic: before it, by the rules of Cancun. data, compressed: bytes of the call.
    """

    gas: int
    intrinsic: int
    data: int
    compressed: int

    @property
    def total(self) -> int:
        """Return the gas of the transaction: 10 for a zero byte and 40 for another at least (EIP-7623)."""
        return max(self.gas + self.intrinsic, 21_000 + (self.intrinsic - 21_000) * 5 // 2)

    def on_mainnet(self, prices: Prices) -> float:
        """Return dollars."""
        return self.total * prices.mainnet * 1e-9 * prices.ether

    def on_rollup(self, prices: Prices) -> float:
        """Return dollars: of the execution, and of the bytes in a blob."""
        execution = self.total * prices.rollup
        return (execution + self.compressed * prices.blob) * 1e-9 * prices.ether


def scenes() -> dict[str, Scene]:
    """Return the scenes by name: plain ones, and one in the default look of meshes."""
    return {
        "a cube, 128 x 128": cube(128),
        "an icon, 128 x 128": load("icons/crown", size=128, antialias=False),
        "a piece of Genesis, 128 x 128": load("genesis/7", size=128, antialias=False),
        "the teapot, 128 x 128": load("teapot", size=128, antialias=False),
        "the teapot, antialiased, 256 x 256": load("teapot", size=256, antialias=True),
    }


def measure(scene: Scene) -> Work:
    """Measure the call that draws a scene whose numbers are in its calldata."""
    data = encode(artifact("Renderer").selectors["render"], scene)
    return Work(call_renderer(scene).gas, intrinsic_gas(data), len(data), len(zlib.compress(data, 9)))


def text(prices: Prices, works: dict[str, Work]) -> str:
    """Return prices and costs as Markdown."""
    lines = []
    for name, work in works.items():
        gas = work.total
        mainnet = f"{work.on_mainnet(prices):,.2f}" + ("" if gas <= MOST else " *")
        lines.append(
            [name, f"{gas:,}", f"{work.data:,}", f"{work.compressed:,}", mainnet, f"{work.on_rollup(prices):,.4f}"]
        )
    head = ["transaction", "gas", "calldata, bytes", "compressed", "mainnet, dollars", "rollup, dollars"]
    return (
        f"Prices, assumed for {prices.date}: {prices.ether:,.0f} dollars an ether; gas at {prices.mainnet:g} gwei on"
        f" mainnet and {prices.rollup:g} on a rollup, blob gas at {prices.blob:g}.\n"
        "`python -m benchmarks.money --ether ... --mainnet ...` takes others.\n"
        "*: above the limit of one transaction.\n\n" + table(head, lines)
    )


def recorded() -> tuple[Prices, dict[str, Work]]:
    """Return the prices and the measurements of money.json."""
    found = read_figures(FILE)
    return Prices(**found["prices"]), {name: Work(**each) for name, each in found["work"].items()}


def main(arguments: list[str] | None = None) -> int:
    """Measure, and write file and table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for each in fields(Prices):
        parser.add_argument(f"--{each.name}", type=str if each.name == "date" else float)
    given = {name: value for name, value in vars(parser.parse_args(arguments)).items() if value is not None}
    prices = Prices(**asdict(recorded()[0]) | given)
    works = {name: measure(scene) for name, scene in scenes().items()}
    found = {"prices": asdict(prices), "work": {name: asdict(each) for name, each in works.items()}}
    return publish("money", found, text(prices, works))


if __name__ == "__main__":
    run_main(main, has_options=True)
