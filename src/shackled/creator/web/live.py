"""The wire between a page and the server: a WebSocket.

From the page come messages {"do": name, ...}, see `actions`. To the page go messages of what it is to show:

    values      of controls, by path: {"value", "changed": from the source's own, "mixed": not the same for all objects}
    texts, attributes   of elements, by name; an attribute that is null is taken away
    spheres     where the lights stand, by their number; null for those that are not there
    aspect, link        of the picture
    say, note, alert    to a screen reader, to all, to all and with emphasis
    open, close, download   a dialog by its id, a file by its address
    wallet      what to ask the visitor's wallet: {"id", "wallet", "method", "params"}

and pictures: four bytes of length, that much JSON ("number", "draft", "moves": how many changes it shows, "show": a
message as above), and the BMP file that the contract returned. They do not go through NiceGUI, which keeps what it sent
for a while to send it again; a picture is of no use when the next one is there.
"""

from __future__ import annotations

import asyncio
import json

from starlette.websockets import WebSocket, WebSocketDisconnect

from .actions import act
from .visitor import Message
from .visitors import Visitors

#: Bytes of a message from the page.
MAX_MESSAGE = 65536
#: The code with which a wire is closed whose visitor is not known (any more).
UNKNOWN = 4404


async def live(socket: WebSocket, visitors: Visitors) -> None:
    """Serves one page until it goes."""
    visitor = visitors.find(socket.path_params["visitor"])
    await socket.accept()
    if visitor is None:
        await socket.close(UNKNOWN)
        return
    turn = asyncio.Lock()

    async def send(message: Message | bytes) -> None:
        # who sends waits until it is sent: nobody is sent more pictures than their line takes
        async with turn:
            try:
                if isinstance(message, bytes):
                    await socket.send_bytes(message)
                else:
                    await socket.send_text(json.dumps(message))
            except (RuntimeError, WebSocketDisconnect):  # gone in the meantime
                return

    try:
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
    except (WebSocketDisconnect, KeyError, RuntimeError):
        return
    finally:
        visitor.leave(send)
