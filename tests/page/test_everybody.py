"""For everybody: keyboards, screen readers, small screens, themes, high contrast, calm."""

from __future__ import annotations

import io
from typing import Any

import pytest
from PIL import Image as PillowImage

from creator_page import PHONE, Visit, scene

#: Elements that are pressed, and are shown.
TARGETS = "button, a[href], summary, input:not([type=range]), select, label.button, [role=radio]"
SMALL = """[...document.querySelectorAll(argument[0])].filter(each => {
    if (!each.checkVisibility({ visibilityProperty: true, opacityProperty: true })) return false;
    // a label is a part of what it names
    const boxes = [each, ...(each.labels ?? []), each.closest('label')].filter(Boolean);
    const around = boxes.map(one => one.getBoundingClientRect());
    const own = each.getBoundingClientRect();
    return own.width > 1 && !around.some(box => box.width >= argument[1] - 0.5 && box.height >= argument[1] - 0.5);
}).map(each => each.outerHTML.slice(0, 160))"""
BEYOND = """[...document.querySelectorAll('#app *')].filter(each => !each.closest('.unseen, .pieces-of, .chips')
    && each.getBoundingClientRect().right > innerWidth + 1 && each.checkVisibility())
    .map(each => each.outerHTML.slice(0, 120))"""
DIALOGS = ("download", "limits", "keys", "things", "about")


def test_with_the_keyboard_only(visit: Visit) -> None:
    page = visit(scene("cube"))
    page.page.keyboard.press("Tab")
    page.page.keyboard.press("Enter")
    assert page.run("document.activeElement.id") == "view"
    shown = page.pixels()
    assert page.after(lambda: page.page.keyboard.press("ArrowRight")) != shown
    assert page.after(lambda: page.page.keyboard.press("Control+z")) == shown
    for name in DIALOGS:
        page.dialog(name)
        assert page.run("document.activeElement.closest('dialog')?.id") == name
        page.page.keyboard.press("Escape")
        page.wait("app.dialog.value === null")
        assert page.run("document.activeElement.id") == "view"


def test_what_screen_readers_hear_and_what_keeps_its_place(visit: Visit) -> None:
    page = visit(scene("cube"), height=720)
    page.open_groups()
    heard = "[...document.querySelectorAll('[role=status]')].map(each => each.textContent).join(' ')"
    page.wait(f"{heard}.includes(' gas')")
    before = page.run(heard)
    page.after(page.press("ArrowRight"))
    page.wait(f"{heard} !== argument", before)
    # axe sees to the names of all others
    assert page.place.get_attribute("aria-label")
    page.drop(**{"broken.glb": b"glTF"})
    page.wait("[...document.querySelectorAll('[role=alert]')].some(each => each.textContent.includes('broken.glb'))")
    # nothing but the panels scrolls
    page.after(page.click("add-light"))
    assert page.run("[document.documentElement.scrollHeight, innerHeight]") == [720, 720]
    # the picture keeps its size, whatever is said below
    place = page.place.bounding_box()
    for name, words in (
        ("fits", ""),
        ("fits", "Free to read on most nodes; fits a transaction on Monad, Arbitrum One and Polygon"),
        ("fits", "Too much for usual nodes: take fewer pixels or triangles"),
        ("triangles", "12,345 of 123,456 triangles"),
    ):
        page.run(f"void (document.querySelector('[data-name={name}]').lastChild.textContent = argument)", words)
        assert page.place.bounding_box() == place


@pytest.mark.parametrize(("scheme", "viewport"), [("light", {}), ("dark", PHONE)], ids=["light", "dark phone"])
def test_axe_finds_no_fault(visit: Visit, scheme: str, viewport: dict[str, Any]) -> None:
    axe = pytest.importorskip("axe_playwright_python.sync_playwright").Axe()
    # the policy of the page lets no script of others in, not even this one
    page = visit(scene("cube", "cone"), color_scheme=scheme, bypass_csp=True, reduced_motion="reduce", **viewport)
    page.open_groups()
    for name in ("", *DIALOGS):
        if name:
            page.dialog(name)
            page.settle()
        if name == "limits":
            page.page.locator("#limits tr.total").wait_for()
        found = axe.run(page.page).response["violations"]
        assert [(each["id"], each["nodes"][0]["html"][:200]) for each in found] == [], name
        if name:
            page.close()


@pytest.mark.parametrize("width", [320, 390, 820])
def test_small_screens(visit: Visit, width: int) -> None:
    page = visit(scene("cube"), width=width, height=640, has_touch=True, is_mobile=True, device_scale_factor=2)
    shown = page.pixels()
    for name in ("shelf", "looks", "scene"):
        button = page.page.locator(f"[data-name=page-{name}]")
        if button.is_visible():
            button.click()
        page.open_groups()
        assert page.run("[document.documentElement.scrollWidth, innerWidth]") == [width, width]
        assert page.run(BEYOND) == []
        assert page.run(SMALL, [TARGETS, 44]) == []
    for name in DIALOGS:
        page.dialog(name)
        page.settle()
        assert page.run(SMALL, [f"dialog :is({TARGETS})", 44]) == [], name
        box = page.page.locator("dialog[open]").bounding_box()
        assert box["x"] >= 0
        assert box["x"] + box["width"] <= width + 1
        page.close()
    page.page.evaluate("scrollTo(0, 0)")
    assert page.after(page.touch((0,), (30,), (60,))) != shown


def test_light_and_dark(visit: Visit) -> None:
    """As in the system, or as on the page."""
    paper = "getComputedStyle(document.body).backgroundColor"
    page = visit(scene("cube"), color_scheme="dark")
    dark = page.run(paper)
    page.page.emulate_media(color_scheme="light")
    page.wait(f"{paper} !== argument", dark)
    page.click("theme")()
    page.wait(f"{paper} === argument", dark)
    page.page.reload()
    page.settle()
    assert page.run(paper) == dark


def test_high_contrast(visit: Visit) -> None:
    """The state of a switch is seen, and the track of a slider."""
    page = visit(scene("cube"), forced_colors="active")
    page.open_groups()

    def look(name: str) -> Any:
        with PillowImage.open(io.BytesIO(page.page.locator(f"[data-name='{name}']").screenshot())) as picture:
            return picture.convert("RGB")

    off = look("ground.on").tobytes()
    page.after(page.field("ground.on").click)
    assert look("ground.on").tobytes() != off
    slider = look("slider-camera.fov")
    end = slider.crop((slider.width - 12, 0, slider.width - 4, slider.height))
    assert len(end.getcolors() or ()) > 1


def test_calm_where_motion_is_reduced(visit: Visit) -> None:
    """The first piece does not turn into view, and nothing else moves by itself."""
    count = """
    this.eyes = new Set();
    const put = CanvasRenderingContext2D.prototype.putImageData;
    CanvasRenderingContext2D.prototype.putImageData = function (...all) {
        if (this.canvas.id === 'picture') eyes.add(String(shackledApp.doc.value.camera.eye));
        return put.apply(this, all);
    };
    """
    page = visit("", reduced_motion="reduce", script=count)
    assert page.run("eyes.size") == 1
    assert not page.run("document.getAnimations().filter(each => each.playState === 'running').length")
