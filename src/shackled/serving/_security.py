"""Middleware that refuses requests by pages of other sites and requests for other host names."""

from __future__ import annotations

import ipaddress
import socket
from collections.abc import Iterable
from urllib.parse import urlsplit

from starlette.datastructures import Headers, MutableHeaders
from starlette.responses import PlainTextResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

LOCAL = ("127.0.0.1", "localhost", "::1")
#: Values of Sec-Fetch-Site for requests by our own pages, and for addresses that were typed or bookmarked.
OWN_SITES = (None, "same-origin", "none")

HEADERS = {
    "content-security-policy": (
        "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; worker-src blob:; style-src 'self';"
        " img-src 'self' data: blob:; connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
    ),
    "x-content-type-options": "nosniff",
    "x-frame-options": "DENY",
    "referrer-policy": "no-referrer",
    "cross-origin-opener-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
    "permissions-policy": "camera=(), geolocation=(), microphone=(), payment=(), usb=()",
}


class SameOrigin:
    """ASGI middleware that refuses cross-origin requests and unknown host names, and adds the security headers.

    A page under an unknown host name could be an attacker's, whose name resolves to this machine (DNS rebinding).
    """

    def __init__(self, app: ASGIApp, local: bool, names: Iterable[str] = ()) -> None:
        """Wrap an application.

        local: whether the server listens on a loopback address only. names: allowed host names besides addresses.
        """
        self.app = app
        self.local = local
        own = () if local else (socket.gethostname(), socket.getfqdn())
        self.names = {name.lower() for name in (*LOCAL, *own, *names)}

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one request or WebSocket."""
        if scope["type"] not in ("http", "websocket"):
            await self.app(scope, receive, send)
            return

        async def send_with_headers(message: Message) -> None:
            if message["type"] == "http.response.start":
                sent = MutableHeaders(scope=message)
                for name, value in HEADERS.items():
                    # a response may have a stricter policy of its own
                    sent.setdefault(name, value)
                # otherwise browsers may combine scripts of an older version with a new page
                sent.setdefault("cache-control", "no-cache")
            await send(message)

        headers = Headers(scope=scope)
        if not (self._is_known_host(headers) and _is_same_origin(scope, headers)):
            if scope["type"] == "http":
                await PlainTextResponse("this request is not allowed", 403)(scope, receive, send_with_headers)
            else:
                await send({"type": "websocket.close", "code": 1008})
            return
        await self.app(scope, receive, send_with_headers)

    def _is_known_host(self, headers: Headers) -> bool:
        try:
            name = urlsplit(f"//{headers.get('host', '')}").hostname or ""
        except ValueError:
            return False
        return name in self.names or (not self.local and _is_address(name))


def _is_same_origin(scope: Scope, headers: Headers) -> bool:
    """Return whether a request was made by our page, by the user or by a program, and not by a page of another site.

    Links of other sites may lead here, in a window of its own; they cannot embed anything and so cause no work.
    """
    origin = headers.get("origin")
    if origin is not None and origin.partition("://")[2] != headers.get("host", ""):
        return False
    if headers.get("sec-fetch-site") in OWN_SITES:
        return True
    is_link = headers.get("sec-fetch-mode") == "navigate" and headers.get("sec-fetch-dest") == "document"
    return is_link and scope["type"] == "http" and scope["method"] == "GET"


def _is_address(name: str) -> bool:
    """Return whether a host name is an IP address, which cannot resolve to another machine."""
    try:
        ipaddress.ip_address(name)
    except ValueError:
        return False
    return True
