"""The server of the page: its routes, and how it starts and ends."""

from __future__ import annotations

import asyncio
import hashlib
import io
import json
import re
import socket
import sys
import zipfile
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

from starlette.applications import Starlette
from starlette.middleware import Middleware
from starlette.middleware.gzip import GZipMiddleware
from starlette.requests import ClientDisconnect, Request
from starlette.responses import HTMLResponse, PlainTextResponse, Response
from starlette.routing import Mount, Route, WebSocketRoute
from starlette.staticfiles import StaticFiles
from starlette.types import ASGIApp
from starlette.websockets import WebSocket

from ..._load import locate
from ...chain import open_node
from ...datasets import Piece
from ...errors import InputError, ShackledError
from ...serving import LOCAL, SameOrigin, listen, run, url_of
from ...web import asset
from .._pool import Pool
from .._state import Source
from .live import MAX_MESSAGE, Visitors, live
from .page import ASSETS, has_thumbnail, page
from .visitor import Visitor, with_head

#: What visitors see first, by default.
FIRST = "icons/shackle"
#: Largest number of bytes of the names and sizes in an upload.
MAX_HEAD = 16384
#: Files with which the page draws the pictures of a movement, and their media types.
WEB = {"live.js": "text/javascript", "evm.wasm": "application/wasm", "contracts.json": "application/json"}
#: Seconds that sending an upload may take.
MAX_SENDING = 300


def serve(
    input: str | None,
    host: str,
    port: int | None,
    fallback_port: int,
    open_browser: bool,
    node: str | None,
    names: Sequence[str] = (),
) -> None:
    """Serve the page until it is interrupted. InputError for a wrong argument.

    input: what visitors see first. port: None takes `fallback_port`, or a free one if that is in use. node: address of
    a node with which visitors can compare pictures. names: allowed host names besides the addresses of this machine.
    """
    first = None if input is None else locate(input)
    if node is not None:
        open_node(node)  # raises the error; sends nothing yet
    with listen(host, port, fallback_port) as listening, suppress(KeyboardInterrupt):
        asyncio.run(_serve(first, listening, host, open_browser, node, names))


async def _serve(
    first: Path | Piece | None,
    listening: socket.socket,
    host: str,
    browse: bool,
    node: str | None,
    names: Sequence[str],
) -> None:
    pool = Pool(node=node)
    try:
        # the workers start while the page is made
        _, html = await asyncio.gather(pool.start(), asyncio.to_thread(page, pool.has_node))
        visitors = Visitors(pool, await first_source(pool, first))
        app = make_app(visitors, html, host in LOCAL, (host, *names))
        await run(app, listening, f"the Creator is at {url_of(host, listening)}", browse, ws_max_size=MAX_MESSAGE)
    finally:
        await pool.close()


async def first_source(pool: Pool, first: Path | Piece | None) -> Source:
    """Return the source that visitors see first; read it if it is a file. InputError if it cannot be shown."""
    if first is None:
        source = Source("piece", FIRST)
    elif isinstance(first, Piece):
        if first.notice:
            print(first.notice, file=sys.stderr)
        source = Source("piece", first.name)
    else:
        try:
            data = first.read_bytes()
        except OSError as error:
            raise InputError(f"{first} cannot be read: {error.strerror}") from None
        read = await pool.upload("", first.name, data)
        for note in read.notes:
            print(note, file=sys.stderr)
        source = read.source
    await pool.open(source)
    return source


