"""How the command ends, whatever happens."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import NoReturn

import click
import pytest

from commands import Shackled
from shackled import __version__, cli
from shackled.base.synonyms import HINTS
from shackled.chain._embedded import EmbeddedChain, RevmChain
from shackled.cli.app import LINES, app, run
from shackled.cli.option import with_options

needs_full = pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no /dev/full here")


def python(code: str, *arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, "-c", code, *arguments], capture_output=True, text=True, timeout=120)


def test_stopped_while_it_is_read_in(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    def run() -> NoReturn:
        raise KeyboardInterrupt

    monkeypatch.setitem(sys.modules, "shackled.cli.app", SimpleNamespace(run=run))
    with pytest.raises(SystemExit) as end:
        cli.main()
    assert end.value.code == 1
    assert capsys.readouterr() == ("", "shackled: stopped\n")


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
    told = python(STARTUP)
    assert (told.returncode, told.stdout, told.stderr) == (1, "", "shackled: stopped\n")


def test_refusals_and_interrupts_exit_with_1(shackled: Shackled, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shackled.parallel.places.open_chain", lambda *_: RevmChain(gas_limit=50_000))
    said = shackled("render shape.obj", expect=1)
    assert said.err == "shackled: the call ran out of gas: 50,000 gas is not enough\n"

    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(EmbeddedChain, "call", interrupt)
    assert shackled("render shape.obj", expect=1).err == "shackled: stopped\n"


@needs_full
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


@needs_full
@pytest.mark.parametrize(
    "words",
    [
        "render shape.obj --size 8 -o full.png",
        "render shape.obj --size 8 --turntable 2 -o full.gif",
        "export shape.obj --size 8 -o full.html",
        "genesis 7 -o full.bmp",
        "gas shape.obj --size 8 --profile full.svg",
    ],
)
def test_a_full_disk_behind_a_file(words: str, shackled: Shackled) -> None:
    name = words.split()[-1]
    Path(name).symlink_to("/dev/full")
    said = shackled(words, expect=1)
    assert (said.out, said.error) == ("", f"shackled: {name} cannot be written: No space left on device")


@pytest.mark.skipif(not shutil.which("sh"), reason="there is no sh here")
def test_closed_outputs() -> None:
    def told(words: str) -> subprocess.CompletedProcess[str]:
        line = f"{sys.executable} -m shackled {words}"
        return subprocess.run(["sh", "-c", line], capture_output=True, text=True, timeout=60)

    for more in ("", "--json", "--jobs 2"):
        done = told(f"render shape.obj {more} --size 8 -o a.bmp >&-")
        assert (done.returncode, done.stdout) == (0, "")
        assert "Traceback" not in done.stderr
        # nothing was printed into the picture
        assert Path("a.bmp").stat().st_size == 54 + 8 * 24
        Path("a.bmp").unlink()
    assert told("gas shape.obj --size 8 --no-stages >&- 2>&-").returncode == 0
    # what belongs to stderr does not come to stdout
    done = told("render shape.obj --near 1e30 --size 8 --json 2>&-")
    assert done.stdout.startswith("{")
    assert done.stdout.count("\n") == 1


# ---- help, and what is loaded ----


def test_help_and_version(shackled: Shackled) -> None:
    assert shackled("--version").out == f"shackled {__version__}\n"
    for words, listed in (("", "render"), ("render", "--max-triangles"), ("token mint", "--icon")):
        text = shackled(f"{words} --help").out
        assert listed in text
        assert shackled(f"{words} -h").out == text
    for group in ("", "datasets", "token edition"):
        assert shackled(group).out == shackled(f"{group} --help").out


LOADED = """
import sys
from shackled.cli.app import run
code = run(sys.argv[1:])
print(sorted(set(sys.modules) & {"numpy", "wasmtime", "PIL", "rich", "shackled.cli.render", "shackled.scene"}))
sys.exit(code)
"""


@pytest.mark.parametrize("words", ["--help", "", "--version"])
def test_help_loads_no_command(words: str) -> None:
    told = python(LOADED, *words.split())
    assert (told.returncode, told.stderr, told.stdout.splitlines()[-1]) == (0, "", "[]")


def test_every_command_can_be_loaded() -> None:
    found = app.to_info_dict(click.Context(app))["commands"]
    assert "render" in found
    assert "list" in found["datasets"]["commands"]
    assert "mint" in found["token"]["commands"]["edition"]["commands"]
    for name, line in LINES.items():
        assert " ".join(found[name]["help"].split()).startswith(line)


WITHOUT = """
import shlex
import sys
class Without:
    def find_spec(self, name, *_):
        if name.partition(".")[0] in {"eth_account", "eth_abi", "eth_utils", "eth_typing", "rlp", "pydantic"}:
            raise ModuleNotFoundError(name)
