"""The page of the preview, which follows the sources: each save compiles, deploys and draws again."""

from __future__ import annotations

import json
import re
import time
from collections.abc import Iterator
from importlib.resources import files
from queue import SimpleQueue
from threading import Event, Lock, Thread
from typing import Any

from ..base.local_server import Answer, listen, run, type_of
from ..base.untrusted import plain
from ..errors import ShackledError
from ._document import HTML
from ._preview import Preview, Request, Token
from ._project import CompilerError, Project
from ._report import summary

#: Seconds between two looks at the sources.
PAUSE = 0.25
ASSETS = ("preview.html", "preview.js", "preview.css")
PAGE_POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src 'self'; "
    "frame-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)
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
        self.project, self.request = project, request
        self.version = 0
        #: The newest of each token, by its number, with the version in which it was read.
        self.tokens: dict[int, tuple[int, Token]] = {}
        self.state: dict[str, Any] = {}
        #: Whether a source has changed since this version was begun.
        self._is_stale = False
        self._ended = Event()
        #: Of what is above and below, which threads of several pages read.
        self._lock = Lock()
        self._listeners: set[SimpleQueue[dict[str, Any] | None]] = set()

    def follow(self) -> None:
        """Make the preview, and make it again whenever a source changes, until `end`."""
        while not self._ended.is_set():
            stamps = self.project.stamps()
            self._is_stale = False
            making = Thread(target=self._make)
            making.start()
            while not self._ended.wait(PAUSE) and stamps == self.project.stamps():
                pass
            self._is_stale = True
            making.join()

    def end(self) -> None:
        """End `follow`, and the events of all pages."""
        self._ended.set()
        with self._lock:
            for queue in self._listeners:
                queue.put(None)

    def _make(self) -> None:
        """Compile, and read all tokens. Whatever fails is shown on the page."""
        self.version += 1
        self._tell(status="compiling", error="", notes=[])
        try:
            self._draw()
        except ShackledError as error:
            self._fail(f"{error}\n\n{error.said}" if isinstance(error, CompilerError) else str(error))
        except Exception as error:
            # a mistake of the preview itself, which the next save may avoid
            self._fail(f"{type(error).__name__}: {error}")

    def _draw(self) -> None:
        started = time.monotonic()
        preview = Preview(self.project, self.request)
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
            while not self._is_stale and (token := next(tokens, None)) is not None:
                found.append(token)
                with self._lock:
                    self.tokens[token.number] = self.version, token
                self._send({"token": self._summary(token.number)})
        finally:
            tokens.close()
        if self._is_stale:
            return
        with self._lock:
            self.tokens = {token.number: (self.version, token) for token in found}
        wrong = sum(bool(token.problems) for token in found)
        seconds = time.monotonic() - started
        print(f"{len(found)} tokens in {seconds:.1f} s, {wrong} with problems", flush=True)
        hint = preview.hint(found)
        notes = [*preview.problems, *([hint] if hint else [])]
        self._tell(status="done", seconds=round(seconds, 1), notes=notes)

    def events(self) -> Iterator[bytes]:
        """Yield the state, with all tokens, and its changes as server-sent events."""
        queue: SimpleQueue[dict[str, Any] | None] = SimpleQueue()
        with self._lock:
            tokens = [*map(self._summary, sorted(self.tokens))]
            message: dict[str, Any] | None = {"version": self.version, **self.state, "tokens": tokens}
            self._listeners.add(queue)
        try:
            while message is not None and not self._ended.is_set():
                yield f"data: {json.dumps(message)}\n\n".encode()
                message = queue.get()
        finally:
            with self._lock:
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
        with self._lock:
            self.state |= changes
        self._send(self.state)

    def _send(self, changes: dict[str, Any]) -> None:
        message = {"version": self.version, **changes}
        with self._lock:
            for queue in self._listeners:
                queue.put(message)

    def answer(self, path: str) -> Answer | None:
        """Return what is sent for a path of the page; None if there is no such file, or not any more."""
        if path == "/events":
            return Answer(self.events(), "text/event-stream")
        if path[1:] in ASSETS or path == "/":
            name = path[1:] or ASSETS[0]
            content = files(__package__).joinpath("assets", name).read_bytes()
            return Answer(content, type_of(name), {"Content-Security-Policy": PAGE_POLICY})
        match = re.fullmatch(r"/(token|file)/(\d+)/(\d+)(?:/(image|animation))?", path, re.ASCII)
        token = self.token(int(match[2]), int(match[3])) if match else None
        if match is None or token is None:
            return None
        if match[1] == "token":
            return Answer(json.dumps({"document": token.document.fields}).encode(), "application/json")
        found = token.document.image if match[4] == "image" else token.document.animation
        if found is None:
            return None
        policy = HTML_POLICY if found.media_type == HTML else FILE_POLICY
        return Answer(found.content, found.media_type, {"Content-Security-Policy": policy})


def serve(project: Project, request: Request, port: int | None, fallback_port: int, browse: bool) -> None:
    """Serve the page until it is interrupted. InputError if the port cannot be used."""
    live = Live(project, request)
    server = listen(live.answer, port, fallback_port)
    following = Thread(target=live.follow)
    following.start()
    try:
        run(server, "the preview is at", "/", browse)
    finally:
        live.end()
        following.join()
