"""Start the Creator by its command, and a browser that opens it."""

from __future__ import annotations

import base64
import os
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

BROWSERS = ("chromium", "chromium-browser")
#: It must not look for updates, or ask for anything but the page.
ARGUMENTS = (
    "--no-sandbox",
    "--disable-gpu",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
)


@dataclass(frozen=True)
class Started:
    """A server. address: of the page. at: when its process was started, by `time.monotonic`."""

    address: str
    at: float
    process: subprocess.Popen[str]

    def processor_seconds(self) -> float:
        """Return the processor seconds of the server and its child processes; infinity where /proc has no figures."""
        found: dict[int, tuple[int, int]] = {}
        for path in Path("/proc").glob("[0-9]*/stat"):
            with suppress(OSError):
                # parent, and clock ticks of user and system, here and in children that have ended
                fields = path.read_text().rpartition(")")[2].split()
                found[int(path.parent.name)] = int(fields[1]), sum(map(int, fields[11:15]))

        def ticks(pid: int) -> int:
            return found[pid][1] + sum(ticks(child) for child, (parent, _) in found.items() if parent == pid)

        return ticks(self.process.pid) / os.sysconf("SC_CLK_TCK") if self.process.pid in found else float("inf")


def browser_path() -> str | None:
    """Return the path of a browser, or None."""
    return next((path for path in map(shutil.which, BROWSERS) if path), None)


@contextmanager
def creator(*arguments: str, port: str = "0", **variables: str) -> Iterator[Started]:
    """Run the server of `shackled creator`. port: "0" takes any free port. variables: of its environment."""
    # deployments on this machine must not change what the page offers
    book = str(Path(__file__).parent / "no-address-book.json")
    environment = {**os.environ, "SHACKLED_ADDRESS_BOOK": book, **variables}
    at = time.monotonic()
    process = subprocess.Popen(
        [sys.executable, "-m", "shackled", "creator", "--no-browser", "--port", port, *arguments],
        stdout=subprocess.PIPE,
        text=True,
        env=environment,
    )
    try:
        assert process.stdout is not None
        line = process.stdout.readline()
        found = re.search(r"http://\S+", line)
        assert found, f"the Creator printed {line!r}"
        yield Started(found[0], at, process)
    finally:
        process.terminate()
        process.communicate(timeout=20)


def pixels(page: Any) -> bytes:
    """Return what the canvas shows: red, green, blue, rows from the top."""
    data = page.evaluate(
        """() => {
            const canvas = document.getElementById('picture');
            const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d');
            copy.drawImage(canvas, 0, 0);
            const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
            let text = '';
            for (let i = 0; i < data.length; i += 4) text += String.fromCharCode(data[i], data[i + 1], data[i + 2]);
            return btoa(text);
        }"""
    )
    return base64.b64decode(data)
