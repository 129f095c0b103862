"""The tasks of worker processes: each is a method of `Tasks`."""

from __future__ import annotations

import pickle
import time
from collections import OrderedDict
from collections.abc import Callable, Sequence
from typing import Any, Generic, TypeVar

from ..artifacts import artifact
from ..chain import EmbeddedChain, open_chain, returned_bytes, returned_counts
from ..datasets import require
from ..errors import RenderError
from ..gas import fits_of, render_call, suffices
from ..image import decode_bmp
from ..scene import Scene, fit_factor, full_turn, resize, simplify_scene
from ..tokens import EditionTerms
from ..workers import report_progress
from ._edition import EditionCalls, edition_calls
from ._picture import Comparison, File, Frame, StagePicture, gif, png
from ._programs import Subject
from ._scene import Facts, arranged, describe
from ._state import Source, State
from ._store import Limits, Stored
from ._takeaway import make_file

Key = TypeVar("Key")
Value = TypeVar("Value")
MakeTasks = Callable[[Limits, Callable[[int, int], None]], Any]

#: Number of sources that a worker keeps in memory.
KEPT = 24


class MissingUploadError(Exception):
    """The worker needs an upload that it has not been given."""


class Recent(Generic[Key, Value]):
    """The most recently used values of a function."""

    def __init__(self, size: int) -> None:
        """Keep nothing yet. size: number of values that are kept."""
        self._size = size
        self._values: OrderedDict[Key, Value] = OrderedDict()

    def get(self, key: Key, make: Callable[[], Value]) -> Value:
        """Return the value of a key; make it if it is not kept."""
        if key not in self._values:
            self._values[key] = make()
        self._values.move_to_end(key)
        while len(self._values) > self._size:
            self._values.popitem(last=False)
        return self._values[key]


