"""The command `shackled creator`: what it serves, and to whom."""

from __future__ import annotations

import http.client
import json
import re
import signal
import sys
from contextlib import closing
from pathlib import Path

import pytest
from tools.children import child

from commands import Shackled
from shackled import InputError
from shackled.cli import creator
from shackled.datasets.genesis import seed_of


def write(folder: Path, files: dict[str, str]) -> None:
    for name, content in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(content, "utf-8")


@pytest.fixture
def page(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A page of a few files, in place of the one that is built."""
    folder, one_file = tmp_path / "built" / "page", tmp_path / "built" / "creator.html"
    write(tmp_path / "built", {"page/index.html": "<p>page", "page/data/evm.wasm": "\0asm"})
    write(tmp_path / "built", {"creator.html": "one", "secret.js": "no"})
    monkeypatch.setattr(creator, "built_page", lambda: (folder, one_file))
    monkeypatch.setenv("SHACKLED_ADDRESS_BOOK", str(tmp_path / "addresses.json"))
    return folder


def ask(page: Path, path: str, input: str | None = None) -> bytes | None:
    return creator.found(page, creator.first_answers(input, page)[0], path)


def test_files_of_the_page_only(page: Path) -> None:
    assert ask(page, "data/evm.wasm") == b"\0asm"
    assert json.loads(ask(page, "addresses.json") or b"") == {"chains": {}}
    for path in ("data", "data/", "../secret.js", "/etc/passwd", "input.json", "\0"):
        assert ask(page, path) is None, path


def test_an_input_comes_with_the_files_that_it_names(page: Path, tmp_path: Path) -> None:
    (tmp_path / "addresses.json").write_text('{"chains": {"1": {}}}', "utf-8")
    folder = tmp_path / "models"
    write(folder, {"z.obj": "mtllib z.mtl\nv 0 0 0\n", "z.mtl": "newmtl m\nmap_Kd images/wood%201.png\n"})
    write(folder, {"images/wood 1.png": "wood", "private.txt": "no"})
    model = str(folder / "z.obj")
    assert json.loads(ask(page, "input.json", model) or b"") == {"names": ["z.obj", "z.mtl", "images/wood 1.png"]}
    assert ask(page, "input/images/wood 1.png", model) == b"wood"
    assert ask(page, "input/private.txt", model) is None
    assert json.loads(ask(page, "addresses.json") or b"") == {"chains": {"1": {}}}


def test_only_files_that_readers_use_are_served(page: Path, tmp_path: Path) -> None:
    """Not what is named within other words, what no reader reads, or what is elsewhere."""
    folder = tmp_path / "models"
    write(folder, {"a.obj": "# id_rsa .env notes/diary.txt mywood.png Wood.PNG link.png\nmtllib sub/a.mtl\n"})
    write(folder, dict.fromkeys(("id_rsa", ".env", "notes/diary.txt", "e", "v", "d.png", "wood.png"), "no"))
    write(folder, {"sub/a.mtl": "", "notes/a.mtl.bak": ""})
    write(tmp_path, {"private.png": "no"})
    (folder / "link.png").symlink_to(tmp_path / "private.png")
    names = json.loads(ask(page, "input.json", str(folder / "a.obj")) or b"")["names"]
    assert names == ["a.obj", "sub/a.mtl", "wood.png"]


def test_pieces_and_links(page: Path, tmp_path: Path) -> None:
    (page / "data" / "pieces").mkdir()
    (page / "data" / "pieces" / "icons-heart.gz").write_bytes(b"")
    answers, place = creator.first_answers("icons/heart", page)
    assert (place, answers["input.json"]) == ("?input", b'{"piece": "icons/heart"}')
    # one that the page lacks is a scene file
    assert json.loads(ask(page, "input.json", "cube") or b"") == {"names": ["cube.json"]}
    assert json.loads(ask(page, "input/cube.json", "cube") or b"")["size"] == [256, 256]
    told = json.loads(ask(page, "input.json", "genesis/12") or b"")
    assert told == {"piece": f"genesis/{seed_of(12).hex()}"}
    with pytest.raises(InputError, match="the link is damaged"):
        creator.first_answers("https://shackled.example/#1abc", page)
    with pytest.raises(InputError, match="does not exist"):
        creator.first_answers(str(tmp_path / "none.obj"), page)


def test_written_to_a_folder(page: Path, tmp_path: Path, shackled: Shackled) -> None:
    out = tmp_path / "site"
    shackled(f"creator --out {out}")
    assert (out / "data" / "evm.wasm").read_bytes() == b"\0asm"
    assert (out / "creator.html").read_text("utf-8") == "one"
    assert "leave out INPUT" in shackled(f"creator teapot --out {out}", expect=2).err


def test_without_a_built_page(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As in an installed package, and in a clone in which nothing was built."""
    package = tmp_path / "src" / "shackled"
    monkeypatch.setattr(creator, "__file__", str(package / "cli" / "creator.py"))
    with pytest.raises(InputError, match=r"needs Node 20 or newer and npm.* `pip install --force-reinstall"):
        creator.built_page()
    (tmp_path / "Makefile").touch()
    with pytest.raises(InputError, match="`make page`"):
        creator.built_page()
    (tmp_path / "build" / "page").mkdir(parents=True)
    (tmp_path / "build" / "page" / "index.html").touch()
    assert creator.built_page() == (tmp_path / "build" / "page", tmp_path / "build" / "creator.html")


def test_the_command_serves_until_it_is_interrupted(page: Path) -> None:
    code = (
        "import sys, pathlib; from shackled.cli import creator, app;"
        "creator.built_page = lambda: (pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[1]));"
        "sys.exit(app.run(['creator', 'cube', '--no-browser', '--port', '0']))"
    )
    with child(sys.executable, "-c", code, page) as process:
        assert process.stdout is not None
        found = re.search(r"http://127\.0\.0\.1:(\d+)/\?input", process.stdout.readline())
        assert found
        with closing(http.client.HTTPConnection("127.0.0.1", int(found[1]), timeout=10)) as connection:
            connection.request("GET", "/?input")
            answer = connection.getresponse()
            assert (answer.read(), answer.getheader("Content-Type")) == (b"<p>page", "text/html")
        process.send_signal(signal.SIGINT)
        assert process.wait(10) == 0
