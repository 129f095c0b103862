"""Spreads parts over places.

Each seat of a place takes the next part when it is free, so that slow places get fewer. What a place cannot do goes
back to the others; a place that fails again and again, or answers wrongly, is left out.
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

from ..chain import Drawing
from ..errors import (
    ChainError,
    NodeBusyError,
    NodeError,
    NodeTimeoutError,
    OutOfGasError,
    RenderError,
    TooLargeError,
    WrongChainError,
)
from ..scene import Scene
from ._listener import Listener
from ._part import Part, check_part
from ._place import Place
from ._referee import Referee
from ._store import Store
from ._tiles import area, halves

#: How often in a row a place may fail, be busy, and, while there are others, find parts too large.
FAILURES, BUSY, MISSES = 3, 10, 6
#: The same for parts that take too long: while it is waited for one, nobody else can do it.
TIMEOUTS = 2
#: The first pause of a place that failed or is busy, and the longest, in seconds.
PAUSE, LONGEST_PAUSE = 0.25, 30.0
#: What a place says when a smaller part may do.
TOO_MUCH = (OutOfGasError, TooLargeError, NodeTimeoutError)


class WrongAnswer(RenderError):
    """A place drew something else than the contracts draw."""


@dataclass(eq=False)
class Bench:
    """A place with what was seen of it.

    capacity: the pixels of a part that it can do, as far as is known. failures, busy, misses: in a row.
    unchecked: the parts that it did and that nobody checked. until: when it may be asked again.
    """

    place: Place
    capacity: int = 1 << 62
    failures: int = 0
    busy: int = 0
    misses: int = 0
    until: float = 0.0
    checked: bool = False
    done: int = 0
    left: bool = False
    unchecked: list[Part] = field(default_factory=list)


class Scheduler:
    """Renders the parts of some frames."""

    def __init__(
        self,
        frames: Sequence[Scene],
        places: Sequence[Place],
        store: Store | None = None,
        listener: Listener | None = None,
        referee: Referee | None = None,
    ) -> None:
        """referee: None checks nothing."""
        self._frames = frames
        self._benches = [Bench(place) for place in places]
        self._store, self._listener, self._referee = store, listener or Listener(), referee
        self._changed = threading.Condition(threading.RLock())
        self._pending: deque[Part] = deque()
        self._flying = 0
        self._results: dict[Part, Drawing] = {}
        self._error: BaseException | None = None
        self._stopped = False
        self._told: set[Bench] = set()
        self._comparing = ThreadPoolExecutor(1)

    def run(self, parts: Sequence[Part]) -> dict[Part, Drawing]:
        """The finished parts; those given may have been cut further. An error ends all of it."""
        with self._changed:
            self._put_first(parts)
        seats = [(bench, seat) for bench in self._benches for seat in range(bench.place.seats)]
        # daemons: a node that does not answer shall not keep the process from ending
        threads = [threading.Thread(target=self._sit, args=each, daemon=True) for each in seats]
        try:
            for thread in threads:
                thread.start()
            with self._changed:
                while not self._over():
                    # with a time, so that Ctrl-C comes through on every platform
                    self._changed.wait(0.5)
                if self._error is not None:
                    raise self._error
                return dict(self._results)
        finally:
            with self._changed:
                self._stopped = True
                self._changed.notify_all()
            self._comparing.shutdown(wait=False, cancel_futures=True)

    @property
    def shares(self) -> dict[str, int]:
        """How many parts each place did, of those that count."""
        found: dict[str, int] = {}
        for bench in self._benches:
            # one host may be asked with several keys
            found[bench.place.name] = found.get(bench.place.name, 0) + bench.done
        return found

    @property
    def used(self) -> list[Place]:
        """The places, but for those that were left out before they did anything that counts."""
        return [bench.place for bench in self._benches if bench.done or not bench.left]

    def _over(self) -> bool:
        return self._stopped or self._error is not None or not (self._pending or self._flying)

    def _sit(self, bench: Bench, seat: int) -> None:
        """What the thread of a seat does."""
        while (part := self._take(bench)) is not None:
            piece, failure = None, None
            try:
                piece = bench.place.work(seat, self._frames[part.frame], part.tile)
            except BaseException as error:
                failure = self._judged(bench, part, error)
            if piece is not None and bench.checked and self._referee is not None:
                # beside the next call of this seat; the first part of a place is compared before it gets another
                with suppress(RuntimeError):  # all is over
                    self._comparing.submit(self._settle, bench, part, piece, None)
            else:
                self._settle(bench, part, piece, failure)

    def _settle(self, bench: Bench, part: Part, piece: Drawing | None, failure: BaseException | None) -> None:
        """Takes in what a seat did."""
        checked = False
        if piece is not None and bench.place.distant:
            try:
                checked = self._check(bench, part, piece)
            except BaseException as error:
                failure = self._judged(bench, part, error)
        with self._changed:
            self._flying -= 1
            try:
                if self._stopped:
                    return
                if failure is not None:
                    self._failed(bench, part, failure)
                elif piece is None or (bench.left and not checked):
                    self._pending.appendleft(part)
                else:
                    self._finished(bench, part, piece, checked)
            except BaseException as error:
                # of a listener, or of the disk
                self._error = error
            finally:
                self._changed.notify_all()

    def _take(self, bench: Bench) -> Part | None:
        """The next part for a place; None if there is nothing more to do for it."""
        with self._changed:
            while not self._over() and not bench.left:
                pause = bench.until - time.monotonic()
                part = None if pause > 0 else self._next(bench)
                if part is not None:
                    self._flying += 1
                    return part
                self._changed.wait(pause if pause > 0 else None)
            return None

    def _next(self, bench: Bench) -> Part | None:
        """The first part that a place can do; if there are only larger ones, a piece of the first."""
        for part in self._pending:
            if area(part.tile) <= bench.capacity:
                self._pending.remove(part)
                return part
        while self._pending:
            part = self._pending.popleft()
            smaller = halves(part.tile)
            if area(part.tile) <= bench.capacity or len(smaller) == 1:
                return part
            self._put_first([Part(part.frame, tile) for tile in smaller])
        return None

    def _check(self, bench: Bench, part: Part, piece: Drawing) -> bool:
        """Whether a part was compared. WrongAnswer if it is not what it should be."""
        scene = self._frames[part.frame]
        try:
            check_part(piece, part.tile)
        except ChainError as error:
            raise WrongAnswer(str(error)) from None
        with self._changed:
            first, bench.checked = not bench.checked, True
        if self._referee is None or not self._referee.wants(first):
            return False
        right = self._referee.draw(scene, part.tile)
        if piece.bmp != right.bmp:
            raise WrongAnswer("its picture is not what the contracts draw")
        if None not in (piece.gas, right.gas) and piece.gas != right.gas:
            self._tell_of_gas(bench, part, piece.gas, right.gas)
        return True

    def _tell_of_gas(self, bench: Bench, part: Part, told: int | None, right: int | None) -> None:
        """Warns, once of each place: the picture is right, but the gas is another than under the rules of Cancun."""
        with self._changed:
            if bench not in self._told:
                self._told.add(bench)
                self._listener.warned(
                    f"the {bench.place.name} counts {told:,} gas for {self._title(part)}, which takes {right:,} here: "
                    "its gas is not that of the rules of Cancun"
                )

    def _title(self, part: Part) -> str:
        """Which part it is, for people."""
        tile, frame = part.tile, self._frames[part.frame]
        of = f"frame {part.frame}" if len(self._frames) > 1 else ""
        if (tile.width, tile.height) == (frame.width, frame.height):
            return of or "the picture"
        return f"the tile of {tile.width} x {tile.height} pixels at ({tile.x}, {tile.y})" + (of and f" of {of}")

    def _judged(self, bench: Bench, part: Part, error: BaseException) -> BaseException:
        """What a place says, or WrongAnswer if it says of the contracts what they do not say here."""
        genuine = isinstance(error, NodeError | OutOfGasError | WrongAnswer) or not isinstance(error, ChainError)
        if genuine or self._referee is None or not bench.place.distant:
            return error
        try:
            self._referee.draw(self._frames[part.frame], part.tile)
        except Exception:
            return error
        return WrongAnswer(str(error))

    def _put_first(self, parts: Sequence[Part]) -> None:
        """Takes parts from the store, or else puts them at the head of the queue."""
        for part in reversed(parts):
            if not self._restored(part):
                self._pending.appendleft(part)

    def _restored(self, part: Part) -> bool:
        """Whether an earlier run finished a part."""
        piece = self._store.read(part) if self._store is not None else None
        if piece is None:
            return False
        self._results[part] = piece
        self._listener.advanced(area(part.tile))
        return True

    def _finished(self, bench: Bench, part: Part, piece: Drawing, checked: bool) -> None:
        bench.failures = bench.busy = bench.misses = 0
        bench.done += 1
        if bench.place.distant and not checked:
            bench.unchecked.append(part)
        if self._store is not None:
            self._store.write(part, piece)
        self._results[part] = piece
        self._listener.advanced(area(part.tile))

    def _failed(self, bench: Bench, part: Part, error: BaseException) -> None:
        """Decides what becomes of a part, and of the place that did not do it."""
        if isinstance(error, TOO_MUCH):
            self._too_much(bench, part, error)
            return
        if isinstance(error, WrongAnswer):
            self._pending.appendleft(part)
            self._leave(bench, RenderError(f"the {bench.place.name} answers wrongly for {self._title(part)}: {error}"))
            return
        if not isinstance(error, NodeError):
            self._error = error
            return
        self._pending.appendleft(part)
        if isinstance(error, NodeBusyError):
            bench.busy += 1
            pause = PAUSE * 2**bench.busy if error.retry_after is None else error.retry_after
            given_up = bench.busy > BUSY or pause > 4 * LONGEST_PAUSE
        else:
            bench.failures += 1
            pause = PAUSE * 2**bench.failures
            given_up = bench.failures >= FAILURES or isinstance(error, WrongChainError)
        if given_up:
            self._leave(bench, error)
        else:
            # not all at the same moment again
            least = pause if isinstance(error, NodeBusyError) and error.retry_after is not None else pause / 2
            bench.until = time.monotonic() + random.uniform(least, max(least, min(pause, LONGEST_PAUSE)) * 1.25)

    def _too_much(self, bench: Bench, part: Part, error: BaseException) -> None:
        pixels = area(part.tile)
        bench.misses += 1
        others = [each for each in self._benches if each is not bench and not each.left]
        if not isinstance(error, OutOfGasError):
            # gas depends on what there is to see, but answers and time on the number of pixels
            bench.capacity = min(bench.capacity, max(area(tile) for tile in halves(part.tile)))
        able = not isinstance(error, OutOfGasError) and any(each.capacity >= pixels for each in others)
        parts = [part] if able else [Part(part.frame, tile) for tile in halves(part.tile)]
        if len(parts) == 1 and not others:
            self._error = type(error)(
                f"{error}; a part of {part.tile.width} x {part.tile.height} pixels is still too much: "
                "take fewer triangles (`max_triangles`)"
            )
            return
        self._put_first(parts)
        if others and bench.misses >= (TIMEOUTS if isinstance(error, NodeTimeoutError) else MISSES):
            self._leave(bench, error)
        elif able:
            # let the others take it
            bench.until = time.monotonic() + PAUSE * 2**bench.misses

    def _leave(self, bench: Bench, error: BaseException) -> None:
        """Leaves a place out, and forgets what it did if nobody can vouch for it."""
        if bench.left:
            return
        bench.left = True
        wrong = not isinstance(error, NodeError | OutOfGasError)
        revoked = [part for part in bench.unchecked if wrong and part in self._results]
        for part in revoked:
            del self._results[part]
            bench.done -= 1
            if self._store is not None:
                self._store.forget(part)
            self._pending.append(part)
            self._listener.advanced(-area(part.tile))
        if all(each.left for each in self._benches):
            several = len(self._benches) > 1
            if wrong and not several:
                error = RenderError(f"{error}; there is no other place to render it")
            self._error = RenderError(f"no place is left to render: {error}") if several else error
            return
        again = f", and {_parts(1 + len(revoked))} rendered again by others" if wrong else ""
        self._listener.warned(f"{error}; it is left out{again}")


def _parts(count: int) -> str:
    return "1 part is" if count == 1 else f"{count} parts are"
