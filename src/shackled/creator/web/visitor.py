"""One visitor: what is looked at, and the picture that follows each change of it."""

from __future__ import annotations

import asyncio
import base64
import json
import time
from collections.abc import Awaitable, Callable, Coroutine, Hashable
from typing import Any, Protocol

from ...errors import ShackledError
from ..history import History
from ..link import to_link
from ..picture import Frame
from ..pool import Pool
from ..presets import PRESETS, apply
from ..scene import Facts
from ..state import Size, Source, State
from .figures import figures
from .shown import Shown, merged
from .waiting import Waiting

Message = dict[str, Any]

#: Seconds without a movement after which the picture is drawn in full.
REST = 0.22
#: Side of what is drawn while it moves, at first, and at least.
DRAFT, LEAST_DRAFT = 96, 48
#: Side of the small pictures of the looks.
LOOK = 56
#: Work that goes on while the page is away: nobody can take back what a wallet was asked.
LASTING = ("mint",)
#: Seconds a moving picture may take before smaller ones are drawn, and below which larger ones are.
SLOW, QUICK = 0.07, 0.03


class Screen(Protocol):
    """What the page shows besides the picture and its figures."""

    def stages(self, visitor: Visitor) -> Coroutine[Any, Any, None]:
        """Gas by stage and the six stage pictures, in their dialog."""

    def takeaway(self, visitor: Visitor) -> Coroutine[Any, Any, None]:
        """What can be taken home, in its dialog."""

    def wallets(self, visitor: Visitor) -> None:
        """What may be minted, by which wallets."""

    def node(self, visitor: Visitor) -> Coroutine[Any, Any, None]:
        """The same picture from the node, and whether it is the same."""


