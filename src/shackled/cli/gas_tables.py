"""Print the tables of `shackled gas`."""

from __future__ import annotations

import sys

from rich.console import Console
from rich.table import Table

from ..gas import KINDS, STACK, GasReport, Profile
from ..values import plural

BAR = 24
#: Number of functions and lines shown.
ROWS = 20


def print_report(report: GasReport, gas_price: float, eth_price: float | None) -> None:
    """Print gas, search, stages, price, and the limits that the gas fits."""
    console = _console()
    for label, value in _figures(report, gas_price, eth_price).items():
        console.print(f"{label:12} {value}", highlight=False, markup=False, soft_wrap=True)
    if report.profile is not None:
        console.print()
        console.print(_stages(report.profile))
    console.print()
    console.print(_fits(report))
    console.print(
        "As documented by the sources on these dates, not measured; operators change them. "
        "The limit of a request includes the intrinsic gas.",
        style="dim",
        soft_wrap=True,
    )


def print_opcodes(profile: Profile) -> None:
    """Print gas by kind of opcode, and their shares in each stage."""
    console = _console()
    kinds = Table("opcodes", "gas", "", box=None, header_style="bold")
    _right(kinds, 1, 2)
    for kind, gas in profile.opcodes().items():
        kinds.add_row(kind, f"{gas:,}", _share(gas, profile.gas))
    stages = Table("stage", *KINDS, box=None, header_style="bold")
    _right(stages, *range(1, 1 + len(KINDS)))
    for stage, whole in profile.stages().items():
        if whole:
            stages.add_row(stage, *(_share(gas, whole) for gas in profile.opcodes(stage).values()))
    for table in (kinds, stages):
        console.print()
        console.print(table)


def print_profile(profile: Profile, opcodes: bool) -> None:
    """Print gas by function, and by line. opcodes: also the share of `STACK` in the own gas of a function."""
    console = _console()
    more = [STACK] if opcodes else []
    functions = Table("function", "self", "", "with calls", *more, box=None, header_style="bold")
    _right(functions, *range(1, 4 + opcodes))
    for each in profile.functions()[:ROWS]:
        shares = [_share(profile.opcodes(function=each.name)[STACK], each.own)] if opcodes else []
        functions.add_row(each.name, f"{each.own:,}", _share(each.own, profile.gas), f"{each.total:,}", *shares)
    lines = Table("line", "function", "gas", "", box=None, header_style="bold")
    _right(lines, 2, 3)
    for place, function, gas in profile.lines()[:ROWS]:
        lines.add_row(place, function, f"{gas:,}", _share(gas, profile.gas))
    for table in (functions, lines):
        console.print()
        console.print(table)
    console.print()


def _console() -> Console:
    # files need no narrow tables
    return Console(file=sys.stdout, width=None if sys.stdout.isatty() else 160)


def _figures(report: GasReport, gas_price: float, eth_price: float | None) -> dict[str, str]:
    exact, found, margin = report.exact, report.search, report.margin
    bracket = next(step for step in found.steps if step.upper is not None)
    last = found.steps[-1]
    ether = report.ether(gas_price)
    dollars = "" if eth_price is None else f", {ether * eth_price:,.2f} US dollars at {eth_price:,g} per ether"
    per = (report.per(report.triangles), report.per(report.lit_pixels))
    figures = {
        "picture": f"{report.scene.width} x {report.scene.height} pixels; "
        f"{plural(report.triangles, 'triangle')}, {plural(report.lit_pixels, 'lit pixel')}",
        "gas": f"{exact.gas:,} of the execution, exact ({report.chain})",
        "searched": f"{found.gas:,} by {found.calls} calls, which narrowed the limits from "
        f"{bracket.lower:,} .. {bracket.upper:,} to {last.lower:,} .. {last.upper:,}",
        "margin": f"{margin.gas:,}, {_share(margin.gas, exact.gas)}: "
        + (
            f"a 64th of the gas is not passed on to an engine, which needs {exact.dearest_call:,}, "
            f"so {margin.kept:,} must be left; the Renderer uses {margin.after:,} of it after the call"
        ),
        "intrinsic": f"{exact.intrinsic_gas:,} to send the scene, not included in the figures above",
        "each": ", ".join(
            f"{gas:,.0f} per {what}"
            for gas, what in zip(per, ("triangle", "lit pixel"), strict=True)
            if gas is not None
        ),
        "transaction": f"{exact.transaction_gas:,} gas, {ether:.6g} ether at {gas_price:g} gwei{dollars}; "
        f"needs a limit of {report.request_limit:,}",
    }
    return {label: text for label, text in figures.items() if text}


def _stages(profile: Profile) -> Table:
    table = Table("stage", "gas", "", "", box=None, header_style="bold")
    _right(table, 1, 2)
    stages = profile.stages()
    most = max(stages.values())
    for stage, gas in stages.items():
        bar = "█" * round(BAR * gas / most) if most else ""
        table.add_row(stage, f"{gas:,}", _share(gas, profile.gas), bar)
    table.add_row("total", f"{profile.gas:,}", "", "", style="bold")
    return table


def _fits(report: GasReport) -> Table:
    table = Table("where it fits", "limit", "of it", "", "source", "date", box=None, header_style="bold")
    _right(table, 1, 2)
    table.columns[4].overflow = "fold"
    for fit in report.fits:
        limit, fits = fit.limit, "[green]yes[/]" if fit.fits else f"[red]no[/]{fit.reason and f', {fit.reason}'}"
        share = f"{100 * report.request_limit / limit.gas:.0f} %"
        table.add_row(limit.name, f"{limit.gas:,}", share, fits, limit.source, limit.date)
    return table


def _right(table: Table, *columns: int) -> None:
    for column in columns:
        table.columns[column].justify = "right"


def _share(part: int, whole: int) -> str:
    return f"{100 * part / whole:.2f} %" if whole else ""
