"""Where the page runs: from a plain server and from disk, in both browsers, offline; and what it weighs."""

from __future__ import annotations

import gzip
import json
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from tools.page_server import ONE, PAGE, Static

from creator_page import OBJ, PHONE, Visit, drawn, link, scene
from firefox import Tab, firefox

TOWN = scene("cube", {"mesh": {"piece": "cone", "object": 0}, "position": [3, 0, 0]}, size=64)
#: What a first picture may weigh, and all of the page; of a page that waits for what it does not need.
MOST_FIRST, MOST = 450_000, 1_200_000


def test_it_asks_for_few_files_of_its_own(visit: Visit, server: Static) -> None:
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

    # once all of it has been loaded, the page needs nobody: from a cache of the browser, or of IPFS
    page.close()
    page.dialog("limits")
    page.page.locator("#limits tr.total").wait_for()
    page.close()
    page.page.context.set_offline(True)
    asked = len(server.asked)
    page.after(lambda: page.drag(40, 10))
    page.after(page.click("look-gold"))
    assert len(server.asked) == asked
    # all of it is small
    files = [path for path in PAGE.rglob("*") if path.is_file() and path.name not in ("preview.jpg", "LICENSES.txt")]
    assert sum(len(gzip.compress(path.read_bytes(), 9)) for path in files) <= MOST
    # all addresses are relative: it may be in any folder of any site
    for path in files:
        if path.suffix in (".html", ".css"):
            assert not re.search("""(src|href)=["']?/""", path.read_text())


def test_what_could_not_be_loaded_is_loaded_later(visit: Visit) -> None:
    """A button whose dialog did not come works when it is clicked again, and so do the keys."""
    page = visit("", allowed="Failed to")
    network = page.page.context
    network.set_offline(True)
    page.click("download")()
    assert "A part of the page could not be loaded" in page.said("error")
    page.after(page.press("s"))
    page.after(page.press("Control+z"))
    network.set_offline(False)
    page.click("download")()
    dialog = page.page.locator("dialog[open]")
    dialog.get_by_role("radio", name="On chain").check(force=True)
    network.set_offline(True)
    page.run("void (app.toasts.value = [])")
    page.click("open-edition")()
    assert "A part of the page could not be loaded" in page.said("error")
    network.set_offline(False)
    page.click("open-edition")()
    dialog.get_by_text("There is no wallet in this browser.").wait_for()


def test_from_disk(visit: Visit, tmp_path: Path) -> None:
    page = visit(TOWN, disk=True, **PHONE)
    assert page.settle() == drawn(TOWN, tmp_path).pixels.tobytes()
    page.after(lambda: page.drop(**{"mine.obj": OBJ.encode()}))
    page.after(page.press("i"))
    page.after(lambda: page.run("app.openPiece('icons/heart')"))
    page.dialog("download")
    name, content = page.file("take-png")
    (tmp_path / name).write_bytes(content)
    page.page.keyboard.press("Escape")
    page.after(lambda: page.drop(**{name: content}))


@pytest.fixture(scope="module")
def tab() -> Iterator[Tab]:
    with firefox("#view") as found:
        yield found


@pytest.mark.browser
@pytest.mark.parametrize("disk", [False, True], ids=["server", "disk"])
def test_firefox(tab: Tab, server: Static, tmp_path: Path, disk: bool) -> None:
    address = ONE.as_uri() if disk else server.address
    settled = "(a => a?.shown.value && a.shown.value.doc === a.doc.value && !a.busy.value)(globalThis.shackledApp)"
    pixels = "Array.from(shackledApp.shown.value.drawn.pixels)"

    def visit(place: str) -> None:
        tab.open("about:blank")
        tab.open(address + place)
        tab.wait(settled)

    visit(link(TOWN))
    expected = drawn(TOWN, tmp_path)
    assert bytes(tab.run(pixels)) == expected.to_pil().convert("RGBA").tobytes()
    assert tab.run("shackledApp.shown.value.drawn.gas") == expected.gas
    before = json.dumps(tab.run("shackledApp.doc.value.camera.eye"), separators=(",", ":"))
    tab.drag(60, 10)
    tab.wait(f"JSON.stringify(shackledApp.doc.value.camera.eye) !== {before!r}")
    tab.wait(settled)
    tab.run(f"shackledApp.open([new File([{json.dumps(OBJ)}], 'mine.obj')]).then(() => null)")
    tab.wait("shackledApp.doc.value.title === 'mine'")
    tab.wait(settled)
    assert tab.run("shackledApp.toasts.value.filter(each => each.kind === 'error').map(each => each.text)") == []
    assert tab.run("await shackledApp.work.png(shackledApp.doc.value, { scale: 1 }).then(blob => blob.size)") > 100
    shown = tab.run(pixels)
    tab.wait("shackledApp.link.value")
    visit(tab.run("shackledApp.link.value"))
    assert tab.run(pixels) == shown
