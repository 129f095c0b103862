"""Make faulty versions of the contract Editions, and check that its tests detect each.

    python -m tools.tokens.mutants           all of them, about twenty minutes
    python -m tools.tokens.mutants WORD ...  those whose code contains one of the words

Prints one line for each: `killed`, with the test that failed, or `SURVIVED`. Exit code 1 if one survived. A text that
the source does not contain exactly once is an error, so that the list follows the contract.
"""

from __future__ import annotations

import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path
from unittest.mock import patch

import pytest

from shackled.artifacts import artifact
from tools import build_contracts as tool
from tools.tokens import world

CONTRACT = "tokens/Editions.sol"
TESTS = (
    "tests/tokens/test_editions.py",
    "tests/tokens/test_editions_invariants.py",
    "tests/tokens/test_metadata_fields.py",
)

#: By source: the code, and what a mutant has instead.
MUTANTS = {
    CONTRACT: [
        ("if (edition > type(uint24).max) revert TooManyEditions(edition);", ""),
        ("edition > type(uint24).max", "edition >= type(uint24).max"),
        ("bytes(name_).length == 0 || ", ""),
        (" || bytes(name_).length > MAX_NAME", ""),
        ("if (valid != bytes(name_).length) revert NameNotUtf8(valid);", ""),
        ("if (supply == 0) revert NoSupply();", ""),
        ("if (royalty > HIGHEST_ROYALTY) revert Royalty(royalty, HIGHEST_ROYALTY);", ""),
        ("if (copies > MOST_AT_ONCE) revert Quantity(copies, MOST_AT_ONCE);", ""),
        ("if (copies > supply) revert NothingLeft(copies, supply);", ""),
        ("        draw(edition, scene);\n", ""),
        ("        draw(edition, scene);\n", "        studio.check(scene);\n"),
        ("staticcall(DRAWING_GAS,", "staticcall(gas(),"),
        ("        revert DrawingOutOfGas(scene, DRAWING_GAS);\n", ""),
        ("        if (available - gasleft() < limit / 2) revert NotAScene(scene);\n", ""),
        ("available < DRAWING_GAS ? available : DRAWING_GAS", "DRAWING_GAS"),
        ("        known(edition);\n", ""),
        ("if (it.model) fields", "fields"),
        ('if (it.model) fields = string.concat(fields, Json.field("animation_url", studio.glbDataURI(it.scene)));', ""),
        ("Json.picture(address(studio), it.scene, it.scale)", "Json.picture(address(studio), it.scene, 1)"),
        ("Edition(msg.sender, price, supply, copies, copies,", "Edition(msg.sender, price, supply, copies, 0,"),
        ("Edition(msg.sender, price, supply, copies, copies,", "Edition(msg.sender, price, supply, 0, 0,"),
        ("if (copies != 0) hand(edition, copies);", "if (copies != 0) hand(0, copies);"),
        ("Edition storage it = ofCaller(edition);", "Edition storage it = known(edition);"),
        ("if (it.closed) revert AlreadyClosed(edition);\n        it.closed = true;", "it.closed = true;"),
        ("        it.closed = true;\n", ""),
        ("Edition storage it = ofCaller(ofEditions[k]);", "Edition storage it = known(ofEditions[k]);"),
        ("            it.settled = it.minted;\n", ""),
        ("it.settled = it.minted;", "it.settled = it.supply;"),
        ("amount += unsettled(it);", "amount = unsettled(it);"),
        ("if (!done) revert WithdrawalRefused(to, amount);", ""),
        ("bool done = to != address(0);", "bool done = true;"),
        ("call(gas(), to, amount, 0, 0, 0, 0)", "call(gas(), to, selfbalance(), 0, 0, 0, 0)"),
        ("quantity == 0 || quantity > MOST_AT_ONCE", "quantity == 0"),
        ("quantity == 0 || quantity > MOST_AT_ONCE", "quantity > MOST_AT_ONCE"),
        ("if (msg.value != due)", "if (msg.value < due)"),
        ("if (msg.value != due)", "if (msg.value > due)"),
        ("if (it.closed) revert AlreadyClosed(edition);\n        uint256 available", "uint256 available"),
        ("if (quantity > available) revert NothingLeft(quantity, available);", ""),
        ("if (quantity > available)", "if (quantity >= available)"),
        ("        it.minted += uint32(quantity);\n", ""),
        (
            "it.minted += uint32(quantity);\n        hand(edition, quantity);",
            "hand(edition, quantity);\n        it.minted += uint32(quantity);",
        ),
        ("_safeMint(msg.sender, quantity);", "_mint(msg.sender, quantity);"),
        ("from == address(0) ? minting : previous", "minting"),
        ("return it.closed ? 0 : it.supply - it.minted;", "return it.supply - it.minted;"),
        ("uint256(it.minted - it.settled) * it.price", "uint256(it.minted) * it.price"),
        ("if (it.artist != msg.sender) revert NotTheArtist(edition, it.artist, msg.sender);", ""),
        ("Strings.escapeJSON(it.name)", "it.name"),
        ('it.supply == OPEN ? "open" : ', ""),
        ("salePrice * it.royalty / 10_000", "salePrice / 10_000 * it.royalty"),
        ("interfaceId == type(IERC2981).interfaceId || ", ""),
        ("if (!_exists(tokenId)) revert URIQueryForNonexistentToken();", ""),
        ("if (msg.value != 0) revert PaymentForNothing(msg.value);\n        super", "super"),
        ("if (from != address(0) && msg.value != 0) revert PaymentForNothing(msg.value);", ""),
        ("if (address(studio_).code.length == 0) revert NoStudio(address(studio_));", ""),
    ],
    "tokens/Utf8.sol": [
        ("if (next >> 6 != 2) return place;", ""),
        (" || first > 0xf4", ""),
        ("character < 0x800", "false"),
        ("character < 0x10000", "false"),
        ("character > 0x10ffff", "false"),
    ],
}


