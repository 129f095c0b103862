"""Gas and size of the contracts."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..artifacts import RENDERER, artifact
from ..chain._embedded import DEFAULT_GAS_LIMIT, RevmChain
from ..deploy._contract import STANDARD
from ..ethereum._encoding import intrinsic_gas
from ..evm._instance import Instance
from ._original import CODE_SIZES, DEPLOYMENT_GAS, PAPER_DEPLOYMENT_ETHER
from ._report import ORIGINAL, OURS, Cell, ExperimentReport, millions, table
from ._runner import Runner

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Extra gas of a transaction that creates a contract.
CREATION = 32000
#: Gas of a word of creation code (EIP-3860).
INITCODE_WORD = 2


def deploy(runner: Runner) -> ExperimentReport:
    """Measure every contract that `shackled deploy` deploys."""
    names = sorted(STANDARD, key=lambda name: (name not in RENDERER, name))
    gas = dict(zip(names, runner.map("deploy", deployment_gas, names), strict=True))
    sizes = {name: (len(artifact(name).runtime), len(artifact(name).creation)) for name in names}
    rows: list[list[Cell]] = [[name, *sizes[name], gas[name]] for name in names]

    def draw(figure: Figure) -> None:
        axes = figure.add_subplot()
        bars = [("original, 7 contracts", sum(CODE_SIZES.values()), DEPLOYMENT_GAS, ORIGINAL)]
        bars += [(name, sizes[name][0], gas[name], OURS) for name in names]
        for place, (_, size, value, color) in enumerate(bars):
            axes.barh(place, value / 1e6, 0.6, color=color)
            axes.text(value / 1e6, place, f"  {value / 1e6:.2f}M, {size:,} bytes", va="center")
        axes.set_yticks(range(len(bars)), [name for name, *_ in bars])
        axes.invert_yaxis()
        axes.grid(axis="y", visible=False)
        axes.set(xlabel="gas, millions", xlim=(0, 1.45 * DEPLOYMENT_GAS / 1e6))

    core = sum(gas[name] for name in RENDERER)
    price = PAPER_DEPLOYMENT_ETHER * 1e9 / DEPLOYMENT_GAS
    text = (
        f"The renderer is {', '.join(RENDERER[:-1])} and {RENDERER[-1]}: {millions(core)} gas. All"
        f" {len(names)} contracts of the package take {millions(sum(gas.values()))}. The seven contracts of the"
        f" original, including its token and its generator, take {millions(DEPLOYMENT_GAS, 1)}."
        f" The paper paid {PAPER_DEPLOYMENT_ETHER} ether for 13"
        " contracts and libraries; for the"
        f" {millions(DEPLOYMENT_GAS, 1)} of the seven, this would be {price:.1f} gwei per gas."
        f" At this price, the renderer would cost {core * price / 1e9:.3f} ether.\n\n"
    )
    lines = [[name, f"{sizes[name][0]:,}", f"{sizes[name][1]:,}", millions(gas[name], 3)] for name in names]
    theirs = [[f"original: {name}", f"{size:,}", "", ""] for name, size in CODE_SIZES.items()]
    theirs.append(["original: together", f"{sum(CODE_SIZES.values()):,}", "", millions(DEPLOYMENT_GAS, 1)])
    return ExperimentReport(
        "Deployment",
        ["contract", "code_bytes", "creation_bytes", "gas"],
        rows,
        text + table(["contract", "code, bytes", "creation code, bytes", "gas"], lines + theirs),
        draw,
        (6.4, 1.2 + 0.35 * len(names)),
    )


def deployment_gas(contract: str) -> int:
    """Measure the gas of the transaction that deploys a contract."""
    chain, evm = RevmChain(), Instance()
    code = chain.creation(contract)
    evm.hold(chain.codes())
    gas = evm.create(code, DEFAULT_GAS_LIMIT).gas
    return gas + intrinsic_gas(code) + CREATION + INITCODE_WORD * -(-len(code) // 32)
