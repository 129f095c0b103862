"""shackled gas"""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Annotated, Any

from ..chain import CHAINS, PATIENCE, NodeChain, open_chain, open_node
from ..errors import InputError
from ..gas import STAGES, flame_graph, make_report, render_call
from ..whole_file import check_output_file, write_output
from .gas_progress import Progress
from .gas_tables import print_opcodes, print_profile, print_report
from .look_options import FIT, Look, load_with
from .option import argument, option

#: The chains that count gas.
EVMS = tuple(CHAINS)


def gas(
    input: Annotated[str, argument("Mesh file, scene file, or name of a piece.", "INPUT")],
    *,
    look: Look,
    evm: Annotated[
        str | None,
        option("--evm", f"EVM to measure in: {', '.join(EVMS)}; default: revm.", "NAME"),
    ] = None,
    rpc: Annotated[
        str | None,
        option("--rpc", "Node that also counts the gas, and runs the search.", "URL", envvar="SHACKLED_RPC"),
    ] = None,
    address: Annotated[str | None, option("--address", "Address of a renderer on the node's chain.", "ADDRESS")] = None,
    rpc_timeout: Annotated[
        float | None, option("--rpc-timeout", f"Timeout of a call to the node (default: {PATIENCE:g}).", "SECONDS")
    ] = None,
    fit: Annotated[str | None, FIT] = None,
    as_json: Annotated[bool, option("--json", "Print a JSON object instead of tables.")] = False,
    profile: Annotated[
        str | None,
        option(
            "--profile",
            "Also show gas by function and line, and write a flame graph, an .svg file.",
            "FILE",
        ),
    ] = None,
    opcodes: Annotated[
        bool,
        option(
            "--opcodes",
            "Also show gas by kind of opcode, by stage, and with --profile by function: stack, jumps, memory.",
        ),
    ] = False,
    stages: Annotated[bool, option("--stages/--no-stages", "Show gas by stage.")] = True,
    gas_price: Annotated[float, option("--gas-price", "Gas price in gwei.", "GWEI")] = 1.0,
    eth_price: Annotated[float | None, option("--eth-price", "Price of one ether in US dollars.", "USD")] = None,
    lower: Annotated[
        int, option("--lower", "Lower bound of the search: an insufficient gas limit.", "GAS", "Search")
    ] = 0,
    upper: Annotated[
        int | None,
        option(
            "--upper", "Upper bound of the search: a sufficient gas limit. Default: found by doubling.", "GAS", "Search"
        ),
    ] = None,
) -> None:
    """Measure the gas of a picture: exactly, by binary search, by stage and by line, and compare it with limits."""
    path = None if profile is None else _check_profile(profile)
    _check_price(gas_price, "--gas-price", "gwei per gas")
    if eth_price is not None:
        _check_price(eth_price, "--eth-price", "US dollars per ether")
    for name, given in (("--profile", path is not None), ("--opcodes", opcodes)):
        if given and not stages:
            raise InputError(f"{name} and --no-stages exclude each other: give one of them")
    place = open_chain(evm)
    node = _open_node(rpc, address, rpc_timeout)
    scene = load_with(input, look, fit)
    with Progress(quiet=as_json) as progress:
        report = make_report(scene, place, lower, upper, stages, progress.step, node)
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
        print(json.dumps({"input": input} | report.to_json(gas_price, eth_price) | more))
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
    if rpc is not None and rpc.strip():
        # the variable may name several
        return open_node(rpc.split()[0], address, timeout)
    for name, value in (("--address", address), ("--rpc-timeout", timeout)):
        if value is not None:
            raise InputError(f"{name} needs --rpc")
    return None


def _check_profile(name: str) -> Path:
    path = Path(name)
    if path.suffix.lower() != ".svg":
        raise InputError(f"--profile writes an .svg file, not {name!r}")
    return check_output_file(path, "profile")


def _check_price(value: float, name: str, unit: str) -> None:
    if not (math.isfinite(value) and value >= 0):
        raise InputError(f"{name} must be 0 or more {unit}, not {value}")
