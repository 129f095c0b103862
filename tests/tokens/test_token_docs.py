"""The contract of docs/tokens.md compiles."""

from __future__ import annotations

from pathlib import Path

from tools import build_contracts as tool

from compiler import needs_compiler

PAGE = Path(__file__).resolve().parents[2] / "docs" / "tokens.md"
HEAD = """// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;
import {Collection, Terms} from "./Collection.sol";
import {Rounds} from "./Rounds.sol";
"""
LEFT_OUT = 'function contractURI() external pure override returns (string memory) { return ""; }'


@needs_compiler
def test_the_contract_of_the_documentation_compiles() -> None:
    code = PAGE.read_text("utf-8").split("```solidity\n")[1].split("```")[0]
    comment = next(line for line in code.splitlines() if "contractURI likewise" in line)
    sources = tool.read_sources(["GenesisCollection"]) | {"tokens/Mine.sol": HEAD + code.replace(comment, LEFT_OUT)}
    outputs = {"tokens/Mine.sol": {"*": ["abi", "evm.deployedBytecode.object"]}}
    request = tool.request(sources, tool.settings_of("GenesisCollection"), outputs)
    built = tool.compile_once(request)["tokens/Mine.sol"]["MyCollection"]
    assert 0 < len(built["evm"]["deployedBytecode"]["object"]) // 2 <= tool.MAX_RUNTIME_SIZE
    assert {"mint", "reveal", "seedOf"} <= {entry.get("name") for entry in built["abi"]}
