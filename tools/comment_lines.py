"""Check that lines of documentation change no byte of a contract.

    python -m tools.comment_lines                     all groups: minutes each
    python -m tools.comment_lines --group engine      one of them

Inserts `/// @dev x.` before declarations without documentation, at random places of the sources of a group, all at
once, and compares with the artifacts. Such a line is a node of the syntax tree: it moves the numbers of all nodes
behind it, which are part of the names by which the optimizer orders functions. If bytes differ, look at functions that
are called with literals, for each of which there is a copy (see ZERO_SLOT in contracts/src/words/Memory.sol).
"""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Callable
from random import Random
from typing import Any

from shackled.artifacts import artifact, standard_input
from tools import build_contracts

#: What may have documentation, at the beginning of a line; functions of assembly have more indentation.
DECLARATION = re.compile(
    r"(?: {4})?(?:(?:abstract contract|contract|library|interface|struct|error|event|modifier|function) \w+"
    r"|constructor\b|(?:u?int|bytes|address|bool|string)\d* (?:\w+ )*constant\b)"
)
#: Lines that are inserted.
COUNT = 20

Compiler = Callable[[dict[str, Any]], dict[str, Any]]


def places(text: str) -> list[int]:
    """Return the lines, from 0, before which a line of documentation adds one to what had none."""
    lines = text.split("\n")
    documented = (line.lstrip().startswith(("///", "*")) for line in ["", *lines])
    return [
        i for i, (line, has) in enumerate(zip(lines, documented, strict=False)) if DECLARATION.match(line) and not has
    ]


def commented(sources: dict[str, str], count: int, random: Random) -> dict[str, str]:
    """Return sources with so many lines of documentation at random places of our own, not of libraries."""
    every = {name: places(text) for name, text in sources.items() if (build_contracts.SOURCES / name).is_file()}
    own = sorted(name for name, lines in every.items() if lines)
    chosen: set[tuple[str, int]] = set()
    while len(chosen) < min(count, sum(map(len, every.values()))):
        # what moves is what stands in later files: each file as often
        name = random.choice(own)
        chosen.add((name, random.choice(every[name])))
    made = {name: text.split("\n") for name, text in sources.items()}
    for name, line in sorted(chosen, reverse=True):
        indent = "    " if made[name][line].startswith(" ") else ""
        made[name].insert(line, f"{indent}/// @dev x.")
    return {name: "\n".join(lines) for name, lines in made.items()}


def changes(group: str, compiler: Compiler, count: int = COUNT, seed: int = 1) -> list[str]:
    """Return a line for each contract of a group whose bytes the inserted lines change.

    compiler: returns the contracts that it makes of a request, by source and name. Raises InputError if the artifacts
    are not those of the sources.
    """
    asked = standard_input(group)
    sources = {name: source["content"] for name, source in asked["sources"].items()}
    made = commented(sources, count, Random(seed))
    selection = {
        name: {contract: ["evm.bytecode.object", "evm.deployedBytecode.object"] for contract in of}
        for name, of in asked["settings"]["outputSelection"].items()
    }
    lines = []
    for outputs in compiler(build_contracts.request(made, asked["settings"], selection)).values():
        for name, output in outputs.items():
            old, new = (
                artifact(name),
                {kind: output["evm"][kind]["object"] for kind in ("bytecode", "deployedBytecode")},
            )
            if (old.creation.hex(), old.runtime.hex()) != (new["bytecode"], new["deployedBytecode"]):
                lines.append(f"{name} has other bytes: {len(new['deployedBytecode']) // 2:,}, not {len(old.runtime):,}")
    return lines


def main() -> int:
    """Check one group or all."""
    parser = argparse.ArgumentParser(description="Check that lines of documentation change no byte of a contract.")
    parser.add_argument("--group", choices=tuple(build_contracts.GROUPS), help="only this group")
    parser.add_argument("--count", type=int, default=COUNT, help="lines that are inserted (%(default)s)")
    parser.add_argument("--seed", type=int, default=1, help="of the random places (%(default)s)")
    options = parser.parse_args()
    failed = 0
    for group in (options.group,) if options.group else build_contracts.GROUPS:
        found = changes(group, compile_now, options.count, options.seed)
        print(f"{group}: {'; '.join(found) or 'the same bytes'}", flush=True)
        failed += bool(found)
    return failed and 1


def compile_now(request: dict[str, Any]) -> dict[str, Any]:
    """Return what the compiler makes of a request."""
    contracts: dict[str, Any] = build_contracts.run_compiler(build_contracts._text(request))["contracts"]
    return contracts


if __name__ == "__main__":
    sys.exit(main())
