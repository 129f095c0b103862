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
from ._document import HTML, Document
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
        #: The newest of each token, by its number, with the version in which it was read.
        self.tokens: dict[int, tuple[int, Token]] = {}
        self.state: dict[str, Any] = {}
        #: Whether a source has changed since this version was begun.
        self._is_stale = False
        self._has_ended = False
        self._listeners: set[asyncio.Queue[dict[str, Any] | None]] = set()

    async def follow(self) -> None:
        """Make the preview, and make it again whenever a source changes, until `end`."""
        while not self._has_ended:
            stamps = await asyncio.to_thread(self.project.stamps)
            self._is_stale = False
            making = asyncio.create_task(self._make())
            while not self._has_ended and stamps == await asyncio.to_thread(self.project.stamps):
                await asyncio.sleep(PAUSE)
            self._is_stale = True
            await making

    def end(self) -> None:
        """End `follow`, and the events of all pages."""
        self._has_ended = True
        for queue in self._listeners:
            queue.put_nowait(None)

    async def _make(self) -> None:
        """Compile, and read all tokens. Whatever fails is told to the page."""
        self.version += 1
        self._tell(status="compiling", error="", notes=[])
        try:
            await self._draw()
        except ShackledError as error:
            self._fail(f"{error}\n\n{error.said}" if isinstance(error, CompilerError) else str(error))
        except Exception as error:
            # a mistake of the preview itself, which the next save may avoid
            self._fail(f"{type(error).__name__}: {error}")

    async def _draw(self) -> None:
        started = time.monotonic()
        preview = await asyncio.to_thread(Preview, self.project, self.request)
        self._tell(
            status="drawing",
            contract=preview.contract.name,
            function=preview.function["name"],
            first=str(preview.first),
            count=preview.count,
            max_gas=self.request.max_gas,
            notes=preview.problems,
        )
        found: list[Token] = []
        tokens = preview.tokens()
        try:
            while not self._is_stale and (token := await asyncio.to_thread(next, tokens, None)) is not None:
                found.append(token)
                self.tokens[token.number] = self.version, token
                self._send({"version": self.version, "token": self._summary(token.number)})
        finally:
            await asyncio.to_thread(tokens.close)
        if self._is_stale:
            return
        self.tokens = {token.number: (self.version, token) for token in found}
        wrong = sum(bool(token.problems) for token in found)
        seconds = time.monotonic() - started
        print(f"{len(found)} tokens in {seconds:.1f} s, {wrong} with problems", flush=True)
        hint = preview.hint(found)
        notes = [*preview.problems, *([hint] if hint else [])]
        self._tell(status="done", seconds=round(seconds, 1), notes=notes)

    def snapshot(self) -> dict[str, Any]:
        """Return all that a page needs that connects now."""
        return {"version": self.version, **self.state, "tokens": [*map(self._summary, sorted(self.tokens))]}

    async def events(self) -> AsyncIterator[str]:
        """Yield the state and its changes as server-sent events."""
        queue: asyncio.Queue[dict[str, Any] | None] = asyncio.Queue()
        self._listeners.add(queue)
        try:
            message: dict[str, Any] | None = self.snapshot()
            while message is not None and not self._has_ended:
                yield f"data: {json.dumps(message)}\n\n"
                message = await queue.get()
        finally:
            self._listeners.discard(queue)

    def token(self, version: int, number: int) -> Token | None:
        """Return a token as a version has it, until a later one replaces it."""
        found = self.tokens.get(number)
        return found[1] if found is not None and found[0] == version else None

    def _summary(self, number: int) -> dict[str, Any]:
        """Return a token for the page; its number as text, since numbers of JavaScript have 53 bits."""
        version, token = self.tokens[number]
        return {**summary(token), "number": str(number), "version": version}

    def _fail(self, said: str) -> None:
        print("\n".join(map(plain, said.splitlines())), flush=True)
        self._tell(status="failed", error=said)

    def _tell(self, **changes: Any) -> None:
        self.state |= changes
        self._send({"version": self.version, **self.state})

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

    def token_of(request: HttpRequest) -> Token | None:
        return live.token(request.path_params["version"], request.path_params["number"])

    async def file(request: HttpRequest) -> Response:
        token = token_of(request)
        document = token.document if token else Document()
        found = document.image if request.path_params["which"] == "image" else document.animation
        if found is None:
            return PlainTextResponse("there is no such file any more", 404)
        policy = HTML_POLICY if found.media_type == HTML else FILE_POLICY
        headers = {"content-security-policy": policy, "x-frame-options": "SAMEORIGIN"}
        return Response(found.content, headers={**headers, "content-type": found.media_type})

    async def token(request: HttpRequest) -> Response:
        found = token_of(request)
        if found is None:
            return PlainTextResponse("there is no such token any more", 404)
        return Response(json.dumps({"document": found.document.fields}), media_type="application/json")

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
    announcement = f"the preview is at {url_of(HOST, listening)}"
    try:
        await run(make_app(live), listening, announcement, browse, live.end)
    finally:
        live.end()
        await following
