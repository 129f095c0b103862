"""What is taken home is what is seen: files, programs, links; and what is refused is told."""

from __future__ import annotations

import base64
import io
import json
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image as PillowImage
from tools.page_server import Static

from creator_page import OBJ, Creator, Visit, drawn, scene
from nodes import anvil, needs_anvil
from shackled import load, render
from shackled.scene._codec import render_call

TOWN = scene(
    "cube",
    {"mesh": {"piece": "cone", "object": 0}, "position": [3, 0, 0], "color": "#d04020", "opacity": 0.6},
    size=[48, 40],
    antialias=True,
    ground={"color": "#708090"},
    lights=[{"kind": "directional", "direction": [1, 2, 1], "shadow": True}],
)


def tab(page: Creator, title: str) -> None:
    page.page.locator("#download").get_by_role("radio", name=title).check(force=True)


def scale(page: Creator, value: int) -> None:
    page.page.locator(f"#download [name=scale][value='{value}']").check(force=True)


def pixels_of(content: bytes, mode: str = "RGB") -> Any:
    with PillowImage.open(io.BytesIO(content)) as picture:
        return np.asarray(picture.convert(mode))


def test_each_file_is_the_picture(visit: Visit, tmp_path: Path) -> None:
    page = visit(TOWN)
    expected = drawn(TOWN, tmp_path)
    assert expected.scene is not None
    assert page.pixels() == expected.pixels.tobytes()
    page.dialog("download")
    for times in (1, 4):
        scale(page, times)
        name, png = page.file("take-png")
        assert np.array_equal(pixels_of(png), expected.pixels.repeat(times, 0).repeat(times, 1))
        # it carries the very call
        (tmp_path / name).write_bytes(png)
        assert render_call(load(tmp_path / name)) == render_call(expected.scene)
    assert name.startswith("cube")
    tab(page, "Files and programs")
    files = {kind: page.file(f"take-{kind}")[1] for kind in ("bmp", "svg", "scene", "glb")}
    assert files["bmp"] == expected.bmp
    # another encoder of PNG than that of the command, around the same pixels
    ours, theirs = (text.decode().partition(";base64,") for text in (files["svg"], expected.encode(".svg")))
    assert ours[0] == theirs[0]
    assert np.array_equal(pixels_of(base64.b64decode(ours[2].partition('"')[0])), expected.pixels)
    # the scene file has pieces by name
    assert json.loads(files["scene"])["objects"][0]["mesh"] == {"piece": "cube", "object": 0}
    (tmp_path / "again.json").write_bytes(files["scene"])
    assert render(tmp_path / "again.json").bmp == expected.bmp
    (tmp_path / "model.glb").write_bytes(files["glb"])
    assert load(tmp_path / "model.glb").triangles >= 92
    tab(page, "On chain")
    _, calldata = page.file("take-calldata")
    assert calldata.decode().strip() == f"0x{render_call(expected.scene).hex()}"
    # without background; and what is too large is not offered
    page.close()
    page.show(scene("cube"))
    page.dialog("download")
    tab(page, "Picture")
    page.page.get_by_label("Without background").check()
    scale(page, 1)
    alpha = pixels_of(page.file("take-png")[1], "RGBA")[..., 3]
    assert (alpha.min(), alpha.max(), alpha[0, 0]) == (0, 255, 0)
    page.close()
    page.change(width=1024, height=8)
    page.dialog("download")
    offered = page.page.locator("#download input[name=scale]")
    assert offered.evaluate_all("all => all.map(each => Number(each.value))") == [1, 2, 3, 4]


