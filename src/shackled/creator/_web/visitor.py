"""One visitor: a state, its history, and the picture that follows each change."""

from __future__ import annotations

import asyncio
import base64
import json
import time
from collections.abc import Awaitable, Callable, Coroutine, Hashable
from dataclasses import asdict, replace
from typing import Any

from ...errors import ShackledError
from .._history import History
from .._link import to_link
from .._picture import Frame
from .._pool import Pool
from .._presets import PRESETS, apply_look
from .._scene import Facts, filled
from .._state import Size, Source, State, scene_key
from .reveal import Reveal
from .shown import Shown, figures, merged
from .wallet import Waiting

Message = dict[str, Any]
Send = Callable[[Message | bytes], Awaitable[None]]

#: Seconds without a movement after which the picture is rendered in full.
REST = 0.22
#: First and least longer side of drafts, the pictures during a movement.
DRAFT, LEAST_DRAFT = 96, 48
#: Side of the pictures of the looks.
LOOK = 56
#: Jobs that go on while the page is disconnected: a request to a wallet cannot be taken back.
LASTING = ("mint", "reveal", "reveal-send")
#: Seconds of a draft above which smaller ones are rendered, and below which larger ones are.
SLOW, QUICK = 0.07, 0.03


class Visitor:
    """A visitor of the page.

    name: secret; it identifies the visitor to the pool and in addresses.
    frame: the last picture in full. turntable: the last GIF.
    wallets: names of the wallets that the page has found. waiting: requests to them. status: of what is done with
    them, by name. collection, reveal: what was typed in the dialog of that name, and the transaction that it shows.
    is_local: whether the page was opened at a loopback address. is_uploading: whether a file is being sent or read.
    greeting: error to show first. stamp: of the last camera that the page has sent after a movement.
    wanted: state whose upload is not in memory; it is restored when the file is uploaded again.
    """

    def __init__(self, name: str, pool: Pool, state: State, facts: Facts) -> None:
        """Render nothing until `join`."""
        self.name = name
        self.pool = pool
        self.facts = facts
        self.history = History(state)
        self.frame: Frame | None = None
        self.seen = time.monotonic()
        self.turntable: bytes | None = None
        self.wallets: list[str] = []
        self.waiting = Waiting()
        self.status: dict[str, str] = {}
        self.collection = ""
        self.reveal: Reveal | None = None
        self.is_local = False
        self.is_uploading = False
        self.greeting = ""
        self.stamp = 0
        self.wanted: State | None = None
        self._shown = Shown()
        self._send: Send | None = None
        self._drawing: asyncio.Task[None] | None = None
        self._draft_in_work = False
        self._again = False
        self._moving = False
        self._resting: asyncio.TimerHandle | None = None
        self._jobs: dict[str, asyncio.Task[None]] = {}
        self._telling: set[asyncio.Task[None]] = set()
        self._number = 0
        self._moves = 0
        self._draft = DRAFT
        self._complaint = ""

    @property
    def state(self) -> State:
        """The current state."""
        return self.history.state

    # ---- connection ----

    async def join(self, send: Send) -> None:
        """Send a page everything, and a picture. send: sends a message to the page."""
        self._send = send
        self._shown = Shown()
        await self.tell({"visitor": self.name} | self._changes())
        if self.greeting:
            await self.tell({"alert": self.greeting})
            self.greeting = ""
        for question in self.waiting.questions:
            await self.tell({"wallet": question})
        self.draw()
        self._draw_looks()

    def leave(self, send: Send) -> None:
        """Disconnect a page and drop its jobs. send: as given to `join`."""
        self.seen = time.monotonic()
        if self._send != send:
            return  # the page has reconnected meanwhile
        self._send = None
        passing = [task for name, task in self._jobs.items() if name not in LASTING]
        for task in (*passing, *([self._drawing] if self._drawing else [])):
            task.cancel()
        if self._resting:
            self._resting.cancel()
        for name in (self.name, f"{self.name} looks"):
            self.pool.leave(name)

    def end(self) -> None:
        """Cancel all jobs: the page does not come back."""
        for task in self._jobs.values():
            task.cancel()

    @property
    def present(self) -> bool:
        """Whether a page is connected."""
        return self._send is not None

    async def tell(self, message: Message) -> None:
        """Send a message to the page, if it is connected and the message is not empty."""
        if self._send is not None and message:
            await self._send(message)

    def progress(self, message: Callable[[int, int], Message]) -> Callable[[int, int], None]:
        """Return a callback for the progress of a long task. message: of (done, total)."""

        def tell(done: int, total: int) -> None:
            task = asyncio.create_task(self.tell(message(done, total)))
            self._telling.add(task)  # or it could be garbage-collected before it is done
            task.add_done_callback(self._telling.discard)

        return tell

    async def refresh(self) -> None:
        """Send all values again: a field of the page may show a value that was refused."""
        self._shown = Shown()
        await self.tell(self._changes())

    # ---- changes ----

    def change(self, state: State, merge: Hashable | None = None) -> None:
        """Set the state and render it. merge: of the changes of one movement, which are rendered as drafts."""
        self.wanted = None
        self._moves += 1
        self.history.change(state, merge)
        if merge is None:
            self._still()
        else:
            self._moving = True
            if self._resting:
                self._resting.cancel()
            self._resting = asyncio.get_running_loop().call_later(REST, self.rest)
        self.draw()

    def rest(self) -> None:
        """End a movement: render the picture in full."""
        moved = self._moving
        self._still()
        self.history.settle()
        if moved:
            self.draw()

    async def open(self, source: Source) -> None:
        """Show another object without changes. InputError if it does not exist."""
        self.show(await self.pool.open(source))

    def show(self, facts: Facts) -> None:
        """Show another object, without changes or in the state that waited for its upload."""
        wanted, self.facts = self.wanted, facts
        self.change(wanted if wanted is not None and wanted.source == facts.source else State(facts.source))
        self._draw_looks()

    async def go(self, state: State) -> None:
        """Show a state of the history, which is current already."""
        if state.source != self.facts.source:
            self.facts = await self.pool.open(state.source)
            self._draw_looks()
        self._still()
        self.draw()

    def _still(self) -> None:
        self._moving = False
        if self._resting:
            self._resting.cancel()
            self._resting = None

    # ---- long tasks ----

    def job(self, name: str, work: Callable[[], Coroutine[Any, Any, None]]) -> None:
        """Begin a long task; it replaces a running one of this name."""
        self.stop(name)
        self._jobs[name] = asyncio.create_task(self._job(name, work))

    def is_at(self, name: str) -> bool:
        """Return whether the long task of this name is running."""
        return name in self._jobs

    def stop(self, name: str) -> None:
        """Cancel the long task of this name, if it is running."""
        task = self._jobs.pop(name, None)
        if task is not None:
            task.cancel()

    async def _job(self, name: str, work: Callable[[], Coroutine[Any, Any, None]]) -> None:
        try:
            await work()
        except ShackledError as error:
            await self.tell({"alert": str(error)})
        finally:
            if self._jobs.get(name) is asyncio.current_task():
                del self._jobs[name]

    # ---- the picture ----

    def draw(self) -> None:
        """Render the state, now or after the picture in work."""
        if self._send is None:
            return
        busy = self._drawing is not None and not self._drawing.done()
        if busy and (self._draft_in_work or not self._moving):
            self._again = True
            return
        # a draft does not wait for an outdated full picture: the pool drops that
        self._draft_in_work = self._moving
        self._drawing = asyncio.create_task(self._draw())

    async def _draw(self) -> None:
        mine = asyncio.current_task()
        started = time.perf_counter()
        state, moves, moving = self.state, self._moves, self._moving
        view = None if moving else self.view | {"stamp": self.stamp}
        self._draft_in_work, self._again = moving, False
        try:
            frame = await self.pool.render(
                self.name, state, self._draft_side(state) if moving else None, count=not moving
            )
        except ShackledError as error:
            await self._complain(str(error))
            frame = None
        if self._drawing is not mine:
            return
        if frame is not None:
            self._complaint = ""
            if moving:
                self._adapt(time.perf_counter() - started)
            await self._send_frame(frame, view, moves)
        if self._again and self._drawing is mine:
            self._drawing = None
            self.draw()

    async def _send_frame(self, frame: Frame, view: Message | None, moves: int) -> None:
        if self._send is None:
            return
        self._number += 1
        draft = view is None
        if not draft:
            self.frame = frame
        show = merged(self._changes(), figures(frame, self.facts, draft))
        head = {"number": self._number, "draft": draft, "moves": moves, "show": show, "view": view}
        await self._send(with_head(head, frame.bmp))

    @property
    def view(self) -> Message:
        """The view with which the page draws pictures of a movement: the camera, and a digest of everything else."""
        state = self.posed
        assert state.camera is not None
        return {"key": scene_key(state), "camera": asdict(state.camera), "follow": state.lights_follow}

    @property
    def posed(self) -> State:
        """The state with a camera of its own, as after the first movement."""
        return replace(self.state, camera=filled(self.state, self.facts).camera)

    async def _complain(self, words: str) -> None:
        if words != self._complaint or not self._moving:
            await self.tell({"alert": words} | self._changes())
        self._complaint = words

    def _draft_side(self, state: State) -> int:
        size = state.size or self.facts.defaults.size or Size()
        return min(self._draft, max(size.width, size.height))

    def _adapt(self, seconds: float) -> None:
        """Adapt the size of drafts to the time that the last one took."""
        if seconds > SLOW:
            self._draft = max(LEAST_DRAFT, int(self._draft * 0.8))
        elif seconds < QUICK:
            self._draft = min(256, int(self._draft * 1.15))

    def _draw_looks(self) -> None:
        self.job("looks", self._looks)

    async def _looks(self) -> None:
        """Send small pictures of the object in each look."""
        facts = self.facts
        plain = State(facts.source)
        for look in PRESETS:
            frame = await self.pool.render(f"{self.name} looks", apply_look(look, plain, facts), LOOK, count=False)
            if frame is not None:
                source = f"data:image/png;base64,{base64.b64encode(frame.png).decode()}"
                await self.tell({"attributes": {f"look-picture-{look.name}": {"src": source}}})

    @property
    def link(self) -> str:
        """Address of the page that restores the state, without scheme and host."""
        return f"/?p={to_link(self.state)}"

    def _changes(self) -> Message:
        message = self._shown.changes(self.history, self.facts)
        if not self._moving and self.wanted is None:
            link = self.link
            if link != self._shown.link:
                self._shown.link = message["link"] = link
        return message


def with_head(head: Message, content: bytes) -> bytes:
    """Return content after a JSON object, whose length is in the first four bytes."""
    packed = json.dumps(head).encode()
    return len(packed).to_bytes(4, "big") + packed + content
