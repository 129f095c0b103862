"""The picture: its bytes, what moves it, and what is shown while it is drawn."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from creator_page import PHONE, Creator, Visit, drawn, scene
from shackled import load, render
from shackled.scene import render_call

TOWN = scene("cube", {"mesh": {"piece": "cone", "object": 0}, "position": [3, 0, 0], "color": "#d04020"}, size=64)
#: Seconds of drawing: to see what is shown meanwhile, and to stop it.
LONG = """app.change({...app.doc.value, width: 2048, height: 2048, antialias: true, title: 'Another',
    rim: { color: '#ffffff', power: 3 }, tone: { exposure: 1, filmic: true, gamma: true }}, 'size')"""


@pytest.mark.parametrize("name", ["icons/coin", "cornell-box", "showcase/glass"])
def test_the_picture_is_the_contracts_own(visit: Visit, name: str) -> None:
    page = visit(scene("cube"))
    page.run(f"await app.openPiece('{name}')")
    page.run("app.change({...app.doc.value, width: 72, height: 72, antialias: false}, 'size')")
    expected = load(name, size=72, antialias=False)
    image = render(expected)
    assert page.settle() == image.pixels.tobytes()
    page.wait("document.querySelector('[data-name=triangles]').textContent === argument", f"{image.triangles:,}")
    figures = [page.page.inner_text(f"[data-name={each}]") for each in ("gas", "triangles", "bytes")]
    assert figures == [f"{number:,}" for number in (image.gas, image.triangles, len(render_call(expected)))]
    assert page.page.inner_text("[data-name=title]")


def test_a_scene_of_pieces_is_that_of_the_command(visit: Visit, tmp_path: Path) -> None:
    assert visit(TOWN).settle() == drawn(TOWN, tmp_path).pixels.tobytes()


def moves(page: Creator, act: Callable[[], object]) -> dict[str, Any]:
    """What an act changes of the camera; undone afterwards."""
    before = page.doc()["camera"]
    shown = page.pixels()
    assert page.after(act) != shown
    camera = page.doc()["camera"]
    assert page.after(page.press("Control+z")) == shown
    return {key: value for key, value in camera.items() if value != before[key]}


def test_what_moves_the_camera(visit: Visit) -> None:
    page = visit(TOWN)

    def wheel() -> None:
        page.view.hover()
        page.page.mouse.wheel(0, -300)

    acts: list[tuple[Callable[[], object], set[str]]] = [
        (lambda: page.drag(120, 30), {"eye"}),
        (lambda: page.drag(60, 0, button="right"), {"eye", "target"}),
        (wheel, {"eye"}),
        (page.press("ArrowLeft", "ArrowUp"), {"eye"}),
        (page.press("Shift+ArrowRight"), {"eye", "target"}),
        (page.press("+", "+"), {"eye"}),
        (page.press("p"), {"projection"}),
    ]
    for act, changed in acts:
        assert moves(page, act).keys() >= changed
    page.after(page.press("-", "-", "-", "ArrowLeft"))
    far = page.doc()["camera"]
    page.after(page.press("f"))
    fitted = page.doc()["camera"]
    page.after(page.press("0"))
    assert fitted != far != page.doc()["camera"]
    assert page.settle() == visit(TOWN).pixels()


def test_a_drag_draws_small_pictures_and_is_one_step(visit: Visit) -> None:
    page = visit(scene("teapot", size=512))
    shown = page.pixels()
    page.run(
        "void (globalThis.sizes = [], app.drawing.seen.subscribe(each => globalThis.sizes.push(each?.drawn.width)))"
    )
    page.drag(90, 0, hold=True)
    page.wait("app.drawing.seen.value.draft && app.drawing.seen.value.doc === app.doc.value")
    assert page.run("app.shown.value.doc !== app.doc.value")
    assert "gas at" in page.page.inner_text("[data-name=status]")
    page.page.mouse.up()
    assert page.settle() != shown
    assert min(page.run("globalThis.sizes")) < 512
    assert page.after(page.press("Control+z")) == shown
    assert not page.run("app.canUndo.value")


def test_drafts_are_without_antialiasing(visit: Visit) -> None:
    page = visit(scene("cube", size=96, antialias=True))
    page.drag(40, 0, hold=True)
    page.wait("app.drawing.seen.value.draft && app.drawing.seen.value.doc === app.doc.value")
    colors = page.run("new Set(new Uint32Array(app.drawing.seen.value.drawn.pixels.buffer)).size")
    page.page.mouse.up()
    page.settle()
    assert colors < page.run("new Set(new Uint32Array(app.shown.value.drawn.pixels.buffer)).size")


def test_a_picture_is_enlarged_by_whole_numbers(visit: Visit) -> None:
    page = visit(scene("cube", size=[100, 70]))
    for width in (1280, 1000, 777):
        page.page.set_viewport_size({"width": width, "height": 700})
        box = page.page.locator("#picture").bounding_box()
        factor = box["width"] * page.run("devicePixelRatio") / 100
        assert factor == pytest.approx(round(factor), abs=0.01)
        assert box["height"] * page.run("devicePixelRatio") / 70 == pytest.approx(factor, abs=0.01)


@pytest.mark.parametrize("viewport", [{"width": 1280, "height": 720}, PHONE], ids=["desk", "phone"])
def test_a_narrow_picture_stays_in_its_place(visit: Visit, viewport: dict[str, Any]) -> None:
    page = visit(scene("cube"), **viewport)
    for width, height in ((1, 128), (4, 4), (320, 4)):
        page.run("app.change({...app.doc.value, width: argument[0], height: argument[1]}, 'size')", [width, height])
        page.settle()
        box = page.view.bounding_box()
        assert min(box["width"], box["height"]) >= 24
        assert box["x"] >= 0
        assert box["x"] + box["width"] <= viewport["width"]
        before = page.doc()["camera"]["eye"]
        page.after(lambda: page.drag(12, 0))
        assert page.doc()["camera"]["eye"] != before


def test_what_is_out_of_view_is_told(visit: Visit) -> None:
    page = visit(scene("cube", camera={"eye": [0, 0, 9], "target": [0, 0, 20]}))
    told = "document.getElementById('app').textContent.includes('press F')"
    page.wait(told)
    page.after(page.press("f"))
    page.wait(f"!{told}")


def test_long_drawing_is_told_and_stopped(visit: Visit) -> None:
    page = visit(scene("torus-knot"))
    title = page.page.inner_text("[data-name=title]")
    page.run(LONG)
    page.wait("app.busy.value !== null")
    # the figures and the title are those of what is seen
    assert page.run("app.drawing.seen.value.doc === app.doc.value") == (
        page.page.inner_text("[data-name=title]") == "Another"
    )
    page.click("cancel")()
    page.wait("!app.busy.value")
    assert "Stopped" in page.said()
    page.after(page.press("Control+z"))
    # the text follows the picture a little later
    page.page.locator("[data-name=title]", has_text=title).wait_for()


def test_a_light_is_dragged_on_its_sphere(visit: Visit) -> None:
    page = visit(scene("cube", lights=[{"kind": "directional", "direction": [0, 1, 1], "shadow": True}]))
    page.open_groups()
    sphere = page.page.locator("[data-name=sphere-0]")
    sphere.scroll_into_view_if_needed()
    box = sphere.bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    def roll() -> None:
        page.page.mouse.move(x, y)
        page.page.mouse.down()
        page.page.mouse.move(x + 0.4 * box["width"], y, steps=4)
        page.page.mouse.up()

    before, direction = page.pixels(), page.doc()["lights"][0]["direction"]
    assert page.after(roll) != before
    light = page.doc()["lights"][0]
    assert light["direction"][0] > direction[0]
    assert light["shadow"]


def test_invert_is_exact(visit: Visit) -> None:
    page = visit(scene("cube"))
    plain = np.frombuffer(page.pixels(), np.uint8)
    assert np.array_equal(np.frombuffer(page.after(page.press("i")), np.uint8), 255 - plain)


def test_two_fingers_zoom_and_move(visit: Visit) -> None:
    page = visit(scene("cube"), **PHONE)
    box = page.view.bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    wire = page.page.context.new_cdp_session(page.page)

    def touch(*steps: tuple[float, float]) -> Callable[[], None]:
        """Two fingers about the middle; steps: how far they are apart, and to the right."""

        def act() -> None:
            for number, (apart, right) in enumerate(steps):
                points = [{"x": x + right + side * apart / 2, "y": y, "id": side} for side in (-1, 1)]
                kind = "touchMove" if number else "touchStart"
                wire.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
            wire.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})

        return act

    def distance() -> float:
        camera = page.doc()["camera"]
        return float(np.linalg.norm(np.subtract(camera["eye"], camera["target"])))

    before = distance()
    page.after(touch((60, 0), (90, 0), (120, 0)))
    near = distance()
    assert near < 0.7 * before
    target = page.doc()["camera"]["target"]
    page.after(touch((60, 0), (60, 30), (60, 60)))
    assert page.doc()["camera"]["target"] != target
    assert distance() == pytest.approx(near, rel=0.05)


def test_the_link_in_the_address_is_the_picture(visit: Visit) -> None:
    page = visit(TOWN)
    page.after(page.press("ArrowLeft", "i"))
    shown = page.pixels()
    assert visit(page.kept()).pixels() == shown
