"""Where the page runs: from a plain server and from disk, in both browsers, offline; and what it weighs."""

from __future__ import annotations

import gzip
import json
from collections.abc import Iterator
from pathlib import Path

import pytest
from tools.page_server import ONE, PAGE, Static

from creator_page import OBJ, PHONE, Visit, drawn, link, scene
from firefox import Tab, firefox, firefox_path

TOWN = scene("cube", {"mesh": {"piece": "cone", "object": 0}, "position": [3, 0, 0]}, size=64)
#: What a first picture may weigh, and all of the page; of a page that waits for what it does not need.
MOST_FIRST, MOST = 450_000, 1_200_000


def test_it_asks_for_its_own_files_only_and_for_few(visit: Visit, server: Static) -> None:
    server.asked.clear()
    page = visit("")
    paths = {path.partition("?")[0] for path in server.asked}
    sizes = [len(gzip.compress((PAGE / (path[1:] or "index.html")).read_bytes(), 9)) for path in paths]
    assert sum(sizes) <= MOST_FIRST
    # dialogs, wallets and readers of files come when they are needed
    page.dialog("about")
    page.page.get_by_text("Licences").first.wait_for()
    assert len(server.asked) > len(paths)
    policy = page.page.get_attribute("meta[http-equiv=Content-Security-Policy]", "content")
    assert "default-src 'none'" in policy
    assert "unsafe-inline" not in policy
    assert "'unsafe-eval'" not in policy


def test_all_of_it_is_small() -> None:
    files = [path for path in PAGE.rglob("*") if path.is_file() and path.name not in ("preview.jpg", "LICENSES.txt")]
    assert sum(len(gzip.compress(path.read_bytes(), 9)) for path in files) <= MOST


@pytest.mark.parametrize("viewport", [{}, PHONE], ids=["desk", "phone"])
def test_from_disk(visit: Visit, tmp_path: Path, viewport: dict[str, int]) -> None:
    page = visit(TOWN, disk=True, **viewport)
    assert page.settle() == drawn(TOWN, tmp_path).pixels.tobytes()
    page.after(lambda: page.drop(**{"mine.obj": OBJ.encode()}))
    page.after(page.press("i"))
    page.run("app.openPiece('icons/heart')")
    page.wait("app.doc.value.title === 'Heart'")
    page.settle()
    page.dialog("download")
    name, content = page.file(page.page.locator("[data-name=take-png]:enabled").click)
    (tmp_path / name).write_bytes(content)
    page.page.keyboard.press("Escape")
    page.after(lambda: page.drop(**{name: content}))


def test_with_the_network_off(visit: Visit, server: Static) -> None:
    """Once all of it has been loaded, the page needs nobody: from a cache of the browser, or of IPFS."""
    page = visit(TOWN)
    page.dialog("limits")
    page.page.locator("#limits tr.total").wait_for()
    page.page.keyboard.press("Escape")
    page.page.context.set_offline(True)
    asked = len(server.asked)
    page.after(lambda: page.drag(40, 10))
    page.after(page.click("look-gold"))
    assert len(server.asked) == asked


def test_from_a_folder_of_a_site(visit: Visit, server: Static) -> None:
    """All addresses are relative."""
    for path in PAGE.rglob("*"):
        if path.suffix in (".html", ".css"):
            assert 'src="/' not in path.read_text()
            assert 'href="/' not in path.read_text()
    assert visit(TOWN).run(
        "performance.getEntriesByType('resource').every(each => each.name.startsWith(argument))", server.address
    )


# ---- Firefox ----


@pytest.fixture(scope="module")
def tab() -> Iterator[Tab]:
    pytest.importorskip("websockets", reason="Firefox is driven by a WebSocket")
    if firefox_path() is None or not PAGE.exists():
        pytest.skip("needs firefox: apt-get install firefox-esr, and make page")
    with firefox() as found:
        yield found


@pytest.mark.browser
@pytest.mark.parametrize("disk", [False, True], ids=["server", "disk"])
def test_firefox(tab: Tab, server: Static, tmp_path: Path, disk: bool) -> None:
    settled = "(a => a?.shown.value && a.shown.value.doc === a.doc.value && !a.busy.value)(globalThis.shackledApp)"
    digest = """await crypto.subtle.digest('SHA-256',
        shackledApp.shown.value.drawn.pixels.filter((_, index) => index % 4 < 3))
        .then(hash => Array.from(new Uint8Array(hash), byte => byte.toString(16).padStart(2, '0')).join(''))"""
    tab.open("about:blank")
    tab.open((ONE.as_uri() if disk else server.address) + link(TOWN))
    tab.wait(settled)
    expected = drawn(TOWN, tmp_path)
    if not disk:  # browsers compute digests for pages that nobody can change on the way
        assert tab.run(digest) == expected.sha256
    assert tab.run("shackledApp.shown.value.drawn.gas") == expected.gas
    before = tab.run("shackledApp.doc.value.camera.eye")
    left, top, width, height = tab.run(
        "(b => [b.x, b.y, b.width, b.height])(document.getElementById('view').getBoundingClientRect())"
    )
    tab.drag((left + width / 2, top + height / 2), (left + width / 2 + 60, top + height / 2 + 10))
    tab.wait(
        f"JSON.stringify(shackledApp.doc.value.camera.eye) !== {json.dumps(json.dumps(before, separators=(',', ':')))}"
    )
    tab.wait(settled)
    tab.run("shackledApp.open([new File([" + json.dumps(OBJ) + "], 'mine.obj')]).then(() => null)")
    tab.wait("shackledApp.doc.value.title === 'mine'")
    tab.wait(settled)
    tab.run("(document.querySelector('[data-name=look-gold]').click(), null)")
    tab.wait(settled)
    assert tab.run("shackledApp.toasts.value.filter(each => each.kind === 'error').map(each => each.text)") == []
    tab.run("(shackledApp.dialog.value = 'download', null)")
    tab.wait("document.querySelector('[data-name=take-png]:enabled') !== null")
    png = tab.run("await shackledApp.work.png(shackledApp.doc.value, { scale: 1 }).then(blob => blob.size)")
    assert png > 100
    shown = tab.run("Array.from(shackledApp.shown.value.drawn.pixels)")
    tab.wait("shackledApp.link.value")
    address = tab.run("shackledApp.link.value")
    tab.open("about:blank")
    tab.open((ONE.as_uri() if disk else server.address) + address)
    tab.wait(settled)
    assert tab.run("Array.from(shackledApp.shown.value.drawn.pixels)") == shown
