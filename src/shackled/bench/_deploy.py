"""What it takes to put the contracts on a chain."""

from __future__ import annotations

from importlib.util import find_spec
from typing import TYPE_CHECKING

from ..artifacts import RENDERER, artifact
from ..chain import DEFAULT_GAS_LIMIT, SENDER, PyEvmChain, PyrevmChain
from ..deploy import STANDARD
from ..ethereum import intrinsic_gas
from ._lab import Lab
from ._original import CODE_SIZES, DEPLOYMENT_GAS, PAPER_DEPLOYMENT_ETHER
from ._plots import ORIGINAL, OURS
from ._report import Cell, Report, millions, table

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Gas of a transaction that creates a contract, beyond that of any.
CREATION = 32000


def run(lab: Lab) -> Report:
    """Every contract that `shackled deploy` puts on a chain."""
    names = sorted(STANDARD, key=lambda name: (name not in RENDERER, name))
    gas = dict(zip(names, lab.map("deploy", deployment_gas, names), strict=True))
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
        f"The renderer is {', '.join(RENDERER[:-1])} and {RENDERER[-1]}: {millions(core)} gas; with all"
        f" {len(names)} contracts of the package {millions(sum(gas.values()))}. The seven contracts of the"
        f" original, its token and its generator among them, take {millions(DEPLOYMENT_GAS, 1)}."
        f" The paper paid {PAPER_DEPLOYMENT_ETHER} ether for 13"
        " contracts and libraries; for the"
        f" {millions(DEPLOYMENT_GAS, 1)} of the seven that would be {price:.1f} gwei for each gas."
        f" At that price the renderer would take {core * price / 1e9:.3f} ether.\n\n"
    )
    lines = [[name, f"{sizes[name][0]:,}", f"{sizes[name][1]:,}", millions(gas[name], 3)] for name in names]
    theirs = [[f"original: {name}", f"{size:,}", "", ""] for name, size in CODE_SIZES.items()]
    theirs.append(["original: together", f"{sum(CODE_SIZES.values()):,}", "", millions(DEPLOYMENT_GAS, 1)])
    return Report(
        "Deployment",
        ["contract", "code_bytes", "creation_bytes", "gas"],
        rows,
        text + table(["contract", "code, bytes", "creation code, bytes", "gas"], lines + theirs),
        draw,
        (6.4, 1.2 + 0.35 * len(names)),
    )


def deployment_gas(contract: str) -> int:
    """Gas of the whole transaction that deploys a contract."""
    return (PyrevmDeployer() if find_spec("pyrevm") else PyEvmDeployer()).gas_of(contract)


class PyrevmDeployer(PyrevmChain):
    """Asks pyrevm."""

    def gas_of(self, contract: str) -> int:
        """Gas of the transaction."""
        code = self.creation(contract)
        evm = self._evm()
        evm.deploy("0x" + SENDER.hex(), code, None, DEFAULT_GAS_LIMIT)
        used: int = evm.result.gas_used
        return used


class PyEvmDeployer(PyEvmChain):
    """Asks py-evm, which counts all but what a transaction costs before it is executed."""

    def gas_of(self, contract: str) -> int:
        """Gas of the transaction."""
        from eth.constants import CREATE_CONTRACT_ADDRESS

        code = self.creation(contract)
        state = self._state()
        place = bytes.fromhex("c0de") + bytes(18)
        message = self._message(code, b"", CREATE_CONTRACT_ADDRESS, DEFAULT_GAS_LIMIT, create_address=place)
        computation = state.computation_class.apply_create_message(state, message, self._transaction)
        return int(computation.get_gas_used()) + intrinsic_gas(code) + CREATION
