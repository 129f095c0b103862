"""The documented gas limits of transactions, nodes and providers, from limits.toml."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from functools import cache
from importlib.resources import files


@dataclass(frozen=True)
class Limit:
    """The gas limit of one request. kind: "transaction" or "call". date: date of the source."""

    name: str
    gas: int
    kind: str
    source: str
    date: str
    remark: str = ""


@cache
def limits() -> tuple[Limit, ...]:
    """Return all known limits, the lowest first."""
    data = tomllib.loads(files(__package__).joinpath("limits.toml").read_text("utf-8"))
    return tuple(sorted((Limit(**entry) for entry in data["limit"]), key=lambda limit: limit.gas))
