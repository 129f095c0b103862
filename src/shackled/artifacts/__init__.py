"""The compiled contracts, from the JSON files in this folder, which tools/build_contracts.py writes."""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cache, cached_property
from importlib.resources import files
from typing import Any

from ..ethereum import SOLIDITY_ERRORS, Errors, Interface, error_table

#: The contracts that render.
RENDERER = (
    "Engine",
    "FragmentEngine",
    "AntialiasedEngine",
    "AntialiasedFragmentEngine",
    "EffectsEngine",
    "Effects",
    "Renderer",
)

#: What the compiler is asked for; it does not change the bytecode.
OUTPUTS = ["abi", "metadata", "evm.bytecode.object", "evm.deployedBytecode.object", "evm.methodIdentifiers"]


@dataclass(frozen=True)
class Artifact:
    """A compiled contract.

    group: contracts that are compiled together, such as "core". creation: creation code, without constructor arguments.
    runtime: code after deployment, with zeros for immutable values. parts: contracts whose addresses the constructor
    takes. selectors: selectors of the functions, by name.
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
        """Interface that encodes calls and decodes results."""
        return Interface(self.abi)

    @cached_property
    def errors(self) -> Errors:
        """Name and parameters (name, type) of each error, by selector."""
        return error_table(self.abi)


@cache
def artifact(name: str) -> Artifact:
    """Return the compiled contract of a name."""
    data = _read(name)
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


def contracts() -> list[str]:
    """Return the names of all compiled contracts."""
    names = {file.name.removesuffix(".json") for file in files(__package__).iterdir() if file.name.endswith(".json")}
    return sorted(names - {"sources", "source-maps"})


@cache
def sources() -> dict[str, str]:
    """Return the texts of the sources of all contracts, by path, those of libraries too."""
    return _read("sources")


def standard_input(group: str) -> dict[str, Any]:
    """Return the standard JSON input from which the compiler makes the contracts of a group, every source included."""
    built = [_read(name) for name in contracts() if artifact(name).group == group]
    selection = {each["source"]: {each["contract"]: OUTPUTS} for each in built}
    paths = sorted({path for each in built for path in each["sources"]})
    return {
        "language": "Solidity",
        "settings": built[0]["settings"] | {"outputSelection": selection},
        "sources": {path: {"content": sources()[path]} for path in paths},
    }


def _read(name: str) -> dict[str, Any]:
    data: dict[str, Any] = json.loads(files(__package__).joinpath(f"{name}.json").read_text("utf-8"))
    return data


@cache
def known_errors() -> Errors:
    """Return the errors of all contracts, since a contract passes on those of contracts that it calls."""
    errors = dict(SOLIDITY_ERRORS)
    for name in contracts():
        errors |= artifact(name).errors
    return errors
