"""The page of the preview, which follows the sources: each save compiles, deploys and draws again."""

from __future__ import annotations

import asyncio
import json
import time
from collections.abc import AsyncIterator
from contextlib import suppress
from importlib.resources import files
from typing import Any

from starlette.applications import Starlette
from starlette.requests import Request as HttpRequest
from starlette.responses import PlainTextResponse, Response, StreamingResponse
from starlette.routing import Route
from starlette.types import ASGIApp

from ..errors import ShackledError
from ..serving import HEADERS, SameOrigin, listen, run, url_of
from ..untrusted import plain
from ._document import HTML, File
from ._preview import Preview, Request, Token
from ._project import CompilerError, Project
from ._summary import summary

HOST = "127.0.0.1"
#: Seconds between two looks at the sources.
PAUSE = 0.25
ASSETS = {"": "text/html", "preview.js": "text/javascript", "preview.css": "text/css"}
PAGE_POLICY = HEADERS["content-security-policy"] + "; frame-src 'self'"
#: Of files of tokens, which are untrusted: they run nothing, and HTML runs apart from the page and without a network.
FILE_POLICY = "default-src 'none'; style-src 'unsafe-inline'; img-src data:; frame-ancestors 'self'; sandbox"
HTML_POLICY = (
    "default-src 'none'; script-src 'unsafe-inline' 'unsafe-eval' data: blob:; style-src 'unsafe-inline' data:; "
    "img-src data: blob:; media-src data: blob:; font-src data:; connect-src data: blob:; worker-src blob: data:; "
    "frame-ancestors 'self'; sandbox allow-scripts"
)


class Live:
    """The state that the page shows, and the pages that listen to its changes."""

    def __init__(self, project: Project, request: Request) -> None:
        """Take what is previewed; `follow` begins."""
        self.project, self.request = project, request
        self.version = 0
        self.tokens: dict[int, Token] = {}
        self.state: dict[str, Any] = {"status": "compiling"}
        #: Whether a source has changed since this version was begun.
        self._is_stale = False
        self._listeners: set[asyncio.Queue[dict[str, Any]]] = set()

    async def follow(self) -> None:
        """Make the preview, and make it again whenever a source changes."""
        while True:
            stamps = await asyncio.to_thread(self.project.stamps)
            self._is_stale = False
            making = asyncio.create_task(self._make())
            while stamps == await asyncio.to_thread(self.project.stamps):
                await asyncio.sleep(PAUSE)
            self._is_stale = True
            await making

    async def _make(self) -> None:
        """Compile, and read all tokens."""
        self.version += 1
        self.tokens = {}
        started = time.monotonic()
        self._tell({"status": "compiling"})
        try:
            preview = await asyncio.to_thread(Preview, self.project, self.request)
        except ShackledError as error:
            said = f"{error}\n\n{error.said}" if isinstance(error, CompilerError) else str(error)
            print("\n".join(map(plain, said.splitlines())), flush=True)
            self._tell({"status": "failed", "error": said})
            return
        self._tell(
            {
                "status": "drawing",
                "contract": preview.contract.name,
                "function": preview.function["name"],
                "first": preview.first,
                "count": preview.count,
                "max_gas": self.request.max_gas,
            }
        )
        tokens = preview.tokens()
        try:
            while not self._is_stale and (token := await asyncio.to_thread(next, tokens, None)) is not None:
                self.tokens[token.number] = token
                self._send({"version": self.version, "token": summary(token)})
        finally:
            await asyncio.to_thread(tokens.close)
        if self._is_stale:
            return
        wrong = sum(bool(token.problems) for token in self.tokens.values())
        seconds = time.monotonic() - started
        print(f"{len(self.tokens)} tokens in {seconds:.1f} s, {wrong} with problems", flush=True)
        self._tell(self.state | {"status": "done", "seconds": round(seconds, 1)})

    def snapshot(self) -> dict[str, Any]:
        """Return all that a page needs that connects now."""
        return {"version": self.version, **self.state, "tokens": [summary(each) for each in self.tokens.values()]}

    async def events(self) -> AsyncIterator[str]:
        """Yield the state and its changes as server-sent events."""
        queue: asyncio.Queue[dict[str, Any]] = asyncio.Queue()
        self._listeners.add(queue)
        try:
            yield _event(self.snapshot())
            while True:
                yield _event(await queue.get())
        finally:
            self._listeners.discard(queue)

    def file(self, number: int, which: str) -> File | None:
        """Return the image or the animation of a token."""
        token = self.tokens.get(number)
        if token is None:
            return None
        return token.document.image if which == "image" else token.document.animation

    def _tell(self, state: dict[str, Any]) -> None:
        self.state = state
        self._send({"version": self.version, **state})

    def _send(self, message: dict[str, Any]) -> None:
        for queue in self._listeners:
            queue.put_nowait(message)


def make_app(live: Live) -> ASGIApp:
    """Return the application of the page."""

    async def asset(request: HttpRequest) -> Response:
        name = request.path_params.get("name", "")
        if name not in ASSETS:
            return PlainTextResponse("there is no such file", 404)
        content = files(__package__).joinpath("assets", name or "preview.html").read_bytes()
        return Response(content, media_type=ASSETS[name], headers={"content-security-policy": PAGE_POLICY})

    async def events(request: HttpRequest) -> Response:
        return StreamingResponse(live.events(), media_type="text/event-stream")

    async def file(request: HttpRequest) -> Response:
        found = None
        if request.path_params["version"] == live.version:
            found = live.file(request.path_params["number"], request.path_params["which"])
        if found is None:
            return PlainTextResponse("there is no such file any more", 404)
        policy = HTML_POLICY if found.media_type == HTML else FILE_POLICY
        headers = {"content-security-policy": policy, "x-frame-options": "SAMEORIGIN"}
        return Response(found.content, headers={**headers, "content-type": found.media_type})

    async def token(request: HttpRequest) -> Response:
        found = live.tokens.get(request.path_params["number"])
        if found is None or request.path_params["version"] != live.version:
            return PlainTextResponse("there is no such token any more", 404)
        document = json.dumps({**summary(found), "document": found.document.fields})
        return Response(document, media_type="application/json")

    app = Starlette(
        routes=[
            Route("/", asset),
            Route("/events", events),
            Route("/file/{version:int}/{number:int}/{which}", file),
            Route("/token/{version:int}/{number:int}", token),
            Route("/{name}", asset),
        ]
    )
    return SameOrigin(app, local=True)


def serve(project: Project, request: Request, port: int | None, fallback_port: int, browse: bool) -> None:
    """Serve the page until it is interrupted. InputError if the port cannot be used."""
    with listen(HOST, port, fallback_port) as listening, suppress(KeyboardInterrupt):
        asyncio.run(_serve(Live(project, request), listening, browse))


async def _serve(live: Live, listening: Any, browse: bool) -> None:
    following = asyncio.create_task(live.follow())
    try:
        await run(make_app(live), listening, f"the preview is at {url_of(HOST, listening)}", browse)
    finally:
        following.cancel()


def _event(message: dict[str, Any]) -> str:
    return f"data: {json.dumps(message)}\n\n"
