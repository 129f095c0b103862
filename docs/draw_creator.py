"""Make the pictures of creator.md: screenshots of the Creator in a real browser, and a GIF of its use.

    python -m docs.draw_creator

Needs chromium. The page is started by its command and used by its buttons.
"""

from __future__ import annotations

import io
from collections.abc import Callable
from pathlib import Path
from typing import Any, Literal

from PIL import Image
from playwright.sync_api import sync_playwright
from tools.page_server import ARGUMENTS, browser_path, creator

FOLDER = Path(__file__).parent
IMAGES = FOLDER / "images"

#: Frames per second of the GIF, and screen pixels per pixel of it.
PACE, SHRINK = 10, 1.5


def main() -> None:
    """Make all pictures."""
    with creator() as server, sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=browser_path(), args=list(ARGUMENTS))

        def visit(width: int, height: int, scheme: Literal["light", "dark"], **options: Any) -> Any:
            context = browser.new_context(viewport={"width": width, "height": height}, color_scheme=scheme, **options)
            page = context.new_page()
            page.set_default_timeout(180_000)
            page.goto(server.address)
            page.wait_for_selector("#picture[data-draft=false]")
            page.wait_for_function("() => [...document.querySelectorAll('.look img')].every(e => e.src.length > 500)")
            page.wait_for_timeout(1500)
            return page

        page = visit(1360, 850, "light")
        save(page, "creator")
        show(page, "[data-name='piece-icons/crown']")
        page.click("[data-name=figures]")
        page.wait_for_function("() => document.querySelectorAll('#stages td.bar').length > 5")
        save(page, "creator-stages")
        page.keyboard.press("Escape")
        show(page, "[data-name=look-gold]")
        page.click("text=Download")
        page.wait_for_function("() => document.querySelector('[data-text=snippet-solidity]').textContent.length > 20")
        save(page, "creator-download")

        page = visit(1360, 850, "dark")
        page.click("[data-tab=common]")
        show(page, "[data-name='piece-torus-knot']", "[data-name=look-neon]")
        page.wait_for_timeout(1500)
        save(page, "creator-dark")

        page = visit(390, 780, "dark", has_touch=True, is_mobile=True, device_scale_factor=1.5)
        save(page, "creator-phone")

        film(visit(1100, 700, "light"))
        browser.close()


def show(page: Any, *buttons: str) -> None:
    """Click buttons, and wait for the picture after each."""
    for button in buttons:
        before = page.get_attribute("#picture", "data-number")
        page.click(button)
        page.wait_for_function("before => document.getElementById('picture').dataset.number > before", arg=before)
        page.wait_for_timeout(700)


def save(page: Any, name: str) -> None:
    """Save a screenshot as a PNG file."""
    path = IMAGES / f"{name}.png"
    with Image.open(io.BytesIO(page.screenshot())) as picture:
        picture.convert("RGB").save(path, optimize=True)
    print(f"{path.relative_to(FOLDER.parent)}: {path.stat().st_size:,} bytes")


def film(page: Any) -> None:
    """Save a GIF of the page in use."""
    frames: list[Image.Image] = []

    def take(count: int = 1) -> None:
        for _ in range(count):
            with Image.open(io.BytesIO(page.screenshot())) as picture:
                small = picture.convert("RGB").resize(
                    (round(picture.width / SHRINK), round(picture.height / SHRINK)), Image.Resampling.LANCZOS
                )
            frames.append(small)
            page.wait_for_timeout(1000 / PACE / 2)

    def drag(x: float, y: float, steps: int) -> None:
        box = page.locator("#view").bounding_box()
        from_x, from_y = box["x"] + box["width"] / 2 - x / 2, box["y"] + box["height"] / 2 - y / 2
        page.mouse.move(from_x, from_y)
        page.mouse.down()
        for step in range(1, steps + 1):
            page.mouse.move(from_x + x * step / steps, from_y + y * step / steps)
            page.wait_for_timeout(60)
            take()
        page.mouse.up()
        page.wait_for_timeout(400)
        take(2)

    def push(button: str, act: Callable[[], None] = lambda: None) -> None:
        page.hover(button)
        take(2)
        page.click(button)
        page.wait_for_timeout(700)
        take(4)
        act()

    take(4)
    drag(200, 30, 12)
    push("[data-name='piece-icons/crown']", lambda: drag(-190, 40, 10))
    push("[data-name=look-gold]")
    push("[data-name=look-neon]", lambda: drag(180, -20, 10))
    push("[data-name=look-facets]")
    take(4)
    # one palette for all frames, so that unchanged parts are not stored again
    sheet = Image.new("RGB", (frames[0].width, frames[0].height * 8))
    for place, frame in enumerate(frames[:: max(1, len(frames) // 8)][:8]):
        sheet.paste(frame, (0, place * frame.height))
    palette = sheet.quantize(256, method=Image.Quantize.FASTOCTREE)  # keeps rare colours that stand out
    reduced = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]
    path = IMAGES / "creator.gif"
    reduced[0].save(path, save_all=True, append_images=reduced[1:], duration=1000 // PACE, loop=0, optimize=True)
    print(f"{path.relative_to(FOLDER.parent)}: {len(frames)} frames, {path.stat().st_size:,} bytes")


if __name__ == "__main__":
    main()
