"""What the scheduler does with places that fail."""

from __future__ import annotations

import re
import threading
import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import pytest
from attrs import evolve

from shackled import OutputError, RenderError, Scene, load
from shackled.chain import open_chain
from shackled.chain._chain import Drawing
from shackled.errors import (
    NodeBusyError,
    NodeTimeoutError,
    NodeUnreachableError,
    OutOfGasError,
    TooLargeError,
    WrongChainError,
)
from shackled.parallel import Listener
from shackled.parallel._backends import Backend, Part, Verifier, draw_part
from shackled.parallel._scheduler import FAILURES, Scheduler
from shackled.parallel._store import PartStore
from shackled.parallel._tiles import area, cut
from shackled.scene._codec import Rectangle

SIDE = 40
SCENE = evolve(load("cube"), width=SIDE, height=SIDE)
#: Says what goes wrong with the n-th call of a place, counted from 0; or answers None.
Trouble = Callable[[int, Rectangle], BaseException | None]


class Shaky:
    """A place that does right but for its trouble."""

    gas: int | None = None

    def __init__(
        self, name: str, trouble: Trouble = lambda n, tile: None, slots: int = 1, untrusted: bool = True
    ) -> None:
        self.name, self.trouble, self.slots, self.untrusted = name, trouble, slots, untrusted
        self.calls = 0
        self.tiles: list[Rectangle] = []
        self.lies = False
        self.gas_told: int | None = None
        self.lock = threading.Lock()
        self.begun = threading.Event()

    def render(self, scene: Scene, tile: Rectangle) -> Drawing:
        with self.lock:
            number, self.calls = self.calls, self.calls + 1
        self.begun.set()
        error = self.trouble(number, tile)
        if error is not None:
            raise error
        piece = draw_part(open_chain(), scene, tile)
        with self.lock:
            self.tiles.append(tile)
        if self.gas_told is not None:
            piece = replace(piece, gas=self.gas_told)
        return replace(piece, bmp=piece.bmp[:-4] + b"\x01\x02\x03\x04") if self.lies else piece

    def check(self) -> list[str]:
        return []

    def close(self) -> None:
        pass


def after(event: threading.Event) -> Trouble:
    """The trouble of a place that waits for something."""

    def wait(n: int, tile: Rectangle) -> None:
        assert event.wait(60)

    return wait


class Notes(Listener):
    def __init__(self) -> None:
        self.warnings: list[str] = []
        self.pixels = 0

    def advanced(self, pixels: int) -> None:
        self.pixels += pixels

    def warned(self, text: str) -> None:
        self.warnings.append(text)


@pytest.fixture(autouse=True)
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shackled.parallel._scheduler.PAUSE", 0.001)


PARTS = [Part(0, tile) for tile in cut(SIDE, SIDE, 4 * SIDE)]


def run(places: Sequence[Backend], verifier: Verifier | None = None, store: PartStore | None = None) -> Notes:
    """Renders the scene; each pixel must come out once, and right."""
    notes = Notes()
    pieces = Scheduler([SCENE], places, store, notes, verifier).run(PARTS)
    assert sum(area(part.tile) for part in pieces) == notes.pixels == SIDE * SIDE
    for part, piece in pieces.items():
        assert piece == draw_part(open_chain(), SCENE, part.tile)
    return notes


def test_several_seats_share_the_parts() -> None:
    places = [Shaky("a", slots=3), Shaky("b")]
    assert run(places).warnings == []
    assert sum(place.calls for place in places) == len(PARTS)


def test_a_slow_place_gets_fewer_parts() -> None:
    done = threading.Event()

    def render(n: int, tile: Rectangle) -> None:
        # all but the one part that the slow place may have begun
        if n + 1 >= len(PARTS) - 1:
            done.set()

    slow, quick = Shaky("slow", after(done)), Shaky("quick", render)
    run([slow, quick])
    assert slow.calls <= 2 < quick.calls


@pytest.mark.parametrize("kind", [OutOfGasError, TooLargeError, NodeTimeoutError])
def test_what_is_too_much_is_cut(kind: type[Exception]) -> None:
    small = Shaky("small", lambda n, tile: kind("too much") if area(tile) > 100 else None)
    run([small])
    assert max(map(area, small.tiles)) <= 100
    # of size and time it learns: after a few attempts it is given nothing larger any more
    assert kind is OutOfGasError or small.calls <= len(small.tiles) + 3


def test_what_cannot_be_cut_any_more() -> None:
    place = Shaky("a", lambda n, tile: OutOfGasError("the call ran out of gas"))
    with pytest.raises(OutOfGasError, match=r"^the call ran out of gas; a tile of .* cannot be split: .*`max_triang"):
        run([place])


@pytest.mark.parametrize(
    "error", [NodeUnreachableError("gone"), OutOfGasError("gas"), NodeTimeoutError("slow")], ids=repr
)
def test_a_place_that_never_works_is_left_out(error: BaseException) -> None:
    bad = Shaky("bad", lambda n, tile: error)
    good = Shaky("good", after(bad.begun))
    notes = run([bad, good])
    assert notes.warnings in ([], [f"{error}; it is left out"])
    assert bad.tiles == []


def test_the_error_of_the_only_place() -> None:
    place = Shaky("a", lambda n, tile: NodeUnreachableError("the node a cannot be reached") if n > 2 else None)
    with pytest.raises(NodeUnreachableError, match=r"^the node a cannot be reached$"):
        run([place])
    assert place.calls == 3 + FAILURES
    places = [place, Shaky("b", lambda n, tile: WrongChainError("the wrong one"))]
    with pytest.raises(RenderError, match=r"^no backend is left to render: "):
        run(places)


