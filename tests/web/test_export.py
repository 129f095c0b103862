"""Exported pages, opened from disk in chromium and Firefox."""

from __future__ import annotations

import base64
import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import shackled
from creator_page import Tab
from firefox import firefox
from shackled import InputError, load, render
from shackled.cli.app import run
from shackled.scene._codec import render_call

VIEW = "document.querySelector('shackled-view')"
READY = f"Boolean({VIEW}.picture || {VIEW}.shadowRoot.querySelector('.error').textContent)"
#: Counts the frames of a movement.
COUNT = f"({VIEW}.addEventListener('frame', () => globalThis.frames_ = (globalThis.frames_ ?? 0) + 1), null)"
REMOTE = re.compile(r"""(?:src|href)\s*=\s*["']?(?:https?:)?//""")


@pytest.fixture(params=["chromium", "firefox"])
def tab(request: pytest.FixtureRequest) -> Iterator[Any]:
    """A tab of each browser. In chromium nothing must go wrong, and nothing be asked of others."""
    if request.param == "firefox":
        with firefox("shackled-view") as found:
            yield found
        return
    faults: list[str] = []
    asked: set[str] = set()
    with request.getfixturevalue("browser").new_page() as page:
        page.on("pageerror", lambda error: faults.append(str(error)))
        page.on("console", lambda message: faults.append(message.text))
        page.on("request", lambda request: asked.add(request.url.partition(":")[0]))
        yield Tab(page, page.locator("shackled-view"), f"{VIEW}.shadowRoot.textContent")
    assert not faults
    assert asked <= {"file", "data", "blob"}


@pytest.mark.browser
def test_in_browsers(
    tab: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """A page that the command wrote shows what `render` prints for the same scene."""
    monkeypatch.chdir(tmp_path)
    assert run(["export", "icons/crown", "-o", "crown.html", "--json"]) == 0
    exported = json.loads(capsys.readouterr().out)
    assert run(["render", "icons/crown", "--json"]) == 0
    rendered = json.loads(capsys.readouterr().out)
    for name in ("sha256", "gas", "width", "height", "triangles"):
        assert exported[name] == rendered[name]
    path = tmp_path / exported["output"]
    assert exported["bytes"] == path.stat().st_size
    tab.open(path.as_uri())
    tab.wait(READY)
    assert tab.run(f"{VIEW}.picture?.sha256") == rendered["sha256"]
    tab.run(COUNT)
    tab.drag(120, 30)
    turn = tab.run(f"{VIEW}.turn")
    assert turn["azimuth"] < -10
    assert turn["elevation"] > 0
    tab.wait(f"{VIEW}.picture?.sha256 !== '{rendered['sha256']}'")
    tab.wait("globalThis.frames_ > 3")


def picture_of(html: str, folder: Path) -> Path:
    """The picture for readers without scripts, as a file."""
    found = re.search(r'<img src="data:image/png;base64,([^"]+)" alt="([^"]+)"', html)
    assert found
    path = folder / "picture.png"
    path.write_bytes(base64.b64decode(found[1]))
    return path


def test_what_a_page_contains(tmp_path: Path) -> None:
    path = tmp_path / "a.html"
    scene = load("icons/crown", size=(48, 40))
    image = shackled.export(scene, path, title="<b>&")
    html = path.read_text("utf-8")
    assert image == render(scene)
    assert "<title>&lt;b&gt;&amp;</title>" in html
    assert "<b>&" not in html
    assert image.sha256 in html
    assert f"{image.gas:,} gas" in html
    assert not REMOTE.search(html)
    restored = load(picture_of(html, tmp_path))
    assert render_call(restored) == render_call(scene)
    # the same file for the same scene
    shackled.export("icons/crown", path, (48, 40), title="<b>&")
    assert path.read_text("utf-8") == html
    # a thousand triangles take less than 1.5 megabytes
    scene = load("teapot", size=512, smooth=True)
    assert sum(len(each.mesh.faces) for each in scene.objects) > 900
    shackled.export(scene, path)
    assert path.stat().st_size < 1_500_000


def test_titles_and_a_large_picture_that_is_left_out(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shackled.web._page.MAX_PNG", 1000)
    path = tmp_path / "my scene.html"
    shackled.export(load("icons/crown"), path, 8)
    assert "<title>my scene</title>" in path.read_text("utf-8")
    # without its scene, the picture is small
    with pytest.raises(InputError, match="carries no scene"):
        load(picture_of(path.read_text("utf-8"), tmp_path))
    shackled.export("icons/crown", path)
    html = path.read_text("utf-8")
    assert "<title>Crown</title>" in html
    assert "<noscript>" in html
    assert "<img" not in html.partition("<script")[0]


@pytest.mark.parametrize(
    ("arguments", "low", "message"),
    [
        (["teapot", "-o", "a.png"], "", "the page a.png must end in .html\n"),
        (["teapot", "-o", "no/a.html"], "", "the folder no of the page a.html does not exist\n"),
        (["no-such-piece"], "", "no-such-piece"),
        (["icons/crown"], "GAS_LIMIT", "--size"),
        (["icons/crown"], "MAX_CALL", "--max-triangles"),
    ],
)
def test_what_cannot_be_exported_is_one_line(
    arguments: list[str],
    low: str,
    message: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """low: a limit that is far too low."""
    if low:
        monkeypatch.setattr(f"shackled.web._page.{low}", 1000)
    monkeypatch.chdir(tmp_path)
    assert run(["export", *arguments]) == 2
    printed = capsys.readouterr().err
    assert message in printed
    assert (printed.startswith("shackled: "), printed.count("\n")) == (True, 1)
    assert not list(tmp_path.iterdir())
