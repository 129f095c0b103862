"""shackled gas"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from itertools import count
from pathlib import Path
from typing import Any

from ..base.checks import number
from ..base.values import plural
from ..base.whole_file import check_output_file, write_output
from ..chain._connection import PATIENCE
from ..chain._node import NodeChain
from ..chain._opening import CHAINS, open_chain, open_node
from ..errors import InputError
from ..gas._flame_graph import flame_graph
from ..gas._limits import render_call
from ..gas._profile import KINDS, STACK, Profile
from ..gas._quick_path import quick_path_note
from ..gas._report import GasReport, make_report
from ..gas._search import SearchStep
from ..gas._stages import STAGES
from .look_options import FIT, INPUT, load_with
from .option import exclude, need, option
from .output import print_json, print_line, print_table
from .progress import LateBar

#: Characters of the bar of a stage; functions and lines shown.
BAR = 24
ROWS = 20
#: The value of an option that is a price.
parse_price = partial(number, low=0)


def gas(
    input: str = INPUT,
    evm: str | None = option("--evm", f"EVM to measure in: {', '.join(CHAINS)}; default: revm.", "NAME"),
    rpc: str | None = option(
        "--rpc", "Node that also counts the gas, and runs the search.", "URL", envvar="SHACKLED_RPC"
    ),
    address: str | None = option("--address", "Address of a renderer on the node's chain.", "ADDRESS"),
    rpc_timeout: float | None = option(
        "--rpc-timeout", f"Timeout of a call to the node (default: {PATIENCE:g}).", "SECONDS"
    ),
    fit: str | None = FIT,
    as_json: bool = option("--json", "Print a JSON object instead of tables."),
    profile: str | None = option(
        "--profile", "Also show gas by function and line, and write a flame graph as an .svg file.", "FILE"
    ),
    opcodes: bool = option(
        "--opcodes", "Also show gas by kind of opcode (stack, jumps, memory), by stage, and with --profile by function."
    ),
    stages: bool = option("--stages/--no-stages", "Show gas by stage.", default=True),
    gas_price: float = option("--gas-price", "Gas price in gwei.", "GWEI", type=float, parse=parse_price, default=1.0),
    eth_price: float | None = option(
        "--eth-price", "Price of one ether in US dollars.", "USD", type=float, parse=parse_price
    ),
    **look: Any,
) -> None:
    """Measure the gas of a picture: exactly, by binary search, by stage and by line, and compare it with limits."""
    path = None if profile is None else _check_profile(profile)
    exclude("--no-stages", not stages, {"--profile": path, "--opcodes": opcodes})
    place = open_chain(evm)
    node = _open_node(rpc, address, rpc_timeout)
    scene = load_with(input, look, fit)
    with LateBar("searching") as bar:
        report = make_report(scene, place, stages=stages, on_step=show_steps(as_json, bar), searched=node)
        counted = None if node is None else node.call("Renderer", render_call(scene))
    if path is not None and report.profile is not None:
        write_output(path, flame_graph(report.profile, input).encode())
    if as_json:
        more: dict[str, Any] = {} if path is None else {"profile": str(path)}
        if node is not None and counted is not None:
            more["node"] = {"name": node.name, "gas": counted.gas}
        if opcodes and report.profile is not None:
            more["opcodes"] = report.profile.opcodes()
            more["opcodes_of_stages"] = {stage: report.profile.opcodes(stage) for stage in STAGES}
        print_json({"input": input} | report.to_json(gas_price, eth_price) | more)
        return
    print_report(report, gas_price, eth_price)
    if node is not None and counted is not None:
        words = "reports no gas" if counted.gas is None else f"counts {counted.gas:,} gas"
        print(f"the {node.name}, on which the search was made, {words}")
    if opcodes and report.profile is not None:
        print_opcodes(report.profile)
    if path is not None and report.profile is not None:
        print_profile(report.profile, opcodes)
        print(f"flame graph: {path}")


def _open_node(rpc: str | None, address: str | None, timeout: float | None) -> NodeChain | None:
    # the variable may name several
    urls = (rpc or "").split()
    need("--rpc", urls, {"--address": address, "--rpc-timeout": timeout})
    return open_node(urls[0], address, timeout) if urls else None


def _check_profile(name: str) -> Path:
    path = Path(name)
    if path.suffix.lower() != ".svg":
        raise InputError(f"--profile writes an .svg file, not {name!r}")
    return check_output_file(path, "profile")


def show_steps(quiet: bool, bar: LateBar) -> Callable[[SearchStep], None]:
    """Return what shows the steps of a search: a line for each unless it is quiet, and a bar."""
    numbers = count(1)

    def show(step: SearchStep) -> None:
        number = next(numbers)
        if not quiet:
            verdict = "sufficient" if step.enough else "insufficient"
            bounds = f"{step.lower:,} < gas" + ("" if step.upper is None else f" <= {step.upper:,}")
            bar.print(f"call {number:2}: {step.limit:>14,} {verdict}; {bounds}")
        if step.upper is not None:
            # halving
            bar.set(number, number + (step.upper - step.lower - 1).bit_length())

    return show


def print_report(report: GasReport, gas_price: float, eth_price: float | None) -> None:
    """Print gas, search, stages, price, and the limits that the gas fits."""
    for label, value in _figures(report, gas_price, eth_price).items():
        print_line(f"{label:12} {value}")
    if report.profile is not None:
        stages = report.profile.stages()
        most = max(stages.values())
        rows = [
            (stage, f"{gas:,}", _share(gas, report.profile.gas), "#" * round(BAR * gas / most) if most else "")
            for stage, gas in stages.items()
        ]
        print_line("")
        print_table(("stage", "gas", "", ""), [*rows, ("total", f"{report.profile.gas:,}", "", "")])
    print_line("")
    limits = []
    for fit in report.fits:
        limit, fits = fit.limit, "yes" if fit.fits else f"no{fit.reason and f', {fit.reason}'}"
        share = f"{100 * report.request_limit / limit.gas:.0f} %"
        limits.append((limit.name, f"{limit.gas:,}", share, fits, limit.source, limit.date))
    print_table(("where it fits", "limit", "of it", "", "source", "date"), limits)
    print_line(
        "As documented by the sources on these dates, not measured; operators change them. "
        "The limit of a request includes the intrinsic gas."
    )


def print_opcodes(profile: Profile) -> None:
    """Print gas by kind of opcode, and their shares in each stage."""
    print_line("")
    kinds = profile.opcodes().items()
    print_table(("opcodes", "gas", ""), [(kind, f"{gas:,}", _share(gas, profile.gas)) for kind, gas in kinds])
    print_line("")
    rows = [
        (stage, *(_share(gas, whole) for gas in profile.opcodes(stage).values()))
        for stage, whole in profile.stages().items()
        if whole
    ]
    print_table(("stage", *KINDS), rows)


def print_profile(profile: Profile, opcodes: bool) -> None:
    """Print gas by function, and by line. opcodes: also the share of `STACK` in the own gas of a function."""
    rows = []
    for each in profile.functions()[:ROWS]:
        shares = [_share(profile.opcodes(function=each.name)[STACK], each.own)] if opcodes else []
        rows.append((each.name, f"{each.own:,}", _share(each.own, profile.gas), f"{each.total:,}", *shares))
    print_line("")
    print_table(("function", "self", "", "with calls", *([STACK] if opcodes else [])), rows)
    print_line("")
    lines = profile.lines()[:ROWS]
    rows = [(place, name, f"{gas:,}", _share(gas, profile.gas)) for place, name, gas in lines]
    print_table(("line", "function", "gas", ""), rows)
    print_line("")


def _figures(report: GasReport, gas_price: float, eth_price: float | None) -> dict[str, str]:
    exact, found = report.exact, report.search
    margin = found.gas - exact.gas
    bracket = next(step for step in found.steps if step.upper is not None)
    last = found.steps[-1]
    ether = report.ether(gas_price)
    dollars = "" if eth_price is None else f", {ether * eth_price:,.2f} US dollars at {eth_price:,g} per ether"
    per = (report.per(report.triangles), report.per(report.lit_pixels))
    note = quick_path_note(report.scene)
    return {
        "picture": f"{report.scene.width} x {report.scene.height} pixels; "
        f"{plural(report.triangles, 'triangle')}, {plural(report.lit_pixels, 'lit pixel')}",
        "gas": f"{exact.gas:,} of the execution, exact ({report.chain})",
        "searched": f"{found.gas:,} by {found.calls} calls, which narrowed the limits from "
        f"{bracket.lower:,} .. {bracket.upper:,} to {last.lower:,} .. {last.upper:,}",
        "margin": f"{margin:,}, {_share(margin, exact.gas)}: a 64th of the gas is not passed on to an engine",
        "intrinsic": f"{exact.intrinsic_gas:,} to send the scene, not included in the figures above",
        "each": ", ".join(
            f"{gas:,.0f} per {what}"
            for gas, what in zip(per, ("triangle", "lit pixel"), strict=True)
            if gas is not None
        ),
        "transaction": f"{exact.transaction_gas:,} gas, {ether:.6g} ether at {gas_price:g} gwei{dollars}; "
        f"needs a limit of {report.request_limit:,}",
    } | ({"quick path": note} if note else {})


def _share(part: int, whole: int) -> str:
    return f"{100 * part / whole:.2f} %" if whole else ""
