"""Finished parts on the disk."""

from __future__ import annotations

from pathlib import Path

import pytest
from attrs import evolve

from shackled import InputError, RenderError, Scene, load
from shackled.chain import open_chain
from shackled.chain._chain import Drawing
from shackled.errors import TooLargeError
from shackled.parallel import Listener
from shackled.parallel._backends import Part, draw_part
from shackled.parallel._job import render_frames
from shackled.parallel._store import PartStore, folder_of, remove_parts
from shackled.parallel._tiles import cut
from shackled.parallel.places import RenderOptions
from shackled.scene._codec import Rectangle
from shackled.scene._turning import full_turn

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
    # not for another picture, nor for one all of whose parts are compared
    assert PartStore(store.folder, [evolve(SCENE, invert=True)]).read(PARTS[0]) is None
    assert PartStore(store.folder, [SCENE], compared=False).read(PARTS[0]) is None
    store.forget(PARTS[0])
    assert store.read(PARTS[0]) is None


def test_another_render_of_the_same_output_may_remove_the_parts(store: PartStore) -> None:
    """The first of two that ends removes the folder, in which the other one still writes."""
    remove_parts(store.folder)
    store.write(PARTS[0], PIECE)
    assert store.read(PARTS[0]) == PIECE


def test_what_is_damaged_is_not_there(store: PartStore) -> None:
    """Even one bit of a pixel, without which the file would be another picture."""
    store.write(PARTS[0], PIECE)
    (file,) = store.folder.glob("*.part")
    whole = file.read_bytes()
    for data in (b"", b"x", b"{}\n", bytes(500), whole[:-1], whole + b"x", whole[:-1] + bytes([whole[-1] ^ 1])):
        file.write_bytes(data)
        assert store.read(PARTS[0]) is None


def test_only_its_own_files_are_removed(store: PartStore) -> None:
    """And such as were being written when the machine went down."""
    store.write(PARTS[0], PIECE)
    (file,) = store.folder.iterdir()
    (store.folder / f".{file.name}.abcd1234").write_bytes(b"half")
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
    keep = tmp_path / "spin.gif.parts"
    how = RenderOptions(tile=(32, 7), keep=keep)
    expected = render_frames(frames, evolve(how, keep=None))
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
        render_frames(frames, how)
    assert said == [f"finished parts are kept in {keep}: run the same command to resume"]
    assert len(list(keep.glob("*.part"))) == 8
    resumed = True
    again = render_frames(frames, how)
    assert len(drawn) == sum(image.calls for image in expected) == 15
    assert again == expected


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
        render_frames([SCENE], RenderOptions(gas_limit=10**9, keep=keep))
    resumed = True
    (again,) = render_frames([SCENE], RenderOptions(gas_limit=10**9, keep=keep))
    assert again.calls == len(drawn) > 3
    assert again.bmp == open_chain().draw(SCENE).bmp
