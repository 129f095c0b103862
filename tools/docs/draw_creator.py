"""Make the pictures of docs/creating.md: screenshots of the Creator in a real browser, and a GIF of its use.

    python -m tools.docs.draw_creator

Needs chromium, and the built page: make page.
"""

from __future__ import annotations

import io
from collections.abc import Callable
from typing import Any, Literal

from PIL import Image

from tools.page_server import chromium, static
from tools.pages import IMAGES

#: Frames per second of the GIF, and screen pixels per pixel of it.
PACE, SHRINK = 10, 1.5
#: When nothing is drawn any more, the pictures of looks among it.
RESTS = """() => {
    const app = globalThis.shackledApp;
    const looks = [...document.querySelectorAll('[data-name^=look-]')];
    return app?.shown.value && app.shown.value.doc === app.doc.value && !app.busy.value
        && (!looks.length || looks.every(each => each.querySelector('img')));
}"""


def main() -> None:
    """Make all pictures."""
    with static() as server, chromium() as browser:

        def visit(width: int, height: int, scheme: Literal["light", "dark"], **options: Any) -> Any:
            context = browser.new_context(viewport={"width": width, "height": height}, color_scheme=scheme, **options)
            page = context.new_page()
            page.set_default_timeout(180_000)
            page.goto(server.address)
            rest(page)
            return page

        page = visit(1360, 850, "light")
        save(page, "creator")
        show(page, "[data-name='piece-icons/crown']")
        page.click("[data-name=status]")
        page.wait_for_selector("#limits tr.total")
        save(page, "creator-stages")
        page.keyboard.press("Escape")
        show(page, "[data-name=look-gold]")
        page.click("[data-name=download]")
        page.wait_for_selector("#download [data-name=take-link]:enabled")
        save(page, "creator-download")

        page = visit(1360, 850, "dark")
        page.click("[data-name=shelf-common]")
        show(page, "[data-name='piece-torus-knot']", "[data-name=look-neon]")
        save(page, "creator-dark")

        save(visit(390, 780, "dark", has_touch=True, is_mobile=True, device_scale_factor=1.5), "creator-phone")
        film(visit(1100, 700, "light"))


def rest(page: Any) -> None:
    """Wait until nothing is drawn any more."""
    while not page.evaluate(RESTS):
        page.wait_for_timeout(100)
    page.wait_for_timeout(300)


def show(page: Any, *buttons: str) -> None:
    """Click buttons, and wait for the picture after each."""
    for button in buttons:
        page.click(button)
        page.wait_for_timeout(800)
        rest(page)


def save(page: Any, name: str) -> None:
    """Save a screenshot as a PNG file."""
    path = IMAGES / f"{name}.png"
    with Image.open(io.BytesIO(page.screenshot())) as picture:
        picture.convert("RGB").save(path, optimize=True)
    print(f"{path.name}: {path.stat().st_size:,} bytes")


def film(page: Any) -> None:
    """Save a GIF of the page in use."""
    frames: list[Image.Image] = []

    def take(count: int = 1) -> None:
        for _ in range(count):
            with Image.open(io.BytesIO(page.screenshot())) as picture:
                size = round(picture.width / SHRINK), round(picture.height / SHRINK)
                frames.append(picture.convert("RGB").resize(size, Image.Resampling.LANCZOS))
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
        page.wait_for_timeout(600)
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
    print(f"{path.name}: {len(frames)} frames, {path.stat().st_size:,} bytes")


if __name__ == "__main__":
    main()
