"""The server of the page: its routes, and how it starts and ends."""

from __future__ import annotations

import asyncio
import errno
import io
import json
import logging
import re
import socket
import sys
import threading
import webbrowser
import zipfile
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

import uvicorn
from starlette.applications import Starlette
from starlette.middleware.gzip import GZipMiddleware
from starlette.requests import Request
from starlette.responses import PlainTextResponse, Response
from starlette.types import ASGIApp
from starlette.websockets import WebSocket

from ..._load import locate
from ...chain import open_node
from ...datasets import Piece
from ...errors import InputError, ShackledError
from ..link import from_link, is_local
from ..pool import Pool
from ..state import Source, State
from .headers import LOCAL, Guard
from .icons import LOGO
from .live import live
from .visitors import Visitors

#: What is seen first, if nothing else is asked for.
FIRST = "icons/shackle"

#: Bytes about the files of an upload.
MAX_HEAD = 16384


def serve(
    input: str | None,
    host: str,
    port: int | None,
    fallback_port: int,
    open_browser: bool,
    node: str | None,
    names: Sequence[str] = (),
) -> None:
    """Serves the page until it is interrupted.

    input: what visitors see first. port: None takes `fallback_port`, or one that is free where that is not. node: the
    address of a node, with whose pictures visitors can compare. names: under which the page may be asked for besides
    the addresses of this machine. InputError if anything of it is wrong.
    """
    first = None if input is None else locate(input)
    if node is not None:
        open_node(node)  # which says if it can be no address; nothing is asked of it yet
    with _listen(host, port, fallback_port) as listening, suppress(KeyboardInterrupt):
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
        # the workers start while NiceGUI is loaded and the page made ready, which takes as long
        await asyncio.gather(pool.start(), asyncio.to_thread(_prepare))
        app = make_app(Visitors(pool), await _first(pool, first), host in LOCAL, (host, *names))
        config = uvicorn.Config(
            app, log_level="warning", timeout_graceful_shutdown=2, ws_max_size=2**16, server_header=False, lifespan="on"
        )
        address = f"http://{_in_address(host)}:{listening.getsockname()[1]}/"
        server = uvicorn.Server(config)
        watch = asyncio.create_task(_announce(server, address, browse))
        try:
            await server.serve(sockets=[listening])
        finally:
            watch.cancel()
    finally:
        await pool.close()


def _prepare() -> None:
    from .page import prepare

    prepare()


async def _announce(server: uvicorn.Server, address: str, browse: bool) -> None:
    while not server.started:
        await asyncio.sleep(0.01)
    print(f"the Creator is at {address} (Ctrl C ends it)", flush=True)
    if browse:
        threading.Thread(target=_browse, args=(address,), daemon=True).start()


def _browse(address: str) -> None:
    if not webbrowser.open(address):
        print(f"there is no browser that could be started here: open {address} in one", file=sys.stderr, flush=True)


async def _first(pool: Pool, first: Path | Piece | None) -> Source:
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


