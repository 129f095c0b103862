"""Measure how many frames a second `<shackled-view>` and the Creator draw while they are turned, in headless chromium.

python -m benchmarks.view [--seconds 6] [--element] [--write]

The element: the teapot of the datasets, 128 x 128 pixels without antialiasing, as it is and smooth. Half the time
passes before frames are counted: the browser first compiles what runs often. --element: nothing else.

The Creator, from a static server: the milliseconds until its first picture, with the bytes and requests for it; frames
a second and their size while the first picture, and the teapot, are dragged. --write: puts it into view.json, under
"after"; "before" has the figures of the page that had a server of its own.
"""

from __future__ import annotations

import argparse
import base64
import gzip
import json
import statistics
import tempfile
import time
from importlib.resources import files
from itertools import pairwise
from pathlib import Path
from typing import Any

from tools.page_server import chromium, static

from shackled import load
from shackled.artifacts import artifact
from shackled.datasets._pieces import require
from shackled.evm._module import module_bytes
from shackled.scene import encode

from . import run_main

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


# ---- the Creator ----

RESULTS = Path(__file__).parent / "view.json"
#: Notes when something is drawn in the canvas, and its width.
COUNT = """
this.painted = [];
for (const name of ['putImageData', 'drawImage']) {
    const draw = CanvasRenderingContext2D.prototype[name];
    CanvasRenderingContext2D.prototype[name] = function (...all) {
        if (this.canvas.id === 'picture') window.painted.push([performance.now(), this.canvas.width]);
        return draw.apply(this, all);
    };
}
"""
#: Whether all looks are drawn, which takes time from what is dragged.
QUIET = """() => {
    const looks = [...document.querySelectorAll('[data-name^=look-] img')];
    return looks.length >= 10 && looks.every(each => each.src.startsWith('data:image/png'));
}"""
#: Seconds of rest before a drag, in which a page may prepare.
REST = 1.5
#: Shows the teapot as the page that had a server did.
TEAPOT = """async () => {
    const app = globalThis.shackledApp;
    await app.openPiece('teapot');
    app.change({...app.doc.value, width: 128, height: 128, antialias: false}, 'size');
}"""


def measure_creator(browser: Any, address: str, seconds: float, teapot: str) -> dict[str, Any]:
    """Return the figures of a page. teapot: a script that shows the teapot, or ""."""
    context = browser.new_context(viewport={"width": 1280, "height": 800})
    context.add_init_script(COUNT)
    tab = context.new_page()
    tab.set_default_timeout(120_000)
    wire = context.new_cdp_session(tab)
    wire.send("Network.enable")
    loaded: list[tuple[str, int]] = []
    sent: dict[str, str] = {}
    wire.on("Network.requestWillBeSent", lambda event: sent.update({event["requestId"]: event["request"]["url"]}))
    wire.on("Network.loadingFinished", lambda event: loaded.append((event["requestId"], event["encodedDataLength"])))
    tab.goto(address)
    tab.wait_for_function("() => this.painted.length")
    sizes = [size for number, size in loaded if sent.get(number, "").startswith("http")]
    found = {
        "first picture, ms": round(tab.evaluate("this.painted[0][0]")),
        "first picture, bytes": round(sum(sizes)),
        "first picture, requests": len(sizes),
        "first object": drag(tab, seconds),
    }
    if teapot:
        tab.evaluate(teapot)
        found["teapot"] = drag(tab, seconds)
    context.close()
    return found


def drag(tab: Any, seconds: float) -> dict[str, Any]:
    """Turn what the page shows; return frames a second, their median width and the longest wait for one."""
    tab.wait_for_function(QUIET)
    tab.wait_for_timeout(1000 * REST)
    box = tab.locator("#view").bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    tab.mouse.move(x, y)
    tab.mouse.down()
    begin, half = time.monotonic(), 0.0
    while (now := time.monotonic() - begin) < seconds:
        half = half or (tab.evaluate("performance.now()") if now > seconds / 2 else 0)
        tab.mouse.move(x + 100 * now / seconds, y + 10 * (now % 1))
        tab.wait_for_timeout(8)
    frames = [frame for frame in tab.evaluate("this.painted") if frame[0] > half]
    tab.mouse.up()
    times = [at for at, _ in frames]
    waits = [after - before for before, after in pairwise(times)]
    return {
        "frames a second": round(1000 * len(waits) / sum(waits), 1),
        "width": statistics.median(width for _, width in frames),
        "longest wait, ms": round(max(waits)),
    }


def main() -> None:
    """Print a line for each figure."""
    parser = argparse.ArgumentParser(description="Frames a second of the element and of the Creator.")
    parser.add_argument("--seconds", type=float, default=6)
    parser.add_argument("--element", action="store_true", help="measure the element only")
    parser.add_argument("--write", action="store_true", help="write view.json")
    options = parser.parse_args()
    with chromium() as browser:
        for smooth in (False, True):
            found = measure(browser, smooth, options.seconds)
            name = "smooth" if smooth else "flat"
            print(f"teapot, {name}: {found['rate']:.1f} frames a second of {found['size']} pixels")
        if not options.element:
            with static() as server:
                after = measure_creator(browser, server.address, options.seconds, TEAPOT)
            print(json.dumps(after, indent=2))
            if options.write:
                known = json.loads(RESULTS.read_text("utf-8"))
                RESULTS.write_text(json.dumps(known | {"after": after}, indent=2) + "\n", "utf-8")


if __name__ == "__main__":
    run_main(main, has_options=True)
