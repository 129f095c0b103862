"""shackled creator"""

from __future__ import annotations

from importlib.util import find_spec
from typing import Annotated

import typer

from ..errors import InputError

#: Where the page is looked for first, if nothing is said.
PORT = 8080


def creator(
    input: Annotated[
        str | None,
        typer.Argument(help="What to begin with: a mesh or scene file, or a piece of a dataset.", metavar="[INPUT]"),
    ] = None,
    port: Annotated[
        int | None, typer.Option("--port", help=f"The port of the page; by default {PORT}, or one that is free.", min=0)
    ] = None,
    browser: Annotated[
        bool, typer.Option("--browser/--no-browser", help="Open the page in the browser at once.")
    ] = True,
    host: Annotated[
        str, typer.Option("--host", help="The address to listen at. Others than 127.0.0.1 let others in.")
    ] = "127.0.0.1",
    name: Annotated[
        list[str] | None,
        typer.Option(
            "--name",
            help="A name under which the page may be asked for, such as that of a proxy before it; may be repeated."
            " Addresses, localhost and the name of this machine need not be given.",
            metavar="HOST",
        ),
    ] = None,
    rpc: Annotated[
        str | None, typer.Option("--rpc", help="A node, with whose pictures ours can be compared.", metavar="URL")
    ] = None,
) -> None:
    """Make pictures on a page in the browser, without code."""
    if find_spec("nicegui") is None:
        raise InputError("the page needs the package nicegui: pip install 'shackled[creator]'")
    from ..creator.web.server import serve

    serve(input, host=host, port=port, fallback_port=PORT, open_browser=browser, node=rpc, names=name or ())
