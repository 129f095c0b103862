"""The picture: its bytes, what moves it, and what is shown while it is drawn."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from examples.showcase import glass

from creator_page import PHONE, Creator, Visit, drawn, scene
from shackled import load, render
from shackled.scene._codec import render_call

TOWN = scene("cube", {"mesh": {"piece": "cone", "object": 0}, "position": [3, 0, 0], "color": "#d04020"}, size=64)
#: Seconds of drawing: to see what is shown meanwhile, and to stop it.
LONG = """app.change({...app.doc.value, width: 2048, height: 2048, antialias: true, title: 'Another',
    rim: { color: '#ffffff', power: 3 }, tone: { exposure: 1, filmic: true, gamma: true }}, 'size')"""
#: Whether a small picture of the document is seen.
DRAFT = "app.drawing.seen.value.draft && app.drawing.seen.value.doc === app.doc.value"
COLORS = "new Set(new Uint32Array(app.{}.value.drawn.pixels.buffer)).size"


def test_the_picture_is_the_contracts_own(visit: Visit, tmp_path: Path) -> None:
    page = visit(TOWN)
    shown = page.pixels()
    assert shown == drawn(TOWN, tmp_path).pixels.tobytes()
    # the link in the address is the picture
    shown = page.after(page.press("ArrowLeft", "i"))
    assert visit(page.kept()).pixels() == shown
    page.change(width=72, height=72)
    for name in ("icons/coin", "cornell-box", "showcase/glass"):
        # a piece keeps its shape: the longer side is that of the picture before
        size = (72, 54) if name == "showcase/glass" else 72
        expected = load(glass() if name == "showcase/glass" else name, size=size, antialias=False)
        image = render(expected)
        shown = page.after(lambda name=name: page.run("app.openPiece(argument)", name))  # type: ignore[misc]
        assert shown == image.pixels.tobytes()
        page.wait("document.querySelector('[data-name=triangles]').textContent === argument", f"{image.triangles:,}")
        figures = [page.page.inner_text(f"[data-name={each}]") for each in ("gas", "triangles", "bytes")]
        assert figures == [f"{number:,}" for number in (image.gas, image.triangles, len(render_call(expected)))]
        assert page.page.inner_text("[data-name=title]")
    # invert is exact
    inverted = np.frombuffer(page.after(page.press("i")), np.uint8)
    assert np.array_equal(inverted, 255 - np.frombuffer(shown, np.uint8))


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
    first = page.pixels()
    acts: list[tuple[Callable[[], object], set[str]]] = [
        (lambda: page.drag(120, 30), {"eye"}),
        (lambda: page.drag(60, 0, button="right"), {"eye", "target"}),
        (page.wheel, {"eye"}),
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
    assert page.after(page.press("0")) == first
    assert fitted != far != page.doc()["camera"]
    # what is out of view is told
    page.show(scene("cube", camera={"eye": [0, 0, 9], "target": [0, 0, 20]}))
    told = "document.getElementById('app').textContent.includes('press F')"
    page.wait(told)
    page.after(page.press("f"))
    page.wait(f"!{told}")


def test_two_fingers_zoom_and_move(visit: Visit) -> None:
    page = visit(scene("cube"), **PHONE)

    def distance() -> float:
        camera = page.doc()["camera"]
        return float(np.linalg.norm(np.subtract(camera["eye"], camera["target"])))

    before = distance()
    page.after(page.touch((-30, 30), (-45, 45), (-60, 60)))
    near = distance()
    assert near < 0.7 * before
    target = page.doc()["camera"]["target"]
    page.after(page.touch((-30, 30), (0, 60), (30, 90)))
    assert page.doc()["camera"]["target"] != target
    assert distance() == pytest.approx(near, rel=0.05)


def test_a_drag_draws_small_pictures_and_is_one_step(visit: Visit) -> None:
    # so large, and antialiased, that no machine draws it while it moves
    page = visit(scene("teapot", size=1024, antialias=True))
    shown = page.pixels()
    page.run("void (this.sizes = [], app.drawing.seen.subscribe(each => this.sizes.push(each?.drawn.width)))")
    page.drag(90, 0, hold=True)
    page.wait(DRAFT)
    assert page.run("app.shown.value.doc !== app.doc.value")
    assert "gas at" in page.page.inner_text("[data-name=status]")
    page.page.mouse.up()
    assert page.settle() != shown
    assert min(page.run("this.sizes")) < 1024
    assert page.after(page.press("Control+z")) == shown
    assert not page.run("app.canUndo.value")
    # small ones are without antialiasing
    page.show(scene("cube", size=96, antialias=True))
    page.drag(40, 0, hold=True)
    page.wait(DRAFT)
    colors = page.run(COLORS.format("drawing.seen"))
    page.page.mouse.up()
    page.settle()
    assert colors < page.run(COLORS.format("shown"))


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


@pytest.mark.parametrize("viewport", [{"width": 1280, "height": 720}, PHONE], ids=["desk", "phone"])
def test_the_place_of_the_picture(visit: Visit, viewport: dict[str, Any]) -> None:
    page = visit(scene("cube"), **viewport)
    # narrow pictures can be held, and stay in their place
    for width, height in ((1, 128), (4, 4), (320, 4)):
        page.change(width=width, height=height)
        box = page.place.bounding_box()
        assert min(box["width"], box["height"]) >= 24
        assert box["x"] >= 0
        assert box["x"] + box["width"] <= viewport["width"]
        before = page.doc()["camera"]["eye"]
        page.after(lambda: page.drag(12, 0))
        assert page.doc()["camera"]["eye"] != before
    # pixels are enlarged by whole numbers
    page.change(width=100, height=70)
    for width in (viewport["width"], 1000, 777):
        page.page.set_viewport_size({"width": width, "height": 700})
        box = page.page.locator("#picture").bounding_box()
        factor = box["width"] * page.run("devicePixelRatio") / 100
        assert factor == pytest.approx(round(factor), abs=0.01)
        assert box["height"] * page.run("devicePixelRatio") / 70 == pytest.approx(factor, abs=0.01)


def test_a_light_is_dragged_on_its_sphere(visit: Visit) -> None:
    page = visit(scene("cube", lights=[{"kind": "directional", "direction": [0, 1, 1], "shadow": True}]))
    page.open_groups()
    before, direction = page.pixels(), page.doc()["lights"][0]["direction"]
    sphere = page.page.locator("[data-name=sphere-0]")
    sphere.scroll_into_view_if_needed()
    box = sphere.bounding_box()
    page.place = sphere
    assert page.after(lambda: page.drag(0.4 * box["width"], 0)) != before
    light = page.doc()["lights"][0]
    assert light["direction"][0] > direction[0]
    assert light["shadow"]
