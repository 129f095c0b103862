"""Pages that were sent and that no browser has opened yet: NiceGUI keeps half a megabyte for each of them."""

from __future__ import annotations

import asyncio
import time

from nicegui import Client, app
from starlette.requests import Request
from starlette.responses import PlainTextResponse, Response

#: How many are kept, and the seconds for which they are.
MOST, PATIENCE = 32, 15.0


def bound_pages() -> None:
    """Forgets the pages that nobody opens; to be called for each page that is made.

    Whoever asks for pages without opening them takes no memory but that of `MOST` pages. A browser that comes later
    than its page is kept asks for it again by itself.
    """
    now = time.time()
    unmet = sorted(client.created for client in Client.instances.values() if not client.has_socket_connection)
    if len(unmet) > MOST:
        Client.prune_instances(client_age_threshold=now - unmet[-MOST - 1])
    asyncio.get_running_loop().call_later(PATIENCE, lambda: Client.prune_instances(client_age_threshold=PATIENCE))


def plain_refusals() -> None:
    """Answers what is not there in plain text; NiceGUI would make a page of it, and keep that."""

    async def absent(request: Request, error: Exception) -> Response:
        return PlainTextResponse("there is nothing here", 404)

    app.add_exception_handler(404, absent)
