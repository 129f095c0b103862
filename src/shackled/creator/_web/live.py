"""The visitors who have the page open, and the WebSocket of each.

A page connects to /live?p=LINK, and on reconnection to /live?p=LINK&visitor=NAME. It sends messages {"do": name, ...},
see `actions`. It is sent messages with some of the keys

    visitor     its name, first of all
    values      of controls by path: {"value", "changed": is not the source's, "mixed": differs between objects}
    texts, attributes, html   of elements by name; an attribute that is null is removed
    spheres     positions of the lights by number, null where there is none
    aspect, link    of the picture
    say, note, alert    for screen readers, for everyone, for everyone with emphasis
    open, close, download   a dialog by its id, a file by its address
    wallet      request to the visitor's wallet: {"id", "wallet", "method", "params"}

and pictures: four bytes of length, that much JSON ("number", "draft", "moves": number of changes that it shows, "show":
a message, "view": null for drafts), and the BMP file as returned by the contract. A view is what the page needs to draw
the pictures of a movement itself: "camera", "key": a digest of everything else, "follow": whether the lights move with
the camera, "stamp": that of the last message "camera" that the picture shows. /call/NAME returns the current view, with
"radius": its length in the call, and the call, packed in the same way.
"""

from __future__ import annotations

import asyncio
import json
import secrets
import time
from contextlib import suppress

from starlette.websockets import WebSocket, WebSocketDisconnect

from ...errors import InputError, ShackledError
from .._link import from_link, is_local
from .._pool import Pool
from .._state import Source, State
from .actions import act
from .visitor import Message, Visitor

#: Largest number of visitors.
MAX_VISITORS = 500
#: Seconds after which a disconnected visitor is forgotten.
ABSENCE = 120
#: Largest number of bytes of a message from the page.
MAX_MESSAGE = 65536
#: Seconds that a connection may take for one message. A page that vanished would keep its place much longer, since
#: pings are not answered but the connection is closed only when the buffered message is sent.
MAX_SENDING = 40


class Visitors:
    """All visitors, by names that cannot be guessed."""

    def __init__(self, pool: Pool, first: Source) -> None:
        """Begin without visitors. pool: renders for all of them. first: the source for visitors without a link."""
        self.pool = pool
        self.first = first
        self._all: dict[str, Visitor] = {}

    async def add(self, link: str = "") -> Visitor:
        """Add a visitor with the state of a link. InputError if there are too many visitors."""
        state, greeting, wanted = State(self.first), "", None
        if link:
            try:
                wanted = from_link(link)
                await self.pool.open(wanted.source)
                state, wanted = wanted, None
            except ShackledError as error:
                greeting = str(error)
        facts = await self.pool.open(state.source)
        visitor = Visitor(secrets.token_urlsafe(18), self.pool, state, facts)
        if wanted is not None and wanted.source.kind == "upload":
            visitor.wanted, greeting = wanted, f"{greeting}, and the picture is restored"
        visitor.greeting = greeting
        self._forget()  # others may have come while the source was opened
        self._all[visitor.name] = visitor
        return visitor

    def find(self, name: str) -> Visitor | None:
        """Return the visitor of a name, or None."""
        return self._all.get(name)

    def drop(self, visitor: Visitor) -> None:
        """Forget a visitor who has been disconnected for long."""
        if not visitor.present and time.monotonic() - visitor.seen >= ABSENCE:
            self._remove(visitor)

    def _forget(self) -> None:
        """Make room for a visitor. InputError if all visitors are connected."""
        absent = sorted((each for each in self._all.values() if not each.present), key=lambda each: each.seen)
        for visitor in absent:
            self.drop(visitor)
            if len(self._all) >= MAX_VISITORS:
                self._remove(visitor)
        if len(self._all) >= MAX_VISITORS:
            raise InputError(f"there are {MAX_VISITORS} visitors already; try again in a few minutes")

    def _remove(self, visitor: Visitor) -> None:
        visitor.end()
        self._all.pop(visitor.name, None)


async def live(socket: WebSocket, visitors: Visitors) -> None:
    """Serve one page until it disconnects."""
    await socket.accept()
    turn, lost = asyncio.Lock(), asyncio.timeout(None)

    async def send(message: Message | bytes) -> None:
        # the lock makes senders wait: pictures are not sent faster than the connection takes them
        async with turn:
            try:
                async with asyncio.timeout(MAX_SENDING):
                    if isinstance(message, bytes):
                        await socket.send_bytes(message)
                    else:
                        await socket.send_text(json.dumps(message))
            except TimeoutError:
                with suppress(RuntimeError):  # the page is gone already
                    lost.reschedule(asyncio.get_running_loop().time())
            except (RuntimeError, WebSocketDisconnect):  # disconnected meanwhile
                return

    visitor = visitors.find(socket.query_params.get("visitor", ""))
    if visitor is None:
        try:
            visitor = await visitors.add(socket.query_params.get("p", ""))
        except ShackledError as error:
            await send({"alert": str(error)})
            await socket.close(1013)
            return
        visitor.is_local = is_local(str(socket.url))
    try:
        async with lost:
            await visitor.join(send)
            while True:
                text = await socket.receive_text()
                if len(text) > MAX_MESSAGE:
                    continue
                try:
                    message = json.loads(text)
                except (ValueError, RecursionError):
                    continue
                await act(visitor, message)
    except (WebSocketDisconnect, KeyError, RuntimeError, TimeoutError):
        return
    finally:
        visitor.leave(send)
        asyncio.get_running_loop().call_later(ABSENCE, visitors.drop, visitor)
