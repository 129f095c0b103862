"""What is taken home is what is seen: files, programs, links; and what is refused is told."""

from __future__ import annotations

import base64
import io
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image as PillowImage
from tools.page_server import Static

from creator_page import OBJ, Creator, Visit, drawn, scene
from nodes import anvil, needs_anvil
from shackled import load, render
from shackled.scene import full_turn, render_call

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


def saved(page: Creator, name: str) -> tuple[str, bytes]:
    """Name and content of a file, once the page can make it."""
    return page.file(page.page.locator(f"[data-name='{name}']:enabled").click)


def pixels_of(content: bytes) -> tuple[tuple[int, int], bytes]:
    with PillowImage.open(io.BytesIO(content)) as picture:
        return picture.size, picture.convert("RGB").tobytes()


def test_each_file_is_the_picture(visit: Visit, tmp_path: Path) -> None:
    page = visit(TOWN)
    shown, expected = page.pixels(), drawn(TOWN, tmp_path)
    assert expected.scene is not None
    page.dialog("download")
    for scale in (1, 4):
        page.page.locator(f"#download [name=scale][value='{scale}']").check(force=True)
        name, png = saved(page, "take-png")
        size, enlarged = pixels_of(png)
        assert size == (48 * scale, 40 * scale)
        rows = np.frombuffer(enlarged, np.uint8).reshape(40 * scale, 48 * scale, 3)
        assert rows[::scale, ::scale].tobytes() == shown
        assert np.array_equal(rows, rows[::scale, ::scale].repeat(scale, 0).repeat(scale, 1))
        # it carries the very call
        (tmp_path / name).write_bytes(png)
        assert render_call(load(tmp_path / name)) == render_call(expected.scene)
    assert name.startswith("cube")
    tab(page, "Files and programs")
    files = {kind: saved(page, f"take-{kind}")[1] for kind in ("bmp", "svg", "scene", "glb")}
    assert files["bmp"] == expected.bmp
    # another encoder of PNG than that of the command, around the same pixels
    ours, theirs = (text.decode().partition(";base64,") for text in (files["svg"], expected.encode(".svg")))
    assert (ours[0], pixels_of(base64.b64decode(ours[2].partition('"')[0]))[1]) == (theirs[0], shown)
    (tmp_path / "again.json").write_bytes(files["scene"])
    assert render(tmp_path / "again.json").bmp == expected.bmp
    assert files["glb"][:4] == b"glTF"
    (tmp_path / "model.glb").write_bytes(files["glb"])
    assert load(tmp_path / "model.glb").triangles >= 92
    tab(page, "On chain")
    _, calldata = saved(page, "take-calldata")
    assert calldata.decode().strip() == f"0x{render_call(expected.scene).hex()}"


def test_a_picture_without_background(visit: Visit) -> None:
    page = visit(scene("cube"))
    page.dialog("download")
    page.page.get_by_label("Without background").check()
    page.page.locator("#download [name=scale][value='1']").check(force=True)
    with PillowImage.open(io.BytesIO(saved(page, "take-png")[1])) as picture:
        alpha = np.asarray(picture.convert("RGBA"))[..., 3]
    assert (alpha.min(), alpha.max()) == (0, 255)
    assert alpha[0, 0] == 0


def test_what_is_too_large_is_not_offered(visit: Visit) -> None:
    page = visit(scene("cube"))
    page.run("app.change({...app.doc.value, width: 1024, height: 8}, 'size')")
    page.settle()
    page.dialog("download")
    offered = page.page.locator("#download input[name=scale]").evaluate_all(
        "all => all.map(each => Number(each.value))"
    )
    assert offered == [1, 2, 3, 4]


def test_a_page_that_turns(visit: Visit, browser: Any, tmp_path: Path) -> None:
    page = visit(TOWN)
    page.dialog("download")
    name, content = saved(page, "take-page")
    assert name.endswith(".html")
    (tmp_path / name).write_bytes(content)
    tab_ = browser.new_page()
    tab_.goto((tmp_path / name).as_uri())
    digest = drawn(TOWN, tmp_path).sha256
    tab_.wait_for_selector("shackled-view")
    assert digest in tab_.inner_text("main")
    found = tab_.evaluate(
        """new Promise(resolve => {
            const view = document.querySelector('shackled-view');
            const look = () => view.picture ? resolve(view.picture.sha256) : setTimeout(look, 20);
            look();
        })"""
    )
    assert found == digest
    tab_.close()


