"""Settings of all tests."""

from __future__ import annotations

import os
from collections.abc import Iterator
from typing import Any

import pytest
from hypothesis import settings
from tools.page_server import ARGUMENTS, browser_path

from nodes import PUBLIC, Node, anvil

# The same examples each time, so that a change fails for what it changed; `make fuzz` looks for new ones.
settings.register_profile("same", derandomize=True)
settings.register_profile("new", derandomize=False)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "same"))


@pytest.fixture(scope="session", autouse=True)
def _address_book(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """No test reads or writes the address book of whoever runs it."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("SHACKLED_ADDRESS_BOOK", str(tmp_path_factory.mktemp("book") / "addresses.json"))
        yield


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
    """Chromium, for tests that skip where it is not installed."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as driver:
        chromium = driver.chromium.launch(executable_path=browser_path(), args=list(ARGUMENTS))
        yield chromium
        chromium.close()
