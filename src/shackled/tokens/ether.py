"""Amounts of ether: on chain they are whole numbers of wei, 10^18 to the ether."""

from __future__ import annotations

import re
from decimal import Decimal

from ..errors import InputError

WEI = 10**18
MAX_ETHER = 10**9


def ether(wei: int) -> str:
    """An amount for people, exact, as "0.15 ether"."""
    return f"{amount(wei)} ether"


def amount(wei: int) -> str:
    """An amount in ether, exact, in decimal digits."""
    whole, rest = divmod(wei, WEI)
    return f"{whole}.{rest:018}".rstrip("0").rstrip(".")


def roughly(wei: int) -> str:
    """An amount for people, to three digits."""
    if wei < 10**11:
        return ether(wei) if wei == 0 else f"{Decimal(f'{wei:.3g}') / 10**9:f} gwei"
    return f"{Decimal(f'{wei:.3g}') / WEI:f} ether"


def parse_ether(text: str, name: str) -> int:
    """The wei of an amount in ether, such as 0.15; in wei or gwei with the unit behind it. InputError if it is none."""
    match = re.fullmatch(r"(\d{1,30})(?:\.(\d{1,18}))?\s*(ether|eth|gwei|wei)?", text.strip())
    if match:
        unit = {"wei": 1, "gwei": 10**9}.get(match[3] or "ether", WEI)
        value = Decimal(f"{match[1]}.{match[2] or 0}").scaleb(0) * unit
        if value == int(value) and value <= MAX_ETHER * WEI:
            return int(value)
    raise InputError(f"{name} must be an amount of ether such as 0.15, or with its unit as 20gwei, not {text!r:.60}")
