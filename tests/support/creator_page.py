"""Pages in tabs of chromium, as tests use them: any that moves a scene, and the Creator's."""

from __future__ import annotations

import base64
import json
import time
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

from shackled import Image, load, render

#: Seconds that anything may take on a machine that is busy with other things.
PATIENCE = 60
PHONE = {"width": 390, "height": 844, "has_touch": True, "is_mobile": True}

OBJ = "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nv 0 0 -1\nf 1 2 3\nf 2 1 4\nf 3 2 4\nf 1 3 4\n"


def scene(*objects: dict[str, Any] | str, size: Any = 48, **keys: Any) -> dict[str, Any]:
    """A small scene. objects: of a scene file, or names of pieces of which the first object is taken."""
    given = [{"mesh": {"piece": each, "object": 0}} if isinstance(each, str) else each for each in objects]
    return {"size": size, **keys, "objects": given}


def link(content: Any, address: str = "") -> str:
    """The link of a scene file. address: of the page."""
    packer = zlib.compressobj(9, zlib.DEFLATED, -15)
    packed = packer.compress(json.dumps(content).encode()) + packer.flush()
    return f"{address}#1{base64.urlsafe_b64encode(packed).decode().rstrip('=')}"


class Tab:
    """A page. place: the element that is dragged and hears keys. told: an expression: what the page says is wrong."""

    #: Where files are dropped.
    TARGET = "document.body"

    def __init__(self, page: Any, place: Any, told: str) -> None:
        self.page, self.place, self.told = page, place, told

    def open(self, url: str) -> None:
        self.page.goto(url)

    def run(self, script: str, argument: Any = None) -> Any:
        """The value of an expression in which `app` is the Creator's, `view` the element, after what it awaits."""
        return self.page.evaluate(
            f"async argument => {{ const [app, view] = [globalThis.shackledApp, globalThis.view]; return {script} }}",
            argument,
        )

    def wait(self, condition: str, argument: Any = None) -> None:
        """Wait until an expression is true. Polled from here: the policy of the page forbids what playwright does."""
        end = time.monotonic() + PATIENCE
        while not self.run(condition, argument):
            assert time.monotonic() < end, f"{condition}: {self.run(self.told)}"
            self.page.wait_for_timeout(15)

    def press(self, *keys: str) -> Callable[[], None]:
        def act() -> None:
            self.place.focus()
            for key in keys:
                self.page.keyboard.press(key)

        return act

    def wheel(self) -> None:
        self.place.hover()
        self.page.mouse.wheel(0, -300)

    def drag(self, x: float, y: float, button: str = "left", start: Any = (0.5, 0.5), hold: bool = False) -> None:
        """Drag by so many pixels of the screen. start: parts of the width and height of the place."""
        box = self.place.bounding_box()
        left, top = box["x"] + box["width"] * start[0], box["y"] + box["height"] * start[1]
        self.page.mouse.move(left, top)
        self.page.mouse.down(button=button)
        self.page.mouse.move(left + x, top + y, steps=5)
        if not hold:
            self.page.mouse.up(button=button)

    def touch(self, *steps: tuple[float, ...]) -> Callable[[], None]:
        """Fingers at the height of the middle. steps: where they are, in pixels to the right of it."""
        box = self.place.bounding_box()
        x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        wire = self.page.context.new_cdp_session(self.page)

        def act() -> None:
            for number, fingers in enumerate([*steps, ()]):
                kind = "touchEnd" if not fingers else "touchMove" if number else "touchStart"
                points = [{"x": x + right, "y": y, "id": finger} for finger, right in enumerate(fingers)]
                wire.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

        return act

    def drop(self, **files: bytes) -> None:
        """Drop files on the page."""
        given = {name: base64.b64encode(content).decode() for name, content in files.items()}
        self.run(
            f"""(() => {{
                const dataTransfer = new DataTransfer();
                for (const [name, content] of Object.entries(argument)) {{
                    const bytes = Uint8Array.from(atob(content), letter => letter.charCodeAt(0));
                    dataTransfer.items.add(new File([bytes], name));
                }}
                const event = {{ dataTransfer, bubbles: true, cancelable: true }};
                for (const type of ['dragenter', 'dragover', 'drop'])
                    {self.TARGET}.dispatchEvent(new DragEvent(type, event));
            }})()""",
            given,
        )


