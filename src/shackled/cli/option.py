"""Options of commands."""

from __future__ import annotations

from typing import Any

import typer


def option(name: str, text: str, kind: str | None = None, panel: str | None = None, **more: Any) -> Any:
    """An option: its names, its help, what stands for its value there, and under which heading."""
    return typer.Option(*name.split(), help=text, metavar=kind, rich_help_panel=panel, show_default=False, **more)
