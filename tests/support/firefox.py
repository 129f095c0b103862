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

from websockets.sync.client import ClientConnection, connect

COMMANDS = ("firefox-esr", "firefox")
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


def firefox_path() -> str | None:
    """Return the path of Firefox, or None."""
    return next((path for path in map(shutil.which, COMMANDS) if path), None)


class Tab:
    """A tab."""

    def __init__(self, connection: ClientConnection) -> None:
        self._connection = connection
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

    def drag(self, start: tuple[float, float], end: tuple[float, float], steps: int = 6) -> None:
        """Drag with the mouse, from one place of the window to another, in pixels."""
        places = [
            [round(a + (b - a) * step / steps) for a, b in zip(start, end, strict=True)] for step in range(steps + 1)
        ]
        moves = [{"type": "pointerMove", "x": x, "y": y, "duration": 30} for x, y in places]
        actions = [moves[0], {"type": "pointerDown", "button": 0}, *moves[1:], {"type": "pointerUp", "button": 0}]
        source = {"type": "pointer", "id": "mouse", "actions": actions}
        self.ask("input.performActions", context=self._context, actions=[source])


@contextmanager
def firefox() -> Iterator[Tab]:
    """Run Firefox with a new profile."""
    path = firefox_path()
    assert path
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        (Path(folder) / "user.js").write_text(PREFERENCES)
        process = subprocess.Popen(
            [path, "--headless", "--no-remote", "--profile", folder, "--remote-debugging-port", "0"],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        try:
            with connect(f"ws://127.0.0.1:{_port(Path(folder), process)}/session", max_size=None) as connection:
                yield Tab(connection)
        finally:
            process.terminate()
            process.wait(20)


def _port(folder: Path, process: subprocess.Popen[bytes]) -> int:
    """Return the port at which Firefox listens, which it writes into its profile."""
    path = folder / "WebDriverBiDiServer.json"
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end and process.poll() is None:
        try:
            return int(json.loads(path.read_text())["ws_port"])
        except (OSError, ValueError, KeyError):
            time.sleep(0.05)
    raise AssertionError("Firefox did not start")
