"""The compiled contracts; tools/build_contracts.py writes the JSON files beside this one."""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cache, cached_property
from importlib.resources import files
from typing import Any

from ..ethereum import SOLIDITY_ERRORS, Errors, Interface, error_table

#: The contracts that draw.
RENDERER = ("Engine", "FragmentEngine", "Renderer")


@dataclass(frozen=True)
class Artifact:
    """A compiled contract.

    group: of contracts that are compiled together, such as "core".
    creation: what deploys it, to be followed by the arguments of the constructor.
    runtime: what stands on the chain then, but for immutable values.
    parts: the contracts whose addresses the constructor asks for.
    selectors: of each function, by its name.
    """

    name: str
    group: str
    abi: list[dict[str, Any]]
    creation: bytes
    runtime: bytes
    parts: list[str]
    selectors: dict[str, bytes]

    @cached_property
    def interface(self) -> Interface:
        """The functions of the contract, to encode calls and decode answers."""
        return Interface(self.abi)

    @cached_property
    def errors(self) -> Errors:
        """Name and parameters (name, type) of each error, by its selector."""
        return error_table(self.abi)


@cache
def artifact(name: str) -> Artifact:
    """Return the compiled contract of that name."""
    data = json.loads(files(__package__).joinpath(f"{name}.json").read_text("utf-8"))
    return Artifact(
        name=name,
        group=data["group"],
        abi=data["abi"],
        creation=bytes.fromhex(data["bytecode"]),
        runtime=bytes.fromhex(data["deployedBytecode"]),
        parts=[
            parameter["internalType"].removeprefix("contract ")
            for entry in data["abi"]
            if entry["type"] == "constructor"
            for parameter in entry["inputs"]
            if parameter["internalType"].startswith("contract ")
        ],
        selectors={
            signature.split("(")[0]: bytes.fromhex(value) for signature, value in data["methodIdentifiers"].items()
        },
    )


def contracts(group: str | None = None) -> list[str]:
    """Return the names of all compiled contracts, or of those of a group."""
    names = (file.name.removesuffix(".json") for file in files(__package__).iterdir() if file.name.endswith(".json"))
    found = sorted(name for name in names if not name.startswith(("standard-input", "source-maps")))
    return [name for name in found if group is None or artifact(name).group == group]


@cache
def known_errors() -> Errors:
    """Return the errors of all contracts, since each passes on those of the contracts that it calls."""
    errors = dict(SOLIDITY_ERRORS)
    for name in contracts():
        errors |= artifact(name).errors
    return errors