class Tasks:
    """The tasks of a worker process, with an EVM and the sources that were used last.

    Every public method but `receive` and `scene` is a task. Tasks raise InputError and RenderError, and
    MissingUploadError for an upload that this worker has not been given.
    """

    def __init__(self, limits: Limits, progress: Callable[[int, int], None]) -> None:
        """Open the EVM. progress: called with (done, total) during long tasks."""
        self._limits = limits
        self._progress = progress
        self._uploads: Recent[str, tuple[Scene, Facts]] = Recent(KEPT)
        self._sources: Recent[Source, tuple[Scene, Facts]] = Recent(KEPT)
        self._turning: Recent[tuple[State, int], list[Scene]] = Recent(2)
        self._simplified: Recent[tuple[Source, int], Scene] = Recent(KEPT)

    def receive(self, uploads: dict[str, Stored]) -> None:
        """Take uploads that a task needs, by their SHA-256."""
        for sha256, stored in uploads.items():
            opened = pickle.loads(stored.scene), stored.facts
            self._uploads.get(sha256, lambda opened=opened: opened)  # type: ignore[misc]

    def warm(self) -> str:
        """Prepare for the first picture; return the name of the chain."""
        chain = self._chain()
        chain.address("Renderer")
        return chain.name

    def facts(self, source: Source) -> Facts:
        """Return the facts of a source."""
        return self._open(source)[1]

    def picture(self, state: State, longest: int | None, count: bool) -> Frame:
        """Render a picture. longest: limit of its longer side. count: whether triangles and pixels are counted."""
        scene = shrunk(self.scene(state), longest)
        chain = self._chain()
        data = render_call(scene)
        started = time.perf_counter()
        result = chain.call("Renderer", data)
        seconds = time.perf_counter() - started
        triangles = lit_pixels = enough = None
        if count:
            counted = chain.call("Renderer", artifact("Renderer").selectors["renderCounted"] + data[4:])
            triangles, lit_pixels = returned_counts(counted.output)
            enough = suffices(chain, "Renderer", data)
        return Frame(
            bmp=returned_bytes(result.output, 0),
            width=scene.width,
            height=scene.height,
            gas=result.gas,
            intrinsic_gas=result.intrinsic_gas,
            triangles=triangles,
            lit_pixels=lit_pixels,
            calldata_bytes=len(data),
            seconds=seconds,
            fits=fits_of(result.gas, result.intrinsic_gas, data, enough),
        )

    def call(self, state: State) -> tuple[bytes, float]:
        """Return the data of the call, and the length in it of a radius of the source."""
        scene = self.scene(state)
        return render_call(scene), fit_factor(scene) * self._open(state.source)[1].bounds.radius

    def thumbnail(self, name: str) -> bytes:
        """Render a piece at 128 x 128 pixels; return a PNG file, which is cached on disk."""
        from ..datasets import draw

        return draw(require(name)).png

    def turn(self, state: State, number: int, frames: int) -> bytes:
        """Render one frame of a turntable; return a PNG file."""
        turning = self._turning.get((state, frames), lambda: full_turn(self.scene(state), frames))
        return png(self._draw(turning[number]), 1)

    def gif(self, frames: Sequence[bytes], milliseconds: int, scale: int) -> bytes:
        """Return an endless GIF. frames: PNG files."""
        return gif(frames, milliseconds, scale)

    def stages(self, state: State) -> list[StagePicture]:
        """Render the six pictures of the pipeline."""
        from ..stages import draw_stages

        made = draw_stages(self.scene(state), self._chain())
        return [StagePicture(each.name, each.title, each.detail, png(each.pixels, 1)) for each in made]

    def stage_gas(self, state: State) -> dict[str, int]:
        """Trace the gas of each stage in order of execution."""
        from ..gas import profile

        return profile(self.scene(state)).stages()

    def compare(self, state: State, url: str) -> Comparison:
        """Render the picture on a node and compare it with ours."""
        from ..chain import open_node

        scene = self.scene(state)
        node = open_node(url)
        started = time.perf_counter()
        theirs = node.draw(scene).bmp
        seconds = time.perf_counter() - started
        return Comparison(theirs == self._chain().draw(scene).bmp, node.name, seconds)

    def read(self, name: str | None, data: bytes) -> tuple[str, Stored, tuple[str, ...]]:
        """Read an untrusted file; see `read_upload`."""
        from ._upload import read_upload

        return read_upload(name, data, self._limits)

    def take(self, state: State, kind: str, scale: int, stored: Stored | None, link: str) -> File:
        """Make a file to download. stored: the upload, if the source is one."""
        source, facts = self._open(state.source)
        subject = Subject(state, facts, source, self.scene(state), stored, link)
        return make_file(kind, subject, self._chain(), scale)

    def edition(self, state: State, terms: EditionTerms) -> EditionCalls:
        """Return the transactions that store the scene and add it as an edition."""
        return edition_calls(self.scene(state), terms, self._chain())

    def scene(self, state: State) -> Scene:
        """Return the scene that is rendered."""
        scene, facts = self._open(state.source)
        if state.max_triangles is not None:
            most, whole = state.max_triangles, scene
            scene = self._simplified.get((state.source, most), lambda: simplify_scene(whole, most))
        return arranged(state, scene, facts.bounds)

    def _open(self, source: Source) -> tuple[Scene, Facts]:
        if source.kind == "upload":
            return self._uploads.get(source.name, lambda: _missing(source.name))
        return self._sources.get(source, lambda: _piece(source))

    def _chain(self) -> EmbeddedChain:
        chain = open_chain()
        if not isinstance(chain, EmbeddedChain):
            raise RenderError(f"the Creator needs an embedded EVM, not the {chain.name}")
        chain.gas_limit = self._limits.gas
        return chain

    def _draw(self, scene: Scene) -> Any:
        return decode_bmp(self._chain().draw(scene).bmp, scene.width, scene.height)


def shrunk(scene: Scene, longest: int | None) -> Scene:
    """Return the scene on a smaller canvas of the same shape. longest: limit of its longer side, or None."""
    largest = max(scene.width, scene.height)
    if longest is None or largest <= longest:
        return scene
    width, height = (max(1, round(side * longest / largest)) for side in (scene.width, scene.height))
    return resize(scene, (width, height))


def _missing(sha256: str) -> tuple[Scene, Facts]:
    raise MissingUploadError(sha256)


def _piece(source: Source) -> tuple[Scene, Facts]:
    piece = require(source.name)
    scene = piece.make()
    return scene, describe(source, scene, piece.title, piece.notice, piece.licence)


# ---- in the worker process ----

_tasks: Any = None


def prepare(make_tasks: MakeTasks, limits: Limits, guarded: bool) -> None:
    """Make the tasks of this process. guarded: whether it reads untrusted files; it can then open no other file."""
    global _tasks
    _tasks = make_tasks(limits, report_progress)
    if guarded:
        from ._sandbox import enter_sandbox

        enter_sandbox()


def perform(task: str, arguments: tuple[Any, ...], uploads: dict[str, Any]) -> tuple[Any, float]:
    """Do a task; return its result and the seconds of processor time. uploads: that this worker lacked."""
    _tasks.receive(uploads)
    begun = time.process_time()
    result = getattr(_tasks, task)(*arguments)
    return result, time.process_time() - begun
