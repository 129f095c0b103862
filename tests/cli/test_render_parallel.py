"""`shackled render` in parts, in other places, and of turntables."""

from __future__ import annotations

import hashlib
import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from PIL import Image as PillowImage

from nodes import anvil, needs_anvil
from shackled.chain import Drawing
from shackled.cli.app import run
from shackled.parallel._backends import draw_part
from shackled.whole_file import write_whole

PATIENCE = 60


def report(capsys: pytest.CaptureFixture[str], *options: str) -> dict[str, object]:
    """What the shape's picture with these options is said to be."""
    assert run(["render", "shape.obj", "--size", "48", "--json", *options]) == 0
    found: dict[str, object] = json.loads(capsys.readouterr().out)
    return found


def test_one_picture_in_parts(capsys: pytest.CaptureFixture[str]) -> None:
    whole = report(capsys)
    for options in (
        ["--tile", "48x7"],
        ["--tile", "20"],
        ["--tile", "4096x7"],
        ["--gas-limit", "400000"],
        ["--jobs", "2"],
    ):
        parts = report(capsys, *options)
        for key in ("sha256", "triangles", "lit_pixels", "width", "height"):
            assert parts[key] == whole[key]
        assert list(parts) == [*whole, "frames", "calls"]
        assert isinstance(parts["calls"], int)
        assert parts["calls"] > 1
        assert Path("shape.png").is_file()
        assert not Path("shape.png.parts").exists()


def test_what_a_job_says(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["render", "shape.obj", "--size", "64", "--tile", "64x16"]) == 0
    output, messages = capsys.readouterr()
    assert messages.startswith("4 calls, about ")
    assert "to send the scene 4 times)" in output
    assert "shape.png, 64 x 64 pixels" in output


def test_a_turntable(capsys: pytest.CaptureFixture[str]) -> None:
    one = report(capsys, "--turntable", "5", "-o", "spin.gif", "--duration", "120")
    two = report(capsys, "--turntable", "5", "-o", "two.gif", "--jobs", "2")
    assert one["sha256"] == two["sha256"]
    assert one["gas"] == two["gas"]
    assert (one["frames"], one["calls"], one["triangles"]) == (5, 5, None)
    with PillowImage.open("spin.gif") as gif, PillowImage.open("two.gif") as other:
        assert gif.n_frames == other.n_frames == 5  # type: ignore[attr-defined]
        assert (gif.info["duration"], other.info["duration"], gif.info["loop"]) == (120, 80, 0)
    report(capsys, "--turntable", "5", "-o", "frames")
    frames = sorted(Path("frames").iterdir())
    assert [path.name for path in frames] == ["000.png", "001.png", "002.png", "003.png", "004.png"]
    pixels = b"".join(np.array(PillowImage.open(path)).tobytes() for path in frames)
    assert hashlib.sha256(pixels).hexdigest() == one["sha256"]


def test_the_words_of_a_turntable(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["render", "shape.obj", "--size", "32", "--turntable", "3"]) == 0
    output, messages = capsys.readouterr()
    assert "shape.gif, 3 frames of 32 x 32 pixels" in output
    assert "triangles" not in output
    assert messages.startswith("3 frames, 3 calls, about ")


