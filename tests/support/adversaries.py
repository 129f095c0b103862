"""The contracts of tests/tokens/contracts, compiled."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest
from tools import build_contracts as tool
from tools.build_contracts import compile_once
from tools.tokens.world import Built

from compiler import MISSING, SOLC

FOLDER = Path(__file__).parents[1] / "tokens" / "contracts"


@cache
def adversary(name: str) -> Built:
    """One of them; the test is skipped where there is no compiler."""
    if name not in _compiled():
        pytest.skip(MISSING)
    return _compiled()[name]


@cache
def _compiled() -> dict[str, Built]:
    if not SOLC.is_dir():
        return {}
    sources = {path.name: path.read_text("utf-8") for path in sorted(FOLDER.glob("*.sol"))}
    request = tool.request(sources, tool.settings(200, True), {"*": {"*": ["abi", "evm.bytecode.object"]}})
    return {
        name: Built(output["abi"], bytes.fromhex(output["evm"]["bytecode"]["object"]))
        for contracts in compile_once(request).values()
        for name, output in contracts.items()
    }
