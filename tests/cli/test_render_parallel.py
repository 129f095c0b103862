"""`shackled render` in parts, in other places, and of turntables."""

from __future__ import annotations

import hashlib
import os
import signal
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image as PillowImage
from tools.children import child

from commands import Shackled
from nodes import anvil, needs_anvil
from shackled.base.whole_file import write_whole
from shackled.chain._chain import Drawing
from shackled.parallel._backends import draw_part

PATIENCE = 60


@pytest.fixture
def report(shackled: Shackled) -> Any:
    """Returns what the shape's picture with these options is said to be."""
    return lambda words="": shackled(f"render shape.obj --size 48 --json {words}").json


def test_one_picture_in_parts(report: Any) -> None:
    whole = report()
    for options in ("--tile 48x7", "--tile 20", "--tile 4096x7", "--gas-limit 400000", "--jobs 2"):
        parts = report(options)
        for key in ("sha256", "triangles", "lit_pixels", "width", "height"):
            assert parts[key] == whole[key]
        assert parts["calls"] > whole["calls"] == 1
        assert Path("shape.png").is_file()
        assert not Path("shape.png.parts").exists()


def test_what_a_job_says(shackled: Shackled) -> None:
    said = shackled("render shape.obj --size 64 --tile 64x16")
    assert said.err.startswith("4 calls, about ")
    assert "to send the scene 4 times)" in said.out
    assert "shape.png, 64 x 64 pixels" in said.out
    said = shackled("render shape.obj --size 32 --turntable 3")
    assert "shape.gif, 3 frames of 32 x 32 pixels" in said.out
    assert "triangles" not in said.out
    assert said.err.startswith("3 frames, 3 calls, about ")


def test_a_turntable(report: Any) -> None:
    one = report("--turntable 5 -o spin.gif --duration 120")
    two = report("--turntable 5 -o two.gif --jobs 2")
    assert (one["sha256"], one["gas"]) == (two["sha256"], two["gas"])
    assert (one["frames"], one["calls"], one["triangles"]) == (5, 5, None)
    with PillowImage.open("spin.gif") as gif, PillowImage.open("two.gif") as other:
        assert gif.n_frames == other.n_frames == 5  # type: ignore[attr-defined]
        assert (gif.info["duration"], other.info["duration"], gif.info["loop"]) == (120, 80, 0)
    report("--turntable 5 -o frames")
    frames = sorted(Path("frames").iterdir())
    assert [path.name for path in frames] == ["000.png", "001.png", "002.png", "003.png", "004.png"]
    pixels = b"".join(np.array(PillowImage.open(path)).tobytes() for path in frames)
    assert hashlib.sha256(pixels).hexdigest() == one["sha256"]


@needs_anvil
def test_nodes_as_they_are(report: Any, shackled: Shackled, monkeypatch: pytest.MonkeyPatch) -> None:
    whole = report()
    with anvil() as first, anvil() as second:
        there = report(f"--rpc {first.url}")
        both = report(f"--rpc {first.url} --rpc {second.url} --jobs 2 --tile 48x3")
        monkeypatch.setenv("SHACKLED_RPC", f"{first.url} {second.url}")
        variable = report()
        assert report("--evm revm")["chain"].startswith("embedded")
        shackled(f"render teapot -o teapot.png --rpc {first.url}")
    keys = ("sha256", "triangles", "lit_pixels")
    assert len({tuple(each[key] for key in keys) for each in (whole, there, both, variable)}) == 1
    assert (there["gas"], there["calls"], both["calls"]) == (whole["gas"], 1, 16)
    assert variable["chain"].startswith("2 nodes: ")


def test_what_is_too_much_for_any_part(shackled: Shackled) -> None:
    said = shackled("render teapot -o a.png --gas-limit 100000", expect=1)
    assert "ran out of gas: 100,000 gas is not enough even for a tile of" in said.err
    assert not Path("a.png").exists()
    assert not Path("a.png.parts").exists()


