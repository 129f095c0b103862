"""Gas by basic block."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from shackled import load
from shackled.artifacts import artifact
from shackled.datasets.genesis import seed_of
from shackled.gas import blocks, functions, render_call, trace

TOOL = Path(__file__).resolve().parents[2] / "tools" / "gas_blocks.py"

pytest.importorskip("eth")


def test_blocks_have_the_gas_of_their_function() -> None:
    root, result = trace("Renderer", render_call(load("tetrahedron")))
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


def test_the_tool() -> None:
    data = (artifact("Genesis").selectors["traits"] + seed_of(0)).hex()
    command = [sys.executable, str(TOOL), "--call", "Genesis", data]
    listed = subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()
    name = listed[1].split()[1]
    told = subprocess.run([*command, name], check=True, capture_output=True, text=True).stdout.splitlines()
    assert told[0] == listed[0]
    assert told[-1] == f"{listed[1].split()[0]} gas in {name}"
    assert all(" x " in line and " gas  " in line for line in told[1:-1])
    wrong = subprocess.run([*command, "Nothing.such"], capture_output=True, text=True)
    assert (wrong.returncode, wrong.stderr) == (1, "Nothing.such was not called in Genesis\n")
