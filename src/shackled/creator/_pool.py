"""Pictures for many visitors at once, rendered in worker processes.

There are three queues: live pictures, long tasks such as GIFs and traces, in processes of lower priority, and untrusted
files, in a sandboxed process. A worker that takes too long or too much memory, or ends, is replaced; the visitor whose
job it was gets one error.
"""

from __future__ import annotations

import asyncio
import hashlib
import os
from dataclasses import replace
from typing import Any

from ..errors import InputError
from ..tokens import EditionTerms
from ._edition import EditionCalls
from ._picture import Comparison, File, Frame, StagePicture, Upload
from ._queue import PoolError, Progress, Queue
from ._scene import Facts
from ._state import Source, State
from ._store import MEGABYTE, Limits, Store, Stored
from ._takeaway import uploaded

__all__ = ["Pool", "PoolError"]

#: Pictures of more pixels are long tasks.
LARGE = 512 * 512
#: Seconds that a live picture may still take after a newer one was requested.
GRACE = 3.0


class Pool:
    """The queues and workers of the Creator, for one event loop: `async with Pool() as pool`, or `start` and `close`.

    Methods raise InputError for wrong input, RenderError for what a contract refused, and PoolError where the work
    could not be done. Cancel a long task by cancelling the asyncio task that waits for it.
    """

    def __init__(self, workers: int | None = None, limits: Limits | None = None, node: str | None = None) -> None:
        """Start no worker yet.

        workers: number of processes for live pictures, one per core by default. node: address for `compare`.
        """
        self.limits = limits or Limits()
        self.store = Store(self.limits.stored)
        self._node = node
        self._facts: dict[Source, Facts] = {}
        bound, count = self.limits, workers or _cores()
        self._live = Queue("picture", count, bound, bound.seconds, grace=GRACE)
        self._slow = Queue("long task", 2, bound, bound.slow_seconds, niceness=10)
        self._reading = Queue("file", 1, bound, bound.reading_seconds, niceness=5, guarded=True)
        self._queues = (self._live, self._slow, self._reading)

    async def __aenter__(self) -> Pool:
        """Start."""
        await self.start()
        return self

    async def __aexit__(self, *error: object) -> None:
        """End."""
        await self.close()

    async def start(self) -> None:
        """Start the workers for live pictures; the others are started when they are needed."""
        await self._live.warm()

    async def close(self) -> None:
        """End all workers at once."""
        await asyncio.gather(*(queue.close() for queue in self._queues))

    @property
    def has_node(self) -> bool:
        """Whether there is a node for `compare`."""
        return self._node is not None

    def leave(self, visitor: str) -> None:
        """Drop all jobs of a visitor."""
        for queue in self._queues:
            queue.leave(visitor)

    # ---- live ----

    async def open(self, source: Source, visitor: str = "") -> Facts:
        """Return the facts of a source. InputError if it does not exist, or the upload is not in memory."""
        if source.kind == "upload":
            return self.store.get(source.name).facts
        if source not in self._facts:
            facts: Facts = await self._ask(self._live, visitor, f"open {source.name}", "facts", source)
            if len(self._facts) >= 1000:  # the number of seeds is not limited
                self._facts.clear()
            self._facts[source] = facts
        return self._facts[source]

    async def render(self, visitor: str, state: State, longest: int | None = None, count: bool = True) -> Frame | None:
        """Render a picture; None if a newer one of the same visitor replaced it, or the visitor has left.

        longest: limit of the longer side in pixels, as during a drag. count: whether triangles and pixels are counted,
        which doubles the time.
        """
        queue, other = self._live, self._slow
        # large pictures must not delay those of a drag
        if await self._pixels(visitor, state, longest) > LARGE:
            queue, other = other, queue
        other.supersede(visitor, "live")
        frame: Frame | None = await self._ask(
            queue, visitor, "live", "picture", state, longest, count, newest=True, uploads=state.source
        )
        return frame

    async def call(self, visitor: str, state: State) -> tuple[bytes, float]:
        """Return the data of the call, and the length in it of a radius of the source."""
        call: tuple[bytes, float] = await self._ask(self._live, visitor, "call", "call", state, uploads=state.source)
        return call

    async def thumbnail(self, name: str) -> bytes:
        """Render a piece at 128 x 128 pixels; return a PNG file, which is cached on disk."""
        png: bytes = await self._ask(self._live, "", f"thumbnail {name}", "thumbnail", name)
        return png

    async def take(self, visitor: str, state: State, kind: str, scale: int = 1, link: str = "") -> File:
        """Make a file to download. kind: name of one of `KINDS`. scale: of a PNG. link: address of the picture."""
        stored = self.store.get(state.source.name) if state.source.kind == "upload" else None
        if kind == "file":
            return uploaded(stored)
        if stored is not None:  # the worker needs only its name
            stored = replace(stored, scene=b"", data=b"")
        queue = self._slow if await self._pixels(visitor, state) > LARGE else self._live
        file: File = await self._ask(
            queue, visitor, f"take {kind}", "take", state, kind, scale, stored, link, uploads=state.source
        )
        return file

    async def edition(self, visitor: str, state: State, terms: EditionTerms) -> EditionCalls:
        """Return the transactions that store the scene and add it as an edition. terms: without the scene."""
        queue = self._slow if await self._pixels(visitor, state) > LARGE else self._live
        calls: EditionCalls = await self._ask(queue, visitor, "edition", "edition", state, terms, uploads=state.source)
        return calls

    # ---- long work ----

    async def turntable(
        self,
        visitor: str,
        state: State,
        frames: int = 36,
        milliseconds: int = 60,
        scale: int = 1,
        progress: Progress | None = None,
    ) -> bytes:
        """Render a GIF in which the object turns once about the vertical axis. progress: called with (done, total)."""
        pixels = gif_pixels(await self._pixels(visitor, state), frames, scale)
        if not 2 <= frames <= self.limits.gif_frames:
            raise InputError(f"a GIF has 2 to {self.limits.gif_frames} frames, not {frames}")
        if pixels > self.limits.gif_pixels:
            raise InputError(
                f"the GIF would have {pixels:,} pixels, more than the limit of {self.limits.gif_pixels:,}: choose fewer"
                " frames or a smaller size"
            )
        made: list[bytes] = []
        for number in range(frames):
            if progress is not None:
                progress(number, frames)
            made.append(
                await self._ask(self._slow, visitor, "gif", "turn", state, number, frames, uploads=state.source)
            )
        gif: bytes = await self._ask(self._slow, visitor, "gif", "gif", made, milliseconds, scale)
        if progress is not None:
            progress(frames, frames)
        return gif

    async def stages(self, visitor: str, state: State) -> list[StagePicture]:
        """Render the six pictures of the pipeline."""
        stages: list[StagePicture] = await self._ask(
            self._slow, visitor, "stages", "stages", state, uploads=state.source
        )
        return stages

    async def stage_gas(self, visitor: str, state: State) -> dict[str, int]:
        """Trace the gas of each stage in order of execution."""
        gas: dict[str, int] = await self._ask(self._slow, visitor, "gas", "stage_gas", state, uploads=state.source)
        return gas

    async def compare(self, visitor: str, state: State) -> Comparison:
        """Compare the picture with that of the node. InputError if the Creator was started without a node."""
        if self._node is None:
            raise InputError("there is no node to compare with: start the Creator with --rpc URL")
        result: Comparison = await self._ask(
            self._slow, visitor, "node", "compare", state, self._node, uploads=state.source
        )
        return result

    # ---- files ----

    async def upload(self, visitor: str, name: str | None, data: bytes) -> Upload:
        """Read an untrusted file. InputError if it cannot be shown.

        name: of the file; None for an archive of several files that were uploaded together.
        """
        if len(data) > self.limits.upload:
            raise InputError(f"the file is larger than the limit of {self.limits.upload / MEGABYTE:g} MB")
        sha256: str
        stored: Stored
        sha256, stored, notes = await self._ask(self._reading, visitor, "read", "read", name, data)
        assert sha256 == hashlib.sha256(data).hexdigest()
        stored = replace(stored, data=data)
        self.store.put(sha256, stored)
        return Upload(stored.facts.source, stored.facts, notes)

    async def _pixels(self, visitor: str, state: State, longest: int | None = None) -> float:
        size = state.size or (await self.open(state.source, visitor)).defaults.size
        assert size is not None
        share = min(1.0, longest / max(size.width, size.height)) if longest else 1.0
        return size.width * size.height * share * share

    async def _ask(
        self,
        queue: Queue,
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
        result = await queue.ask(visitor, channel, task, arguments, newest, supply, progress)
        if result is None and not newest:
            raise PoolError("the job was dropped, because the visitor has left")
        return result


def gif_pixels(pixels: float, frames: int, scale: int) -> int:
    """Return the number of pixels of all frames of a GIF. pixels: of one frame, before it is enlarged."""
    return round(pixels) * frames * scale * scale


def _cores() -> int:
    try:
        return len(os.sched_getaffinity(0))
    except AttributeError:  # not available on every system
        return os.cpu_count() or 1