def make_app(visitors: Visitors, html: str, local: bool, names: Sequence[str] = ()) -> ASGIApp:
    """Return the application. html: the page. local, names: see `SameOrigin`."""
    pool = visitors.pool
    thumbnails: dict[str, bytes] = {}

    async def index(request: Request) -> Response:
        return HTMLResponse(html)

    async def thumbnail(request: Request) -> Response:
        name = request.path_params["name"]
        if name not in thumbnails:
            if not has_thumbnail(name):
                return PlainTextResponse("there is no such piece", 404)
            if len(thumbnails) > 2000:
                thumbnails.clear()
            try:
                thumbnails[name] = await pool.thumbnail(name)
            except ShackledError as error:
                return PlainTextResponse(str(error), 503)
        return Response(thumbnails[name], media_type="image/png", headers={"cache-control": "max-age=3600"})

    async def take(request: Request) -> Response:
        visitor = visitors.find(request.path_params["visitor"])
        if visitor is None:
            return PlainTextResponse("this page is not connected any more: reload it", 404)
        kind = request.path_params["kind"]
        if kind == "turntable":
            if visitor.turntable is None:
                return PlainTextResponse("there is no GIF yet", 404)
            return _download(visitor.turntable, "turntable.gif", "image/gif")
        try:
            scale = int(request.query_params.get("scale", "1")[:4])
            link = str(request.base_url).rstrip("/") + visitor.link
            file = await pool.take(visitor.name, visitor.state, kind, scale, link)
        except (ShackledError, ValueError) as error:
            return PlainTextResponse(str(error), 400)
        return _download(file.data, file.name, file.media_type)

    async def call(request: Request) -> Response:
        visitor = visitors.find(request.path_params["visitor"])
        if visitor is None:
            return PlainTextResponse("this page is not connected any more: reload it", 404)
        view = visitor.view
        try:
            data, radius = await pool.call(visitor.name, visitor.posed)
        except ShackledError as error:
            return PlainTextResponse(str(error), 400)
        content = with_head(view | {"radius": radius}, data)
        return Response(content, media_type="application/octet-stream", headers={"cache-control": "no-store"})

    async def web(request: Request) -> Response:
        name = request.path_params["name"]
        if name not in WEB:
            return PlainTextResponse("there is no such file", 404)
        tag = f'"{hashlib.sha256(asset(name)).hexdigest()[:32]}"'
        if request.headers.get("if-none-match") == tag:
            return Response(status_code=304, headers={"etag": tag})
        return Response(asset(name), media_type=WEB[name], headers={"etag": tag})

    async def upload(request: Request) -> Response:
        visitor = visitors.find(request.path_params["visitor"])
        if visitor is None:
            return PlainTextResponse("this page is not connected any more: reload it", 404)
        if visitor.is_uploading:
            return PlainTextResponse("another file is being opened; try again when it is shown", 429)
        visitor.is_uploading = True
        try:
            return await read(request, visitor)
        except (ClientDisconnect, TimeoutError):
            return PlainTextResponse("the upload was interrupted, or took too long", 408)
        finally:
            visitor.is_uploading = False

    async def read(request: Request, visitor: Visitor) -> Response:
        async with asyncio.timeout(MAX_SENDING):
            body = await _body(request, pool.limits.upload + MAX_HEAD)
        if body is None:
            return PlainTextResponse(f"the limit is {pool.limits.upload // 2**20} MB for all files together", 413)
        try:
            name, data = unpack_upload(body)
            read = await pool.upload(visitor.name, name, data)
            visitor.show(read.facts)
        except ShackledError as error:
            return PlainTextResponse(str(error), 400)
        for note in read.notes:
            await visitor.tell({"note": note})
        return PlainTextResponse("read")

    async def connect(socket: WebSocket) -> None:
        await live(socket, visitors)

    app = Starlette(
        routes=[
            Route("/", index),
            Route("/reveal", index),  # the page opens the dialog
            Route("/thumbnail/{name:path}.png", thumbnail),
            Route("/take/{visitor}/{kind}", take),
            Route("/call/{visitor}", call),
            Route("/web/{name}", web),
            Route("/upload/{visitor}", upload, methods=["POST"]),
            WebSocketRoute("/live", connect),
            Mount("/assets", StaticFiles(directory=ASSETS)),
        ],
        middleware=[] if local else [Middleware(GZipMiddleware)],
    )
    # around all of Starlette, whose responses to failures are made outside its middleware
    return SameOrigin(app, local, names)


def unpack_upload(body: bytes) -> tuple[str | None, bytes]:
    """Return name and bytes of an uploaded file; None and an archive for several files. InputError if it is malformed.

    body: four bytes of length, that much JSON with a list of [name, size], and the files one after the other.
    """
    damaged = InputError("the upload is malformed")
    length = int.from_bytes(body[:4], "big")
    try:
        listed = json.loads(body[4 : 4 + length]) if length <= MAX_HEAD else None
    except (ValueError, RecursionError):
        raise damaged from None
    files: list[tuple[str, bytes]] = []
    at = 4 + length
    for entry in listed if isinstance(listed, list) else []:
        if not isinstance(entry, list) or [type(each) for each in entry] != [str, int] or entry[1] < 0:
            raise damaged
        files.append((entry[0], body[at : at + entry[1]]))
        at += entry[1]
    if not files or at != len(body):
        raise damaged
    if len(files) == 1:
        return files[0]
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as archive:
        for name, data in sorted(files):
            # without a date: the same files are the same upload, at any time and in any order
            archive.writestr(zipfile.ZipInfo(name.replace("\\", "/").rsplit("/", 1)[-1] or "file"), data)
    return None, stream.getvalue()


async def _body(request: Request, bound: int) -> bytes | None:
    """Return the body of a request; None if it has more than `bound` bytes."""
    body, size = bytearray(), 0
    async for chunk in request.stream():
        size += len(chunk)
        if size <= bound:
            body += chunk
        elif size > 16 * bound:
            break  # browsers show the response only if the whole body was read; but there are limits
    return bytes(body) if size <= bound else None


def _download(data: bytes, name: str, media_type: str) -> Response:
    plain = re.sub(r"[^A-Za-z0-9._-]", "-", name)[:100] or "picture"
    headers = {"content-disposition": f'attachment; filename="{plain}"', "cache-control": "no-store"}
    return Response(data, media_type=media_type, headers=headers)
