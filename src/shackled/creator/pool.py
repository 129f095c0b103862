"""Pictures for many visitors at once, made in worker processes.

Visitors are served in turn. What a visitor wants to see live is made by workers of its own, so that long work, such as
a film or a trace of the gas, never stands in its way; the system lets long work wait as well, for its processes are
nice. Files of strangers are read by a process that can do nothing else. A worker that takes too long, or ends, or takes
too much memory, costs the visitor who asked one clear error, and is replaced.
"""

from __future__ import annotations

import asyncio
import hashlib
import os
from collections.abc import Callable
from dataclasses import replace
from typing import Any

from ..errors import InputError
from .lane import Lane, PoolError
from .limits import MEGABYTE, Limits
from .picture import Comparison, File, Frame, StagePicture, Upload
from .scene import Facts
from .state import Source, State
from .store import Store, Stored
from .takeaway import uploaded

__all__ = ["Pool", "PoolError"]

Progress = Callable[[int, int], None]

#: Pixels of pictures that count as long work.
LARGE = 512 * 512
#: Seconds that a live picture may still take when a newer one is wanted.
GRACE = 3.0


class Pool:
    """Use it within one event loop: `async with Pool() as pool`, or `start` and `close`.

    Methods raise InputError for what a visitor did wrong, RenderError for what a contract refused, and its child
    PoolError where the work could not be done here. Long work is cancelled by cancelling the task that waits for it.
    """

    def __init__(self, workers: int | None = None, limits: Limits | None = None, node: str | None = None) -> None:
        """workers: for live pictures; None takes one for each core. node: the address of one to compare with."""
        self.limits = limits or Limits()
        self.store = Store(self.limits.stored)
        self._node = node
        self._facts: dict[Source, Facts] = {}
        bound, waiting = self.limits, self.limits.waiting
        count = workers or _cores()
        self._live = Lane("picture", count, bound, bound.seconds, waiting, grace=GRACE)
        self._slow = Lane("long work", 2, bound, bound.slow_seconds, waiting, niceness=10)
        self._reading = Lane("file", 1, bound, bound.reading_seconds, waiting, niceness=5, guarded=True)
        self._lanes = (self._live, self._slow, self._reading)

    async def __aenter__(self) -> Pool:
        """Starts."""
        await self.start()
        return self

    async def __aexit__(self, *error: object) -> None:
        """Ends."""
        await self.close()

    async def start(self) -> None:
        """Gets the workers for live pictures ready; the others are started when they are needed."""
        await self._live.warm()

    async def close(self) -> None:
        """Ends all workers, whatever they are at."""
        await asyncio.gather(*(lane.close() for lane in self._lanes))

    @property
    def has_node(self) -> bool:
        """Whether pictures can be compared with those of a node."""
        return self._node is not None

    def leave(self, visitor: str) -> None:
        """Gives up all that a visitor waits for."""
        for lane in self._lanes:
            lane.leave(visitor)

    # ---- live ----

    async def open(self, source: Source, visitor: str = "") -> Facts:
        """What is known of a source. InputError if there is none of that name, or the file is not here."""
        if source.kind == "upload":
            return self.store.get(source.name).facts
        if source not in self._facts:
            facts: Facts = await self._ask(self._live, visitor, f"open {source.name}", "facts", source)
            if len(self._facts) >= 1000:  # anyone may ask for any seed
                self._facts.clear()
            self._facts[source] = facts
        return self._facts[source]

    async def render(self, visitor: str, state: State, longest: int | None = None, count: bool = True) -> Frame | None:
        """The picture of a state; None if a newer one of the same visitor took its place, or the visitor has left.

        longest: the longer side is brought down to so many pixels, as while dragging. count: without it, triangles and
        pixels are left out, which takes half the time.
        """
        lane, other = self._live, self._slow
        # large pictures must not stand in the way of those that are dragged
        if await self._pixels(visitor, state, longest) > LARGE:
            lane, other = other, lane
        other.supersede(visitor, "live")
        frame: Frame | None = await self._ask(
            lane, visitor, "live", "picture", state, longest, count, newest=True, uploads=state.source
        )
        return frame

    async def thumbnail(self, name: str, visitor: str = "") -> bytes:
        """A piece at 128 x 128 as it comes, as a PNG; kept on disk from run to run."""
        png: bytes = await self._ask(self._live, visitor, f"thumbnail {name}", "thumbnail", name)
        return png

    async def take(self, visitor: str, state: State, kind: str, scale: int = 1, link: str = "") -> File:
        """A file to take away, of one of the kinds of `takeaway.KINDS`. link: the address that restores the picture."""
        stored = self.store.get(state.source.name) if state.source.kind == "upload" else None
        if kind == "file":
            return uploaded(stored)
        if stored is not None:  # the worker needs its name only
            stored = replace(stored, scene=b"", data=b"")
        lane = self._slow if await self._pixels(visitor, state) > LARGE else self._live
        file: File = await self._ask(
            lane, visitor, f"take {kind}", "take", state, kind, scale, stored, link, uploads=state.source
        )
        return file

    # ---- long work ----

    async def turntable(
        self,
        visitor: str,
        state: State,
        frames: int = 36,
        milliseconds: int = 60,
        scale: int = 1,
        longest: int | None = None,
        progress: Progress | None = None,
    ) -> bytes:
        """A GIF of the object turning once about the upright axis, frame by frame."""
        pixels = film_pixels(await self._pixels(visitor, state, longest), frames, scale)
        if not 2 <= frames <= self.limits.gif_frames:
            raise InputError(f"a film has from 2 to {self.limits.gif_frames} pictures, not {frames}")
        if pixels > self.limits.gif_pixels:
            raise InputError(
                f"the film would have {pixels:,} pixels, at most {self.limits.gif_pixels:,} are made: choose fewer"
                " pictures or a smaller size"
            )
        made: list[bytes] = []
        for number in range(frames):
            if progress is not None:
                progress(number, frames)
            made.append(
                await self._ask(
                    self._slow, visitor, "film", "turn", state, number, frames, longest, uploads=state.source
                )
            )
        film: bytes = await self._ask(self._slow, visitor, "film", "gif", made, milliseconds, scale)
        if progress is not None:
            progress(frames, frames)
        return film

    async def stages(self, visitor: str, state: State, longest: int | None = None) -> list[StagePicture]:
        """The six pictures of the pipeline."""
        stages: list[StagePicture] = await self._ask(
            self._slow, visitor, "stages", "stages", state, longest, uploads=state.source
        )
        return stages

    async def stage_gas(
        self, visitor: str, state: State, longest: int | None = None, progress: Progress | None = None
    ) -> dict[str, int]:
        """Gas by stage, in the order in which a picture is made; it takes a second for two million gas."""
        gas: dict[str, int] = await self._ask(
            self._slow, visitor, "gas", "stage_gas", state, longest, uploads=state.source, progress=progress
        )
        return gas

    async def compare(self, visitor: str, state: State) -> Comparison:
        """The picture as the node makes it, beside ours. InputError if the Creator was started without a node."""
        if self._node is None:
            raise InputError("there is no node to compare with: start the Creator with --rpc URL")
        result: Comparison = await self._ask(
            self._slow, visitor, "node", "compare", state, self._node, uploads=state.source
        )
        return result

    # ---- files ----

    async def upload(self, visitor: str, name: str | None, data: bytes) -> Upload:
        """Reads a file of a stranger; of no name, it is an archive of files that were handed in together.

        InputError, for people, if it cannot be shown.
        """
        if len(data) > self.limits.upload:
            raise InputError(f"the file is larger than the {self.limits.upload / MEGABYTE:g} MB that are read")
        sha256: str
        stored: Stored
        sha256, stored, notes = await self._ask(self._reading, visitor, "read", "read", name, data)
        assert sha256 == hashlib.sha256(data).hexdigest()
        stored = replace(stored, data=data)
        self.store.put(sha256, stored)
        return Upload(stored.facts.source, stored.facts, notes)

    async def _pixels(self, visitor: str, state: State, longest: int | None = None) -> float:
        """Of a picture."""
        size = state.size or (await self.open(state.source, visitor)).defaults.size
        assert size is not None
        share = min(1.0, longest / max(size.width, size.height)) if longest else 1.0
        return size.width * size.height * share * share

    async def _ask(
        self,
        lane: Lane,
        visitor: str,
        channel: str,
        task: str,
        *arguments: Any,
        newest: bool = False,
        uploads: Source | None = None,
        progress: Progress | None = None,
    ) -> Any:
        supply = None
        if uploads is not None and uploads.kind == "upload":
            name = uploads.name
            self.store.get(name)
            supply = lambda: {name: replace(self.store.get(name), data=b"")}  # noqa: E731
        result = await lane.ask(visitor, channel, task, arguments, newest, supply, progress)
        if result is None and not newest:
            raise PoolError("it was given up, as the visitor has left")
        return result


def film_pixels(pixels: float, frames: int, scale: int) -> int:
    """Of all pictures of a film, each of so many."""
    return round(pixels) * frames * scale * scale


def _cores() -> int:
    """That this process may use."""
    try:
        return len(os.sched_getaffinity(0))
    except AttributeError:  # not every system tells
        return os.cpu_count() or 1