def compiled(name: str, source: str) -> dict[str, object]:
    """Return ABI and creation code of Editions with another text of a source."""
    sources = tool.read_sources(["Editions"]) | {name: source}
    outputs = {CONTRACT: {"Editions": ["abi", "evm.bytecode.object"]}}
    # what is broken has unused variables, and functions that could be stricter
    with patch.object(tool, "HARMLESS", tool.HARMLESS | {"2018", "2072", "5667"}):
        built = tool.run_compiler(json.dumps(tool.request(sources, tool.settings_of("Editions"), outputs)))
    output = built["contracts"][CONTRACT]["Editions"]
    return {"abi": output["abi"], "creation": output["evm"]["bytecode"]["object"]}


def run_tests(file: str) -> int:
    """Run the tests with a mutant in place of the contract."""
    mutant = json.loads(Path(file).read_text("utf-8"))
    built = world.Built(mutant["abi"], bytes.fromhex(mutant["creation"]))
    with patch.object(world, "artifact", lambda name: built if name == "Editions" else artifact(name)):
        return pytest.main(["-x", "-q", "--tb=no", "-p", "no:cacheprovider", *TESTS])


def main() -> int:
    """Try all mutants, or those that are named."""
    if sys.argv[1:2] == ["--run"]:
        return run_tests(sys.argv[2])
    survived = 0
    for source, old, new in ((source, *change) for source, changes in MUTANTS.items() for change in changes):
        original = (tool.SOURCES / source).read_text("utf-8")
        if sys.argv[1:] and not any(word in old + new for word in sys.argv[1:]):
            continue
        if original.count(old) != 1:
            raise SystemExit(f"{source} does not contain this exactly once: {old}")
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder, "mutant.json")
            file.write_text(json.dumps(compiled(source, original.replace(old, new))), "utf-8")
            command = [sys.executable, "-m", "tools.tokens.mutants", "--run", str(file)]
            result = subprocess.run(command, capture_output=True, text=True, cwd=tool.ROOT)
        failed = re.search(r"^(?:FAILED|ERROR) \S*::(\S+)", result.stdout, re.M)
        survived += result.returncode == 0
        verdict = "SURVIVED" if result.returncode == 0 else f"killed by {failed[1] if failed else result.stdout[-200:]}"
        print(f"{verdict}: {' '.join(old.split())[:70]} -> {' '.join(new.split())[:70] or 'nothing'}", flush=True)
    print(f"{survived} survived")
    return int(survived > 0)


if __name__ == "__main__":
    sys.exit(main())