def make_app(visitors: Visitors, first: Source, local: bool, names: Sequence[str] = ()) -> ASGIApp:
    """The whole of the server. local: whether it is for this machine only. names: see `Guard`."""
    from fastapi import FastAPI
    from nicegui import app as gui
    from nicegui import ui

    from .elements import ASSETS
    from .page import build
    from .shelf import has_thumbnail
    from .unmet import bound_pages, plain_refusals

    pool = visitors.pool
    app: Any = FastAPI(openapi_url=None, docs_url=None, redoc_url=None)
    thumbnails: dict[str, bytes] = {}

    @ui.page("/", title="Shackled Creator", language="en-US")
    async def index(request: Request, p: str = "") -> None:
        bound_pages()
        greeting, wanted = "", None
        state = State(first)
        if p:
            try:
                state = wanted = from_link(p)
                await pool.open(state.source)
                wanted = None
            except ShackledError as error:
                greeting, state = str(error), State(first)
        try:
            visitor = visitors.add(state, await pool.open(state.source))
        except InputError as error:
            ui.label(str(error))
            return
        if wanted is not None and wanted.source.kind == "upload":
            visitor.wanted, greeting = wanted, f"{greeting}, and the picture is as it was"
        visitor.greeting = greeting
        visitor.is_local = is_local(str(request.base_url))
        ui.context.client.on_delete(lambda: visitors.drop(visitor))
        build(visitor)

    async def thumbnail(request: Request) -> Response:
        name = request.path_params["name"]
        if name not in thumbnails:
            if not has_thumbnail(name):
                return PlainTextResponse("there is no such piece", 404)
            if len(thumbnails) > 2000:
                thumbnails.clear()
            thumbnails[name] = await pool.thumbnail(name)
        return Response(thumbnails[name], media_type="image/png", headers={"cache-control": "max-age=3600"})

    async def take(request: Request) -> Response:
        visitor = visitors.find(request.path_params["visitor"])
        if visitor is None:
            return PlainTextResponse("this page is not known any more: reload it", 404)
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

    async def upload(request: Request) -> Response:
        visitor = visitors.find(request.path_params["visitor"])
        if visitor is None:
            return PlainTextResponse("this page is not known any more: reload it", 404)
        body = await _body(request, pool.limits.upload + MAX_HEAD)
        if body is None:
            return PlainTextResponse(f"files of up to {pool.limits.upload // 2**20} MB are read, all together", 413)
        try:
            name, data = unpack(body)
            read = await pool.upload(visitor.name, name, data)
            visitor.show(read.facts)
        except ShackledError as error:
            return PlainTextResponse(str(error), 400)
        for note in read.notes:
            await visitor.tell({"note": note})
        return PlainTextResponse("read")

    async def wire(socket: WebSocket) -> None:
        await live(socket, visitors)

    from starlette.staticfiles import StaticFiles

    routes: Starlette = app
    routes.router.add_route("/thumbnail/{name:path}.png", thumbnail)
    routes.router.add_route("/take/{visitor}/{kind}", take)
    routes.router.add_route("/upload/{visitor}", upload, methods=["POST"])
    routes.router.add_websocket_route("/live/{visitor}", wire)
    routes.router.mount("/assets", StaticFiles(directory=ASSETS))
    ui.run_with(
        app,
        title="Shackled Creator",
        favicon=LOGO,
        dark=None,
        language="en-US",
        tailwind=False,
        gzip_middleware_factory=None,
        show_welcome_message=False,
        reconnect_timeout=20,
        cache_control_directives="public, max-age=300",
    )
    logging.getLogger("nicegui").setLevel(logging.ERROR)
    plain_refusals()
    gui.config.quasar_config["loadingBar"]["skipHijack"] = True  # it has no name, and the picture says it
    guarded: ASGIApp = Guard(app, local, names)
    return guarded if local else GZipMiddleware(guarded)


def unpack(body: bytes) -> tuple[str | None, bytes]:
    """The file of an upload, by name; several files are put into one archive of no name. InputError if it is none.

    Four bytes of length, that much JSON with names and sizes, and the files one after the other.
    """
    damaged = InputError("what arrived is no upload of the page")
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
            # of no date: the same files are the same upload, whenever and in whatever order they are handed in
            archive.writestr(zipfile.ZipInfo(name.replace("\\", "/").rsplit("/", 1)[-1] or "file"), data)
    return None, stream.getvalue()


async def _body(request: Request, bound: int) -> bytes | None:
    """What is sent; None if it is more than `bound` bytes."""
    body, size = bytearray(), 0
    async for chunk in request.stream():
        size += len(chunk)
        if size <= bound:
            body += chunk
        elif size > 16 * bound:
            break  # a browser understands the answer only when it has sent everything; but there are limits
    return bytes(body) if size <= bound else None


def _download(data: bytes, name: str, media_type: str) -> Response:
    plain = re.sub(r"[^A-Za-z0-9._-]", "-", name)[:100] or "picture"
    headers = {"content-disposition": f'attachment; filename="{plain}"', "cache-control": "no-store"}
    return Response(data, media_type=media_type, headers=headers)


def _listen(host: str, port: int | None, fallback: int) -> socket.socket:
    """A socket that listens there."""
    try:
        family = socket.getaddrinfo(host, None, type=socket.SOCK_STREAM)[0][0]
    except OSError:
        raise InputError(f"`host` must be an address of this machine such as 127.0.0.1, not {host!r}") from None
    if port is not None and port > 65535:
        raise InputError(f"`port` must be from 1 to 65535, not {port}")
    wanted = (fallback, 0) if port is None else (port,)
    for number in wanted:
        # the protocol is said, or asyncio would not know that it may turn off the delay of small packets
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
                raise InputError(f"port {number} of {host} cannot be had: {reason}; choose another by `port`") from None
            continue
        return listening
    raise AssertionError("one of the ports was had or refused")


def _in_address(host: str) -> str:
    return f"[{host}]" if ":" in host else "localhost" if host in ("0.0.0.0", "::") else host
