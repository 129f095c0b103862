"""Debian's Firefox without a screen, driven by WebDriver BiDi: https://w3c.github.io/webdriver-bidi."""

from __future__ import annotations

import json
import shutil
import subprocess
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from tools.children import child
from websockets.sync.client import ClientConnection, connect

#: Seconds in which it must start, and answer.
PATIENCE = 60
#: It must not ask for anything but the page.
PREFERENCES = """\
user_pref("app.update.enabled", false);
user_pref("browser.shell.checkDefaultBrowser", false);
user_pref("browser.safebrowsing.malware.enabled", false);
user_pref("datareporting.policy.dataSubmissionEnabled", false);
user_pref("network.captive-portal-service.enabled", false);
user_pref("network.connectivity-service.enabled", false);
user_pref("services.settings.server", "data:,");
"""


class Tab:
    """A tab, with the methods of creator_page.Tab. place: the selector of the element that is dragged."""

    def __init__(self, connection: ClientConnection, place: str) -> None:
        self._connection, self._place = connection, place
        self._last = 0
        self.ask("session.new", capabilities={})
        self._context = self.ask("browsingContext.getTree")["contexts"][0]["context"]

    def ask(self, method: str, **parameters: Any) -> Any:
        """Return the result of a command."""
        self._last += 1
        self._connection.send(json.dumps({"id": self._last, "method": method, "params": parameters}))
        while True:
            answer = json.loads(self._connection.recv(timeout=PATIENCE))
            if answer.get("id") == self._last:
                assert answer["type"] == "success", answer
                return answer["result"]

    def open(self, url: str) -> None:
        self.ask("browsingContext.navigate", context=self._context, url=url, wait="complete")

    def run(self, script: str) -> Any:
        """Return the value of an expression."""
        found = self.ask(
            "script.evaluate",
            expression=f"(async () => JSON.stringify({script}))()",
            target={"context": self._context},
            awaitPromise=True,
        )
        assert found["type"] == "success", found
        return json.loads(found["result"].get("value", "null"))

    def wait(self, condition: str) -> None:
        end = time.monotonic() + PATIENCE
        while not self.run(condition):
            assert time.monotonic() < end, condition
            time.sleep(0.05)

    def drag(self, x: float, y: float) -> None:
        """Drag the place by so many pixels."""
        box = self.run(f"document.querySelector({self._place!r}).getBoundingClientRect().toJSON()")
        left, top = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        moves = [
            {"type": "pointerMove", "x": round(left + x * part / 6), "y": round(top + y * part / 6), "duration": 30}
            for part in range(7)
        ]
        actions = [moves[0], {"type": "pointerDown", "button": 0}, *moves[1:], {"type": "pointerUp", "button": 0}]
        source = {"type": "pointer", "id": "mouse", "actions": actions}
        self.ask("input.performActions", context=self._context, actions=[source])


@contextmanager
def firefox(place: str) -> Iterator[Tab]:
    """Firefox with a new profile, into which it writes the port at which it listens; place: as of a tab."""
    path = shutil.which("firefox-esr") or shutil.which("firefox")
    if path is None:
        pytest.skip("needs Firefox: apt-get install firefox-esr")
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        (Path(folder) / "user.js").write_text(PREFERENCES)
        command = (path, "--headless", "--no-remote", "--profile", folder, "--remote-debugging-port", "0")
        said, end = Path(folder) / "WebDriverBiDiServer.json", time.monotonic() + PATIENCE
        with child(*command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
            try:
                while not (said.exists() and said.read_text().endswith("}")):
                    assert time.monotonic() < end, "Firefox did not start"
                    time.sleep(0.05)
                port = json.loads(said.read_text())["ws_port"]
                with connect(f"ws://127.0.0.1:{port}/session", max_size=None) as connection:
                    yield Tab(connection, place)
            finally:
                # it ends its own processes then
                process.terminate()
                process.wait(20)