sys.meta_path.insert(0, Without())
from shackled.cli.app import run
print([run(shlex.split(each)) for each in sys.argv[1:]])
"""


def test_what_works_without_the_extra_chain(folder: Path) -> None:
    working = [
        "render shape.obj --size 8 -o a.png",
        "render shape.obj --size 8 --turntable 2 --one-call -o b.png",
        "export shape.obj -o c.glb",
        "export shape.obj --size 8 -o d.html",
        "gas shape.obj --size 8 --json",
        "genesis 7 -o e.png",
        "datasets list icons",
        "info shape.obj",
    ]
    signed = "--rpc http://127.0.0.1:9 --private-key-env KEY"
    told = python(WITHOUT, *working, *(f"{each} {signed}" for each in ("deploy", "store icons/die", "library store")))
    assert told.stdout.splitlines()[-1] == str([0] * len(working) + [2] * 3)
    line = "shackled: an account that signs needs a package that is not installed: pip install 'shackled[chain]'"
    assert told.stderr.splitlines()[-3:] == [line] * 3
    assert sorted(path.name[0] for path in folder.iterdir()) == [*"abcdes"]


def test_completion(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    """As a shell asks for it."""
    for words, expected in (("shackled inf", ["info"]), ("shackled render --turnt", ["--turntable"])):
        monkeypatch.setenv("_SHACKLED_COMPLETE", "bash_complete")
        monkeypatch.setenv("COMP_WORDS", words)
        monkeypatch.setenv("COMP_CWORD", str(words.count(" ")))
        with pytest.raises(SystemExit) as end:
            run([])
        assert end.value.code == 0
        assert [line.partition(",")[2] for line in capsys.readouterr().out.split()] == expected


# ---- other words ----

MEANT = {
    "mint icons/die": "command mint: it is store, which mints no token; `shackled token mint` does",
    "turntable shape.obj": "command turntable: it is render INPUT --turntable FRAMES",
    "render shape.obj --chain revm": "option --chain: it is --evm",
    "gas shape.obj --chain=revm": "option --chain: it is --evm",
    "stages shape.obj --chain revm -o out": "option --chain: it is --evm",
    "render shape.obj --width 64": "option --width: it is --size",
    "render shape.obj --fps 24": "option --fps: it is --duration",
    "render shape.obj --alpha": "option --alpha: it is --transparent",
    "gas shape.obj --bg red": "option --bg: it is --background",
    "render shape.obj --intensity 2": f"option --intensity: {with_options(HINTS['intensity'])}",
}


@pytest.mark.parametrize(("words", "meant"), MEANT.items(), ids=MEANT)
def test_other_words_name_the_right_ones(words: str, meant: str, shackled: Shackled, folder: Path) -> None:
    said = shackled(words, expect=2)
    assert (said.out, said.err) == ("", f"shackled: no such {meant}\n")
    assert [each.name for each in folder.iterdir()] == ["shape.obj"]


@pytest.mark.parametrize(("words", "named"), [("deploy --chain 1", "--chain-id"), ("token turntable", "'turntable'")])
def test_words_that_mean_something_else_are_left(words: str, named: str, shackled: Shackled) -> None:
    message = shackled(words, expect=2).err
    assert named in message
    assert "it is" not in message
