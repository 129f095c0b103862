"""The Creator in browsers: as files from a plain server, and as one file from disk. Nothing else can be reached."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import pytest
from tools.page_server import ONE, PAGE, Static, static

from creator_page import PATIENCE, Creator, Visit, link


@pytest.fixture(scope="session")
def server() -> Iterator[Static]:
    """The page as files."""
    if not PAGE.exists():
        pytest.skip("the page is not built: make page")
    with static() as served:
        yield served


@pytest.fixture
def visit(browser: Any, server: Static, tmp_path: Path) -> Iterator[Visit]:
    """Opens the page. At the end of the test nothing must have gone wrong in it, and nothing been asked of others."""
    contexts: list[Any] = []
    faults: list[str] = []
    known = ["data:", "blob:", "file:", server.address]

    def check(url: str) -> None:
        if not url.startswith(tuple(known)):
            faults.append(f"asked for {url}")

    def open_page(
        place: dict[str, Any] | str = "",
        *,
        disk: bool = False,
        allowed: str = "",
        nodes: Sequence[str] = (),
        script: str = "",
        width: int = 1280,
        height: int = 800,
        wait: bool = True,
        context: Any = None,
        **options: Any,
    ) -> Creator:
        """place: a scene, or what follows the address. disk: the single file. allowed: what the console may say.

        nodes: addresses that the visitor names. context: of another page, to open a tab beside it.
        """
        known.extend(nodes)

        def listen(message: Any) -> None:
            if message.type in ("error", "warning") and not (allowed and allowed in message.text):
                faults.append(message.text)

        if context is None:
            context = browser.new_context(viewport={"width": width, "height": height}, **options)
            contexts.append(context)
            context.set_default_timeout(1000 * PATIENCE)
            context.on("console", listen)
            context.on("request", lambda request: check(request.url))
            context.on("weberror", lambda error: faults.append(str(error.error)))
            if script:
                context.add_init_script(script)
        page = context.new_page()
        page.goto((ONE.as_uri() if disk else server.address) + (place if isinstance(place, str) else link(place)))
        found = Creator(page)
        if wait:
            found.settle()
        return found

    yield open_page
    for context in contexts:
        context.close()
    assert not faults
