"""shackled creator"""

from __future__ import annotations

from importlib.util import find_spec
from typing import Annotated

import typer

from ..errors import InputError

#: The port of the page, unless it is taken or --port is given.
PORT = 8080


def creator(
    input: Annotated[
        str | None,
        typer.Argument(help="Mesh file, scene file or dataset piece to open.", metavar="[INPUT]"),
    ] = None,
    port: Annotated[
        int | None, typer.Option("--port", help=f"Port of the page. Default: {PORT}, or a free one.", min=0)
    ] = None,
    browser: Annotated[bool, typer.Option("--browser/--no-browser", help="Open the page in the browser.")] = True,
    host: Annotated[
        str, typer.Option("--host", help="Address to listen at. Any but 127.0.0.1 lets other machines connect.")
    ] = "127.0.0.1",
    name: Annotated[
        list[str] | None,
        typer.Option(
            "--name",
            help="Host name that requests may use, such as that of a proxy; may be repeated."
            " Addresses, localhost and the name of this machine are always allowed.",
            metavar="HOST",
        ),
    ] = None,
    rpc: Annotated[str | None, typer.Option("--rpc", help="Node to compare renders with.", metavar="URL")] = None,
) -> None:
    """Make pictures on a page in the browser."""
    if find_spec("nicegui") is None:
        raise InputError("the page needs the package nicegui: pip install 'shackled[creator]'")
    from ..creator.web.server import serve

    serve(input, host=host, port=port, fallback_port=PORT, open_browser=browser, node=rpc, names=name or ())