def test_what_turns(visit: Visit, tmp_path: Path) -> None:
    """test_work.py has what is in a page that turns, and in turntables; test_export.py opens such a page."""
    page = visit(TOWN)
    page.dialog("download")
    name, content = page.file("take-page")
    assert name.endswith(".html")
    assert drawn(TOWN, tmp_path).sha256 in content.decode()
    page.page.get_by_label("pictures").fill("6")
    page.page.keyboard.press("Tab")
    for kind in ("GIF", "APNG"):
        page.page.get_by_role("radio", name=kind, exact=True).check(force=True)
        name, content = page.file(f"take-{kind.lower()}")
        assert name.startswith("cube")
        with PillowImage.open(io.BytesIO(content)) as film:
            assert film.n_frames == 6  # type: ignore[attr-defined]
    # another is cancelled, and what comes next does not wait for it
    page.close()
    page.show(scene("torus-knot", size=256))
    page.dialog("download")
    button = page.page.locator("[data-name=take-gif]")
    button.click()
    job = page.page.locator("#download .job")
    job.wait_for()
    job.get_by_role("button", name="Cancel").click()
    job.wait_for(state="detached")
    assert button.is_enabled()
    page.page.keyboard.press("Escape")
    page.after(page.press("i"))


def test_the_link_is_copied(visit: Visit, server: Static) -> None:
    page = visit(TOWN, permissions=["clipboard-read", "clipboard-write"])
    page.dialog("download")
    copy = page.page.locator("[data-name=take-link]:enabled")
    copy.click()
    assert "Copied" in page.said()
    address = page.run("navigator.clipboard.readText()")
    assert address.startswith(f"{server.address}#1")
    assert "on this computer only" in page.page.inner_text("#download")
    assert visit(address.removeprefix(server.address)).pixels() == page.pixels()
    # why nothing is copied is told
    page.run("void (navigator.clipboard.writeText = async () => { throw new Error('forbidden') })")
    copy.click()
    assert "does not allow" in page.said("error")


def test_programs_are_shown_and_saved(visit: Visit) -> None:
    page = visit(scene("cube"))
    page.after(lambda: page.drop(**{"mine.obj": OBJ.encode()}))
    page.dialog("download")
    tab(page, "Files and programs")
    name, python = page.file("take-python")
    assert name == "mine.py"
    assert b"shackled" in python
    name, solidity = page.file("take-solidity")
    assert (name, solidity.splitlines()[0]) == ("mine.sol", b"// SPDX-License-Identifier: UNLICENSED")
    tab(page, "On chain")
    for kind in ("cast", "cast-anywhere"):
        assert b"cast call" in page.file(f"take-{kind}")[1]


@needs_anvil
def test_a_node_draws_the_same(visit: Visit) -> None:
    with anvil() as node:
        page = visit(scene("cube"), nodes=[node.url], allowed="ERR_CONNECTION_REFUSED")
        page.dialog("download")
        tab(page, "On chain")
        page.page.get_by_label("Address of a node").fill(node.url)
        button = page.page.locator("[data-name=node]")
        button.click()
        page.page.get_by_text("The same bytes as here").wait_for()
        node.stop()
        button.click()
        page.page.locator("#download .trouble").wait_for()


def test_limits_stages_and_gas(visit: Visit) -> None:
    page = visit(scene("cube", size=24))
    page.click("status")()
    dialog = page.page.locator("#limits")
    dialog.locator("h3", has_text="Where it fits").wait_for()
    dialog.locator("tr.total").wait_for()
    cells = dialog.locator("table.bars").last.locator("tr:not(.total) td.number:last-child").all_inner_texts()
    assert len(cells) > 5
    assert sum(int(text.replace(",", "")) for text in cells) == page.run("app.shown.value.drawn.gas")
    dialog.locator(".strip-of-stages canvas").nth(5).wait_for()
    seen = set()
    for number in range(6):
        dialog.get_by_label("Stage of the pipeline").fill(str(number))
        seen.add(dialog.locator("figcaption b").inner_text())
    assert len(seen) == 6
    dialog.get_by_text("fits", exact=True).first.wait_for()
    # what does not fit is made to fit
    page.close()
    page.show(scene("torus", size=256, antialias=True))
    before = page.run("app.shown.value.drawn.gas")
    page.after(page.dialog("limits").locator("[data-name=fit-transaction], [data-name=fit-edition]").first.click)
    assert page.run("app.shown.value.drawn.gas") < min(before, 2**24)
    dialog.get_by_text("Undo brings the former picture back").wait_for()
