"""Bytes of a contract by the function that they belong to."""

from __future__ import annotations

import json

from tools import build_contracts
from tools.build_contracts import function_sizes

from shackled.artifacts import artifact, contracts


def test_bytes_are_counted_for_their_function() -> None:
    """By hand: pushed values belong to their instruction, and an empty field repeats the one before."""
    sources = {"0": {"name": "a.sol", "functions": [["A.g", 50, 10], ["A.f", 10, 20]]}}
    # PUSH2 in f, PUSH1 in g; ADD before any function, DUP1 between the two, STOP behind both; two of no source
    code = bytes.fromhex("610102600301800050fe")
    entries = "10:5:0:-;59:1;9;30;60;1:1:-1;10"
    assert function_sizes(code, entries, sources) == {"A.f": 3, "A.g": 2, "a.sol": 3, "compiler": 2}


def test_every_byte_is_counted() -> None:
    maps = json.loads((build_contracts.ARTIFACTS / build_contracts.SOURCE_MAPS).read_text("utf-8"))
    for name in contracts():
        code = artifact(name).runtime
        counted = function_sizes(code, maps["contracts"][name]["map"], maps["sources"])
        assert counted.total() == len(code)
        # most of it is ours
        assert counted["compiler"] < 0.4 * len(code), name
