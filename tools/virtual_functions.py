"""Write which contract implements each virtual function of an engine: contracts/README.md.

python -m tools.virtual_functions            writes the table between its marks
python -m tools.virtual_functions --check    writes nothing; fails if it is not up to date
"""

from __future__ import annotations

import re
import sys
from dataclasses import dataclass, field
from functools import cache

from shackled.artifacts import RENDERER
from tools.build_contracts import CONTRACTS, SOURCES
from tools.pages import update

CONTRACT = re.compile(r"^(?:abstract )?contract (\w+)(?: is ([\w, ]+))? \{\n(.*?)^\}", re.M | re.S)
FUNCTION = re.compile(r"^    function (\w+)\([^;{]*?\)([^;{]*)(;|\{\s*\}|\{)", re.M)
COMMAND = "python -m tools.virtual_functions"


@dataclass(frozen=True)
class Contract:
    """bases: the contracts that it inherits. virtual: its functions that others may override. bodies: the functions
    that it implements, and whether they have statements.
    """

    bases: list[str]
    virtual: set[str] = field(default_factory=set)
    bodies: dict[str, bool] = field(default_factory=dict)


@cache
def contracts() -> dict[str, Contract]:
    """Return the contracts of all files, by name."""
    found = {}
    for path in SOURCES.rglob("*.sol"):
        for name, bases, body in CONTRACT.findall(re.sub(r"//.*", "", path.read_text("utf-8"))):
            found[name] = made = Contract(bases.split(", ") if bases else [])
            for function, words, end in FUNCTION.findall(body):
                if "virtual" in words.split():
                    made.virtual.add(function)
                if end != ";":
                    made.bodies[function] = "}" not in end
    return found


@cache
def lineage(name: str) -> type:
    """Return a class that inherits as a contract does: in both languages by C3, in Solidity from the right."""
    return type(name, tuple(map(lineage, reversed(contracts()[name].bases))), {})


def table() -> str:
    """Return the table in Markdown, and how many answers there are."""
    engines = [name for name in RENDERER if name.endswith("Engine")]
    order = {engine: [each.__name__ for each in lineage(engine).__mro__[:-1]] for engine in engines}
    virtual = {engine: set().union(*(contracts()[name].virtual for name in order[engine])) for engine in engines}
    functions = sorted(set().union(*virtual.values()))
    lines = [f"| function | {' | '.join(engines)} |", "|---" * (1 + len(engines)) + "|"]
    count = 0
    for function in functions:
        cells = []
        for engine in engines:
            # others may have a private function of this name
            names = order[engine] if function in virtual[engine] else []
            name = next((name for name in names if function in contracts()[name].bodies), "")
            is_empty = name and not contracts()[name].bodies[function]
            count += bool(is_empty)
            cells.append(f"*nothing* ({name})" if is_empty else name)
        lines.append(f"| `{function}` | {' | '.join(cells)} |")
    sizes = ", ".join(f"{engine} {len(names) - 1}" for engine, names in order.items())
    lines.append(f"\n{len(functions)} functions; {count} times *nothing*. Inherited contracts: {sizes}.")
    return "\n".join(lines)


def main() -> int:
    """Update the page, or check it."""
    return update({CONTRACTS / "README.md": lambda _: table()}, COMMAND, check="--check" in sys.argv[1:])


if __name__ == "__main__":
    sys.exit(main())
