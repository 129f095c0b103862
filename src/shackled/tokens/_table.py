"""What everything around tokens costs, beside what the original paid."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Cost:
    """Something that was done, and its gas: of a transaction all that was paid, of a read the execution alone.

    original: what the Shackled contracts of 2021 took for the same, lowest and highest; None where they had no such
    thing, or it was not measured.
    """

    name: str
    gas: int
    original: tuple[int, int] | None = None


#: Measured of the contracts of 2021.
ORIGINAL_MINT_1 = (124_000, 124_000)
ORIGINAL_MINT_5 = (712_000, 712_000)
ORIGINAL_TOKEN_URI = (5_700_000_000, 14_400_000_000)


def comparison(costs: Sequence[Cost]) -> list[tuple[str, str, str, str]]:
    """Return a heading, and a row for each action: what, gas, gas of the original, how many times less."""
    rows = [("action", "gas", "original", "times less")]
    for cost in costs:
        if cost.original is None:
            rows.append((cost.name, f"{cost.gas:,}", "-", "-"))
            continue
        low, high = cost.original
        original = short_gas(low) if low == high else f"{short_gas(low)} to {short_gas(high)}"
        ratios = [f"{each / cost.gas:,.{1 if each < 20 * cost.gas else 0}f}" for each in (low, high)]
        rows.append((cost.name, f"{cost.gas:,}", original, " to ".join(dict.fromkeys(ratios))))
    return rows


def markdown(costs: Sequence[Cost]) -> str:
    """Return the comparison as a table of Markdown."""
    head, *rows = comparison(costs)
    lines = [head, ("---", "---:", "---:", "---:"), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"


def short_gas(gas: int) -> str:
    """Gas for people, to the thousand or the million."""
    return f"{gas / 1e6:,.0f} M" if gas >= 10_000_000 else f"{gas / 1e3:,.0f} k"
