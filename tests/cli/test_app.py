"""How the command ends, whatever happens."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import NoReturn

import click
import pytest

from shackled import cli
from shackled.cli.app import LINES, app
from shackled.cli.app import run as run_command
from shackled.cli.option import with_options
from shackled.words import INSTEAD


def test_stopped_while_it_is_read_in(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    def run() -> NoReturn:
        raise KeyboardInterrupt

    monkeypatch.setitem(sys.modules, "shackled.cli.app", SimpleNamespace(run=run))
    with pytest.raises(SystemExit) as end:
        cli.main()
    assert end.value.code == 1
    assert capsys.readouterr() == ("", "shackled: stopped\n")


@pytest.mark.parametrize("group", ["datasets", "token"])
def test_a_group_without_a_command_prints_its_help(capsys: pytest.CaptureFixture[str], group: str) -> None:
    assert run_command([group]) == 2
    output, messages = capsys.readouterr()
    assert f"Usage: shackled {group}" in output + messages
    assert "shackled: " not in messages


def test_what_is_left_out_is_a_note_on_stderr(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("a.obj").write_text("mtllib a.mtl\nmtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    assert run_command(["render", "a.obj", "--size", "8", "--json"]) == 0
    assert capsys.readouterr().err == "shackled: note: a.obj: its materials are left out: a.mtl does not exist\n"


def test_characters_that_steer_a_terminal_are_not_sent_to_it(capsys: pytest.CaptureFixture[str]) -> None:
    assert run_command(["render", "a\x1b[31m.obj"]) == 2
    assert capsys.readouterr().err == "shackled: a?[31m.obj does not exist\n"


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no /dev/full here")
@pytest.mark.parametrize("unbuffered", ["", "1"])
def test_a_full_disk_behind_the_output(unbuffered: str) -> None:
    with Path("/dev/full").open("w", encoding="utf-8") as full:
        told = subprocess.run(
            [sys.executable, "-m", "shackled", "render", "shape.obj", "--size", "8", "--json"],
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
            timeout=60,
            env=os.environ | {"PYTHONUNBUFFERED": unbuffered},
        )
    assert told.returncode == 1
    assert told.stderr == "shackled: No space left on device\n"


STARTUP = """
import sys
class Stop:
    def find_spec(self, name, *_):
        if name == "click":
            raise KeyboardInterrupt
sys.meta_path.insert(0, Stop())
from shackled_command import main
main()
"""


def test_stopped_while_the_package_is_read_in() -> None:
    """That is before the package can do anything about it."""
    told = subprocess.run([sys.executable, "-c", STARTUP], capture_output=True, text=True, timeout=60)
    assert (told.returncode, told.stdout, told.stderr) == (1, "", "shackled: stopped\n")


LOADED = """
import sys
from shackled.cli.app import run
code = run({arguments})
print(sorted(set(sys.modules) & {{"numpy", "wasmtime", "PIL", "rich", "shackled.cli.render", "shackled.scene"}}))
sys.exit(code)
"""


@pytest.mark.parametrize("arguments", [["--help"], [], ["--version"], ["--completion", "bash"]], ids=" ".join)
def test_help_loads_no_command(arguments: list[str]) -> None:
    told = subprocess.run(
        [sys.executable, "-c", LOADED.format(arguments=arguments)], capture_output=True, text=True, timeout=60
    )
    assert (told.returncode, told.stderr) == (0, "")
    assert told.stdout.splitlines()[-1] == "[]"


WITHOUT = """
import sys
class Without:
    def find_spec(self, name, *_):
        if name.partition(".")[0] in {"eth_account", "eth_abi", "eth_utils", "eth_typing", "rlp", "pydantic"}:
            raise ModuleNotFoundError(name)
