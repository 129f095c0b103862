"""The Creator in browsers: as files from a plain server, and as one file from disk. Nothing else can be reached."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
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

    def listen(message: Any, allowed: str) -> None:
        if message.type in ("error", "warning") and not (allowed and allowed in message.text):
            faults.append(message.text)

    def open_page(
        place: dict[str, Any] | str = "",
        *,
        disk: bool = False,
        allowed: str = "",
        nodes: Sequence[str] = (),
        script: str = "",
        answer: Callable[..., Any] | None = None,
        book: Any = None,
        width: int = 1280,
        height: int = 800,
        context: Any = None,
        **options: Any,
    ) -> Creator:
        """place: a scene, or what follows the address. disk: the single file. allowed: what the console may say.

        nodes: addresses that the visitor names. answer: a function of Python for scripts. book: the chains of the
        address book. context: of another page, to open a tab beside it.
        """
        known.extend(nodes)
        if context is None:
            context = browser.new_context(viewport={"width": width, "height": height}, **options)
            contexts.append(context)
            context.set_default_timeout(1000 * PATIENCE)
            context.on("console", lambda message: listen(message, allowed))
            context.on("request", lambda request: check(request.url))
            context.on("weberror", lambda error: faults.append(str(error.error)))
            if answer:
                context.expose_function("answer", answer)
            if script:
                context.add_init_script(script)
            if book is not None:
                context.route("**/addresses.json", lambda route: route.fulfill(json={"chains": book}))
        page = Creator(context.new_page())
        page.open((ONE.as_uri() if disk else server.address) + (place if isinstance(place, str) else link(place)))
        page.settle()
        return page

    yield open_page
    for context in contexts:
        context.close()
    assert not faults