class Visitor:
    """Somebody with the page open.

    name: what the worker pool knows them by, and what their addresses hold; nobody can guess it.
    """

    def __init__(self, name: str, pool: Pool, state: State, facts: Facts) -> None:
        """Nothing is drawn until `join`."""
        self.name = name
        self.pool = pool
        self.facts = facts
        self.history = History(state)
        self.frame: Frame | None = None
        self.screen: Screen | None = None
        self.seen = time.monotonic()
        self.turntable: bytes | None = None
        #: The names of the wallets that the page has found, and what they were asked.
        self.wallets: list[str] = []
        self.waiting = Waiting()
        #: How far minting is, for people.
        self.minting = ""
        #: Whether the page was opened at an address that leads to the same computer only.
        self.is_local = False
        #: What is said when the page is there.
        self.greeting = ""
        #: A picture whose file is not here: it comes back when somebody hands the file in.
        self.wanted: State | None = None
        self._shown = Shown()
        self._send: Callable[[Message | bytes], Awaitable[None]] | None = None
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
        """What is chosen now."""
        return self.history.state

    # ---- coming and going ----

    async def join(self, send: Callable[[Message | bytes], Awaitable[None]]) -> None:
        """Somebody is there and is sent everything, and a picture."""
        self._send = send
        self._shown = Shown()
        await self.tell(self._changes())
        if self.greeting:
            await self.tell({"alert": self.greeting})
            self.greeting = ""
        for question in self.waiting.questions:
            await self.tell({"wallet": question})
        self.draw()
        self._draw_looks()

    def leave(self, send: Callable[[Message | bytes], Awaitable[None]]) -> None:
        """Nobody is there any more; what was in work is dropped. `send`: as it was given to `join`."""
        self.seen = time.monotonic()
        if self._send != send:
            return  # somebody else came in the meantime: the same page, connected again
        self._send = None
        passing = [task for name, task in self._jobs.items() if name not in LASTING]
        for task in (*passing, *([self._drawing] if self._drawing else [])):
            task.cancel()
        if self._resting:
            self._resting.cancel()
        for name in (self.name, f"{self.name} looks"):
            self.pool.leave(name)

    def end(self) -> None:
        """Nobody comes back."""
        for task in self._jobs.values():
            task.cancel()

    def progress(self, message: Callable[[int, int], Message]) -> Callable[[int, int], None]:
        """What tells the page how far long work is; `message`: of what is done, of how much."""

        def tell(done: int, total: int) -> None:
            task = asyncio.create_task(self.tell(message(done, total)))
            self._telling.add(task)  # or it may be collected before it is done
            task.add_done_callback(self._telling.discard)

        return tell

    async def refresh(self) -> None:
        """Sends everything anew, for what was typed there is not what is."""
        self._shown = Shown()
        await self.tell(self._changes())

    @property
    def present(self) -> bool:
        """Whether anybody is there."""
        return self._send is not None

    async def tell(self, message: Message) -> None:
        """Sends a message to the page, if it is there and the message says anything."""
        if self._send is not None and message:
            await self._send(message)

    # ---- what changes ----

    def change(self, state: State, merge: Hashable | None = None) -> None:
        """Another state, and its picture; a quick one, if it is one of many that make a step."""
        self.wanted = None
        self._moves += 1
        self.history.change(state, merge)
        if merge is None:
            self._still()
            self.draw()
        else:
            self._moving = True
            if self._resting:
                self._resting.cancel()
            self._resting = asyncio.get_running_loop().call_later(REST, self.rest)
            self.draw()

    def rest(self) -> None:
        """The movement is over: the picture in full."""
        moved = self._moving
        self._still()
        self.history.settle()
        if moved:
            self.draw()

    async def open(self, source: Source) -> None:
        """Another object, as it comes."""
        self.show(await self.pool.open(source))

    def show(self, facts: Facts) -> None:
        """Another object, of which everything is known: as it comes, or as it was wanted before it was here."""
        wanted, self.facts = self.wanted, facts
        self.change(wanted if wanted is not None and wanted.source == facts.source else State(facts.source))
        self._draw_looks()

    async def go(self, state: State) -> None:
        """A state of the history, whatever its source."""
        if state.source != self.facts.source:
            self.facts = await self.pool.open(state.source)
            self._draw_looks()
        self._still()
        self.draw()

    def job(self, name: str, work: Callable[[], Coroutine[Any, Any, None]]) -> None:
        """Does long work beside everything else, in place of the work of that name that was going on."""
        self.stop(name)
        self._jobs[name] = asyncio.create_task(self._job(name, work))

    def is_at(self, name: str) -> bool:
        """Whether the work of that name goes on."""
        return name in self._jobs

    def stop(self, name: str) -> bool:
        """Ends the work of a name; whether there was any."""
        task = self._jobs.pop(name, None)
        return task is not None and task.cancel()

    async def _job(self, name: str, work: Callable[[], Coroutine[Any, Any, None]]) -> None:
        try:
            await work()
        except ShackledError as error:
            await self.tell({"alert": str(error)})
        finally:
            if self._jobs.get(name) is asyncio.current_task():
                del self._jobs[name]

    def _still(self) -> None:
        self._moving = False
        if self._resting:
            self._resting.cancel()
            self._resting = None

    # ---- the picture ----

    def draw(self) -> None:
        """Sees to it that the page gets the picture of the state: now, or as soon as the one in work is there."""
        if self._send is None:
            return
        busy = self._drawing is not None and not self._drawing.done()
        if busy and (self._draft_in_work or not self._moving):
            self._again = True
            return
        # a full picture that is no longer wanted gives way to a quick one: the pool drops it
        self._draft_in_work = self._moving
        self._drawing = asyncio.create_task(self._draw())

    async def _draw(self) -> None:
        mine = asyncio.current_task()
        started = time.perf_counter()
        state, moves, moving = self.state, self._moves, self._moving
        # this one is all that was wanted until now
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
            await self._send_frame(frame, moving, moves)
        if self._again and self._drawing is mine:
            self._drawing = None
            self.draw()

    async def _send_frame(self, frame: Frame, moving: bool, moves: int) -> None:
        if self._send is None:
            return
        self._number += 1
        if not moving:
            self.frame = frame
        show = merged(self._changes(), figures(frame, self.facts, draft=moving))
        head = json.dumps({"number": self._number, "draft": moving, "moves": moves, "show": show}).encode()
        await self._send(len(head).to_bytes(4, "big") + head + frame.bmp)

    async def _complain(self, words: str) -> None:
        if words != self._complaint or not self._moving:
            await self.tell({"alert": words} | self._changes())
        self._complaint = words

    def _draft_side(self, state: State) -> int:
        size = state.size or self.facts.defaults.size or Size()
        return min(self._draft, max(size.width, size.height))

    def _adapt(self, seconds: float) -> None:
        """Quick pictures become smaller where they are late, and larger where there is time."""
        if seconds > SLOW:
            self._draft = max(LEAST_DRAFT, int(self._draft * 0.8))
        elif seconds < QUICK:
            self._draft = min(256, int(self._draft * 1.15))

    def _draw_looks(self) -> None:
        self.job("looks", self._looks)

    async def _looks(self) -> None:
        """Small pictures of the object in each look."""
        facts = self.facts
        plain = State(facts.source)
        for look in PRESETS:
            frame = await self.pool.render(f"{self.name} looks", apply(look, plain, facts), LOOK, count=False)
            if frame is not None:
                source = f"data:image/png;base64,{base64.b64encode(frame.png).decode()}"
                await self.tell({"attributes": {f"look-picture-{look.name}": {"src": source}}})

    # ---- what the page shows ----

    @property
    def link(self) -> str:
        """The address that restores all."""
        return f"/?p={to_link(self.state)}"

    def _changes(self) -> Message:
        """What the page does not show yet as it is."""
        message = self._shown.changes(self.history, self.facts)
        if not self._moving and self.wanted is None:
            link = self.link
            if link != self._shown.link:
                self._shown.link = message["link"] = link
        return message
