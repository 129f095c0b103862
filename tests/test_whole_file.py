"""Files that are written whole, wherever they lead."""

from __future__ import annotations

import os
import stat
import threading
from collections.abc import Callable
from pathlib import Path

import pytest

from shackled import InputError, OutputError
from shackled.base.whole_file import (
    check_output_file,
    check_output_folder,
    make_output_folder,
    write_output,
    write_whole,
)

needs_posix = pytest.mark.skipif(os.name != "posix", reason="links, pipes and modes are those of POSIX")
needs_full = pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no /dev/full here")


@needs_posix
@pytest.mark.parametrize(("mask", "mode"), [(0o027, 0o640), (0o022, 0o644)])
def test_others_may_read_it_as_of_any_file(tmp_path: Path, mask: int, mode: int) -> None:
    before = os.umask(mask)
    try:
        for data in (b"1", b"2"):
            write_whole(tmp_path / "a", data)
            assert stat.S_IMODE((tmp_path / "a").stat().st_mode) == mode
            assert (tmp_path / "a").read_bytes() == data
    finally:
        os.umask(before)


@needs_posix
def test_links_stay_and_their_files_are_written(tmp_path: Path) -> None:
    (tmp_path / "there").mkdir()
    target = tmp_path / "there" / "target.png"
    for name, leads in (("new.png", "there/target.png"), ("second.png", "new.png")):
        (tmp_path / name).symlink_to(leads)
        for data in (b"first", b"second"):
            assert check_output_file(tmp_path / name, "picture") == tmp_path / name
            write_output(tmp_path / name, data)
            assert (tmp_path / name).is_symlink()
            assert not target.is_symlink()
            assert target.read_bytes() == data
    assert [path.name for path in target.parent.iterdir()] == ["target.png"]
    assert sorted(path.name for path in tmp_path.iterdir()) == ["new.png", "second.png", "there"]


@needs_posix
def test_links_that_lead_nowhere(tmp_path: Path) -> None:
    for name, leads in (("a.png", "b.png"), ("b.png", "a.png"), ("c.png", "missing/c.png")):
        (tmp_path / name).symlink_to(leads)
    for name in ("a.png", "c.png"):
        with pytest.raises(InputError, match=f"{name} cannot be written: "):
            write_output(tmp_path / name, b"1")
        assert (tmp_path / name).is_symlink()
    with pytest.raises(InputError, match=r"the folder .*missing of the picture c.png does not exist"):
        check_output_file(tmp_path / "c.png", "picture")


@needs_posix
def test_a_pipe_is_written_to(tmp_path: Path) -> None:
    pipe, data, found = tmp_path / "pipe.png", bytes(range(256)) * 1000, []
    os.mkfifo(pipe)
    reader = threading.Thread(target=lambda: found.append(pipe.read_bytes()), daemon=True)
    reader.start()
    write_output(check_output_file(pipe, "picture"), data)
    reader.join(20)
    assert found == [data]
    assert stat.S_ISFIFO(pipe.stat().st_mode)


@needs_full
def test_a_full_device(tmp_path: Path) -> None:
    (tmp_path / "full.png").symlink_to("/dev/full")
    with pytest.raises(OutputError, match=r"full.png cannot be written: No space left on device") as error:
        write_output(tmp_path / "full.png", b"1")
    assert (error.value.filename, error.value.errno) == (str(tmp_path / "full.png"), 28)
    assert (tmp_path / "full.png").is_symlink()


def test_a_full_disk_changes_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "a").write_bytes(b"before")

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "replace", full)
    with pytest.raises(OutputError):
        write_output(tmp_path / "a", b"after")
    assert (tmp_path / "a").read_bytes() == b"before"
    assert len(list(tmp_path.iterdir())) == 1


def test_names_of_any_length_that_a_disk_takes(tmp_path: Path) -> None:
    for name in ("n" * 255, "ü" * 127, "n" * 250 + ".png"):
        write_output(tmp_path / name, b"1")
        assert (tmp_path / name).read_bytes() == b"1"
    with pytest.raises(InputError, match="File name too long"):
        write_output(tmp_path / ("n" * 256), b"1")
    with pytest.raises(InputError, match=r"nnn cannot be written: File name too long"):
        check_output_file(tmp_path / ("n" * 300), "picture")


def test_wrong_paths(tmp_path: Path) -> None:
    (tmp_path / "file").write_bytes(b"")
    for path in (tmp_path / "missing" / "a", tmp_path / "file" / "a"):
        with pytest.raises(InputError, match="cannot be written: "):
            write_output(path, b"1")
        with pytest.raises(InputError, match="does not exist"):
            check_output_file(path, "picture")
    for each in (check_output_folder, make_output_folder):
        with pytest.raises(InputError, match="is a file, not a folder to write to"):
            each(tmp_path / "file")
    with pytest.raises(InputError, match="cannot be written: Not a directory"):
        make_output_folder(tmp_path / "file" / "a" / "b")
    make_output_folder(tmp_path / "x" / "y")
    assert check_output_folder(tmp_path / "x" / "y").is_dir()


def test_data_is_on_the_disk_before_its_name(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Otherwise a power failure could leave an empty file in place of the old one."""
    done: list[str] = []

    def watched(name: str) -> Callable[..., None]:
        each = getattr(os, name)

        def call(*arguments: object) -> None:
            done.append(name)
            each(*arguments)

        return call

    for name in ("fsync", "replace"):
        monkeypatch.setattr(os, name, watched(name))
    write_whole(tmp_path / "file", b"data")
    assert done == ["fsync", "replace"]
