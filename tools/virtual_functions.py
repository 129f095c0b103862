"""Make the table of contracts/README.md of which contract implements each virtual function of an engine."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path
from typing import NamedTuple

from shackled.artifacts import RENDERER
from tools.build_contracts import CONTRACTS, SOURCES
from tools.pages import filled

PAGE = CONTRACTS / "README.md"
CONTRACT = re.compile(r"^(?:abstract )?contract (\w+)(?: is ([\w, ]+))? \{\n(.*?)^\}", re.M | re.S)
FUNCTION = re.compile(r"^    function (\w+)\([^;{]*?\)([^;{]*)(;|\{\s*\}|\{)", re.M)


class Contract(NamedTuple):
    """virtual: the functions that others may override. bodies: those it implements, and whether with statements."""

    bases: list[str]
    virtual: set[str]
    bodies: dict[str, bool]


@cache
def contracts() -> dict[str, Contract]:
    """Return the contracts of all files, by name."""
    found = {}
    for path in SOURCES.rglob("*.sol"):
        for name, bases, body in CONTRACT.findall(re.sub(r"//.*", "", path.read_text("utf-8"))):
            functions = FUNCTION.findall(body)
            virtual = {each for each, words, _ in functions if "virtual" in words.split()}
            bodies = {each: "}" not in end for each, _, end in functions if end != ";"}
            found[name] = Contract(bases.split(", ") if bases else [], virtual, bodies)
    return found


@cache
def lineage(name: str) -> type:
    """Return a class that inherits as a contract does: in both languages by C3, in Solidity from the right."""
    return type(name, tuple(map(lineage, reversed(contracts()[name].bases))), {})


def answer(engine: str, function: str) -> str:
    """Return which contract implements a function in an engine, as a cell of the table."""
    names = [each.__name__ for each in lineage(engine).__mro__[:-1]]
    # others may have a private function of this name
    if not any(function in contracts()[name].virtual for name in names):
        return ""
    name = next(name for name in names if function in contracts()[name].bodies)
    return name if contracts()[name].bodies[function] else f"*nothing* ({name})"


def table() -> str:
    """Return the table in Markdown, and how often the answer is nothing."""
    engines = [name for name in RENDERER if name.endswith("Engine")]
    inherited = {engine: [each.__name__ for each in lineage(engine).__mro__[1:-1]] for engine in engines}
    functions = set().union(*(contracts()[name].virtual for names in inherited.values() for name in names))
    lines = [f"| function | {' | '.join(engines)} |", "|---" * (1 + len(engines)) + "|"]
    for function in sorted(functions):
        lines.append(f"| `{function}` | {' | '.join(answer(engine, function) for engine in engines)} |")
    sizes = ", ".join(f"{engine} {len(names)}" for engine, names in inherited.items())
    count = "\n".join(lines).count("*nothing*")
    lines.append(f"\n{len(functions)} functions; {count} times *nothing*. Inherited contracts: {sizes}.")
    return "\n".join(lines)


def files() -> dict[Path, str]:
    """Return the text of the page, by its path."""
    return {PAGE: filled(PAGE, lambda _: table())}
