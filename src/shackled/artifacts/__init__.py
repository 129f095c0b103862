"""The compiled contracts; tools/build_contracts.py writes the JSON files beside this one."""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any

from ..ethereum import keccak256

#: What draws: the others are for those who want them.
RENDERER = ("Engine", "FragmentEngine", "Renderer")


@dataclass(frozen=True)
class Artifact:
    """A compiled contract.

    group: of contracts that are compiled together, such as "core".
    creation: what deploys it, to be followed by the arguments of the constructor.
    runtime: what stands on the chain then, but for immutable values.
    parts: the contracts whose addresses the constructor asks for.
    selectors: of each function, by its name.
    errors: name and parameters (name, type) of each error, by its selector.
    """

    name: str
    group: str
    abi: list[dict[str, Any]]
    creation: bytes
    runtime: bytes
    parts: list[str]
    selectors: dict[str, bytes]
    errors: dict[bytes, tuple[str, list[tuple[str, str]]]]

    @property
    def functions(self) -> dict[bytes, str]:
        """The name of each function, by its selector."""
        return {selector: name for name, selector in self.selectors.items()}


@cache
def artifact(name: str) -> Artifact:
    """The contract of that name."""
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
        errors=dict(map(_error, (entry for entry in data["abi"] if entry["type"] == "error"))),
    )


def contracts(group: str | None = None) -> list[str]:
    """The names of all compiled contracts, or of those of a group."""
    names = (file.name.removesuffix(".json") for file in files(__package__).iterdir() if file.name.endswith(".json"))
    found = sorted(name for name in names if not name.startswith(("standard-input", "source-maps")))
    return [name for name in found if group is None or artifact(name).group == group]


def _error(entry: dict[str, Any]) -> tuple[bytes, tuple[str, list[tuple[str, str]]]]:
    parameters = [(parameter["name"], parameter["type"]) for parameter in entry["inputs"]]
    signature = f"{entry['name']}({','.join(kind for _, kind in parameters)})"
    return keccak256(signature.encode())[:4], (entry["name"], parameters)
