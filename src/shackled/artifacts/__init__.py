"""The compiled contracts, from the JSON files in this folder, which tools/build_contracts.py writes."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from functools import cache, cached_property
from hashlib import sha256
from importlib.resources import files
from pathlib import Path
from typing import Any

from ..errors import InputError
from ..ethereum._abi import SOLIDITY_ERRORS, Errors, Interface, error_table

#: The contracts that render.
RENDERER = (
    "Engine",
    "FragmentEngine",
    "AntialiasedEngine",
    "AntialiasedFragmentEngine",
    "AntialiasedSmoothEngine",
    "EffectsEngine",
    "Effects",
    "Renderer",
)

#: What the compiler is asked for; it does not change the bytecode.
OUTPUTS = ["abi", "metadata", "evm.bytecode.object", "evm.deployedBytecode.object", "evm.methodIdentifiers"]

#: Where sources are: in a wheel; in a checkout, the contracts and the libraries, which npm installs.
_HERE = Path(__file__).parent
SOURCES = (_HERE / "sources", *(_HERE.parents[2] / "contracts" / name for name in ("src", "node_modules")))


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
            # a contract, or the interface that it inherits
            re.sub(r"^contract I?(?=[A-Z][a-z])", "", parameter["internalType"])
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
    return sorted(names - {"source-maps"})


@cache
def source(path: str) -> str | None:
    """Return the text of a source of the contracts or of a library; None for one of a library that is not installed."""
    found = next((folder / path for folder in SOURCES if (folder / path).is_file()), None)
    return None if found is None else found.read_text("utf-8")


def standard_input(group: str) -> dict[str, Any]:
    """Return the standard JSON input from which the compiler makes the contracts of a group, every source included.

    Raises InputError if a source is not installed, or is not the one of which the contracts were made.
    """
    built = [_read(name) for name in contracts() if artifact(name).group == group]
    selection = {each["source"]: {each["contract"]: OUTPUTS} for each in built}
    digests = {path: digest for each in built for path, digest in each["sources"].items()}
    texts = {path: source(path) for path in sorted(digests)}
    for path, text in texts.items():
        if text is None:
            again = "" if SOURCES[1].is_dir() else " of the clone, install Shackled from it"
            raise InputError(f"the source {path}, of a library, is not installed: run npm ci in contracts/{again}")
        if sha256(text.encode()).hexdigest() != digests[path]:
            raise InputError(f"{path} has changed: run tools/build_contracts.py --group {group}")
    return {
        "language": "Solidity",
        "settings": built[0]["settings"] | {"outputSelection": selection},
        "sources": {path: {"content": text} for path, text in texts.items()},
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
