"""Tables that read well as text and as Markdown, and numbers in them."""

from __future__ import annotations

from collections.abc import Sequence


def table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A Markdown table whose columns are aligned: the first to the left, the others to the right."""
    widths = [max(map(len, column)) for column in zip(head, *rows, strict=True)]
    rule = ["-" * widths[0], *("-" * (width - 1) + ":" for width in widths[1:])]

    def line(cells: Sequence[str]) -> str:
        first, *others = zip(cells, widths, strict=True)
        return "| " + " | ".join([first[0].ljust(first[1]), *(cell.rjust(width) for cell, width in others)]) + " |"

    return "\n".join([line(head), line(rule), *map(line, rows)])


def millions(gas: float | None, digits: int = 2) -> str:
    """Such as 4.93M; nothing for None."""
    return "" if gas is None else f"{gas / 1e6:,.{digits}f}M"


def ratio(a: float | None, b: float | None) -> str:
    """a / b, in whole numbers where it is large; nothing where either is None."""
    if not a or not b:
        return ""
    return f"{a / b:,.0f}" if a >= 20 * b else f"{a / b:.2f}"
