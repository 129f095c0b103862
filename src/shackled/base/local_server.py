"""Pages for the browser of the user: a server on this machine, which other sites can neither read nor embed."""

from __future__ import annotations

import sys
import webbrowser
from collections.abc import Callable, Iterable
from contextlib import suppress
from email.message import Message
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import PurePath
from threading import Thread
from typing import Any
from urllib.parse import unquote

from attrs import Factory, frozen

from ..errors import InputError

HOST = "127.0.0.1"
HEADERS = {
    # otherwise browsers may combine scripts of an older version with a new page
    "Cache-Control": "no-cache",
    "Content-Security-Policy": "frame-ancestors 'none'",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
}
TYPES = {".html": "text/html", ".css": "text/css", ".js": "text/javascript", ".json": "application/json"}
TYPES |= {".jpg": "image/jpeg", ".wasm": "application/wasm"}


@frozen
class Answer:
    """What is sent for a path. body: in parts that are sent as they come, if it is not bytes. headers: further ones."""

    body: bytes | Iterable[bytes]
    kind: str
    headers: dict[str, str] = Factory(dict)


def type_of(name: str) -> str:
    """Return the media type of a file."""
    return TYPES.get(PurePath(name).suffix, "application/octet-stream")


def listen(answer: Callable[[str], Answer | None], port: int | None, fallback: int) -> ThreadingHTTPServer:
    """Return a server that has its port, at which `run` answers.

    answer: what is sent for a path, such as "/data/a.js"; None for 404. port: None takes the other, or a free one.
    """

    class Handler(_Handler):
        find = staticmethod(answer)

    reason: str | None = None
    for number in (fallback, 0) if port is None else (port,):
        try:
            return _Server((HOST, number), Handler)
        except (OSError, OverflowError) as error:
            reason = getattr(error, "strerror", None) or str(error)
    raise InputError(f"port {number} of {HOST} cannot be used: {reason}; choose another `port`")


def run(server: ThreadingHTTPServer, announcement: str, place: str, browse: bool) -> None:
    """Answer until the process is interrupted. place: what of the address follows the port. browse: whether to open it
    in the browser.
    """
    address = f"http://{HOST}:{server.server_port}{place}"
    print(f"{announcement} {address} (press Ctrl-C to end it)", flush=True)
    if browse:
        Thread(target=_open, args=(address,), daemon=True).start()
    with server, suppress(KeyboardInterrupt):
        server.serve_forever()


def _open(address: str) -> None:
    if not webbrowser.open(address):
        print(f"no browser could be started: open {address} in one", file=sys.stderr, flush=True)


class _Server(ThreadingHTTPServer):
    def handle_error(self, request: Any, client_address: Any) -> None:
        """Do not tell that a page was closed before it had its answer."""
        if not isinstance(sys.exception(), ConnectionError):
            super().handle_error(request, client_address)


class _Handler(BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    find: Callable[[str], Answer | None]

    def do_GET(self) -> None:
        """Answer a request."""
        is_own = is_trusted(self.headers, self.connection.getsockname()[1])
        found = self.find(unquote(self.path.partition("?")[0])) if is_own else None
        status = 403 if not is_own else 404 if found is None else 200
        answer = found or Answer(b"", "text/plain")
        body = answer.body
        headers = {**HEADERS, **answer.headers, "Content-Type": answer.kind}
        headers |= {"Content-Length": str(len(body))} if isinstance(body, bytes) else {"Connection": "close"}
        self.send_response(status)
        for name, value in headers.items():
            self.send_header(name, value)
        self.end_headers()
        if self.command == "GET":
            for part in [body] if isinstance(body, bytes) else body:
                self.wfile.write(part)

    do_HEAD = do_GET

    def log_message(self, format: str, *arguments: object) -> None:
        """Print nothing."""


def is_trusted(headers: Message, port: int) -> bool:
    """Return whether a request is of our page, of the user or of a program, and not of a page of another site.

    Under another host name, it could be of an attacker's page, whose name resolves to this machine. Links of other
    sites may lead here, in a window of its own.
    """
    # browsers leave out the usual port
    hosts = [f"{name}:{port}".removesuffix(":80") for name in (HOST, "localhost")]
    if headers.get("Host", "").lower() not in hosts:
        return False
    origin = headers.get("Origin")
    if origin is not None and origin.removeprefix("http://") not in hosts:
        return False
    is_link = headers.get("Sec-Fetch-Mode") == "navigate" and headers.get("Sec-Fetch-Dest") == "document"
    return is_link or headers.get("Sec-Fetch-Site") in (None, "same-origin", "none")
