"""Exported pages, opened from disk in chromium and Firefox."""

from __future__ import annotations

import base64
import json
import re
from pathlib import Path
from typing import Any

import pytest

import shackled
from firefox import firefox, firefox_path
from shackled import InputError, load, render
from shackled.cli.app import run
from shackled.scene import render_call

VIEW = "document.querySelector('shackled-view')"
READY = f"Boolean({VIEW}.picture || {VIEW}.shadowRoot.querySelector('.error').textContent)"
SHA256 = f"{VIEW}.picture?.sha256"
BOX = f"{VIEW}.getBoundingClientRect().toJSON()"
REMOTE = re.compile(r"""(?:src|href)\s*=\s*["']?(?:https?:)?//""")


@pytest.fixture
def page(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> tuple[Path, str]:
    """A page that the command wrote, and the hash that `render` prints for the same scene."""
    monkeypatch.chdir(tmp_path)
    assert run(["export", "icons/crown", "-o", "crown.html", "--json"]) == 0
    exported = json.loads(capsys.readouterr().out)
    assert run(["render", "icons/crown", "--json"]) == 0
    rendered = json.loads(capsys.readouterr().out)
    for name in ("sha256", "gas", "width", "height", "triangles"):
        assert exported[name] == rendered[name]
    path = tmp_path / exported["output"]
    assert exported["bytes"] == path.stat().st_size
    return path, rendered["sha256"]


def drag_of(box: dict[str, float]) -> tuple[tuple[float, float], tuple[float, float]]:
    middle = box["x"] + box["width"] / 2, box["y"] + 100
    return middle, (middle[0] + 120, middle[1] + 30)


def check_turn(turn: dict[str, float]) -> None:
    assert turn["azimuth"] < -10
    assert turn["elevation"] > 0


def test_in_chromium(page: tuple[Path, str], browser: Any) -> None:
    path, sha256 = page
    faults: list[str] = []
    asked: list[str] = []
    with browser.new_page() as tab:
        tab.on("pageerror", lambda error: faults.append(str(error)))
        tab.on("console", lambda message: faults.append(message.text))
        tab.on("request", lambda request: asked.append(request.url.partition(":")[0]))
        tab.goto(path.as_uri())
        until(tab, READY)
        assert tab.evaluate(SHA256) == sha256
        start, end = drag_of(tab.evaluate(BOX))
        tab.mouse.move(*start)
        tab.mouse.down()
        tab.mouse.move(*end, steps=6)
        tab.mouse.up()
        check_turn(tab.evaluate(f"{VIEW}.turn"))
        until(tab, f"{SHA256} !== '{sha256}'")
    assert not faults
    assert set(asked) <= {"file", "data", "blob"}


def until(tab: Any, condition: str) -> None:
    # the policy of the page forbids what playwright's own waiting does
    for _ in range(600):
        if tab.evaluate(condition):
            return
        tab.wait_for_timeout(50)
    raise AssertionError(condition)


@pytest.mark.browser
@pytest.mark.skipif(firefox_path() is None, reason="needs Firefox: apt-get install firefox-esr")
def test_in_firefox(page: tuple[Path, str]) -> None:
    path, sha256 = page
    with firefox() as tab:
        tab.open(path.as_uri())
        tab.wait(READY)
        assert tab.run(SHA256) == sha256
        tab.run(f"({VIEW}.addEventListener('frame', () => globalThis.frames_ = (globalThis.frames_ ?? 0) + 1), null)")
        tab.drag(*drag_of(tab.run(BOX)))
        check_turn(tab.run(f"{VIEW}.turn"))
        tab.wait(f"{SHA256} !== '{sha256}'")
        assert tab.run("globalThis.frames_") > 3


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


def test_a_large_picture_is_left_out(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shackled.web._page.MAX_PNG", 1000)
    path = tmp_path / "a.html"
    shackled.export("icons/crown", path, 8)
    # without its scene, the picture is small
    with pytest.raises(InputError, match="carries no scene"):
        load(picture_of(path.read_text("utf-8"), tmp_path))
    shackled.export("icons/crown", path)
    assert "<noscript>" in path.read_text("utf-8")
    assert "<img" not in path.read_text("utf-8").partition("<script")[0]


def test_titles_of_pieces_and_files(tmp_path: Path) -> None:
    path = tmp_path / "my scene.html"
    shackled.export("icons/crown", path, 8)
    assert "<title>Crown</title>" in path.read_text("utf-8")
    shackled.export(load("icons/crown"), path, 8)
    assert "<title>my scene</title>" in path.read_text("utf-8")


def test_a_thousand_triangles_take_less_than_1_5_megabytes(tmp_path: Path) -> None:
    path = tmp_path / "a.html"
    scene = load("teapot", size=512, smooth=True)
    assert sum(len(each.mesh.faces) for each in scene.objects) > 900
    shackled.export(scene, path)
    assert path.stat().st_size < 1_500_000


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["teapot", "-o", "a.png"], "shackled: the page a.png must end in .html\n"),
        (["teapot", "-o", "no/a.html"], "shackled: the folder no of the page a.html does not exist\n"),
        (["no-such-piece"], None),
    ],
)
def test_wrong_usage_is_one_line(
    arguments: list[str],
    message: str | None,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run(["export", *arguments]) == 2
    _, printed = capsys.readouterr()
    assert printed == (message or printed)
    assert printed.count("\n") == 1
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(("name", "option"), [("GAS_LIMIT", "--size"), ("MAX_CALL", "--max-triangles")])
def test_a_scene_that_is_too_large_names_the_way_out(
    name: str, option: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(f"shackled.web._page.{name}", 1000)
    monkeypatch.chdir(tmp_path)
    assert run(["export", "icons/crown"]) == 2
    assert option in capsys.readouterr().err
    assert not list(tmp_path.iterdir())