@needs_anvil
def test_nodes_as_they_are(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    whole = report(capsys)
    with anvil() as first, anvil() as second:
        there = report(capsys, "--rpc", first.url)
        both = report(capsys, "--rpc", first.url, "--rpc", second.url, "--jobs", "2", "--tile", "48x3")
        monkeypatch.setenv("SHACKLED_RPC", f"{first.url} {second.url}")
        variable = report(capsys)
        assert str(report(capsys, "--evm", "revm")["chain"]).startswith("embedded")
        assert run(["render", "teapot", "-o", "teapot.png", "--rpc", first.url]) == 0
    keys = ("sha256", "triangles", "lit_pixels")
    assert {tuple(each[key] for key in keys) for each in (whole, there, both, variable)} == {
        tuple(whole[key] for key in keys)
    }
    assert (there["gas"], there["calls"], both["calls"]) == (whole["gas"], 1, 16)
    assert str(variable["chain"]).startswith("2 nodes: ")


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--turntable", "1"], "the number of frames of a turntable must be a finite number from 2 to 720"),
        (["--turntable", "3", "-o", "a.svg"], "must end in .gif .png .webp or .mp4, or be a folder"),
        (["--turntable", "3", "-o", "missing/a.gif"], "the folder missing of the animation a.gif does not exist"),
        (["--turntable", "3", "-o", "shape"], "shape is a file, not a folder to write to"),
        (["--turntable", "3", "--duration", "5"], "the duration of a frame in milliseconds must be"),
        (["--duration", "50"], "--duration needs --turntable"),
        (["--tile", "0"], "the sides of a --tile must be whole numbers from 1"),
        (["--tile", "4x"], "--tile must be a side such as 128 or WIDTHxHEIGHT"),
        (["--jobs", "0"], "--jobs must be a whole number from 1 to 256, not 0"),
        (["--gas-limit", "-1"], "--gas-limit must be a whole number of gas from 1"),
        (["--rpc", "localhost:8545"], "--rpc must be the address of a node"),
        (["--rpc", "http://127.0.0.1:1", "--evm", "revm"], "--rpc and --evm exclude each other"),
        (["--rpc", "http://127.0.0.1:1", "--cluster", "local"], "--rpc and --cluster exclude each other"),
        (["--cluster", "teapot"], "--cluster must be local or an address such as tcp://host:8786, not 'teapot'"),
        (
            ["--evm", "http://127.0.0.1:1"],
            "--evm is the name of an EVM: give --rpc for the node 'http://127.0.0.1:1'",
        ),
        (["--rpc-timeout", "5"], "--rpc-timeout needs --rpc"),
        (["--verify", "all"], "--verify needs --rpc or --cluster"),
        (["--rpc", "http://127.0.0.1:1", "--verify", "most"], "--verify must be one of all, some, none, not 'most'"),
        (["--evm", "reference", "--jobs", "2"], "is gone: use one of revm, pyrevm, pyevm"),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else "",
)
def test_wrong_usage(capsys: pytest.CaptureFixture[str], options: list[str], message: str) -> None:
    Path("shape").write_text("", "utf-8")
    assert run(["render", "shape.obj", *options]) == 2
    output, messages = capsys.readouterr()
    assert message in messages
    assert output == ""
    assert messages.count("\n") == 1


def test_what_is_too_much_for_any_part(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["render", "teapot", "-o", "a.png", "--gas-limit", "100000"]) == 1
    messages = capsys.readouterr().err
    assert "ran out of gas: 100,000 gas is not enough even for a tile of" in messages
    assert not Path("a.png").exists()
    assert not Path("a.png.parts").exists()


def test_stopped_and_resumed(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    options = ["--turntable", "12"]
    expected = report(capsys, *options, "-o", "expected.gif")
    limit = 7
    drawn: list[object] = []

    def counted(*arguments: object) -> Drawing:
        if len(drawn) == limit:
            raise KeyboardInterrupt
        drawn.append(arguments)
        return draw_part(*arguments)  # type: ignore[arg-type]

    monkeypatch.setattr("shackled.parallel._backends.draw_part", counted)
    assert run(["render", "shape.obj", "--size", "48", *options, "-o", "spin.gif"]) == 1
    messages = capsys.readouterr().err.splitlines()
    assert messages[-2:] == [
        "shackled: finished parts are kept in spin.gif.parts: run the same command to resume",
        "shackled: stopped",
    ]
    assert not Path("spin.gif").exists()
    limit = 1000
    assert report(capsys, *options, "-o", "spin.gif")["sha256"] == expected["sha256"]
    assert len(drawn) == 12
    assert Path("spin.gif").read_bytes() == Path("expected.gif").read_bytes()
    assert not Path("spin.gif.parts").exists()


@pytest.fixture
def interruptible() -> Iterator[None]:
    """What is started from here on reacts to SIGINT, even where the tests themselves run with it ignored."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.usefixtures("interruptible")
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
    with subprocess.Popen(
        [*command, "--turntable", "720", "-o", "{stem}.gif"],
        env={**os.environ, mark: "1"},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as process:
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


def wait_until(true: object) -> None:
    """Returns when a condition holds."""
    assert callable(true)
    end = time.monotonic() + PATIENCE
    while not true():
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


def test_a_picture_that_cannot_be_written_keeps_its_parts(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def full_but_for_parts(path: Path, data: bytes) -> None:
        if path.suffix == ".png":
            raise OSError(28, "No space left on device")
        write_whole(path, data)

    with monkeypatch.context() as patched:
        patched.setattr("shackled.whole_file.write_whole", full_but_for_parts)
        assert run(["render", "shape.obj", "--size", "48", "--tile", "48x12"]) == 1
    lines = capsys.readouterr().err.splitlines()
    assert lines[1:] == [
        "shackled: finished parts are kept in shape.png.parts: run the same command to resume",
        "shackled: shape.png cannot be written: No space left on device",
    ]
    assert len(list(Path("shape.png.parts").glob("*.part"))) == 4
