"""Gas by basic block."""

from __future__ import annotations

import subprocess
import sys
from functools import cache
from pathlib import Path

import pytest
from tools import gas_blocks
from tools.gas_blocks import blocks, functions

from shackled import load
from shackled.artifacts import artifact
from shackled.datasets.genesis import seed_of
from shackled.gas import render_call
from shackled.gas._trace import trace

ROOT = Path(__file__).resolve().parents[2]

pytest.importorskip("eth")


def test_blocks_have_the_gas_of_their_function() -> None:
    root, result = trace("Renderer", render_call(load("tetrahedron", antialias=False)))
    total = 0
    for contract in ("Renderer", "Engine"):
        for name, gas in functions(root, contract):
            found = blocks(root, contract, name)
            assert sum(block.gas for block in found) == gas
            total += gas
            for block in found:
                # nothing is passed without a price
                assert 0 < block.count <= block.gas
                assert "JUMPDEST" not in block.instructions[1:]
                assert not {"JUMP", "JUMPI", "RETURN"} & set(block.instructions[:-1])
    assert total == result.gas


def test_the_tool(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    call = ["--call", "Genesis", (artifact("Genesis").selectors["traits"] + seed_of(0)).hex()]
    command = [sys.executable, "tools/gas_blocks.py", *call]
    listed = subprocess.run(command, check=True, capture_output=True, text=True, cwd=ROOT).stdout.splitlines()
    # the call is the same each time
    monkeypatch.setattr(gas_blocks, "trace", cache(trace))
    name = listed[1].split()[1]
    assert gas_blocks.main([*call, name]) == 0
    told = capsys.readouterr().out.splitlines()
    assert told[0] == listed[0]
    assert told[-1] == f"{listed[1].split()[0]} gas in {name}"
    assert all(" x " in line and " gas  " in line for line in told[1:-1])
    assert gas_blocks.main([*call, "Nothing.such"]) == 1
    assert capsys.readouterr().err == "Nothing.such was not called in Genesis\n"
