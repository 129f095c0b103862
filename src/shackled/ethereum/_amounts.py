"""Amounts of ether, which are whole numbers of wei on chain: 1 ether is 10^18 wei."""

from __future__ import annotations

import re
from decimal import ROUND_UP, Context, Decimal

from ..errors import InputError

#: In wei.
ETHER = 10**18
GWEI = 10**9
#: More than exists.
MAX_ETHER = 10**9


def ether(wei: int) -> str:
    """Write an amount exactly, as "0.15 ether"."""
    return f"{amount(wei)} ether"


def amount(wei: int) -> str:
    """Write an amount in ether exactly, in decimal digits without the unit."""
    whole, rest = divmod(wei, ETHER)
    return f"{whole}.{rest:018}".rstrip("0").rstrip(".")


def roughly(wei: int) -> str:
    """Write an amount to three digits, in ether or gwei."""
    if wei < 10**11:
        return ether(wei) if wei == 0 else f"{Decimal(f'{wei:.3g}') / GWEI:f} gwei"
    return f"{Decimal(f'{wei:.3g}') / ETHER:f} ether"


def rounded(wei: int) -> str:
    """Write an amount in ether to six decimal places, or to two digits if that would be zero."""
    text = f"{wei / ETHER:.6f}".rstrip("0").rstrip(".")
    return text if wei == 0 or float(text) else f"{wei / ETHER:.2g}"


def at_most(wei: int) -> str:
    """Write an amount in ether to six digits, rounded up."""
    return f"{Context(prec=6, rounding=ROUND_UP).create_decimal(Decimal(wei)) / ETHER:f}"


def parse_ether(text: str, name: str) -> int:
    """Parse an amount such as "0.15", "20gwei" or "7 wei", by default in ether, and return wei.

    Raises InputError, which names `name`, if it is invalid.
    """
    match = re.fullmatch(r"(\d{1,30})(?:\.(\d{1,18}))?\s*(ether|eth|gwei|wei)?", text.strip())
    if match:
        unit = {"wei": 1, "gwei": GWEI}.get(match[3] or "ether", ETHER)
        value = Decimal(f"{match[1]}.{match[2] or 0}") * unit
        if value == int(value) and value <= MAX_ETHER * ETHER:
            return int(value)
    raise InputError(f"{name} must be an amount of ether such as 0.15, or with its unit as 20gwei, not {text!r:.60}")
