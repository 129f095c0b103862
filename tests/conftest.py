"""Settings of all tests."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, settings
from tools.page_server import browser_path, chromium

from nodes import ANVIL, PUBLIC, Node, anvil
from pictures import chain
from shackled.chain._opening import _opened

# The same examples each time, so that a change fails for what it changed; `make fuzz` looks for new ones.
# A busy machine is not a fault of a test.
PATIENT = settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.register_profile("same", PATIENT, derandomize=True)
settings.register_profile("new", PATIENT, derandomize=False)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "same"))

#: Chromium finds no host by name, and no address but this machine's.
ALONE = "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1"


@pytest.fixture(scope="session", autouse=True)
def _address_book(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """No test reads or writes the address book of whoever runs it."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("SHACKLED_ADDRESS_BOOK", str(tmp_path_factory.mktemp("book") / "addresses.json"))
        yield


#: Files and folders whose tests take some seconds of a processor together: all are slow.
SLOW = (
    "bench",
    "cli/test_app.py",
    "cli/test_render.py",
    "cli/test_render_parallel.py",
    "cli/test_several.py",
    "cli/test_streams.py",
    "conformance",
    "contracts/test_antialiasing.py",
    "contracts/test_brightness.py",
    "contracts/test_golden.py",
    "contracts/test_random_scenes.py",
    "contracts/test_runs.py",
    "contracts/test_smooth_light.py",
    "contracts/test_tile_culling.py",
    "contracts/test_tile_gas.py",
    "contracts/test_tiles.py",
    "evm",
    "gas/test_blocks.py",
    "judge",
    "library/test_library.py",
    "package",
    "page",
    "parallel/test_cluster.py",
    "parallel/test_job.py",
    "parallel/test_strips.py",
    "preview/test_needs.py",
    "preview/test_preview.py",
    "preview/test_stored_scenes.py",
    "scene/test_canvas.py",
    "scene/test_decode.py",
    "scene/test_restored.py",
    "scene/test_scaling.py",
    "studio/test_glb.py",
    "studio/test_studio_gas.py",
    "test_benchmarks.py",
    "test_docs.py",
    "test_examples.py",
    "test_workers.py",
    "tokens/test_editions_invariants.py",
    "tokens/test_invariants.py",
    "tokens/test_reveal.py",
    "tokens/test_token_docs.py",
    "tokens/test_token_gas.py",
    "web/test_encoder.py",
    "web/test_export.py",
    "web/test_web_render.py",
    "web/test_widget.py",
)


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark tests by their file and the fixtures that they use. Tests of a node are skipped where there is no anvil."""
    slow = [Path(__file__).parent / each for each in SLOW]
    assert all(each.exists() for each in slow), "SLOW names a file that is gone"
    for item in items:
        if any(item.path.is_relative_to(each) for each in slow):
            item.add_marker("slow")
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


@pytest.fixture(scope="module", params=["interpreter", "compiled"])
def each_evm(request: pytest.FixtureRequest) -> Iterator[None]:
    """The embedded EVM, whose contracts all run in the interpreter; then one whose contracts are all compiled."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("SHACKLED_EVM", request.param)
        for known in (_opened, chain):
            known.cache_clear()
        yield
    for known in (_opened, chain):
        known.cache_clear()


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    """Chromium, which finds no host but this machine. Of a module: beside it, no test can use a loop of asyncio."""
    pytest.importorskip("playwright.sync_api", reason="the tests of pages need playwright")
    if browser_path() is None:
        pytest.skip("the tests of pages need chromium: apt-get install chromium")
    with chromium(ALONE) as started:
        yield started
