"""Files with which a block explorer verifies the sources of contracts."""

from __future__ import annotations

import json
from collections.abc import Sequence
from importlib.resources import files
from pathlib import Path

from ..artifacts import standard_input
from ..errors import InputError
from ..ethereum import checksum_address
from ..whole_file import make_output_folder, write_output
from ._contract import Deployment

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
