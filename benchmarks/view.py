"""Measure how many frames a second `<shackled-view>` and the Creator draw while they are turned, in headless chromium.

python -m benchmarks.view [--seconds 6] [--element] [--write]

The element: the teapot of the datasets, 128 x 128 pixels without antialiasing, as it is and smooth. Half the time
passes before frames are counted: the browser first compiles what runs often. Then the default look at 256 x 256 pixels,
with compiled contracts and in the interpreter, in turns: the time of drawing. --element: nothing else.

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
from shackled.datasets._pieces import require
from shackled.evm._module import module_bytes
from shackled.scene._codec import render_call

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


#: Turns the scene so often, each time until its picture is drawn at rest; returns the milliseconds of the second half.
DRAW = """count => new Promise(resolve => {
    const view = document.querySelector('shackled-view');
    const drawn = [];
    view.addEventListener('picture', ({detail}) => {
        drawn.push(detail.milliseconds);
        if (drawn.length === count) resolve(drawn.slice(count / 2));
        else view.turn = {azimuth: 9 * drawn.length, elevation: 10};
    });
    view.turn = {azimuth: 1, elevation: 10};
})"""


def page(call: bytes, attributes: str = "", compiles: bool = True) -> str:
    """Return an HTML page that holds a view of a call, and all that it needs.

    attributes: of the element. compiles: otherwise WebAssembly is said to have no tail calls.
    """

    def script(name: str, content: bytes) -> str:
        packed = base64.b64encode(gzip.compress(content, 9, mtime=0)).decode()
        return f'<script type="text/plain" id="{name}">{packed}</script>'

    folder = files("shackled") / "web"
    view = (folder / "view.js").read_text("utf-8")
    assert "WebAssembly.validate(" in view
    if not compiles:
        view = view.replace("WebAssembly.validate(", "(()=>false)(")
    return f"""<!doctype html>
<meta charset="utf-8">
<shackled-view src="#scene" evm="#evm" contracts="#contracts" {attributes}></shackled-view>
{script("scene", call)}
{script("evm", module_bytes())}
{script("contracts", (folder / "contracts.json").read_bytes())}
<script type="module">{view}</script>
"""


def run(browser: Any, html: str, script: str, argument: float) -> Any:
    """Return what a script returns in a page, once its picture is there."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "page.html"
        path.write_text(html, "utf-8")
        tab = browser.new_page(viewport={"width": 480, "height": 600})
        tab.goto(path.as_uri())
        tab.wait_for_function(
            "() => document.querySelector('shackled-view').shadowRoot.querySelector('[aria-busy=false]')"
        )
        # the element measures its speed
        tab.wait_for_timeout(1000)
        found = tab.evaluate(script, argument)
        tab.close()
    return found


#: Rounds and turns of the time of drawing.
ROUNDS, TURNS = 5, 24


def drawing(browser: Any, seconds: float) -> str:
    """Return what compiled contracts save, in one line."""
    call = render_call(load("teapot", 256))
    times: dict[bool, list[float]] = {True: [], False: []}
    for _ in range(ROUNDS):
        for compiles, each in times.items():
            each += run(browser, page(call, "exact", compiles), DRAW, TURNS)
    compiled, interpreted = statistics.median(times[True]), statistics.median(times[False])
    rate = run(browser, page(call), TURN, 1000 * seconds)
    return (
        f"teapot, default look, 256 x 256 pixels: {compiled:.1f} ms compiled, {interpreted:.1f} ms interpreted, ratio "
        f"{compiled / interpreted:.2f}; while it turns {rate['rate']:.1f} frames a second of {rate['size']} pixels"
    )


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
            call = render_call(load(require("teapot").make(), smooth=smooth))
            found = run(browser, page(call), TURN, 1000 * options.seconds)
            name = "smooth" if smooth else "flat"
            print(f"teapot, {name}: {found['rate']:.1f} frames a second of {found['size']} pixels")
        print(drawing(browser, options.seconds))
        if not options.element:
            with static() as server:
                after = measure_creator(browser, server.address, options.seconds, TEAPOT)
            print(json.dumps(after, indent=2))
            if options.write:
                known = json.loads(RESULTS.read_text("utf-8"))
                RESULTS.write_text(json.dumps(known | {"after": after}, indent=2) + "\n", "utf-8")


if __name__ == "__main__":
    run_main(main, has_options=True)