class Creator(Tab):
    """The Creator's page."""

    def __init__(self, page: Any) -> None:
        super().__init__(page, page.locator("#view"), "app?.toasts.value")

    def settle(self) -> bytes:
        """Wait for the picture and the fields of the document; its pixels: red, green, blue, rows from the top."""
        self.wait("app?.shown.value && [app.shown.value.doc, app.calm.value].every(doc => doc === app.doc.value)")
        self.wait("!app.busy.value")
        # it is painted before the frame after the next
        self.run("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(0))))")
        return self.pixels()

    def pixels(self) -> bytes:
        """What the canvas shows, brought back to the size of the picture."""
        text = self.run(
            """(() => {
                const { width, height } = app.doc.value;
                const copy = new OffscreenCanvas(width, height).getContext('2d');
                copy.imageSmoothingEnabled = false;
                copy.drawImage(document.getElementById('picture'), 0, 0, width, height);
                const { data } = copy.getImageData(0, 0, width, height);
                let text = '';
                for (let i = 0; i < data.length; i += 4) text += String.fromCharCode(data[i], data[i + 1], data[i + 2]);
                return btoa(text);
            })()"""
        )
        return base64.b64decode(text)

    def after(self, act: Callable[[], object]) -> bytes:
        """The pixels when the picture has followed what was done, which has to change the document."""
        self.run("void (globalThis.earlier = app.doc.value)")
        act()
        self.wait("app.doc.value !== globalThis.earlier")
        return self.settle()

    def show(self, place: dict[str, Any]) -> bytes:
        """Show another scene, by its link; its pixels."""
        return self.after(lambda: self.run("void (location.hash = argument)", link(place)))

    def change(self, **values: Any) -> bytes:
        """Change keys of the document; its pixels."""
        return self.after(lambda: self.run("app.change({...app.doc.value, ...argument}, 'size')", values))

    def doc(self) -> Any:
        """The document."""
        return self.run("app.doc.value")

    def kept(self) -> str:
        """The link of the document, once it is in the address and the document in the browser."""
        self.wait("app.link.value && (app.missing.value.length || location.hash === app.link.value)")
        return str(self.run("app.link.value"))

    def click(self, name: str) -> Callable[[], None]:
        """Click what has that data-name."""
        return lambda: self.page.locator(f"[data-name='{name}']").first.click()

    def open_groups(self) -> None:
        """Open all panels, and what is in them."""
        closed = "document.querySelectorAll('.panel details:not([open])')"
        while self.run(f"{closed}.length"):
            self.run(f"void {closed}.forEach(each => {{ each.open = true }})")
            self.page.wait_for_timeout(30)

    def field(self, path: str) -> Any:
        """The field of a control, or its switch."""
        return self.page.locator(f"[data-name='{path}']")

    def typed(self, path: str, value: str) -> bytes:
        """Type a value into the field of a control; the pixels that follow."""

        def act() -> None:
            self.field(path).fill(value)
            self.field(path).press("Enter")

        return self.after(act)

    def said(self, kind: str = "note") -> str:
        """What the page says, when it says something."""
        self.wait("app?.toasts.value.some(each => each.kind === argument)", kind)
        return " ".join(each["text"] for each in self.run("app.toasts.value") if each["kind"] == kind)

    def dialog(self, name: str) -> Any:
        """Open a dialog."""
        self.run("void app.openDialog(argument)", name)
        found = self.page.locator("dialog[open]")
        found.wait_for()
        return found

    def close(self) -> None:
        """Close the dialog."""
        self.run("app.closeDialog()")
        self.page.locator("dialog[open]").wait_for(state="detached")

    def file(self, name: str) -> tuple[str, bytes]:
        """Name and content of the download of a button, once the page can make it."""
        with self.page.expect_download(timeout=1000 * PATIENCE) as download:
            self.page.locator(f"[data-name='{name}']:enabled").click()
        return download.value.suggested_filename, Path(download.value.path()).read_bytes()


def drawn(content: dict[str, Any], folder: Path) -> Image:
    """The picture of a scene file by the command line's own means."""
    path = folder / "expected.json"
    path.write_text(json.dumps(content))
    return render(load(path))


Visit = Callable[..., Creator]