def test_a_busy_place_is_asked_when_it_says(monkeypatch: pytest.MonkeyPatch) -> None:
    times: list[float] = []

    def busy(n: int, tile: Rectangle) -> BaseException | None:
        times.append(time.monotonic())
        return NodeBusyError("busy", 0.2) if n == 0 else None

    run([Shaky("a", busy)])
    assert times[1] - times[0] >= 0.2
    with pytest.raises(NodeBusyError):
        run([Shaky("b", lambda n, tile: NodeBusyError("busy"))])
    with pytest.raises(NodeBusyError, match="tomorrow"):
        run([Shaky("c", lambda n, tile: NodeBusyError("tomorrow", 86400))])


def test_what_a_contract_is_said_to_refuse() -> None:
    """It is true if it refuses here too; else the place is left out."""

    class Agreeing(Verifier):
        def draw(self, scene: Scene, tile: Rectangle) -> Drawing:
            raise RenderError("the contract refused: NoViewDirection()")

    liar = Shaky("liar", lambda n, tile: RenderError("the contract refused: NoViewDirection()"))
    for verifier in (None, Agreeing(every=False)):
        with pytest.raises(RenderError, match=r"^the contract refused: NoViewDirection\(\)$"):
            run([liar], verifier)
    notes = run([liar, Shaky("honest", after(liar.begun))], Verifier(every=False))
    (warning,) = notes.warnings
    assert re.fullmatch(
        r"the liar answers wrongly for the tile of 40 x 4 pixels at \(0, \d+\): the contract refused: "
        r"NoViewDirection\(\); it is left out, and 1 part is rendered again by others",
        warning,
    )


def test_a_place_that_lies_at_once() -> None:
    liar = Shaky("liar")
    honest = Shaky("honest", after(liar.begun))
    liar.lies = True
    notes = run([liar, honest], Verifier(every=False))
    assert len(notes.warnings) == 1
    assert "its picture is not what the contracts draw; it is left out" in notes.warnings[0]
    assert liar.calls == 1
    with pytest.raises(RenderError, match=r"answers wrongly for the tile .* not what the contracts draw$"):
        run([liar], Verifier(every=False))


def test_gas_that_is_not_true() -> None:
    """The picture is right: it is taken, and the gas is told of once."""
    boaster = Shaky("boaster", slots=2)
    boaster.gas_told = 5
    notes = Notes()
    pieces = Scheduler([SCENE], [boaster], None, notes, Verifier(every=True)).run(PARTS)
    assert {piece.gas for piece in pieces.values()} == {5}
    (warning,) = notes.warnings
    assert re.match(r"the boaster counts 5 gas for the tile of 40 x 4 .*, which takes [\d,]{6,} here: its gas", warning)


def test_a_place_that_begins_to_lie(tmp_path: Path) -> None:
    """Nothing that it did since it was last known to be right is kept."""
    found_out = threading.Event()

    class OnlyFirstAndLast(Verifier):
        asked = 0

        def selects(self, first: bool) -> bool:
            self.asked += 1
            if self.asked > len(PARTS) // 2:
                found_out.set()
            return first or self.asked > len(PARTS) // 2

    class Turncoat(Shaky):
        def render(self, scene: Scene, tile: Rectangle) -> Drawing:
            self.lies = self.calls > 0
            return super().render(scene, tile)

    liar, honest = Turncoat("liar"), Shaky("honest", after(found_out))
    store = PartStore(tmp_path / "parts", [SCENE])
    notes = run([liar, honest], OnlyFirstAndLast(every=False), store)
    assert len(notes.warnings) == 1
    assert "parts are rendered again by others" in notes.warnings[0]
    for part in PARTS:
        assert store.read(part) == draw_part(open_chain(), SCENE, part.tile)


def test_half_a_picture_is_no_picture() -> None:
    class Cutter(Shaky):
        def render(self, scene: Scene, tile: Rectangle) -> Drawing:
            piece = super().render(scene, tile)
            return replace(piece, bmp=piece.bmp[: len(piece.bmp) // 2])

    with pytest.raises(RenderError, match=r"^the cutter answers wrongly for the tile .*: the contract "):
        run([Cutter("cutter")])


def test_halves_of_an_earlier_run_are_taken(tmp_path: Path) -> None:
    """A place learns that parts are too large; those that were cut before are there, however they are come by."""

    def large(n: int, tile: Rectangle) -> BaseException | None:
        return TooLargeError("too large") if area(tile) > 2 * SIDE else None

    folder = tmp_path / "parts"
    first, again = Shaky("first", large), Shaky("again", large)
    run([first], store=PartStore(folder, [SCENE]))
    assert len(first.tiles) == 2 * len(PARTS)
    run([again], store=PartStore(folder, [SCENE]))
    assert again.tiles == []


def test_a_full_disk_ends_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(path: Path, data: bytes, is_verified: bool = False) -> None:
        raise OSError(28, "No space left on device")

    store = PartStore(tmp_path / "parts", [SCENE])
    monkeypatch.setattr("shackled.base.whole_file.write_whole", full)
    with pytest.raises(OutputError, match="No space left on device"):
        run([Shaky("a")], store=store)


def test_a_listener_that_fails_ends_it() -> None:
    class Deaf(Listener):
        def advanced(self, pixels: int) -> None:
            raise OSError("nobody listens")

    with pytest.raises(OSError, match="nobody listens"):
        Scheduler([SCENE], [Shaky("a")], None, Deaf()).run(PARTS)
