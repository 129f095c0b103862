"""Finished parts on the disk."""

from __future__ import annotations

from pathlib import Path

import pytest
from attrs import evolve

from shackled import InputError, Processes, RenderError, Scene, load
from shackled._on import Bounds
from shackled.chain import Drawing, open_chain
from shackled.errors import TooLargeError
from shackled.parallel import Listener, folder_of, remove_parts, render_frames
from shackled.parallel._backends import Part, draw_part
from shackled.parallel._store import PLAN, PartStore
from shackled.parallel._tiles import cut
from shackled.scene import Rectangle, full_turn

SCENE = evolve(load("cube"), width=32, height=20)
PARTS = [Part(0, tile) for tile in cut(32, 20, 160)]
PIECE = draw_part(open_chain(), SCENE, PARTS[0].tile)


@pytest.fixture
def store(tmp_path: Path) -> PartStore:
    return PartStore(tmp_path / "cube.png.parts", [SCENE])


def test_parts_are_found_again(store: PartStore) -> None:
    assert store.read(PARTS[0]) is None
    store.write(PARTS[0], PIECE)
    assert PartStore(store.folder, [SCENE]).read(PARTS[0]) == PIECE
    assert store.read(PARTS[1]) is None
    store.forget(PARTS[0])
    assert store.read(PARTS[0]) is None


def test_parts_of_another_picture_are_not_taken(store: PartStore) -> None:
    store.write(PARTS[0], PIECE)
    assert PartStore(store.folder, [evolve(SCENE, invert=True)]).read(PARTS[0]) is None


@pytest.mark.parametrize("damage", [b"", b"x", b"{}\n", bytes(500)], ids=repr)
def test_what_is_damaged_is_not_there(store: PartStore, damage: bytes) -> None:
    store.write(PARTS[0], PIECE)
    (file,) = store.folder.glob("*.part")
    for data in (damage, file.read_bytes()[:-1], file.read_bytes() + b"x"):
        file.write_bytes(data)
        assert store.read(PARTS[0]) is None


def test_a_flipped_bit_is_not_taken(store: PartStore) -> None:
    """Of a pixel: the file is a whole part otherwise, and would be another picture."""
    store.write(PARTS[0], PIECE)
    (file,) = store.folder.glob("*.part")
    data = bytearray(file.read_bytes())
    data[-1] ^= 1
    file.write_bytes(data)
    assert store.read(PARTS[0]) is None


def test_plans(store: PartStore) -> None:
    assert store.read_plan() is None
    store.write_plan(PARTS)
    assert store.read_plan() == PARTS
    assert PartStore(store.folder, [evolve(SCENE, invert=True)]).read_plan() is None
    for plan in (PARTS[1:], [*PARTS, PARTS[0]], [*PARTS, Part(1, Rectangle(0, 0, 32, 20))]):
        store.write_plan(plan)
        assert store.read_plan() is None
    (store.folder / PLAN).write_text("[1", "utf-8")
    assert store.read_plan() is None


def test_only_its_own_files_are_removed(store: PartStore) -> None:
    store.write(PARTS[0], PIECE)
    store.write_plan(PARTS)
    other = store.folder / "note.txt"
    other.write_text("mine", "utf-8")
    remove_parts(store.folder)
    assert list(store.folder.iterdir()) == [other]
    other.unlink()
    remove_parts(store.folder)
    assert not store.folder.exists()
    remove_parts(store.folder)


def test_a_folder_that_cannot_be(tmp_path: Path) -> None:
    (tmp_path / "a.png.parts").write_text("", "utf-8")
    with pytest.raises(InputError, match=r"a.png.parts is a file, not a folder to write to"):
        PartStore(folder_of(tmp_path / "a.png"), [SCENE])
    remove_parts(folder_of(tmp_path / "a.png"))
    assert (tmp_path / "a.png.parts").is_file()


@pytest.mark.parametrize("stop", [KeyboardInterrupt(), RenderError("no more")], ids=repr)
def test_a_job_goes_on_where_it_stopped(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, stop: BaseException) -> None:
    frames = full_turn(SCENE, 5)
    bounds, keep = Bounds(tile=(32, 7)), tmp_path / "spin.gif.parts"
    expected = render_frames(frames, None, bounds)
    drawn: list[Rectangle] = []

    def counted(chain: object, scene: Scene, tile: Rectangle) -> Drawing:
        if len(drawn) == 8 and not resumed:
            raise stop
        drawn.append(tile)
        return draw_part(open_chain(), scene, tile)

    monkeypatch.setattr("shackled.parallel._backends.draw_part", counted)
    monkeypatch.setattr(Listener, "warned", lambda self, text: said.append(text))
    said: list[str] = []
    resumed = False
    with pytest.raises(type(stop)):
        render_frames(frames, None, bounds, keep=keep)
    assert said == [f"finished parts are kept in {keep}: run the same command to resume"]
    assert len(list(keep.glob("*.part"))) == 8
    resumed = True
    again = render_frames(frames, None, bounds, keep=keep)
    assert len(drawn) == expected.calls == 15
    assert [image.bmp for image in again.images] == [image.bmp for image in expected.images]
    assert [image.gas for image in again.images] == [image.gas for image in expected.images]


def test_a_job_that_was_cut_otherwise_keeps_its_plan(tmp_path: Path) -> None:
    keep = tmp_path / "cube.png.parts"
    first = render_frames([SCENE], None, Bounds(tile=(16, 10)), keep=keep)
    assert first.calls == 4
    assert render_frames([SCENE], None, Bounds(gas_limit=20_000_000), keep=keep).calls == 1
    keep2 = tmp_path / "large.png.parts"
    large = evolve(SCENE, width=64, height=64)
    tight = render_frames([large], None, Bounds(tile=(64, 16)), keep=keep2)
    # two threads would be given more parts
    assert render_frames([large], Processes(2), keep=keep2).calls == tight.calls == 4


def test_a_single_part_that_is_cut_later(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    keep, drawn, resumed = tmp_path / "cube.png.parts", list[Rectangle](), False

    def narrow(chain: object, scene: Scene, tile: Rectangle) -> Drawing:
        if tile.width * tile.height > 200:
            raise TooLargeError("too large")
        if len(drawn) == 3 and not resumed:
            raise KeyboardInterrupt
        drawn.append(tile)
        return draw_part(open_chain(), scene, tile)

    monkeypatch.setattr("shackled.parallel._backends.draw_part", narrow)
    monkeypatch.setattr(Listener, "warned", lambda self, text: None)
    with pytest.raises(KeyboardInterrupt):
        render_frames([SCENE], None, Bounds(gas_limit=10**9), keep=keep)
    resumed = True
    again = render_frames([SCENE], None, Bounds(gas_limit=10**9), keep=keep)
    assert again.calls == len(drawn) > 3
    assert again.images[0].bmp == open_chain().draw(SCENE).bmp


def test_what_was_being_written_is_taken_away_too(tmp_path: Path) -> None:
    """When the machine goes down, a file may be there that was not finished."""
    store = PartStore(tmp_path / "parts", [SCENE])
    part = Part(0, Rectangle(0, 0, 16, 10))
    store.write(part, draw_part(open_chain(), SCENE, part.tile))
    (name,) = store.folder.iterdir()
    for each in (name.name, PLAN):
        (store.folder / f".{each}.abcd1234").write_bytes(b"half")
    remove_parts(store.folder)
    assert not store.folder.exists()
