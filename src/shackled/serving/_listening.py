"""Sockets on which the pages are served, and the browser that shows them."""

from __future__ import annotations

import asyncio
import errno
import socket
import sys
import threading
import webbrowser
from typing import Any

import uvicorn
from starlette.types import ASGIApp

from ..errors import InputError


def listen(host: str, port: int | None, fallback: int) -> socket.socket:
    """Return a listening socket. InputError if the address or the port cannot be used."""
    try:
        family = socket.getaddrinfo(host, None, type=socket.SOCK_STREAM)[0][0]
    except OSError:
        raise InputError(f"`host` must be an address of this machine such as 127.0.0.1, not {host!r}") from None
    if port is not None and port > 65535:
        raise InputError(f"`port` must be from 1 to 65535, not {port}")
    wanted = (fallback, 0) if port is None else (port,)
    for number in wanted:
        # with an explicit protocol, or asyncio would not set TCP_NODELAY
        listening = socket.socket(family, socket.SOCK_STREAM, socket.IPPROTO_TCP)
        listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listening.bind((host, number))
        except OSError as error:
            listening.close()
            if error.errno == errno.EADDRNOTAVAIL:
                raise InputError(f"`host` must be an address of this machine such as 127.0.0.1, not {host!r}") from None
            if number == wanted[-1]:
                reason = error.strerror or str(error)
                raise InputError(f"port {number} of {host} cannot be used: {reason}; choose another `port`") from None
            continue
        return listening
    raise AssertionError("unreachable: the last port was bound or refused")


def url_of(host: str, listening: socket.socket) -> str:
    """Return the address of the page for a browser on this machine."""
    name = f"[{host}]" if ":" in host else "localhost" if host in ("0.0.0.0", "::") else host
    return f"http://{name}:{listening.getsockname()[1]}/"


async def run(app: ASGIApp, listening: socket.socket, announcement: str, browse: bool, **settings: Any) -> None:
    """Serve an application until the process is interrupted.

    announcement: printed once the server accepts requests; it ends in the address. browse: whether the address is
    opened in the browser. settings: further ones of uvicorn.
    """
    defaults: dict[str, Any] = {"log_level": "warning", "timeout_graceful_shutdown": 2, "ws": "websockets-sansio"}
    server = uvicorn.Server(uvicorn.Config(app, server_header=False, **(defaults | settings)))
    watch = asyncio.create_task(_announce(server, announcement, browse))
    try:
        await server.serve(sockets=[listening])
    finally:
        watch.cancel()


async def _announce(server: uvicorn.Server, announcement: str, browse: bool) -> None:
    while not server.started:
        await asyncio.sleep(0.01)
    print(f"{announcement} (press Ctrl-C to end it)", flush=True)
    if browse:
        threading.Thread(target=open_in_browser, args=(announcement.rpartition(" ")[2],), daemon=True).start()


def open_in_browser(address: str) -> None:
    """Open an address in the browser, or ask the user to do so."""
    if not webbrowser.open(address):
        print(f"no browser could be started: open {address} in one", file=sys.stderr, flush=True)
