"""Settings of all tests."""

from __future__ import annotations

import os
from collections.abc import Iterator
from typing import Any

import pytest
from hypothesis import settings
from tools.page_server import ARGUMENTS, browser_path

from nodes import ANVIL, PUBLIC, Node, anvil

# The same examples each time, so that a change fails for what it changed; `make fuzz` looks for new ones.
settings.register_profile("same", derandomize=True)
settings.register_profile("new", derandomize=False)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "same"))

#: Chromium finds no host by name, and no address but this machine's.
ALONE = "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1"


@pytest.fixture(scope="session", autouse=True)
def _address_book(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """No test reads or writes the address book of whoever runs it."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("SHACKLED_ADDRESS_BOOK", str(tmp_path_factory.mktemp("book") / "addresses.json"))
        yield


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark tests by the fixtures that they use. Tests with the mark "node" are skipped where there is no anvil."""
    for item in items:
        fixtures: list[str] = getattr(item, "fixturenames", [])
        for name in {"browser", "node", "running_node"}.intersection(fixtures):
            item.add_marker(name.removeprefix("running_"))
        if ANVIL is None and item.get_closest_marker("node"):
            item.add_marker(pytest.mark.skip(reason="anvil is not installed: npm ci in contracts/"))


@pytest.fixture(scope="module")
def running_node(request: pytest.FixtureRequest) -> Iterator[Node]:
    """An anvil for the tests of a file, which may set NODE_OPTIONS to options of its command line."""
    with anvil(*getattr(request.module, "NODE_OPTIONS", PUBLIC)) as started:
        yield started


@pytest.fixture
def node(running_node: Node) -> Iterator[Node]:
    """The anvil of the file; what a test does to its chain is undone after it."""
    before = running_node.rpc("evm_snapshot")
    yield running_node
    running_node.rpc("evm_revert", before)


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    """Chromium, which finds no host but this machine. Of a module: beside it, no test can use a loop of asyncio."""
    sync_api = pytest.importorskip("playwright.sync_api", reason="the tests of pages need playwright")
    if browser_path() is None:
        pytest.skip("the tests of pages need chromium: apt-get install chromium")
    with sync_api.sync_playwright() as driver:
        chromium = driver.chromium.launch(executable_path=browser_path(), args=[*ARGUMENTS, ALONE])
        yield chromium
        chromium.close()
