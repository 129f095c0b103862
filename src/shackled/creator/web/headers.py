"""What the server forbids: pages of others to speak with it, and its own to fetch anything from elsewhere."""

from __future__ import annotations

import ipaddress
import re
import secrets
import socket
from collections.abc import Iterable
from urllib.parse import urlsplit

from starlette.datastructures import Headers, MutableHeaders
from starlette.responses import PlainTextResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

LOCAL = ("127.0.0.1", "localhost", "::1")
#: What browsers say of requests of pages that are ours, and of addresses that somebody typed or chose from a list.
OWN_SITES = (None, "same-origin", "none")

#: Scripts of our own only, inline ones by a number that is new each time. Styles are set inline by Vue and Quasar.
POLICY = (
    "default-src 'none'; script-src 'self' 'nonce-{nonce}'; style-src 'self' 'unsafe-inline'; font-src 'self' data:;"
    " img-src 'self' data: blob:; connect-src 'self'; manifest-src 'self'; base-uri 'none'; form-action 'none';"
    " frame-ancestors 'none'; object-src 'none'"
)
FIXED = {
    "x-content-type-options": "nosniff",
    "x-frame-options": "DENY",
    "referrer-policy": "no-referrer",
    "cross-origin-opener-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
    "permissions-policy": "camera=(), geolocation=(), microphone=(), payment=(), usb=()",
}


class Guard:
    """Refuses what comes from pages of other sites, or to a name that is not ours, and adds the headers to the rest.

    local: whether it listens for this machine only. names: by which it is known besides its addresses; a page of
    another name could have had that name lead here (DNS rebinding), and is refused.
    """

    def __init__(self, app: ASGIApp, local: bool, names: Iterable[str] = ()) -> None:
        """`app`: what is guarded."""
        self.app = app
        self.local = local
        own = () if local else (socket.gethostname(), socket.getfqdn())
        self.names = {name.lower() for name in (*LOCAL, *own, *names)}

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serves one request or WebSocket."""
        if scope["type"] not in ("http", "websocket"):
            await self.app(scope, receive, send)
            return
        headers = Headers(scope=scope)
        if not (self._is_ours(headers) and _comes_from_us(scope, headers)):
            if scope["type"] == "http":
                await PlainTextResponse("not from here", 403)(scope, receive, send)
            else:
                await send({"type": "websocket.close", "code": 1008})
            return
        nonce = secrets.token_urlsafe(16)
        page: list[bytes] = []
        start: Message = {}

        async def dress(message: Message) -> None:
            nonlocal start
            if message["type"] == "http.response.start":
                sent = MutableHeaders(scope=message)
                for name, value in FIXED.items():
                    sent[name] = value
                sent["content-security-policy"] = POLICY.format(nonce=nonce)
                if sent.get("content-type", "").startswith("text/html"):
                    start = message  # held back until its length is known
                    return
            elif message["type"] == "http.response.body" and start:
                page.append(message.get("body", b""))
                if message.get("more_body"):
                    return
                html = numbered(b"".join(page), nonce)
                MutableHeaders(scope=start)["content-length"] = str(len(html))
                await send(start)
                message = {"type": "http.response.body", "body": html}
            await send(message)

        await self.app(scope, receive, dress)

    def _is_ours(self, headers: Headers) -> bool:
        """Whether the name that is asked for is one of this server."""
        try:
            name = urlsplit(f"//{headers.get('host', '')}").hostname or ""
        except ValueError:
            return False
        return name in self.names or (not self.local and _is_address(name))


def _comes_from_us(scope: Scope, headers: Headers) -> bool:
    """Whether a request comes from a page of ours, from a person, or from a program, and not from a page of others.

    Pages of others may lead here, in a window of its own; they can load nothing of ours, and so make no work.
    """
    origin = headers.get("origin")
    if origin is not None and origin.partition("://")[2] != headers.get("host", ""):
        return False
    if headers.get("sec-fetch-site") in OWN_SITES:
        return True
    goes_there = headers.get("sec-fetch-mode") == "navigate" and headers.get("sec-fetch-dest") == "document"
    return goes_there and scope["type"] == "http" and scope["method"] == "GET"


def _is_address(name: str) -> bool:
    """Whether it is an IP address, which nobody can have lead elsewhere."""
    try:
        ipaddress.ip_address(name)
    except ValueError:
        return False
    return True


def numbered(html: bytes, nonce: str) -> bytes:
    """The page with the number in each script element. What it shows holds none, for NiceGUI writes < as &lt; there."""
    return re.sub(rb"<script\b", f'<script nonce="{nonce}"'.encode(), html)
