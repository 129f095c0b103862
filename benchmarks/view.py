"""Measure how many frames a second `<shackled-view>` draws while it is turned, in headless chromium.

python -m benchmarks.view [SECONDS]

The teapot of the datasets, 128 x 128 pixels without antialiasing, as it is and smooth. Half the time passes before
frames are counted: the browser first compiles what runs often.
"""

from __future__ import annotations

import base64
import gzip
import sys
import tempfile
from importlib.resources import files
from pathlib import Path
from typing import Any

from playwright.sync_api import sync_playwright
from tools.page_server import ARGUMENTS, browser_path

from shackled import load
from shackled.artifacts import artifact
from shackled.datasets import require
from shackled.evm import module_bytes
from shackled.scene import encode

#: Turns the scene for some milliseconds, a little in each frame of the screen; the second half is counted.
TURN = """milliseconds => new Promise(resolve => {
    const view = document.querySelector('shackled-view');
    const begin = performance.now();
    const times = [];
    let size = '';
    view.addEventListener('frame', ({detail}) => {
        size = `${detail.width} x ${detail.height}`;
        if (performance.now() > begin + milliseconds / 2) times.push(performance.now());
    });
    const step = now => {
        if (now > begin + milliseconds) {
            resolve({rate: (times.length - 1) / (times.at(-1) - times[0]) * 1000, size});
            return;
        }
        view.turn = {azimuth: (now - begin) / 20, elevation: 10};
        requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
})"""


def page(call: bytes, attributes: str = "") -> str:
    """Return an HTML page that holds a view of a call, and all that it needs. attributes: of the element."""

    def script(name: str, content: bytes) -> str:
        packed = base64.b64encode(gzip.compress(content, 9, mtime=0)).decode()
        return f'<script type="text/plain" id="{name}">{packed}</script>'

    folder = files("shackled") / "web"
    return f"""<!doctype html>
<meta charset="utf-8">
<shackled-view src="#scene" evm="#evm" contracts="#contracts" {attributes}></shackled-view>
{script("scene", call)}
{script("evm", module_bytes())}
{script("contracts", (folder / "contracts.json").read_bytes())}
<script type="module">{(folder / "view.js").read_text("utf-8")}</script>
"""


def measure(browser: Any, smooth: bool, seconds: float) -> dict[str, Any]:
    """Return the frames a second, and their size."""
    scene = load(require("teapot").make(), smooth=smooth)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "page.html"
        path.write_text(page(encode(artifact("Renderer").selectors["render"], scene)), "utf-8")
        tab = browser.new_page(viewport={"width": 480, "height": 600})
        tab.goto(path.as_uri())
        tab.wait_for_function(
            "() => document.querySelector('shackled-view').shadowRoot.querySelector('[aria-busy=false]')"
        )
        # the element measures its speed
        tab.wait_for_timeout(1000)
        found: dict[str, Any] = tab.evaluate(TURN, 1000 * seconds)
        tab.close()
    return found


def main() -> None:
    """Print a line for each kind of shading."""
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 6
    with sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=browser_path(), args=list(ARGUMENTS))
        for smooth in (False, True):
            found = measure(browser, smooth, seconds)
            name = "smooth" if smooth else "flat"
            print(f"teapot, {name}: {found['rate']:.1f} frames a second of {found['size']} pixels")
        browser.close()


if __name__ == "__main__":
    main()
