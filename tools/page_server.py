"""Serve the Creator's built page, and say where browsers are that open it."""

from __future__ import annotations

import http.server
import shutil
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from playwright.sync_api import Browser

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


#: The page that tools/build_page.py writes: as files, and as one.
PAGE = Path(__file__).parent.parent / "build" / "page"
ONE = PAGE.parent / "creator.html"


@dataclass
class Static:
    """A server of files. address: of the page. asked: the paths that were asked for, with their queries."""

    address: str
    asked: list[str] = field(default_factory=list)


@contextmanager
def static(folder: Path = PAGE) -> Iterator[Static]:
    """Serve a folder as `python -m http.server` does."""

    class Handler(http.server.SimpleHTTPRequestHandler):
        def log_message(self, format: str, *arguments: Any) -> None:
            served.asked.append(self.path)

    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), partial(Handler, directory=str(folder))) as server:
        served = Static(f"http://127.0.0.1:{server.server_port}/")
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield served
        server.shutdown()


@contextmanager
def chromium(*more: str) -> Iterator[Browser]:
    """Start a browser, which is closed at the end. more: arguments of its command line beside ARGUMENTS."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=browser_path(), args=[*ARGUMENTS, *more])
        yield browser
        browser.close()


def browser_path() -> str | None:
    """Return the path of a browser, or None."""
    return next((path for path in map(shutil.which, BROWSERS) if path), None)
