"""Distribute parts over backends.

Each slot of a backend takes the next part when it is free, so that slow backends get fewer. A part that a backend
cannot render returns to the queue; a backend that fails repeatedly, or answers wrongly, is dropped.
"""

from __future__ import annotations

import random
import threading
import time
from collections import deque
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass, field

from ..chain._chain import Drawing
from ..errors import (
    ChainError,
    NodeBusyError,
    NodeError,
    NodeTimeoutError,
    OutOfGasError,
    Place,
    RenderError,
    TooLargeError,
    WrongChainError,
    warn,
)
from ..image import decode_bmp
from ..scene._scene import Scene
from ._backends import Backend, Part, Verifier
from ._store import PartStore
from ._tiles import area, halves

#: How often in a row a backend may fail, be busy, and, while there are others, find parts too large.
FAILURES, BUSY, MISSES = 3, 10, 6
#: The same for timeouts: until a part has timed out, no other backend can render it.
TIMEOUTS = 2
#: The first and the longest pause of a backend that failed or is busy, in seconds.
PAUSE, LONGEST_PAUSE = 0.25, 30.0
#: Errors after which a smaller part may succeed.
TOO_MUCH = (OutOfGasError, TooLargeError, NodeTimeoutError)


@dataclass(frozen=True)
class Outline:
    """The size of a job. gas: an estimate of what it will use."""

    parts: int
    frames: int
    pixels: int
    gas: int


class Listener:
    """Receives the progress of a job; this one shows warnings only. Threads may call it, one at a time."""

    #: Where the job was asked for, as threads do not know it; None shows warnings where they are given.
    place: Place | None = None

    def planned(self, outline: Outline) -> None:
        """Handle the start of the job."""

    def advanced(self, pixels: int) -> None:
        """Handle finished pixels, of this or an earlier run; fewer than 0 if some have to be rendered again."""

    def warned(self, text: str) -> None:
        """Handle a failure that does not end the job."""
        warn(text, RuntimeWarning, self.place)

    def ended(self) -> None:
        """Handle the end of the job, finished or not."""


class WrongAnswer(RenderError):
    """An answer differs from what the contracts draw."""


@dataclass(eq=False)
class BackendState:
    """A backend and what is known of it.

    capacity: the most pixels of a part that may succeed. failures, busy, misses: how often in a row.
    until: monotonic time of the end of its pause. checked: whether its first part has been compared. done: how many
    finished parts count. left: whether it was dropped. unchecked: finished parts that were not compared. warned:
    whether its gas was found to be wrong.
    """

    backend: Backend
    capacity: int = 1 << 62
    failures: int = 0
    busy: int = 0
    misses: int = 0
    until: float = 0.0
    checked: bool = False
    done: int = 0
    left: bool = False
    unchecked: list[Part] = field(default_factory=list)
    warned: bool = False