sys.meta_path.insert(0, Without())
from shackled.cli.app import run
"""


def test_what_works_without_the_extra_chain(folder: Path) -> None:
    commands = [
        ["render", "shape.obj", "--size", "8", "-o", "a.png"],
        ["render", "shape.obj", "--size", "8", "--turntable", "2", "--one-call", "-o", "b.png"],
        ["export", "shape.obj", "-o", "c.glb"],
        ["export", "shape.obj", "--size", "8", "-o", "d.html"],
        ["gas", "shape.obj", "--size", "8", "--json"],
        ["genesis", "7", "-o", "e.png"],
        ["datasets", "list", "icons"],
        ["info", "shape.obj"],
    ]
    signed = ["--rpc", "http://127.0.0.1:9", "--private-key-env", "KEY"]
    needing = [["deploy", *signed], ["store", "icons/die", *signed], ["library", "store", *signed]]
    code = f"{WITHOUT}\nassert [run(each) for each in {commands}] == [0] * {len(commands)}"
    code += f"\nassert [run(each) for each in {needing}] == [2] * {len(needing)}"
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=120)
    line = "shackled: an account that signs needs a package that is not installed: pip install 'shackled[chain]'"
    assert (told.returncode, told.stderr.splitlines()[-3:]) == (0, [line] * 3)
    assert sorted(path.name[0] for path in folder.iterdir()) == [*"abcdes"]


def test_every_command_can_be_loaded() -> None:
    found = app.to_info_dict(click.Context(app))["commands"]
    assert "render" in found
    assert "list" in found["datasets"]["commands"]
    assert "mint" in found["token"]["commands"]["edition"]["commands"]
    for name, line in LINES.items():
        assert " ".join(found[name]["help"].split()).startswith(line)


@pytest.mark.skipif(not shutil.which("sh"), reason="there is no sh here")
def test_closed_outputs() -> None:
    def told(*arguments: str) -> subprocess.CompletedProcess[str]:
        line = " ".join([sys.executable, "-m", "shackled", *arguments])
        return subprocess.run(["sh", "-c", line], capture_output=True, text=True, timeout=60)

    for arguments in (["shape.obj"], ["shape.obj", "--json"], ["shape.obj", "--jobs", "2"]):
        done = told("render", *arguments, "--size", "8", "-o", "a.bmp", ">&-")
        assert (done.returncode, done.stdout) == (0, "")
        assert "Traceback" not in done.stderr
        # nothing was printed into the picture
        assert Path("a.bmp").stat().st_size == 54 + 8 * 24
        Path("a.bmp").unlink()
    assert told("gas", "shape.obj", "--size", "8", "--no-stages", ">&-", "2>&-").returncode == 0
    # what belongs to stderr does not come to stdout
    done = told("render", "shape.obj", "--near", "1e30", "--size", "8", "--json", "2>&-")
    assert json.loads(done.stdout)["lit_pixels"] == 0


@pytest.mark.parametrize(
    ("arguments", "meant"),
    [
        (["mint", "icons/die"], "command mint: it is store, which mints no token; `shackled token mint` does"),
        (["render", "shape.obj", "--chain", "revm"], "option --chain: it is --evm"),
        (["gas", "shape.obj", "--chain=revm"], "option --chain: it is --evm"),
        (["stages", "shape.obj", "--chain", "revm", "-o", "out"], "option --chain: it is --evm"),
        (["render", "shape.obj", "--width", "64"], "option --width: it is --size"),
        (["render", "shape.obj", "--fps", "24"], "option --fps: it is --duration"),
        (["render", "shape.obj", "--alpha"], "option --alpha: it is --transparent"),
        (["gas", "shape.obj", "--bg", "red"], "option --bg: it is --background"),
        (["render", "shape.obj", "--intensity", "2"], None),
        (["turntable", "shape.obj"], "command turntable: it is render INPUT --turntable FRAMES"),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else "",
)
def test_other_words_name_the_right_ones(
    arguments: list[str], meant: str | None, capsys: pytest.CaptureFixture[str], folder: Path
) -> None:
    assert run_command(arguments) == 2
    meant = meant or f"option --intensity: {with_options(INSTEAD['intensity'])}"
    assert capsys.readouterr() == ("", f"shackled: no such {meant}\n")
    assert [each.name for each in folder.iterdir()] == ["shape.obj"]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [(["deploy", "--chain", "1"], "--chain-id"), (["token", "turntable"], "'turntable'")],
    ids=str,
)
def test_words_that_mean_something_else_are_left(
    arguments: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run_command(arguments) == 2
    message = capsys.readouterr().err
    assert said in message
    assert "it is" not in message


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no /dev/full here")
@pytest.mark.parametrize(
    "arguments",
    [
        ["render", "shape.obj", "--size", "8", "-o", "full.png"],
        ["render", "shape.obj", "--size", "8", "--turntable", "2", "-o", "full.gif"],
        ["export", "shape.obj", "--size", "8", "-o", "full.html"],
        ["genesis", "7", "-o", "full.bmp"],
        ["gas", "shape.obj", "--size", "8", "--profile", "full.svg"],
    ],
    ids=" ".join,
)
def test_a_full_disk_behind_a_file(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    name = arguments[-1]
    Path(name).symlink_to("/dev/full")
    assert run_command(arguments) == 1
    output, messages = capsys.readouterr()
    assert output == ""
    assert messages.splitlines()[-1] == f"shackled: {name} cannot be written: No space left on device"


@pytest.mark.parametrize(
    "arguments",
    [
        ["render", "shape.obj", "-o", f"{'n' * 300}.png"],
        ["render", "shape.obj", "--turntable", "2", "-o", f"{'n' * 300}.gif"],
        ["render", "shape.obj", "--turntable", "2", "-o", "n" * 300],
        ["export", "shape.obj", "-o", f"{'n' * 300}.html"],
        ["genesis", "7", "-o", f"{'n' * 300}.png"],
        ["stages", "shape.obj", "--size", "8", "-o", "n" * 300],
        ["bench", "deploy", "-o", "n" * 300],
        ["gas", "shape.obj", "--profile", f"{'n' * 300}.svg"],
    ],
    ids=lambda arguments: f"{arguments[0]} {len(arguments)} {arguments[-1][-4:]}",
)
def test_names_that_are_too_long_are_wrong_usage(
    arguments: list[str], folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = list(folder.iterdir())
    assert run_command(arguments) == 2
    output, messages = capsys.readouterr()
    assert output == ""
    assert messages.startswith("shackled: ")
    assert messages.endswith("cannot be written: File name too long\n")
    assert messages.count("\n") == 1
    assert list(folder.iterdir()) == before
