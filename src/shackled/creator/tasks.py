"""What a worker does for a visitor, each a method of its desk."""

from __future__ import annotations

import pickle
import time
from collections import OrderedDict
from collections.abc import Callable, Sequence
from typing import Any, Generic, TypeVar

from ..artifacts import artifact
from ..chain import Chain, EmbeddedChain, open_chain, returned_bytes, returned_counts
from ..datasets import require
from ..errors import InputError, RenderError
from ..gas import render_call
from ..image import decode_bmp
from ..scene import Scene, full_turn, resize, simplify_scene
from .film import film, png
from .fits import by_trying, places
from .limits import Limits
from .picture import Comparison, File, Frame, StagePicture
from .scene import Facts, arranged, describe
from .state import Source, State
from .store import Stored
from .subject import Subject
from .takeaway import make
from .worker import MissingUploadError

Key = TypeVar("Key")
Value = TypeVar("Value")

#: Sources that a worker keeps at hand.
KEPT = 24


class Recent(Generic[Key, Value]):
    """The values that were asked for last."""

    def __init__(self, size: int) -> None:
        """`size`: how many are kept."""
        self._size = size
        self._values: OrderedDict[Key, Value] = OrderedDict()

    def get(self, key: Key, make: Callable[[], Value]) -> Value:
        """The value of a key; it is made if it is not at hand."""
        if key not in self._values:
            self._values[key] = make()
        self._values.move_to_end(key)
        while len(self._values) > self._size:
            self._values.popitem(last=False)
        return self._values[key]


class Desk:
    """A worker's place: an EVM, and the sources that were asked for last.

    Every method but `receive` is a task. They raise InputError and RenderError, and MissingUploadError for a file that
    this worker was not given yet.
    """

    def __init__(self, limits: Limits, progress: Callable[[int, int], None]) -> None:
        """`progress` is told how much of long work is done, of how much."""
        self._limits = limits
        self._progress = progress
        self._uploads: Recent[str, tuple[Scene, Facts]] = Recent(KEPT)
        self._sources: Recent[Source, tuple[Scene, Facts]] = Recent(KEPT)
        self._turning: Recent[tuple[State, int, int | None], list[Scene]] = Recent(2)
        self._simplified: Recent[tuple[Source, int], Scene] = Recent(KEPT)

    def receive(self, uploads: dict[str, Stored]) -> None:
        """Takes files that a task needs."""
        for sha256, stored in uploads.items():
            opened = pickle.loads(stored.scene), stored.facts
            self._uploads.get(sha256, lambda opened=opened: opened)  # type: ignore[misc]

    # ---- tasks ----

    def hello(self) -> str:
        """Gets everything ready for a first picture; the name of the chain."""
        chain = self._chain()
        chain.address("Renderer")
        return chain.name

    def facts(self, source: Source) -> Facts:
        """What is known of a source."""
        return self._open(source)[1]

    def picture(self, state: State, longest: int | None, count: bool) -> Frame:
        """A picture; its longer side brought down to `longest`, triangles and pixels counted if wanted."""
        scene = shrunk(self.scene(state), longest)
        chain = self._chain()
        data = render_call(scene)
        started = time.perf_counter()
        result = chain.call("Renderer", data)
        seconds = time.perf_counter() - started
        triangles = lit_pixels = suffices = None
        if count:
            counted = chain.call("Renderer", artifact("Renderer").selectors["renderCounted"] + data[4:])
            triangles, lit_pixels = returned_counts(counted.output)
            suffices = by_trying(lambda gas: chain.call("Renderer", data, gas))
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
            fits=places(result.gas, result.intrinsic_gas, data, suffices),
        )

    def thumbnail(self, name: str) -> bytes:
        """A piece at 128 x 128 as it comes, as a PNG; kept on disk from run to run."""
        from ..datasets import draw

        return draw(require(name)).png

    def turn(self, state: State, number: int, frames: int, longest: int | None) -> bytes:
        """One picture of a turntable of so many, as a PNG."""
        key = state, frames, longest
        turning = self._turning.get(key, lambda: full_turn(shrunk(self.scene(state), longest), frames))
        return png(self._draw(turning[number]), 1)

    def gif(self, frames: Sequence[bytes], milliseconds: int, scale: int) -> bytes:
        """A film that goes round for ever, of pictures as PNG."""
        return film(frames, milliseconds, scale)

    def stages(self, state: State, longest: int | None) -> list[StagePicture]:
        """The six pictures of the pipeline."""
        from ..stages import draw_stages

        made = draw_stages(shrunk(self.scene(state), longest), self._chain())
        return [StagePicture(each.name, each.title, each.detail, png(each.pixels, 1)) for each in made]

    def stage_gas(self, state: State, longest: int | None) -> dict[str, int]:
        """Gas by stage, in the order in which a picture is made; traced, which takes a second for two million gas."""
        from ..gas import profile

        scene = shrunk(self.scene(state), longest)
        total = self._chain().draw(scene).gas or 0
        if total > self._limits.traced_gas:
            raise InputError(
                f"gas is traced stage by stage for pictures of up to {self._limits.traced_gas:,} gas; this one takes"
                f" {total:,}: choose a smaller size or fewer triangles"
            )
        return profile(scene, lambda used: self._progress(used, total)).stages()

    def compare(self, state: State, url: str) -> Comparison:
        """The picture made by a node, beside the one that is made here."""
        from ..chain import open_node

        scene = self.scene(state)
        node: Chain = open_node(url)
        started = time.perf_counter()
        theirs = node.draw(scene).bmp
        seconds = time.perf_counter() - started
        return Comparison(theirs == self._chain().draw(scene).bmp, node.name, seconds)

    def read(self, name: str | None, data: bytes) -> tuple[str, Stored, tuple[str, ...]]:
        """Reads a file of a stranger: its SHA-256, what is kept of it, and notes for people."""
        from .upload import read_upload

        return read_upload(name, data, self._limits)

    def take(self, state: State, kind: str, scale: int, stored: Stored | None, link: str) -> File:
        """A file to take away; `stored` is that of an upload."""
        source, facts = self._open(state.source)
        subject = Subject(state, facts, source, self.scene(state), stored, link)
        return make(kind, subject, self._chain(), scale)

    # ---- what tasks have in common ----

    def scene(self, state: State) -> Scene:
        """The scene that is drawn."""
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
    """The scene on a smaller canvas of the same shape; no side is longer than `longest`."""
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