@pytest.mark.parametrize("kind", ["gif", "apng"])
def test_a_turntable(visit: Visit, kind: str) -> None:
    page = visit(scene("cube", size=32))
    page.after(page.click("piece-icons/heart"))
    page.dialog("download")
    if kind == "apng":
        page.page.get_by_role("radio", name="APNG").check(force=True)
    page.page.get_by_label("pictures").fill("6")
    page.page.keyboard.press("Tab")
    name, content = saved(page, f"take-{kind}")
    assert name.startswith("heart-turning.")
    turning = full_turn(load("icons/heart", size=32, antialias=False), 6)
    with PillowImage.open(io.BytesIO(content)) as film:
        assert film.n_frames == 6  # type: ignore[attr-defined]
        for place, frame in enumerate(turning):
            film.seek(place)
            shown = np.asarray(film.convert("RGB").resize((32, 32), PillowImage.Resampling.NEAREST)).astype(int)
            # a GIF has 256 colours; the contract Turntable goes a little back
            assert np.abs(shown - render(frame).pixels).mean() < {"gif": 3, "apng": 30}[kind]


def test_a_turntable_is_cancelled(visit: Visit) -> None:
    page = visit(scene("torus-knot", size=256))
    page.dialog("download")
    button = page.page.locator("[data-name=take-gif]")
    button.click()
    job = page.page.locator("#download .job")
    job.wait_for()
    job.get_by_role("button", name="Cancel").click()
    job.wait_for(state="detached")
    assert button.is_enabled()
    # and what comes next does not wait for it
    page.page.keyboard.press("Escape")
    page.after(page.press("i"))


def test_the_link_is_copied(visit: Visit, server: Static) -> None:
    page = visit(TOWN, permissions=["clipboard-read", "clipboard-write"])
    page.dialog("download")
    page.page.locator("[data-name=take-link]:enabled").click()
    assert "Copied" in page.said()
    address = page.run("navigator.clipboard.readText()")
    assert address.startswith(f"{server.address}#1")
    assert "on this computer only" in page.page.inner_text("#download")
    assert visit(address.removeprefix(server.address)).pixels() == page.pixels()


def test_why_nothing_is_copied_is_told(visit: Visit) -> None:
    refuse = "if (navigator.clipboard) navigator.clipboard.writeText = async () => { throw new Error('forbidden') }"
    page = visit(scene("cube"), script=refuse)
    page.dialog("download")
    page.page.locator("[data-name=take-link]:enabled").click()
    assert "does not allow" in page.said("error")


def test_programs_are_shown_and_saved(visit: Visit) -> None:
    page = visit(scene("cube"))
    page.after(lambda: page.drop(**{"mine.obj": OBJ.encode()}))
    page.dialog("download")
    tab(page, "Files and programs")
    name, python = saved(page, "take-python")
    assert name == "mine.py"
    assert b"shackled" in python
    name, solidity = saved(page, "take-solidity")
    assert (name, solidity.splitlines()[0]) == ("mine.sol", b"// SPDX-License-Identifier: UNLICENSED")
    tab(page, "On chain")
    for kind in ("cast", "cast-anywhere"):
        assert b"cast call" in saved(page, f"take-{kind}")[1]


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
    gas = page.run("app.shown.value.drawn.gas")
    cells = dialog.locator("table.bars").last.locator("tr:not(.total) td.number:last-child").all_inner_texts()
    assert len(cells) > 5
    assert sum(int(text.replace(",", "")) for text in cells) == gas
    dialog.locator(".strip-of-stages canvas").nth(5).wait_for()
    seen = set()
    for number in range(6):
        dialog.get_by_label("Stage of the pipeline").fill(str(number))
        seen.add(dialog.locator("figcaption b").inner_text())
    assert len(seen) == 6
    dialog.get_by_text("fits", exact=True).first.wait_for()


def test_a_picture_is_made_to_fit(visit: Visit) -> None:
    page = visit(scene("torus", size=256, antialias=True))
    dialog = page.dialog("limits")
    button = dialog.locator("[data-name=fit-transaction], [data-name=fit-edition]").first
    button.wait_for()
    before = page.run("app.shown.value.drawn.gas")
    page.after(button.click)
    assert page.run("app.shown.value.drawn.gas") < min(before, 2**24)
    dialog.get_by_text("Undo brings the former picture back").wait_for()


def test_the_scene_file_has_pieces_by_name(visit: Visit) -> None:
    page = visit(TOWN)
    page.dialog("download")
    tab(page, "Files and programs")
    content = json.loads(saved(page, "take-scene")[1])
    assert content["objects"][0]["mesh"] == {"piece": "cube", "object": 0}