class Scheduler:
    """Renders the parts of some frames."""

    def __init__(
        self,
        frames: Sequence[Scene],
        backends: Sequence[Backend],
        store: PartStore | None = None,
        listener: Listener | None = None,
        verifier: Verifier | None = None,
    ) -> None:
        """Start nothing yet. store: keeps finished parts. verifier: None compares nothing."""
        self._frames = frames
        self._states = [BackendState(backend) for backend in backends]
        self._store, self._listener, self._verifier = store, listener or Listener(), verifier
        self._changed = threading.Condition(threading.RLock())
        self._pending: deque[Part] = deque()
        self._flying = 0
        self._results: dict[Part, Drawing] = {}
        self._error: BaseException | None = None
        self._stopped = False
        self._comparing = ThreadPoolExecutor(1)

    def run(self, parts: Sequence[Part]) -> dict[Part, Drawing]:
        """Render parts and return the finished ones, some of them cut further; an error ends the job."""
        with self._changed:
            self._put_first(parts)
        slots = [state for state in self._states for _ in range(state.backend.slots)]
        # daemons, so that a node that does not answer does not keep the process from ending
        threads = [threading.Thread(target=self._serve, args=(state,), daemon=True) for state in slots]
        try:
            for thread in threads:
                thread.start()
            with self._changed:
                while not self._over():
                    # with a timeout, so that Ctrl-C works on every platform
                    self._changed.wait(0.5)
                    for text in [text for state in self._states for text in state.backend.check()]:
                        self._listener.warned(text)
                if self._error is not None:
                    raise self._error
                return dict(self._results)
        finally:
            with self._changed:
                self._stopped = True
                self._changed.notify_all()
            self._comparing.shutdown(wait=False, cancel_futures=True)

    @property
    def used(self) -> list[Backend]:
        """Return the backends without those that were dropped and contributed nothing."""
        return [state.backend for state in self._states if state.done or not state.left]

    def _over(self) -> bool:
        return self._stopped or self._error is not None or not (self._pending or self._flying)

    def _serve(self, state: BackendState) -> None:
        """Run the thread of a slot."""
        while (part := self._take(state)) is not None:
            piece, failure = None, None
            try:
                piece = state.backend.render(self._frames[part.frame], part.tile)
            except BaseException as error:
                failure = self._judged(state, part, error)
            if piece is not None and state.checked and self._verifier is not None:
                # in parallel with the next call; the first part of a backend is compared before it gets another
                with suppress(RuntimeError):  # the job has ended
                    self._comparing.submit(self._settle, state, part, piece, None)
            else:
                self._settle(state, part, piece, failure)

    def _settle(self, state: BackendState, part: Part, piece: Drawing | None, failure: BaseException | None) -> None:
        """Record the result of a call."""
        checked = False
        if piece is not None and state.backend.untrusted:
            try:
                checked = self._check(state, part, piece)
            except BaseException as error:
                failure = self._judged(state, part, error)
        with self._changed:
            self._flying -= 1
            try:
                if self._stopped:
                    return
                if failure is not None:
                    self._failed(state, part, failure)
                elif piece is None or (state.left and not checked):
                    self._pending.appendleft(part)
                else:
                    self._finished(state, part, piece, checked)
            except BaseException as error:
                # raised by a listener, or by the disk
                self._error = error
            finally:
                self._changed.notify_all()

    def _take(self, state: BackendState) -> Part | None:
        """Wait for the next part of a backend; return None when there is none left for it."""
        with self._changed:
            while not self._over() and not state.left:
                pause = state.until - time.monotonic()
                part = None if pause > 0 else self._next(state)
                if part is not None:
                    self._flying += 1
                    return part
                self._changed.wait(pause if pause > 0 else None)
            return None

    def _next(self, state: BackendState) -> Part | None:
        """Take the first part within the capacity of a backend, or else half of the first one."""
        for part in self._pending:
            if area(part.tile) <= state.capacity:
                self._pending.remove(part)
                return part
        while self._pending:
            part = self._pending.popleft()
            smaller = halves(part.tile)
            if area(part.tile) <= state.capacity or len(smaller) == 1:
                return part
            self._put_first([Part(part.frame, tile) for tile in smaller])
        return None

    def _check(self, state: BackendState, part: Part, piece: Drawing) -> bool:
        """Return whether a part was compared; raise WrongAnswer if it is wrong."""
        try:
            decode_bmp(piece.bmp, part.tile.width, part.tile.height)
        except ChainError as error:
            raise WrongAnswer(str(error)) from None
        with self._changed:
            first, state.checked = not state.checked, True
        if self._verifier is None or not self._verifier.selects(first):
            return False
        right = self._verifier.draw(self._frames[part.frame], part.tile)
        if piece.bmp != right.bmp:
            raise WrongAnswer("its picture is not what the contracts draw")
        with self._changed:
            if None not in (piece.gas, right.gas) and piece.gas != right.gas and not state.warned:
                state.warned = True
                self._listener.warned(
                    f"the {state.backend.name} counts {piece.gas:,} gas for {self._title(part)}, which takes "
                    f"{right.gas:,} here: its gas is not that of the rules of Cancun"
                )
        return True

    def _title(self, part: Part) -> str:
        """Return the name of a part for messages."""
        tile, frame = part.tile, self._frames[part.frame]
        of = f"frame {part.frame}" if len(self._frames) > 1 else ""
        if (tile.width, tile.height) == (frame.width, frame.height):
            return of or "the picture"
        return f"the tile of {tile.width} x {tile.height} pixels at ({tile.x}, {tile.y})" + (of and f" of {of}")

    def _judged(self, state: BackendState, part: Part, error: BaseException) -> BaseException:
        """Return the error of a call, or WrongAnswer where the contracts do not fail here."""
        genuine = isinstance(error, NodeError | OutOfGasError | WrongAnswer) or not isinstance(error, ChainError)
        if genuine or self._verifier is None or not state.backend.untrusted:
            return error
        try:
            self._verifier.draw(self._frames[part.frame], part.tile)
        except Exception:
            return error
        return WrongAnswer(str(error))

    def _put_first(self, parts: Sequence[Part]) -> None:
        """Restore parts from the store, or put them at the head of the queue."""
        for part in reversed(parts):
            piece = self._store.read(part) if self._store is not None else None
            if piece is None:
                self._pending.appendleft(part)
            else:
                self._results[part] = piece
                self._listener.advanced(area(part.tile))

    def _finished(self, state: BackendState, part: Part, piece: Drawing, checked: bool) -> None:
        state.failures = state.busy = state.misses = 0
        state.done += 1
        if state.backend.untrusted and not checked:
            state.unchecked.append(part)
        if self._store is not None:
            self._store.write(part, piece)
        self._results[part] = piece
        self._listener.advanced(area(part.tile))

    def _failed(self, state: BackendState, part: Part, error: BaseException) -> None:
        """Requeue or cut a part that failed; pause or drop the backend."""
        if isinstance(error, TOO_MUCH):
            self._too_much(state, part, error)
            return
        if isinstance(error, WrongAnswer):
            self._pending.appendleft(part)
            name = state.backend.name
            self._leave(state, RenderError(f"the {name} answers wrongly for {self._title(part)}: {error}"))
            return
        if not isinstance(error, NodeError):
            self._error = error
            return
        self._pending.appendleft(part)
        if isinstance(error, NodeBusyError):
            state.busy += 1
            asked = error.retry_after
            pause = PAUSE * 2**state.busy if asked is None else asked
            given_up = state.busy > BUSY or pause > 4 * LONGEST_PAUSE
        else:
            state.failures += 1
            asked, pause = None, PAUSE * 2**state.failures
            given_up = state.failures >= FAILURES or isinstance(error, WrongChainError)
        if given_up:
            self._leave(state, error)
        else:
            # random, so that not all slots retry at the same time
            least = pause / 2 if asked is None else asked
            state.until = time.monotonic() + random.uniform(least, max(least, min(pause, LONGEST_PAUSE)) * 1.25)

    def _too_much(self, state: BackendState, part: Part, error: BaseException) -> None:
        """Cut a part; drop a backend that finds many too large, if there are others."""
        state.misses += 1
        others = any(each is not state and not each.left for each in self._states)
        tiles = halves(part.tile)
        if not isinstance(error, OutOfGasError):
            # gas depends on what is visible; the size of an answer and its time depend on the number of pixels
            state.capacity = min(state.capacity, max(map(area, tiles)))
        if len(tiles) == 1 and not others:
            tile = f"a tile of {part.tile.width} x {part.tile.height} pixels"
            text = f"{error}; {tile} cannot be split: use fewer triangles (`max_triangles`)"
            if isinstance(error, OutOfGasError) and state.backend.gas is not None and not state.backend.untrusted:
                text = f"{error} even for {tile}; raise `gas_limit` or use `max_triangles`"
            self._error = type(error)(text)
            if isinstance(self._error, OutOfGasError):
                self._error.limit = state.backend.gas
            return
        self._put_first([Part(part.frame, tile) for tile in tiles])
        if others and state.misses >= (TIMEOUTS if isinstance(error, NodeTimeoutError) else MISSES):
            self._leave(state, error)

    def _leave(self, state: BackendState, error: BaseException) -> None:
        """Drop a backend, and requeue its parts that were not compared if it answered wrongly."""
        if state.left:
            return
        state.left = True
        wrong = not isinstance(error, NodeError | OutOfGasError)
        revoked = [part for part in state.unchecked if wrong and part in self._results]
        for part in revoked:
            del self._results[part]
            state.done -= 1
            if self._store is not None:
                self._store.forget(part)
            self._pending.append(part)
            self._listener.advanced(-area(part.tile))
        if all(each.left for each in self._states):
            several = len(self._states) > 1
            self._error = RenderError(f"no backend is left to render: {error}") if several else error
            return
        parts = f"{1 + len(revoked)} parts are" if revoked else "1 part is"
        again = f", and {parts} rendered again by others" if wrong else ""
        self._listener.warned(f"{error}; it is left out{again}")
