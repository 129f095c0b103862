"""Contracts that can be deployed: address, code and gas before the deployment, and files that verify their sources."""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path

from ..artifacts import RENDERER, artifact, standard_input
from ..base.whole_file import make_output_folder, write_output
from ..chain._embedded import EmbeddedChain
from ..chain._opening import open_chain
from ..errors import ChainError, InputError
from ..ethereum._encoding import PROXY, SALT, checksum_address, create2_address, intrinsic_gas

#: The contracts that `shackled deploy` deploys by default; each follows those that it calls.
STANDARD = (
    *RENDERER,
    *("Original", "Genesis", "PngEncoder", "Turntable", "GlbEncoder", "Studio", "Library", "Web", "Editions"),
)
#: All contracts that `shackled deploy` can deploy.
CONTRACTS = (*STANDARD, "GenesisMetadata")

#: The runtime code of the proxy: CREATE2 of the call's data, whose first word is the salt.
PROXY_CODE = bytes.fromhex(
    "7fffffffffffffffffffffffffffffffffffffffffffffffffffffffffffffffe03601600081602082378035828234f5801515603957"
    "8182fd5b8082525050506014600cf3"
)


@dataclass(frozen=True)
class Deployment:
    """A contract that the proxy can deploy.

    creation: creation code followed by constructor arguments. code: runtime code. gas: of the whole transaction.
    """

    name: str
    creation: bytes
    code: bytes
    gas: int

    @property
    def address(self) -> bytes:
        """Address of the contract, 20 bytes, the same on every chain."""
        return create2_address(self.creation)

    @property
    def data(self) -> bytes:
        """Data of the transaction to the proxy."""
        return SALT + self.creation


def deployments(names: Iterable[str] = STANDARD) -> list[Deployment]:
    """Return contracts by name, each after those that it calls, which are added. InputError for unknown names."""
    chosen = list(names)
    for name in chosen:
        if name not in CONTRACTS:
            raise InputError(f"there is no contract {name!r} to deploy; the contracts are {', '.join(CONTRACTS)}")
    return in_order(chosen)


def in_order(names: Iterable[str]) -> list[Deployment]:
    """Return contracts whose constructors take only other contracts, each after those that it calls."""
    chosen: list[str] = []

    def add(name: str) -> None:
        for part in artifact(name).parts:
            add(part)
        if name not in chosen:
            chosen.append(name)

    for name in names:
        add(name)
    local = local_chain()
    return [deployment(name, local.creation(name), chosen[:number], local) for number, name in enumerate(chosen)]


def deployment(name: str, creation: bytes, parts: Sequence[str] = (), local: EmbeddedChain | None = None) -> Deployment:
    """Return a contract of any creation code, after running its constructor in a local EVM with the contracts `parts`.

    name: for messages and the address book. Raises ChainError if the constructor fails.
    """
    local = local_chain() if local is None else local
    for part in parts:
        local.address(part)
    local.put(PROXY, PROXY_CODE)
    data = SALT + creation
    result = local.run(PROXY, data)
    if result.output != create2_address(creation):
        raise ChainError(
            f"the contract {name} could not be deployed: the proxy returned {result.output.hex() or 'nothing'}"
        )
    return Deployment(name, creation, local.create(name, creation), result.gas + intrinsic_gas(data))


def local_chain() -> EmbeddedChain:
    """Return a new embedded EVM, whose state is not shared."""
    return type(open_chain())()


SUMMARY = "contracts.json"


def write_verification(folder: Path, chain_id: int, deployed: Sequence[Deployment]) -> dict[str, str]:
    """Write the compiler's input as standard JSON, and a list of contracts with addresses and constructor arguments.

    Every source is in the input as text, since explorers refuse those that it only names. Returns the contracts that
    are left out, since a source of theirs is not installed, and why.

    Raises InputError or OutputError if the folder cannot be written to.
    """
    contracts, inputs, left_out = [], {}, {}
    artifacts = files("shackled.artifacts")
    for each in deployed:
        built = json.loads(artifacts.joinpath(f"{each.name}.json").read_text("utf-8"))
        # one input for each group of contracts that are compiled together
        name = f"standard-input-{built['group']}.json"
        try:
            inputs[name] = json.dumps(standard_input(built["group"]), indent=1).encode() + b"\n"
        except InputError as error:
            left_out[each.name] = str(error)
            continue
        contracts.append(
            {
                "name": f"{built['source']}:{each.name}",
                "address": checksum_address(each.address),
                "compiler": built["compiler"],
                "standardInput": name,
                "constructorArguments": each.creation[len(built["bytecode"]) // 2 :].hex(),
            }
        )
    summary = json.dumps({"chainId": chain_id, "contracts": contracts}, indent=2) + "\n"
    make_output_folder(folder)
    for name, data in {**inputs, SUMMARY: summary.encode()}.items():
        write_output(folder / name, data)
    return left_out
