"""Options of commands, and how messages name them."""

from __future__ import annotations

import re
from typing import Any

import typer

#: The options of the parameters that messages of the library name, as `max_triangles`.
OPTIONS = {
    "address": "--address",
    "any_chain": "--any-chain",
    "chain": "--chain",
    "cluster": "--cluster",
    "gas_limit": "--gas-limit",
    "host": "--host",
    "jobs": "--jobs",
    "licence": "--licence",
    "max_fee": "--max-fee",
    "max_triangles": "--max-triangles",
    "port": "--port",
    "rpc": "--rpc",
    "salt": "--salt",
    "size": "--size",
    "tile": "--tile",
    "timeout": "--rpc-timeout",
    "verify": "--verify",
}


def option(name: str, text: str, kind: str | None = None, panel: str | None = None, **more: Any) -> Any:
    """An option: its names, its help, what stands for its value there, and under which heading."""
    return typer.Option(*name.split(), help=text, metavar=kind, rich_help_panel=panel, **more)


def with_options(message: str) -> str:
    """Write a message of the library in one line, with options in place of the parameters that it names."""
    return re.sub(r"`(\w+)`", lambda match: OPTIONS.get(match[1], match[0]), " ".join(message.split()))