def test_stopped_and_resumed(report: Any, shackled: Shackled, monkeypatch: pytest.MonkeyPatch) -> None:
    expected = report("--turntable 12 -o expected.gif")
    limit = 7
    drawn: list[object] = []

    def counted(*arguments: object) -> Drawing:
        if len(drawn) == limit:
            raise KeyboardInterrupt
        drawn.append(arguments)
        return draw_part(*arguments)  # type: ignore[arg-type]

    monkeypatch.setattr("shackled.parallel._backends.draw_part", counted)
    said = shackled("render shape.obj --size 48 --turntable 12 -o spin.gif", expect=1)
    assert said.err.splitlines()[-2:] == [
        "shackled: finished parts are kept in spin.gif.parts: run the same command to resume",
        "shackled: stopped",
    ]
    assert not Path("spin.gif").exists()
    limit = 1000
    assert report("--turntable 12 -o spin.gif")["sha256"] == expected["sha256"]
    assert len(drawn) == 12
    assert Path("spin.gif").read_bytes() == Path("expected.gif").read_bytes()
    assert not Path("spin.gif.parts").exists()


@pytest.mark.skipif(sys.platform != "linux", reason="looks for processes in /proc")
@pytest.mark.parametrize(
    ("inputs", "kind"),
    [(["teapot"], signal.SIGINT), (["teapot", "cube"], signal.SIGINT), (["teapot", "cube"], signal.SIGKILL)],
    ids=["threads", "processes", "killed"],
)
def test_nothing_runs_on(inputs: list[str], kind: signal.Signals) -> None:
    """Ctrl-C ends threads, and the processes of several inputs, which also end if the command is killed."""
    mark = f"SHACKLED_TEST_{os.getpid()}_{kind}"
    command = [sys.executable, "-m", "shackled", "render", *inputs, "--size", "128", "--jobs", "2"]
    with child(*command, "--turntable", "720", "-o", "{stem}.gif", env={**os.environ, mark: "1"}) as process:
        wait_until(lambda: len(list(Path("teapot.gif.parts").glob("*.part"))) > 4)
        assert len(marked(mark) - {process.pid}) == (2 if len(inputs) > 1 else 0)
        process.send_signal(kind)
        output, messages = process.communicate(timeout=PATIENCE)
    wait_until(lambda: not marked(mark))
    assert output == ""
    assert "Traceback" not in messages
    if kind == signal.SIGINT:
        assert process.returncode == 1
        assert messages.endswith("shackled: stopped\n")
    assert not Path("teapot.gif").exists()
    kept = len(list(Path("teapot.gif.parts").glob("*.part")))
    assert 4 < kept < 720


def wait_until(holds: Callable[[], object]) -> None:
    end = time.monotonic() + PATIENCE
    while not holds():
        assert time.monotonic() < end
        time.sleep(0.02)


def marked(mark: str) -> set[int]:
    """The processes with a variable of that name."""
    found = set()
    for path in Path("/proc").glob("[0-9]*/environ"):
        try:
            if mark.encode() in path.read_bytes():
                found.add(int(path.parent.name))
        except OSError:
            continue
    return found


def test_a_picture_that_cannot_be_written_keeps_its_parts(shackled: Shackled, monkeypatch: pytest.MonkeyPatch) -> None:
    def full_but_for_parts(path: Path, data: bytes, is_verified: bool = False) -> None:
        if path.suffix == ".png":
            raise OSError(28, "No space left on device")
        write_whole(path, data)

    monkeypatch.setattr("shackled.base.whole_file.write_whole", full_but_for_parts)
    said = shackled("render shape.obj --size 48 --tile 48x12", expect=1)
    assert said.err.splitlines()[1:] == [
        "shackled: finished parts are kept in shape.png.parts: run the same command to resume",
        "shackled: shape.png cannot be written: No space left on device",
    ]
    assert len(list(Path("shape.png.parts").glob("*.part"))) == 4
