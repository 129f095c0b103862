"""shackled creator"""

from __future__ import annotations

from importlib.util import find_spec
from typing import Annotated

import typer

from ..errors import InputError

#: Default port.
PORT = 8080


def creator(
    input: Annotated[
        str | None,
        typer.Argument(help="Mesh or scene file, or piece of a dataset, to show first.", metavar="[INPUT]"),
    ] = None,
    port: Annotated[
        int | None, typer.Option("--port", help=f"Port of the page (default: {PORT}, or a free one).", min=0)
    ] = None,
    browser: Annotated[bool, typer.Option("--browser/--no-browser", help="Open the page in the browser.")] = True,
    host: Annotated[
        str, typer.Option("--host", help="Address to listen on; any other than 127.0.0.1 accepts other machines.")
    ] = "127.0.0.1",
    name: Annotated[
        list[str] | None,
        typer.Option(
            "--name",
            help="Allowed host name, such as that of a proxy; may be repeated. Addresses, localhost and the name of"
            " this machine are always allowed.",
            metavar="HOST",
        ),
    ] = None,
    rpc: Annotated[str | None, typer.Option("--rpc", help="Node to compare pictures with.", metavar="URL")] = None,
) -> None:
    """Make pictures on a page in the browser, without code."""
    if not all(map(find_spec, ("jinja2", "starlette", "uvicorn", "websockets"))):
        raise InputError("the page needs more packages: pip install 'shackled[creator]'")
    from ..creator import serve

    serve(input, host=host, port=port, fallback_port=PORT, open_browser=browser, node=rpc, names=name or ())
