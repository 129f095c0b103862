"""The custom element in Firefox, on a page opened from disk."""

from __future__ import annotations

import hashlib
import http.server
import json
import shutil
import subprocess
import threading
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import pytest
from benchmarks.view import page as html

from shackled import load, render
from shackled.artifacts import artifact
from shackled.scene import encode

FIREFOX = next((path for path in map(shutil.which, ("firefox", "firefox-esr")) if path), None)
PATIENCE = 120

pytestmark = pytest.mark.skipif(FIREFOX is None, reason="Firefox is not installed: apt-get install firefox-esr")

#: Tells a server, by the names of images, what happens: the picture, its frames while it is turned, the picture then.
SCRIPT = """<script type="module">
const view = document.querySelector('shackled-view');
const tell = content => { new Image().src = `ADDRESS/${encodeURIComponent(JSON.stringify(content))}`; };
let [frames, pictures] = [0, 0];
view.addEventListener('error', ({message}) => tell({message, end: true}));
view.addEventListener('frame', () => frames++);
view.addEventListener('picture', ({detail}) => {
    tell({...detail, frames, end: ++pictures === 2});
    if (pictures === 1) for (let k = 1; k < 40; k++) setTimeout(() => { view.turn = {azimuth: k}; }, 1000 + 50 * k);
});
</script>"""


def test_the_picture_is_that_of_python(tmp_path: Path) -> None:
    scene = load("icons/crown", size=64)
    told: list[dict[str, Any]] = []
    ended = threading.Event()

    class Handler(http.server.BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            if self.path == "/wait":
                # Firefox ends when it has a picture of the page, for which it waits until all images are there
                ended.wait(PATIENCE)
            else:
                told.append(json.loads(unquote(self.path[1:])))
                if told[-1].get("end"):
                    ended.set()
            self.send_response(204)
            self.end_headers()

        def log_message(self, *_: Any) -> None:
            pass

    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    server.daemon_threads = True
    threading.Thread(target=server.serve_forever, daemon=True).start()
    address = f"http://127.0.0.1:{server.server_port}"
    page = tmp_path / "page.html"
    call = encode(artifact("Renderer").selectors["render"], scene)
    page.write_text(f'{html(call)}<img src="{address}/wait">{SCRIPT.replace("ADDRESS", address)}', "utf-8")
    assert FIREFOX
    command = [FIREFOX, "--headless", f"--profile={tmp_path}/profile", f"--screenshot={tmp_path}/page.png"]
    (tmp_path / "profile").mkdir()
    try:
        subprocess.run([*command, page.as_uri()], timeout=2 * PATIENCE, check=True, capture_output=True)
    finally:
        server.shutdown()
        server.server_close()
    first, last = told
    image = render(scene)
    assert first["sha256"] == hashlib.sha256(image.pixels.tobytes()).hexdigest()
    assert (first["gas"], first["width"], first["height"]) == (image.gas, 64, 64)
    assert last["sha256"] != first["sha256"]
    assert last["frames"] > 5
